# yade-blocks, GPL-2.0-or-later
"""Uniform tension through bonded Voronoi blocks: what contact points see with edges in 1, 2, 4 joints.

A plate of 0.2 x 0.1 m, some 200 blocks and joints too stiff to matter, pulled with 1 N/mm2 at both ends, its sides free. Every joint's normal stress is then
known, cos^2 of the angle between its normal and the pull; it is compared with what the contact points have, across the pull (within 60 degrees) and more than a
cell from the outline.

	scripts/run.sh segments [size=0.01] [most=4] [key=value ...]        about 15 s a seed

With one joint an edge each contact point sits at a junction of three joints, where stresses do not converge, however stiff the joints or fine the zones. With
more joints there are points inside the edges. A joint with n segments is 1 + 2/n^2 times as stiff in bending as it should be.
Expected: at junctions an error that does not vanish, inside the edges one that does.
"""
import numpy as np

import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks import loading, pictures, scenario
from yadeblocks.engines import loopList
from yadeblocks.scenario import Key
from yadeblocks.session import Session
from yadeblocks.specimen import nodesWhere, rectangle

# ---- parameters (SI)

length, height, thickness, pull = 0.2, 0.1, 0.05, 1e6 # [m], [Pa]
rock = dict(young=16.7e9, poisson=0.2, density=2000)
p = scenario.parameters({
	**scenario.usualParameters(seed=1, seeds=1, threads=1, tag='', alpha=0.5, lloyd=2), 'size': Key(
		0.01, 'size of the blocks, root of their mean area', 'm', (lambda s: 0 < s < height / 4, 'must be positive and below a quarter of the height')
	), 'stiffness': Key(100., 'of the joints, in units of Young\'s modulus by size', '', scenario.positive),
	'most': Key(4, 'most joints an edge; 1, 2, 4 ... are looked at', rule=(lambda n: 1 <= n <= 16, 'must lie in [1, 16]'))
})
kn = p.stiffness * rock['young'] / p.size # [Pa/m]


def build(seed, segments):
	O.reset()
	O.materials.append(BlockMat(label='rock', **rock))
	model = BlockModel(thickness=thickness)
	model.addVoronoi(
		rectangle(0, 0, length, height), 'rock', size=p.size, sizeMeaning='sqrtArea', lloyd=p.lloyd, seed=seed, mergeFraction=0.2, edgeSegments=segments
	)
	model.bond([JointMat(material1='rock', material2='rock', kn=kn, ks=kn / 2, cohesion=1e15, tension=1e15)])
	left, right = nodesWhere(model, lambda x, y: x < 1e-9), nodesWhere(model, lambda x, y: x > length - 1e-9)
	model.drive('left', left, 'x')
	model.drive('one', left[:1], 'y')
	model.push('right', right, 'x', force=pull * height * thickness)
	model.insert()
	O.dt, O.engines = 1, loopList(alpha=p.alpha, rescueFile='')
	return model


def stresses(model):
	"""Normal stress at the contact points by the pull, what it should be, and whether a point sits at a junction of three joints or more."""
	normal, place = np.repeat(model.normal, 2, axis=0), model.contactPositions()
	away = 1.5 * p.size
	chosen = (abs(place[:, 0] - length / 2) < length / 2 - away) & (abs(place[:, 1] - height / 2) < height / 2 - away) & (normal[:, 0]**2 > 0.25)
	_, which, count = np.unique(np.rint(place / (1e-5 * p.size)).astype(int), axis=0, return_inverse=True, return_counts=True)
	return model.pointSigma[chosen] / pull, normal[chosen, 0]**2, count[which.ravel()][chosen] > 2


# ---- running

rms = lambda error: np.sqrt(np.mean(error**2)) if len(error) else np.nan
with Session(p) as session:
	for seed in p.seedList:
		if not session.wants(seed): continue
		with session.run(seed) as run:
			n, rows = 1, []
			while n <= p.most:
				with run.stepping():
					model = build(seed, n)
					loading.settle(model, ratio=1e-5, floor=pull * height * thickness)
				found, exact, junction = stresses(model)
				error = found - exact
				run.add('smallest_%d' % n, '1', found.min())
				run.add('largest_%d' % n, '1', found.max())
				run.add('error_at_junctions_%d' % n, '1', rms(error[junction]))
				run.add('error_inside_edges_%d' % n, '1', rms(error[~junction]))
				rows.append((n, rms(error)))
				n *= 2
			run.curve(segments=np.array([row[0] for row in rows]), error=np.array([row[1] for row in rows]))
			run.model(model, steps=O.iter)
	session.write()
	session.picture('cracks.png', pictures.drawCracks, model, title='Plate of Voronoi blocks, edges in %d joints' % (n // 2))
scenario.waitIfBatch()
