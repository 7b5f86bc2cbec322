# yade-blocks, GPL-2.0-or-later
# needs: python3-scipy
"""Diagonal compression of a small wall (ASTM E519, RILEM LUMB6): shear strength from the largest load along a diagonal.

Two bricks by seven courses, nearly square, bed and head joints without thickness that soften. The wall stands on a corner, as in the machine: one diagonal is
upright. The shoes grip a tenth of each side there; the lower one stands still, the upper one comes down, and nothing holds either sideways, so that the
force acts along the diagonal. Strength is 0.707 P by the mean area of the two sides.

	scripts/run.sh diagonal [key=value ...]        about 10 s

Expected of the strength: limit analysis of the same joints as if they did not soften (yadeblocks.limitanalysis), an upper bound. The joints have the
properties of the wall J4D; there is no measurement of this wall with them. With fracture energies a hundred times as large, GfI=1800 GfII=12500 stroke=3e-3
steps=60000, the strength comes up to the limit; with these the joints break one after the other, far below it. If one bed joint alone could slide, the limit
would be cohesion / (1 - friction).

Expected of the tension in the centre while all is elastic: 0.5 P / A (RILEM, from Frocht 1931, for a body without joints). Joints that are softer in shear than
across raise it.
"""
from math import atan, atan2, cos, pi, sin

import numpy as np

import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks import brickwork, curves, loading, masonry, pictures, picturesfields, scenario
from yadeblocks.engines import loopList
from yadeblocks.export import principalStresses
from yadeblocks.limitanalysis import largestForce
from yadeblocks.pace import Pace
from yadeblocks.recording import Recorder
from yadeblocks.results import Cracks
from yadeblocks.scenario import Key
from yadeblocks.session import Session
from yadeblocks.snapshot import Film

# ---- parameters (SI)

bricks, courses = 2, 7
length, height, gap, thickness, friction, brick, joint = masonry.j4d
p = scenario.parameters({
	**scenario.usualParameters(threads=1, tag='', alpha=0.3, stroke=1e-3, steps=30000), 'cohesion': Key(
		joint['cohesion'], 'cohesion of the joints', 'Pa', scenario.positive
	), 'friction': Key(friction, 'friction coefficient of the joints', rule=(lambda f: 0 <= f < 1, 'must lie in [0, 1): beyond, no bed joint would slide')),
	'tension': Key(joint['tension'], 'tensile strength of the joints', 'Pa',
			scenario.positive), 'kn': Key(joint['kn'], 'normal stiffness of the joints', 'Pa/m',
							scenario.positive), 'ks': Key(joint['ks'], 'shear stiffness of the joints', 'Pa/m', scenario.positive),
	'GfI': Key(joint['GfI'], 'fracture energy in tension', 'N/m',
			scenario.positive), 'GfII': Key(joint['GfII'], 'fracture energy in shear', 'N/m', scenario.positive),
	'zone': Key(0.03, 'size of the zones', 'm', (lambda s: 0 < s <= 0.1, 'must be positive and at most 0.1'))
})
dt = 1e-4 # [s]; masses are scaled to suit
wide, high = bricks * (length + gap), courses * (height + gap)
area = (wide + high) / 2 * thickness
turn = pi / 2 - atan2(high, wide) # from the wall as it is laid, lower left corner in (0, 0), to where its diagonal is upright


def laid(points):
	"""Where points of the turned wall lie in the wall as it is laid [m]."""
	x, y = np.asarray(points, float).T
	return cos(turn) * x + sin(turn) * y, cos(turn) * y - sin(turn) * x


def build():
	"""The wall in its shoes, and its joints by name."""
	O.reset()
	O.materials.append(BlockMat(label='unit', **brick))
	model = BlockModel(thickness=thickness, planeStress=True)
	placed = brickwork.runningBond(bricks, courses, length, height, gap).turned(turn).addTo(model, 'unit', zoneSize=p.zone)
	strengths = dict(cohesion=p.cohesion, tension=p.tension, frictionAngle=atan(p.friction), GfI=p.GfI, GfII=p.GfII)
	joints = placed.bond(model, [JointMat(material1='unit', material2='unit', kn=p.kn, ks=p.ks, **strengths)])
	x, y = laid(model.reference)
	shoe = lambda x, y: np.flatnonzero(((x < 1e-9) & (y < 0.1 * high + 1e-9)) | ((y < 1e-9) & (x < 0.1 * wide + 1e-9))).tolist()
	model.drive('support', shoe(x, y), 'y')
	model.drive('foot', [int(np.hypot(x, y).argmin())], 'x') # it alone, so that nothing is held sideways
	model.drive('shoe', shoe(wide - x, high - y), 'y', velocity=-p.stroke / (p.steps * dt), rampTime=0.1 * p.steps * dt)
	model.insert()
	O.dt, O.engines = dt, loopList(contact=True, alpha=p.alpha)
	return model, joints


def centreTension(model):
	"""Larger principal stress of the mean stress within a tenth of the sides of the centre [Pa]."""
	x, y = laid(model.reference[model.zoneNodes].mean(axis=1))
	near = (abs(x / wide - 0.5) < 0.1) & (abs(y / high - 0.5) < 0.1)
	return principalStresses(np.average(model.zoneStress()[near], axis=0, weights=model.zoneVolume[near])[None])[0, 0]


# ---- running

with Session(p) as session:
	with session.run(1) as run:
		with run.stepping():
			model, joints = build()
			limit = 0.707 * largestForce(model, 'shoe', (0, -1)).load / area
			cracks, film = Cracks(model, joints), Film(model)
			stop, pace = loading.Stop(drop=0.5, displacement=p.stroke), Pace(
				model, lambda: model.groupForce('shoe'), lambda: model.groupForce('support')
			)
			record = Recorder(
				path=lambda: -model.groupTravelled('shoe'), load=lambda: -model.groupForce('shoe'), centre=lambda: centreTension(model),
				broken=cracks.look, damage=lambda: model.pointDamage.max()
			)
			record.after(lambda row: film.look(row.path / p.stroke, row.load, O.time)).after(lambda row: pace(row.damage > 0.1))
			record.after(lambda row: stop(row.path, row.load, row.broken))
			O.engines += [record.engine(20)]
			O.run(2 * p.steps, True)
		load = record['load']
		strength, peak = curves.peak(record['path'], load)
		whole = (record['damage'] < 1e-9) & (load > 0.05 * strength)
		strength = 0.707 * strength / area
		run.add('diagonal_shear_strength', 'MPa', strength / 1e6, limit / 1e6, 'limit analysis of joints that do not soften, an upper bound')
		run.add('path_at_peak', 'mm', 1e3 * record['path'][peak])
		elastic = np.mean(record['centre'][whole] / load[whole]) * area if whole.any() else np.nan
		run.add('centre_tension_by_load', '1', elastic, 0.5, 'RILEM LUMB6, from Frocht 1931, without joints')
		run.curve(path_mm=1e3 * record['path'], load_kN=load / 1e3, centre_MPa=record['centre'] / 1e6, broken=record['broken'])
		run.model(model, steps=O.iter, names=joints)
	session.write()
	session.picture('cracks.png', pictures.drawCracks, model, title='Diagonal compression', names=joints)
	session.picture('sheet.png', picturesfields.drawSheet, film.peak, title='Diagonal compression, at the peak')
	session.picture(
		'curve.png', pictures.drawCurve, session.results.curves, 'path_mm', 'load_kN', ('shortening of the diagonal [mm]', 'load [kN]'),
		[pictures.Reference('limit analysis', limit * area / 0.707 / 1e3)], 'Diagonal compression'
	)
scenario.waitIfBatch()
