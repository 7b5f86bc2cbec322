# yade-blocks, GPL-2.0-or-later
# needs: python3-scipy
"""How far a dry wall may be tilted: limit analysis, and the mechanism in a picture."""
from math import atan, degrees

import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks.brickwork import runningBond
from yadeblocks.limitanalysis import bodyForces, largestMultiplier
from yadeblocks.pictures import drawMechanism
from yadeblocks.specimen import rectangle

O.materials.append(BlockMat(label='unit', young=10e9, poisson=0.2, density=2000))
model = BlockModel(thickness=0.1)
runningBond(bricks=5, courses=6, length=0.4, height=0.175, first='part').addTo(model, 'unit', rigid=True)
base = model.addRigid(rectangle(-0.2, -0.2, 2.2, 0), 'unit')
model.bond([JointMat(material1='unit', material2='unit', kn=2e10, ks=1e10, bonded=False, frictionAngle=atan(0.65))])
limit = largestMultiplier(model, bodyForces(model, (9.81, 0)), bodyForces(model, (0, -9.81)), fixed=[base])
print('falls at %.5f of its weight from the side, tilted by %.1f degrees' % (limit.load, degrees(atan(limit.load))))
drawMechanism('out/limit/mechanism.png', model, limit.mechanism, title='Limit multiplier %.4f' % limit.load)
