# yade-blocks, GPL-2.0-or-later
"""A rigid platen lies on two stones by its weight, then presses them, slowly where they cannot follow, and its force is read."""
import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks import loading
from yadeblocks.engines import loopList
from yadeblocks.platen import Platen
from yadeblocks.specimen import nodesWhere, rectangle

O.materials.append(BlockMat(label='stone', young=20e9, poisson=0.2, density=2500))
O.materials.append(BlockMat(label='steel', young=200e9, poisson=0.3, density=7800))
model = BlockModel(thickness=0.1)
for x in (0, 0.2):
	model.addRegion(rectangle(x, 0, x + 0.2, 0.2), 'stone', zoneSize=0.05)
plate = model.addRigid(rectangle(-0.05, 0.2, 0.45, 0.25), 'steel')
model.bond([JointMat(material1='stone', material2=other, kn=1e11, ks=5e10, bonded=False, frictionAngle=0.5) for other in ('stone', 'steel')])
model.drive('base', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
model.gravity((0, -9.81)) # weighs rigid blocks, too
model.insert()
O.dt, O.engines = 1e-4, loopList(newton=dict(damping=0.3), alpha=0.5)
O.run(1, True)
loading.settle(model, ratio=1e-3)
weight = -O.bodies[model.bodyOf(plate)].state.mass * 9.81
platen = Platen(model, plate, velocity=(0, -1e-4), rampTime=0.01, servo=dict(floor=10)) # [m/s], [s], [N]
O.engines = [platen.engine()] + O.engines
O.run(500, True)
print('driven by %.2f kN, with its weight of %.2f kN on the stones %.2f kN' % tuple(-f / 1e3 for f in (platen.force[1], weight, platen.force[1] + weight)))
