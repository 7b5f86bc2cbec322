# yade-blocks, GPL-2.0-or-later
"""A joint law that remembers: shear stiffness falls with the way that a joint has slid to and fro."""
import numpy as np

import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks.engines import loopList
from yadeblocks.specimen import nodesWhere, rectangle

O.materials.append(BlockMat(label='rock', young=20e9, poisson=0.2, density=2500))
model = BlockModel(thickness=1)
model.addRegion(rectangle(0, 0, 0.1, 0.1), 'rock', zoneSize=0.05)
model.addRegion(rectangle(0, 0.1, 0.1, 0.2), 'rock', zoneSize=0.05)
model.bond([JointMat(material1='rock', material2='rock', kn=1e12, ks=5e11, cohesion=1e9, tension=1e9)])
model.drive('base', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
model.drive('top', nodesWhere(model, lambda x, y: y > 0.2 - 1e-9), 'x', velocity=1e-5)
model.insert()
kn, ks = (np.repeat(model.jointProperties[name], 2) for name in ('kn', 'ks'))


def wearing(columns):
	"""tau = ks slip / (1 + wear / 1 um); wear is the way slid so far [m]. Its two columns are 0 at first, and saved with the model."""
	columns['wear'] += abs(columns['slip'] - columns['before'])
	columns['before'][:] = columns['slip']
	columns['sigma'][:] = kn * columns['opening']
	columns['tau'][:] = ks * columns['slip'] / (1 + columns['wear'] / 1e-6)


O.dt, O.engines = 1e-4, loopList(alpha=0.5)
O.engines[0].law = NumpyLaw(wearing, columns=['wear', 'before'])
O.run(500, True)
O.saveTmp()
O.loadTmp() # functions are not saved: it is given anew
O.engines[0].law.function = wearing
O.run(500, True)
model = O.bodies[0].shape.model
print('wear [m]:', model.lawColumns['wear'])
