# yade-blocks, GPL-2.0-or-later
"""What every optional feature costs a step, switched off and on. To be started by scripts/price.sh:

	scripts/price.sh [quick=false]        about 8 minutes on two idle cores, and a build the first time; quick=false: longer windows, more repetitions

Three states are measured: a couplet in tension whose first joints are broken (TT2 of tension.py, bonded joints only), a masonry
prism in compression before its first crack (compression.py, half as wide) and the same prism crushed, with general contact. From
each, the same window of steps is run again and again, with one feature more every time. Instructions are counted in callgrind and
repeat to about 1e-4; times are medians of 15 turns, in each of which a feature is compared with the bare step.

Switched off, a feature leaves only the question whether it is on. To show it, the instructions of the bare scene are sorted by source
line: those in a feature's own files, or on lines elsewhere that speak of it, are its price while it is off: an upper bound.
"""
import json
import re
import sys
import time
from math import radians
from pathlib import Path

import numpy as np

import yadeblocks
from yade import *
from yadeblocks import scenario
from yadeblocks.checkpoint import sceneModel
from yadeblocks.engines import addBehindForces, engineList, find, loopList
from yadeblocks.recording import Recorder, runner
from yadeblocks.specimen import Gauge, nodesWhere, rectangle

house = Path(yadeblocks.__file__).resolve().parents[2] # __file__ is YADE itself
sys.path.insert(0, str(house / 'scripts'))
from laboratory.features import features
from laboratory.instructions import Marks, readProfiles, sourceLines

p = scenario.parameters({'part': '', 'scene': 'tension', 'quick': True}, {
	'part': scenario.Rule(lambda part: part in ('states', 'times', 'counts', 'threads', 'table'), 'is set by scripts/price.sh, which starts this script'),
	'scene': ('tension', 'compression', 'crushed')
})
folder = Path('out/price')
window = 100 if p.quick else 400 # steps
repetitions = 15 if p.quick else 45 # of every timed window
segments = 2, 4 # joints of an edge, beside one
writeEvery, lookEvery, recordEvery = 1000, 100, 50 # steps between ParaView files, looks at the stability, gauge readings

# ---- the scenes

unit = dict(young=16.7e9, poisson=0.2, density=1900)
joint = dict(kn=400e9, ks=200e9, frictionAngle=radians(38), frictionAngleResidual=0, cohesion=0.6e6, tension=0.6e6)
mortarJoint = dict(kn=348e9, ks=174e9, frictionAngle=radians(15), frictionAngleResidual=0, cohesion=1.4e6, cohesionResidual=0.28e6, tension=0.7e6)
unitJoint = dict(kn=1260e9, ks=630e9, frictionAngle=radians(20), frictionAngleResidual=0, cohesion=15e6, cohesionResidual=3e6, tension=7.5e6)


def joints(unitToUnit, mortarToOthers):
	return [
		JointMat(material1='unit', material2='unit', **unitToUnit),
		JointMat(material1='mortar', material2='mortar', **mortarToOthers),
		JointMat(material1='unit', material2='mortar', **mortarToOthers)
	]


def bareLoop(alpha):
	"""The bare time step: no feature but large displacements and local damping."""
	O.engines = loopList(alpha=alpha, watchPeriod=0)


def native(model):
	"""The same step through YADE's InteractionLoop."""
	alpha = find('BlockMotion').alpha
	O.engines = engineList([], contact=find('BlockLoop').contact, alpha=alpha, watchPeriod=0)


def addGeneralContact():
	find('BlockLoop').contact = True


def tension(edgeSegments=1):
	"""A couplet of 100 x 115 mm with a mortar layer of 2 mm blocks, pulled until some joints have broken."""
	O.reset()
	O.materials.append(BlockMat(label='unit', **unit))
	O.materials.append(BlockMat(label='mortar', young=2.974e9, poisson=0.2, density=1250))
	model, length, low, high = BlockModel(thickness=0.05), 0.1, 0.05, 0.065
	model.addVoronoi(rectangle(0, low, length, high), 'mortar', size=2e-3, lloyd=1, seed=1, mergeFraction=0.1, edgeSegments=edgeSegments)
	model.addRegion(rectangle(0, 0, length, low), 'unit', zoneSize=8e-3)
	model.addRegion(rectangle(0, high, length, high + low), 'unit', zoneSize=8e-3)
	model.bond(joints(joint, joint))
	model.drive('bottom', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
	model.drive('top', nodesWhere(model, lambda x, y: y > high + low - 1e-9), 'y', velocity=0.02e-3, rampTime=0.05)
	model.insert()
	O.dt = 1.5 / 10000
	bareLoop(0.3)
	return model


def compression():
	"""A prism of five bricks and four mortar joints, 130 x 290 mm."""
	O.reset()
	O.materials.append(BlockMat(label='unit', young=20e9, poisson=0.2, density=2000))
	O.materials.append(BlockMat(label='mortar', young=5.8e9, poisson=0.2, density=2000))
	model, width, y = BlockModel(thickness=0.285), 0.13, 0
	for layer in range(9):
		label, size, thick = ('mortar', 3e-3, 0.01) if layer % 2 else ('unit', 0.01, 0.05)
		model.addVoronoi(rectangle(0, y, width, y + thick), label, size=size, sizeMeaning='edge', lloyd=3, seed=1000 + layer, mergeFraction=0.1)
		y += thick
	model.bond(joints(unitJoint, mortarJoint))
	bottom = nodesWhere(model, lambda x, y: y < 1e-9)
	model.drive('bottom', bottom, 'y')
	model.drive('centre', bottom[abs(model.reference[bottom, 0] - width / 2).argmin()], 'x')
	model.drive('platen', nodesWhere(model, lambda x, y: y > 0.29 - 1e-9), 'y', velocity=-0.01e-3, rampTime=18)
	model.insert()
	O.dt = 360 / 10000
	bareLoop(0.2)
	return model


def runUntil(condition, what, most=20000):
	while not condition():
		if O.iter > most: raise RuntimeError('price: %s is not reached within %d steps' % (what, most))
		O.run(50, True)


def states():
	"""Builds the scenes, brings them to where they are measured and saves them."""
	broken = lambda model: np.count_nonzero(np.isin(model.pointStatus, (1, 2)))
	for n in (1, *segments):
		model = tension(n)
		runUntil(lambda: broken(model) >= 20, 'the first crack in tension')
		save('tension' if n == 1 else 'tension-%d' % n, model)
	model = compression()
	O.run(400, True)
	save('compression', model)
	model = compression()
	addGeneralContact()
	runUntil(lambda: broken(model) >= 0.2 * model.contactCount, 'the crushed state')
	save('crushed', model)


def save(name, model):
	touching = [len(i.geom.ends) // 2 for i in O.interactions if i.geom.contact >= 0]
	sizes = dict(
		blocks=model.blockCount, nodes=model.nodeCount, zones=model.zoneCount, points=model.contactCount, pairs=len(list(O.interactions)),
		broken=int(np.count_nonzero(np.isin(model.pointStatus, (1, 2)))), freeContacts=len(touching), touchingEdges=sum(touching)
	)
	(folder / (name + '.sizes.json')).write_text(json.dumps(sizes))
	O.save(str(folder / (name + '.yade')))


# ---- the features


def softenAFifth(model):
	"""Joints that soften, a fifth of which have less tensile strength than stress, so that they begin to in the next step."""
	model.setJoints(GfI=1000, GfII=1e4)
	stress = np.reshape(model.pointSigma, (-1, 2)).min(axis=1)
	chosen = np.argsort(stress)[-len(stress) // 5:]
	model.setJoints(chosen[stress[chosen] > 0], tension=0.95 * stress[chosen[stress[chosen] > 0]])


def addCap(model):
	model.setJoints(GfI=1000, GfII=1e4, capStrength=1e9, capFirst=1e9, capResidual=1e9, capPeakClosure=1e-3, capEnergy=1e6, capShear=9)


def addGauge(model):
	nodes = np.arange(model.nodeCount)
	read = Recorder(opening=Gauge(model, nodes[:40], nodes[-40:]), force=lambda: model.groupForce(model.groups[-1]))
	O.engines = O.engines + [read.engine(recordEvery)]


def addExport(model):
	from yadeblocks.export import BlocksExport
	export = BlocksExport(folder / 'vtk')
	export.write(model, O.time) # imports what it needs
	O.engines = O.engines + [runner('export', lambda: export.write(model, O.time), window)]


class Row:
	"""A feature: its name, how it is switched on, how often it works (1: as often as in the window), and the state it has if it is not the scene's."""
	def __init__(self, name, switch, share=1, state=''):
		self.name, self.switch, self.share, self.state = name, switch, share, state


rows = [
	Row('general contact', lambda model: addGeneralContact()),
	Row("YADE's InteractionLoop", native),
	Row('small strain instead of large displacement', lambda model: setattr(model, 'smallStrain', True)),
	Row('dilation', lambda model: model.setJoints(frictionAngleResidual=radians(4), dilationAngle=radians(4))), # it may not exceed it
	Row('residual friction', lambda model: model.setJoints(frictionAngleResidual=radians(30))),
	Row('joints that soften, none does', lambda model: model.setJoints(GfI=1000, GfII=1e4)),
	Row('joints that soften, up to a fifth do', softenAFifth),
	Row('joints that soften, with a cap, none yields', addCap),
	Row('strengths that scatter', lambda model: model.scatterStrengths(cov=0.01)),
	Row('gravity (dead loads)', lambda model: model.gravity((0, -9.81))),
	Row('adaptive damping instead of local', lambda model: setattr(find('BlockMotion'), 'damping', 'adaptive')),
	Row('no damping instead of local', lambda model: setattr(find('BlockMotion'), 'damping', 'none')),
	Row('stability watch, every %d steps' % lookEvery, lambda model: setattr(find('BlockMotion'), 'watchPeriod', lookEvery)),
	Row('energy accounts (O.trackEnergy)', lambda model: setattr(O, 'trackEnergy', True)),
	Row('crack recorder, every step', lambda model: addBehindForces(BlockCrackRecorder())),
	Row('gauge in a PyRunner, every %d steps' % recordEvery, addGauge),
	Row('ParaView files, every %d steps' % writeEvery, addExport, window / writeEvery)
]
rows.append(Row('servo', lambda model: addBehindForces(BlockServo(groups=[model.groups[-1]], floor=1))))
if p.scene == 'tension': rows += [Row('edges in %d joints' % n, None, state='tension-%d' % n) for n in segments]
if p.scene == 'crushed': rows = [row for row in rows if 'general contact' not in row.name]

bare = Row('bare', None)


def start(row=bare):
	"""The scene's state, with one feature more; a few steps behind the switch, which may change masses."""
	O.load(str(folder / ((row.state or p.scene) + '.yade')))
	model = sceneModel()
	if row.switch: row.switch(model)
	O.run(recordEvery + 1, True)
	return model


def counts():
	marks = Marks('build/price/libmarks.so')
	for row in [bare, Row('bare again', None)] + rows:
		start(row)
		with marks.counting(row.name):
			O.run(window, True)


def times():
	"""CPU times of a step [ns], one a turn; features take turns, because the machine's speed changes from second to second."""
	found = {}
	for _ in range(repetitions):
		for row in [bare] + rows:
			start(row)
			begun = time.process_time()
			O.run(window, True)
			found.setdefault(row.name, []).append(1e9 * (time.process_time() - begun) / window)
	(folder / (p.scene + '.times.json')).write_text(json.dumps(found))


def threads():
	"""Wall-clock time of a step on as many threads as YADE has [ns]."""
	found = {}
	for count in (1, 2):
		start()
		for e in O.engines:
			e.ompThreads = count
		clock = []
		for _ in range(repetitions):
			begun = time.perf_counter()
			O.run(window, True)
			clock.append(time.perf_counter() - begun)
		found[count] = 1e9 * float(np.median(clock)) / window
	(folder / (p.scene + '.threads.json')).write_text(json.dumps(found))


# ---- the table


def kilo(instructions):
	return '%.1f' % (instructions / 1e3)


def report():
	lines, table = [], []
	source = sourceLines(house)
	for scene in ('tension', 'compression', 'crushed'):
		read = lambda kind: json.loads((folder / ('%s.%s.json' % (scene, kind))).read_text())
		sizes, turns, profiles = read('sizes'), read('times'), readProfiles(folder / (scene + '.callgrind'))
		once = float(np.median(turns['bare']))
		bare = profiles['bare']
		off = bare.total / window
		lines += [
			'',
			'## %s' % scene, '', ', '.join('%d %s' % (value, name) for name, value in sizes.items()) + '.', '',
			'Bare: %s thousand instructions, %.0f µs a step; counted again: %+.4f %%.' %
			(kilo(off), once / 1e3, 100 * (profiles['bare again'].total / bare.total - 1)), '',
			'| feature | instructions a step, on (10³) | more than bare | | µs more |', '|---|---:|---:|---:|---:|'
		]
		for row in rows:
			if row.name not in profiles: continue
			more, slower = row.share * (profiles[row.name].total / window -
							off), row.share * float(np.median(np.subtract(turns[row.name], turns['bare'])))
			lines.append('| %s | %s | %+.1f | %+.1f %% | %+.1f |' % (row.name, kilo(off + more), more / 1e3, 100 * more / off, slower / 1e3))
			table.append((scene, row.name, off, off + more, once, once + slower))
		if (folder / (scene + '.threads.json')).exists():
			clock = read('threads')
			lines.append(
				'| two threads instead of one (wall-clock) | | | %+.0f %% | %+.1f |' %
				(100 * (clock['2'] / clock['1'] - 1), (clock['2'] - clock['1']) / 1e3)
			)
		if scene != 'crushed':
			lines += ['', '| switched off | instructions a step | share of the bare step |', '|---|---:|---:|']
			for name, feature in features.items():
				count = bare.inFeature(feature, source) / window
				lines.append('| %s | %.0f | %.2f %% |' % (name, count, 100 * count / off))
				table.append((scene, name + ', off', off - count, off, '', ''))
		lines += ['', '| where the bare step goes | share |', '|---|---:|']
		lines += ['| %s | %.1f %% |' % (short(name), 100 * count / bare.total) for name, count in bare.byFunction().most_common(12)]
	(folder / 'table.md').write_text('\n'.join(lines[1:]) + '\n')
	with open(folder / 'price.csv', 'w') as csv:
		csv.write('scene,feature,instructions_without,instructions_with,ns_without,ns_with\n')
		for row in table:
			csv.write(','.join('"%s"' % cell if isinstance(cell, str) else '%.6g' % cell for cell in row) + '\n')
	print('\n'.join(lines))


def short(function):
	"""A C++ function's name without arguments and namespaces; code of libraries without symbols is an address."""
	name = re.sub(r'\(anonymous namespace\)::|blocks::|yade::|std::|boost::', '', function)
	return 'a library' if name.startswith('0x') else re.sub(r'\(.*|<.*', '', name).split(' ')[-1].strip("'").strip() or function[:40]


folder.mkdir(parents=True, exist_ok=True)
{'states': states, 'times': times, 'counts': counts, 'threads': threads, 'table': report}[p.part]()
