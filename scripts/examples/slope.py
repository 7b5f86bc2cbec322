# yade-blocks, GPL-2.0-or-later
# needs: python3-shapely
"""A slope cut by bedding, cross joints and a fault, under its own weight."""
import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks.engines import loopList
from yadeblocks.jointsets import JointSet, cut
from yadeblocks.specimen import nodesWhere

O.materials.append(BlockMat(label='rock', young=10e9, poisson=0.25, density=2600))
slope = cut(
	[(0, 0), (30, 0), (30, 10), (20, 10), (14, 20), (0, 20)], # outline [m]
	[JointSet('bedding', dip=15, spacing=4), JointSet('cross', dip=-75, spacing=6, scatter=0.1, seed=2)],
	cracks={'fault': [(5, 20), (12, 0)]},
	least=1.0
)
print(slope.counts, slope.notes['merged'], 'small blocks joined a neighbour')
model = BlockModel(thickness=1)
placed = slope.addTo(model, 'rock', zoneSize=3)
model.bond([JointMat(material1='rock', material2='rock', kn=1e9, ks=5e8, cohesion=1e6, tension=0.5e6, frictionAngle=0.6)])

# ---- each set and each crack names its joints
joints = placed.joints(model)
model.setJoints(joints['fault'], cohesion=0, tension=0, frictionAngle=0.5, frictionAngleResidual=0.5)
model.drive('foot', nodesWhere(model, lambda x, y: y < 1e-6), 'xy')
model.drive('left', nodesWhere(model, lambda x, y: (x < 1e-6) & (y > 1e-6)), 'x')
model.gravity((0, -9.81))
model.insert()
O.dt, O.engines = 1e-4, loopList(contact=True, alpha=0.5)
O.run(1000, True)
print('largest displacement %.2f mm' % (1e3 * abs(model.displacement).max()))
