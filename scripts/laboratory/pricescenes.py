# yade-blocks, GPL-2.0-or-later
"""Scenes in which price.py measures a step: a couplet in tension, a prism in compression, the prism crushed. Run by YADE."""
import json

import numpy as np

import yadeblocks # noqa: F401 (loads the plugin)
from yade import BlockMat, BlockModel, JointMat, O
from yadeblocks import masonry
from yadeblocks.engines import engineList, find, loopList
from yadeblocks.readings.status import isBroken
from yadeblocks.specimen import nodesWhere, rectangle

segments = 2, 4 # joints of an edge, beside one
# no dilation, and nothing left of friction
joint = dict(masonry.table3, dilationAngle=0, frictionAngleResidual=0)
mortarJoint, unitJoint = dict(masonry.table8, frictionAngleResidual=0), dict(masonry.table9, frictionAngleResidual=0)


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
	couplet = masonry.tensionCouplet
	O.materials.append(BlockMat(label='unit', **couplet.unit))
	O.materials.append(BlockMat(label='mortar', **couplet.mortar))
	model, length, low = BlockModel(thickness=couplet.thickness), couplet.width, couplet.brickHeight
	high = low + couplet.mortarHeight
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
	prism = masonry.prism
	O.materials.append(BlockMat(label='unit', **prism.unit))
	O.materials.append(BlockMat(label='mortar', **prism.mortar))
	model, width, y = BlockModel(thickness=prism.thickness), 0.13, 0
	for layer in range(2 * prism.bricks - 1):
		label, size, thick = ('mortar', 3e-3, prism.mortarHeight) if layer % 2 else ('unit', 0.01, prism.brickHeight)
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


def _runUntil(condition, what, most=20000):
	while not condition():
		if O.iter > most: raise RuntimeError('price: %s is not reached within %d steps' % (what, most))
		O.run(50, True)


def saveStates(folder):
	"""Builds the scenes, brings them to where they are measured and saves them in a folder."""
	for n in (1, *segments):
		model = tension(n)
		_runUntil(lambda: countBroken(model) >= 20, 'the first crack in tension')
		_save(folder, 'tension' if n == 1 else 'tension-%d' % n, model)
	model = compression()
	O.run(400, True)
	_save(folder, 'compression', model)
	model = compression()
	addGeneralContact()
	_runUntil(lambda: countBroken(model) >= 0.2 * model.contactCount, 'the crushed state')
	_save(folder, 'crushed', model)


def _save(folder, name, model):
	touching = [len(i.geom.ends) // 2 for i in O.interactions if i.geom.contact >= 0]
	sizes = dict(
		blocks=model.blockCount, nodes=model.nodeCount, zones=model.zoneCount, points=model.contactCount, pairs=len(list(O.interactions)),
		broken=countBroken(model), freeContacts=len(touching), touchingEdges=sum(touching)
	)
	(folder / (name + '.sizes.json')).write_text(json.dumps(sizes))
	O.save(str(folder / (name + '.yade')))


def countBroken(model):
	"""Contact points that have broken."""
	return int(np.count_nonzero(isBroken(model.pointStatus)))
