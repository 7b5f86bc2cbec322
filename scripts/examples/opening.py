# yade-blocks, GPL-2.0-or-later
"""A tunnel in jointed rock under stress: the rock is at rest, blocks are taken out, it comes to rest again."""
import numpy as np

import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks.engines import loopList
from yadeblocks.loading import settle
from yadeblocks.specimen import nodesWhere, rectangle

O.materials.append(BlockMat(label='rock', young=20e9, poisson=0.25, density=2600))
model = BlockModel(thickness=1)
model.addVoronoi(rectangle(-10, -10, 10, 10), 'rock', size=1.2, seed=1)
model.bond([JointMat(material1='rock', material2='rock', kn=2e10, ks=1e10, cohesion=3e6, tension=1e6, frictionAngle=0.7)])
model.setStress((-3e6, -6e6, 0)) # sxx, syy, sxy in situ [Pa]
edge = nodesWhere(model, lambda x, y: np.maximum(abs(x), abs(y)) > 10 - 1e-9)
model.drive('far', edge, 'xy')
model.insert()
O.trackEnergy, O.dt, O.engines = True, 1e-3, loopList(alpha=0.5)
O.run(10, True)
print('at rest: largest displacement %.1e mm' % (1e3 * abs(model.displacement).max()))

centres = np.array([model.reference[a:b].mean(axis=0) for a, b in zip(model.firstNode, model.firstNode[1:])])
model.remove(np.flatnonzero(np.hypot(*centres.T) < 2))
settle(model)
print('%d blocks taken out, with %.0f J' % (len(model.removedBlocks), O.energy['blockRemoved']))
print('the walls come in by up to %.2f mm; %d contact points broke' % (1e3 * abs(model.displacement).max(), (model.pointStatus > 0).sum()))
