# yade-blocks, GPL-2.0-or-later
"""A wall of bricks whose mortar joints have no thickness, pushed sideways."""
import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks.brickwork import runningBond
from yadeblocks.engines import loopList
from yadeblocks.picturesfields import drawNames
from yadeblocks.results import Cracks

# ---- bricks grow by half a joint on every side; bed and head joints carry the mortar's stiffness and strength
O.materials.append(BlockMat(label='brick', young=16.7e9, poisson=0.15, density=1900))
wall = runningBond(bricks=4.5, courses=4, length=0.21, height=0.052, joint=0.01, crack=True)
print(wall.counts) # {'half': 32, 'part': 4}
model = BlockModel(thickness=0.1)
placed = wall.addTo(model, 'brick', zoneSize=0.06)
mortar = dict(kn=82e9, ks=36e9, tension=0.25e6, cohesion=0.35e6, frictionAngle=0.6435)

# ---- joints have names: bed, head, unit in the middle of each brick, platen with other blocks; and those that we give
placed.bond(model, [JointMat(material1='brick', material2='brick', **mortar)], unit=dict(kn=1e15, ks=1e15, tension=2e6, cohesion=2.8e6))
places = model.contactPositions().reshape(-1, 2, 2).mean(axis=1)
model.nameJoints('lowest bed', [i for i in model.jointsNamed('bed') if places[i, 1] < 0.07])
model.setJoints('lowest bed', tension=0.1e6, cohesion=0.2e6)

# ---- 0.3 N/mm² from above, then sideways
x0, y0, x1, y1 = wall.bounds
press = model.group('press', lambda x, y: y > y1 - 1e-9).push('y', force=-0.3e6 * (x1 - x0) * 0.1, rampTime=0.02)
side = model.group('side', press.nodes).drive('x')
base = model.group('base', lambda x, y: y < 1e-9).drive('xy')
model.insert()
O.dt, O.engines = 1e-4, loopList(contact=True, alpha=0.3)
O.run(500, True)
side.setTarget(2e-4, rampTime=0.05)
O.run(4000, True)
print('%.1f kN at %.2f mm; moment about the toe %.0f N m' % (side.force[0] / 1e3, 1e3 * side.displacement[0], base.moment((x1, y0))))
print({name: counts for name, counts in Cracks(model).counts().items()})
drawNames('out/masonry/joints.png', model)
