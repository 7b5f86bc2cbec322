# yade-blocks, GPL-2.0-or-later
"""A scene that is saved and loaded goes on with the same bits."""
from pathlib import Path

import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks.engines import loopList
from yadeblocks.specimen import nodesWhere, rectangle

O.materials.append(BlockMat(label='rock', young=20e9, poisson=0.2, density=2500))
model = BlockModel(thickness=1)
model.addVoronoi(rectangle(0, 0, 0.1, 0.1), 'rock', size=0.03, seed=1)
model.bond([JointMat(material1='rock', material2='rock', kn=2e12, ks=1e12, cohesion=10e6, tension=5e6, frictionAngle=0.6)])
model.drive('base', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
model.drive('top', nodesWhere(model, lambda x, y: y > 0.1 - 1e-9), 'y', velocity=-1e-3)
model.insert()
O.dt, O.engines = 1e-5, loopList(alpha=0.3)
O.run(100, True)
Path('out/saving').mkdir(parents=True, exist_ok=True)
O.save('out/saving/middle.yade.bz2')
O.run(100, True)
bits = model.fingerprint()
O.load('out/saving/middle.yade.bz2')
model = O.bodies[0].shape.model # the loaded one
O.run(100, True)
assert model.fingerprint() == bits
