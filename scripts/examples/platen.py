# yade-blocks, GPL-2.0-or-later
"""A rigid platen presses two stones by YADE's own means, slowed by a servo, and its reaction is read."""
import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks import loading
from yadeblocks.engines import loopList
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
platen = O.bodies[model.bodyOf(plate)]
platen.state.blockedDOFs = 'xyzXYZ' # held, so far
O.dt, O.engines = 1e-4, loopList(newton=dict(damping=0.3), alpha=0.5)
O.run(1, True)
loading.settle(model, ratio=1e-3)
platen.state.vel = (0, -1e-4, 0) # driven [m/s]
O.run(500, True)
print('the platen carries %.2f kN' % (O.forces.f(platen.id)[1] / 1e3))
