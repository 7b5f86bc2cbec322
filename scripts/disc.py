# yade-blocks, GPL-2.0-or-later
"""A disc pressed across a diameter (Brazilian test), elastic: the tension in its centre.

A disc of one deformable block, plane stress; a radial pressure on two opposite arcs. It is brought to rest in time steps.

	scripts/run.sh disc [zone=0.002] [arc=10] [key=value ...]        a few seconds

Expected in the centre, with p the pressure and 2a the arc: 2 p (sin 2a - a) / pi across the load, -2 p (sin 2a + a) / pi along it (Hondros 1959); for small a
these are 2 P / (pi D t) and -6 P / (pi D t).
"""
from math import pi, radians, sin

import numpy as np

import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks import loading, pictures, picturesfields, scenario
from yadeblocks.plane import unit
from yadeblocks.engines import loopList
from yadeblocks.export import State, writeStates
from yadeblocks.recording import Recorder
from yadeblocks.scenario import Key
from yadeblocks.session import Session

# ---- parameters (SI)

radius, thickness = 0.05, 0.025 # [m]
rock = dict(young=20e9, poisson=0.2, density=2500)
p = scenario.parameters({
	**scenario.usualParameters(threads=1, tag='', alpha=0.5, plane='stress', vtk=True), 'force': Key(
		10e3, 'total force on each arc', 'N', scenario.positive
	), 'arc': Key(10., 'angle of each loaded arc', 'degrees', (lambda x: 1 <= x <= 60, 'must lie in [1, 60]')),
	'zone': Key(2e-3, 'size of the zones', 'm', (lambda s: 0 < s < radius / 4, 'must be positive and below a quarter of the radius'))
})
half = radians(p.arc) / 2
pressure = p.force / (2 * radius * sin(half) * thickness) # whose sum across the load is the force
across, along = 2 * pressure / pi * (sin(2 * half) - half), -2 * pressure / pi * (sin(2 * half) + half)


def build():
	"""The disc; corners at the ends of the arcs, sides no longer than half a zone there."""
	O.reset()
	O.materials.append(BlockMat(label='rock', **rock))
	model = BlockModel(thickness=thickness, planeStress=p.plane == 'stress')
	loaded = int(max(4, 2 * np.ceil(half * radius / p.zone))) # sides of each arc
	free = int(np.ceil((pi - 2 * half) * radius / p.zone))
	turn = np.concatenate([np.linspace(-half, half, loaded, endpoint=False), np.linspace(half, pi - half, free, endpoint=False)])
	at = pi / 2 + np.concatenate([turn, turn + pi])
	model.addRegion(radius * unit(at), 'rock', zoneSize=p.zone)
	model.bond([])
	ends = model.reference[model.edgeNodes]
	middle = ends.mean(axis=1)
	beside = abs(np.arctan2(middle[:, 0], abs(middle[:, 1]))) < half
	for edge in np.flatnonzero(beside):
		model.traction([edge], tuple(-pressure * middle[edge] / np.hypot(*middle[edge])))
	centre = np.hypot(*model.reference.T).argmin()
	below = np.hypot(model.reference[:, 0], model.reference[:, 1] + radius / 2).argmin()
	model.drive('centre', [centre], 'xy')
	model.drive('below', [below], 'x')
	model.insert()
	O.dt, O.engines = 1e-4, loopList(alpha=p.alpha)
	return model


def centreStress(model):
	"""Mean sxx, syy, sxy of the zones within a twentieth of the radius, by volume [Pa].

	Where zones are too large for that, of those around the innermost grid point."""
	middles = model.reference[model.zoneNodes].mean(axis=1)
	near = np.hypot(*middles.T) < 0.05 * radius
	if not near.any(): near = (model.zoneNodes == np.hypot(*model.reference.T).argmin()).any(axis=1)
	return np.average(model.zoneStress()[near], axis=0, weights=model.zoneVolume[near])


# ---- running

with Session(p) as session:
	with session.run(1) as run:
		with run.stepping():
			model = build()
			record = Recorder(step=lambda: O.iter, stress=lambda: centreStress(model)[0], unbalanced=lambda: model.unbalancedRatio(floor=p.force))
			O.engines += [record.engine(100)]
			loading.settle(model, ratio=1e-6, floor=p.force)
		stress = centreStress(model)
		run.add('centre_stress', 'MPa', stress[0] / 1e6, across / 1e6, 'Hondros 1959')
		run.add('centre_stress_along', 'MPa', stress[1] / 1e6, along / 1e6, 'Hondros 1959')
		run.curve(step=record['step'], centre_stress_MPa=record['stress'] / 1e6, unbalanced=record['unbalanced'])
		run.model(model, steps=O.iter)
		run.quality(unbalanced_ratio_max=record['unbalanced'][-1])
	session.write()
	session.picture('cracks.png', pictures.drawCracks, model, title='Disc under %g kN' % (p.force / 1e3))
	session.picture('stress.png', picturesfields.drawField, model, 'sxx', title='stress across the load')
	session.picture('crosses.png', picturesfields.drawCrosses, model)
	if p.vtk: session.later(writeStates, p.folder, State(model, O.time))
scenario.waitIfBatch()
