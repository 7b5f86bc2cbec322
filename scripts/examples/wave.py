# yade-blocks, GPL-2.0-or-later
"""A blow on the end of a bar: true masses, no damping."""
import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks.engines import loopList
from yadeblocks.specimen import nodesWhere, rectangle

O.materials.append(BlockMat(label='rock', young=20e9, poisson=0.0, density=2500))
model = BlockModel(thickness=1)
model.addRegion(rectangle(0, 0, 4, 0.2), 'rock', zoneSize=0.1, zoning='regular')
model.bond([])
model.insert()
O.engines = loopList(quasiStatic=False, damping='none') # the engine keeps O.dt stable
model.velocity[nodesWhere(model, lambda x, y: x < 0.5)] = (0.01, 0) # the blow
O.trackEnergy = True
O.run(200, True)
print('after %.3g s the wave has gone %.2f m' % (O.time, O.time * (20e9 / 2500)**0.5))
