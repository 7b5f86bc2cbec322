# yade-blocks, GPL-2.0-or-later
"""BlockModel.follow: from event to event, and on in time steps."""
import numpy as np
import pytest

from scenes import *
from yadeblocks import loading
from yadeblocks.specimen import Gauge


def test_goes_on_without_a_jump_in_force():
	"""Handed over half-way up, a couplet is pulled on: from step to step the force grows by speed x stiffness, with cracks and without inertia's jolt."""
	model = couplet()
	O.run(1, True)
	gauge = Gauge(model, nodesWhere(model, lambda x, y: abs(y - 0.01) < 1e-9, 'unit'), nodesWhere(model, lambda x, y: abs(y - 0.02) < 1e-9, 'unit'))
	start = gauge()
	path = loading.follow(model, 'top', gauges=[gauge], displacement=2e-6)
	assert path['ended'] == 'displacement' and path['reached'][0] == pytest.approx(2e-6, rel=1e-12)
	assert path['residual'] < 1e-10 and path['inadmissible'] < 1e-9
	assert gauge() - start == pytest.approx(path['gauges'][0][-1], rel=1e-3) # large displacement: strains of 1e-4
	assert model.groupForce('top') == pytest.approx(path['reached'][1], rel=1e-3)
	force, stiffness = model.groupForce('top'), path['reached'][1] / path['reached'][0]
	O.run(2, True) # the forces of the first step are those of the hand-over itself
	grown = model.groupForce('top') - force
	step = model.groupVelocity('top') * O.dt
	assert grown == pytest.approx(stiffness * step, rel=0.1) # softened by no crack; one step more or less of large strain
	O.run(50, True)
	assert model.groupForce('top') - force == pytest.approx(51 * stiffness * step, rel=0.1)


def test_same_peak_and_first_crack_as_slow_loading():
	model = couplet()
	O.run(1, True)
	path = model.follow('top', peak=True)
	exact, first = path['reached'][1], path['crackPoint'][0]
	assert model.groupForce('top') == pytest.approx(exact, rel=1e-3)
	model = couplet(steps=30000, damping='local', alpha=0.8)
	largest, cracked = 0, None
	while O.iter < 30000:
		O.run(50, True)
		largest = max(largest, model.groupForce('top'))
		if cracked is None and (model.pointStatus > 0).any(): cracked = np.flatnonzero(model.pointStatus)
		if cracked is not None and model.groupForce('top') < 0.8 * largest: break
	assert first in cracked
	assert largest == pytest.approx(exact, rel=0.02) # rate and inertia, which fall with slower loading


def test_platens_are_followed_and_leapt_with():
	"""A column glued between a held and a driven platen: sigma = u / (h/E + 2/kn) by both, at poisson 0."""
	materials(poisson=0)
	model = BlockModel(thickness=0.1)
	model.addRegion(rectangle(0, 0, 0.1, 0.2), 'unit', zoneSize=0.03)
	low, high = model.addRigid(rectangle(0, -0.02, 0.1, 0), 'unit'), model.addRigid(rectangle(0, 0.2, 0.1, 0.22), 'unit')
	model.bond()
	model.insert()
	for block, velocity in ((low, 0), (high, 1e-4)):
		O.bodies[model.bodyOf(block)].state.blockedDOFs = 'xyzXYZ'
		O.bodies[model.bodyOf(block)].state.vel = (0, velocity, 0)
	O.dt = 1e-4
	O.engines = [ForceResetter()] + engines(glued(frictionAngle=0, cohesion=1e12, dilationAngle=0))[:-1] + [NewtonIntegrator(damping=0.3), BlockIntegrator(rescueFile='')]
	O.run(1, True)
	compliance = 0.2 / brick['young'] + 2 / glue['kn']
	strength, tension = compliance * glue['tension'], glue['tension']
	jump = model.elasticJump(fraction=0.5)
	assert jump['time'] == pytest.approx(0.5 * (strength / 1e-4), rel=1e-3) # one step was done before
	assert np.asarray(model.pointSigma) == pytest.approx(0.5 * tension, rel=1e-3)
	moved = 1e-4 * O.dt # in the first step; half of what was left comes on top
	assert O.bodies[model.bodyOf(high)].state.pos[1] == pytest.approx(0.21 + moved + 0.5 * (strength - moved), rel=1e-9)
	path = model.follow(high, cracks=1, drop=0)
	assert path['force'].max() == pytest.approx(tension * 0.01, rel=1e-3)
	assert path['force'][0] == pytest.approx(0.5 * tension * 0.01, rel=1e-3)


def test_refusals():
	model = couplet()
	with pytest.raises(RuntimeError, match='no properties yet'):
		model.follow('top')
	O.run(1, True)
	before = np.array(model.position)
	with pytest.raises(RuntimeError, match='"bottom" has no target'):
		model.follow('bottom')
	with pytest.raises(ValueError, match='no motion group "middle"'):
		model.follow('middle')
	with pytest.raises(ValueError, match="'path' or 'cascade', got 'jump'"):
		model.follow('top', release='jump')
	with pytest.raises(ValueError, match='index of a rigid block, got 2'):
		model.follow(2)
	for key, value in (('drop', 1), ('displacement', 0), ('cracks', 0)):
		with pytest.raises(ValueError, match=key):
			model.follow('top', **{key: value})
	assert (model.position == before).all()
	model.release('bottom')
	with pytest.raises(RuntimeError, match='hold them: block'):
		model.follow('top')
