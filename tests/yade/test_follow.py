# yade-blocks, GPL-2.0-or-later
"""BlockModel.follow: from event to event, and on in time steps."""
import json
import re
from pathlib import Path

import numpy as np
import pytest

from scenes import *
from yadeblocks import loading
from yadeblocks.specimen import Gauge

scripts = Path(differences.__code__.co_filename).parents[2] / 'scripts'


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


def test_says_how_far_it_is_and_can_be_stopped(monkeypatch):
	model = couplet()
	O.run(1, True)
	seen = []
	path = model.follow('top', progress=lambda *now: seen.append(now) or len(seen) < 5)
	assert path['ended'] == 'stopped' and len(seen) == 5
	assert [now[0] for now in seen] == path['displacement'].tolist() and [now[1] for now in seen] == path['force'].tolist()
	assert [now[2] for now in seen] == path['broken'].tolist() and seen[-1][2] > 0

	class Line(list):
		"""Stands for progress.Progress, which writes only now and then."""
		def __init__(self, total, text, label):
			super().__init__()
			self.total, self.text, self.label = total, text, label
			lines.append(self)

		__enter__ = lambda self: self
		__exit__ = lambda self, *_: None
		__call__ = lambda self, done: self.append((done / self.total, self.text()))

	lines = []
	monkeypatch.setattr(loading.path, 'Progress', Line)
	path = loading.follow(model, 'top', 'a label', displacement=1e-5)
	assert lines[0].label == 'a label' and len(lines[0]) == len(path['force'])
	for (share, text), force, displacement, broken in zip(lines[0], path['force'], path['displacement'], path['broken']):
		assert share == pytest.approx(displacement / 1e-5, abs=1e-3)
		assert text == 'u %.4f mm  force %.4g N  broken %d' % (1e3 * displacement, force, broken)


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
	O.engines = [ForceResetter()] + engines(glued(frictionAngle=0, cohesion=1e12, dilationAngle=0)
						)[:-1] + [NewtonIntegrator(damping=0.3), BlockIntegrator(rescueFile='')]
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


@pytest.mark.parametrize(
	'arguments, peak', [
		(['tension', 'case=TT3'], 'peak_tensile_stress'),
		(['shear', 'size=7e-3', 'afterPeak=false'], 'peak_shear_stress'),
	]
)
def test_scenarios_by_events(tmp_path, arguments, peak):
	"""solver=events: the curve begins near nothing, the strength is not below the first crack, and equilibrium holds to rounding."""
	run = runYade(scripts / (arguments[0] + '.py'), *arguments[1:], 'solver=events', 'vtk=false', cwd=tmp_path)
	assert run.returncode == 0, run.stderr
	result = json.loads((tmp_path / 'out' / arguments[0] / 'result.json').read_text())
	measured = {quantity['name']: quantity['measured'] for quantity in result['quantities']}
	assert result['complete'] and result['cost']['steps'] == 0
	assert measured[peak] >= measured['first_crack_stress'] > 0
	assert result['quality']['unbalanced_ratio_max'] < 1e-10 # 1e6 roundings
	curve = np.genfromtxt(tmp_path / 'out' / arguments[0] / 'curve.csv', delimiter=',', names=True)
	assert abs(curve['stress_MPa'][0]) < 0.01 * measured[peak] # the precompression alone, on lopsided blocks
	assert curve['stress_MPa'].max() == pytest.approx(measured[peak], rel=1e-6)
	assert (np.diff(curve['broken']) >= 0).all()


def test_goes_on_in_time_steps_behind_the_peak(tmp_path):
	"""Shear by events up to the peak, then in steps: the stress does not jump, and comes down to friction."""
	run = runYade(scripts / 'shear.py', 'size=7e-3', 'solver=events', 'stroke=0.3e-3', 'steps=3000', 'vtk=false', cwd=tmp_path)
	assert run.returncode == 0, run.stderr
	curve = np.genfromtxt(tmp_path / 'out' / 'shear' / 'curve.csv', delimiter=',', names=True)
	stress, top = curve['stress_MPa'], np.flatnonzero(curve['exact'])[-1]
	assert stress[top] == stress[:top + 1].max() and len(stress) > top + 10
	assert stress[top + 1] == pytest.approx(stress[top], rel=0.01) # what small displacement left out
	assert 0.5 * 0.5 < stress[-1] < 0.8 * stress[top] # tan 36 degrees x 0.5, more or less


def test_steps_behind_the_path_change_no_strength(tmp_path):
	"""However fast they are: the strength is that of the path, with and without them."""
	strengths, highest = [], []
	for words in ['afterPeak=false'], ['steps=1000']:
		run = runYade(scripts / 'shear.py', 'size=7e-3', 'solver=events', 'stroke=0.3e-3', 'vtk=false', 'sheets=false', *words, cwd=tmp_path)
		assert run.returncode == 0 and 'no peak' not in run.stdout, run.stdout + run.stderr
		found = json.loads((tmp_path / 'out' / 'shear' / 'result.json').read_text())['quantities']
		strengths.append(next(q['measured'] for q in found if q['name'] == 'peak_shear_stress'))
		highest.append(np.genfromtxt(tmp_path / 'out' / 'shear' / 'curve.csv', delimiter=',', names=True)['stress_MPa'].max())
	assert strengths[0] == pytest.approx(strengths[1], rel=1e-9) and strengths[0] == pytest.approx(highest[0], rel=1e-6)
	assert highest[1] > 1.02 * strengths[1] # or the test would show nothing


def test_steps_end_behind_the_peak_where_they_are_asked_to(tmp_path):
	"""Without a residual, and with no neighbours but those that joints bond; the peak is that of the whole run."""
	found = []
	for words in ['afterPeak=false'], []:
		run = runYade(
			scripts / 'shear.py', 'size=7e-3', 'contact=false', 'steps=2000', 'stroke=0.3e-3', 'vtk=false', 'sheets=false', *words, cwd=tmp_path
		)
		assert run.returncode == 0, run.stderr
		result = json.loads((tmp_path / 'out' / 'shear' / 'result.json').read_text())
		found.append({q['name']: q['measured'] for q in result['quantities']} | {'steps': result['cost']['steps']})
	short, whole = found
	assert short['peak_shear_stress'] == whole['peak_shear_stress'] and short['first_crack_point'] == whole['first_crack_point'] >= 0
	assert 'residual_shear_stress' in whole and 'residual_shear_stress' not in short and short['steps'] < whole['steps']


def test_cascades_under_a_held_displacement(tmp_path):
	"""Of this couplet the peak comes behind a snap-back: cascades take a path of their own to it, 0.5 % higher (slow steps: 0.33 % and falling)."""
	peaks = []
	for release in 'path', 'cascade':
		words = ['sigma=1e6', 'seed=3', 'solver=events', 'afterPeak=false', 'vtk=false', 'sheets=false', 'release=' + release]
		run = runYade(scripts / 'shear.py', *words, cwd=tmp_path)
		assert run.returncode == 0, run.stderr
		found = json.loads((tmp_path / 'out' / 'shear' / 'result.json').read_text())['quantities']
		peaks.append(next(q['measured'] for q in found if q['name'] == 'peak_shear_stress'))
	assert peaks == [pytest.approx(1.64332, rel=1e-4), pytest.approx(1.65134, rel=1e-4)]


def test_compression_says_where_events_end(tmp_path):
	"""Small displacement ends early in a prism; from there on there are time steps, and the curve has no gap."""
	words = ['unitSize=0.025', 'mortarSize=0.006', 'solver=events', 'steps=1500', 'stroke=0.6e-3', 'vtk=false', 'sheets=false']
	run = runYade(scripts / 'compression.py', *words, cwd=tmp_path)
	assert run.returncode == 0, run.stderr
	said = re.search(r'from event to event, highest force (\S+) N; the path ends(?:, \S+ % below it)?: (.+)', run.stdout)
	assert said and re.search('blocks|asked|point', said[2])
	curve = np.genfromtxt(tmp_path / 'out' / 'compression' / 'curve.csv', delimiter=',', names=True)
	at = np.flatnonzero(np.isclose(curve['stress_MPa'], float(said[1]) / 0.285**2 / 1e6, rtol=5e-3))[0] # four digits; the section is a square
	assert len(curve) > at + 10 and curve['stress_MPa'][at + 1] == pytest.approx(curve['stress_MPa'][at], rel=0.01)


def test_scenarios_refuse_what_events_have_not(tmp_path):
	for script, words, text in (('tension', ['solver=events', 'halfRate=true'], 'solver=events has no rate'),
					('compression', ['solver=events', 'servo=true'], 'solver=events has no rate')):
		run = runYade(scripts / (script + '.py'), *words, cwd=tmp_path)
		assert run.returncode == 2 and text in run.stderr
