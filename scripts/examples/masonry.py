# yade-blocks, GPL-2.0-or-later
"""A wall of bricks whose mortar joints have no thickness, pushed sideways."""
import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks.brickwork import runningBond
from yadeblocks.engines import loopList
from yadeblocks.specimen import nodesWhere

# ---- bricks grow by half a joint on every side; bed and head joints carry the mortar's stiffness and strength
O.materials.append(BlockMat(label='brick', young=16.7e9, poisson=0.15, density=1900))
wall = runningBond(bricks=4.5, courses=4, length=0.21, height=0.052, joint=0.01, crack=True)
print(wall.counts) # {'half': 32, 'part': 4}
model = BlockModel(thickness=0.1)
placed = wall.addTo(model, 'brick', zoneSize=0.06)
mortar = dict(kn=82e9, ks=36e9, tension=0.25e6, cohesion=0.35e6, frictionAngle=0.6435)
model.bond([JointMat(material1='brick', material2='brick', **mortar)])

# ---- joints have names: bed, head, unit in the middle of each brick, platen with blocks of other builders
joints = placed.joints(model)
model.setJoints(joints['unit'], kn=1e15, ks=1e15, tension=2e6, cohesion=2.8e6)

# ---- 0.3 N/mm² from above, then sideways
x0, y0, x1, y1 = wall.bounds
top = nodesWhere(model, lambda x, y: y > y1 - 1e-9)
model.drive('base', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
model.push('press', top, 'y', force=-0.3e6 * (x1 - x0) * 0.1, rampTime=0.02)
model.drive('side', top, 'x')
model.insert()
O.dt, O.engines = 1e-4, loopList(contact=True, alpha=0.3)
O.run(500, True)
model.setTarget('side', 2e-3, rampTime=0.02)
O.run(500, True)
print('%.1f kN' % (model.groupForce('side') / 1e3))
