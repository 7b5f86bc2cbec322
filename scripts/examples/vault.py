# yade-blocks, GPL-2.0-or-later
"""An arch of rigid voussoirs under its own weight."""
from math import atan

import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks.engines import loopList
from yadeblocks.specimen import rectangle
from yadeblocks.voussoirs import arch

O.materials.append(BlockMat(label='stone', young=20e9, poisson=0.2, density=2000))
model = BlockModel(thickness=0.5)
ring = arch(radius=1, thickness=0.15, count=15).addTo(model, 'stone', rigid=True)
feet = [model.addRigid(rectangle(x - 0.2, -0.2, x + 0.2, 0), 'stone') for x in (-1, 1)]
model.bond([JointMat(material1='stone', material2='stone', kn=3e10, ks=1.5e10, bonded=False, frictionAngle=atan(2))])
model.gravity((0, -9.81))
model.insert()
for foot in feet:
	O.bodies[model.bodyOf(foot)].state.blockedDOFs = 'xyzXYZ'
O.dt, O.engines = 1e-4, loopList(newton=dict(damping=0.3))
O.run(3000, True)
assert abs(model.displacement).max() < 1e-4 # it stands
