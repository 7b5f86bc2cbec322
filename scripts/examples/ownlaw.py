# yade-blocks, GPL-2.0-or-later
"""A joint law of one's own in numpy: elastic, but no tension, and no shear without pressure."""
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
model.drive('top', nodesWhere(model, lambda x, y: y > 0.2 - 1e-9), 'y', velocity=1e-5)
model.insert()


def noTension(columns):
	"""Stresses [Pa] from openings and slips [m], an entry for each contact point."""
	properties = model.jointProperties
	columns['sigma'][:] = np.minimum(0, np.repeat(properties['kn'], 2) * columns['opening'])
	columns['tau'][:] = np.where(columns['sigma'] < 0, np.repeat(properties['ks'], 2) * columns['slip'], 0)


O.dt, O.engines = 1e-4, loopList(alpha=0.5)
O.engines[0].law = NumpyLaw(noTension)
O.run(500, True)
assert (model.pointSigma <= 0).all() and model.pointOpening.min() > 0 # it has come apart, and nothing holds it
