# yade-blocks, GPL-2.0-or-later
"""A shear wave from below through a layer of rock, doubled at the surface; the base lets it in, and out again."""
from math import pi

import numpy as np

import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks.engines import loopList
from yadeblocks.specimen import nodesWhere, rectangle

O.materials.append(BlockMat(label='rock', young=2e9, poisson=0.25, density=2200))
model = BlockModel(thickness=1)
model.addRegion(rectangle(0, 0, 2, 40), 'rock', zoneSize=1, zoning='regular')
model.bond([])
model.drive('sides', range(model.nodeCount), 'y') # a shear wave moves along x alone
base, surface = nodesWhere(model, lambda x, y: y < 1e-9), nodesWhere(model, lambda x, y: y > 40 - 1e-9)
model.viscous('base', base)
times = np.linspace(0, 0.1, 201)
model.setIncoming('base', times, np.outer(0.01 * np.sin(pi * times / 0.1)**2, (1, 0))) # velocities of the wave on its way up [m/s]
model.insert()
O.trackEnergy, O.engines = True, loopList(quasiStatic=False, damping='none')
most = 0
while O.time < 0.4:
	O.run(20, True)
	most = max(most, model.velocity[surface, 0].max())
print('the surface moves at up to %.4f m/s, twice the 0.01 that came in' % most)
print('brought in %.4f J, gone out %.4f J' % (-O.energy['blockWork'], O.energy['blockViscous']))
