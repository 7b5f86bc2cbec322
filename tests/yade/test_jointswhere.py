# yade-blocks, GPL-2.0-or-later
"""Joints by the pair of materials that they are between and by region: chosen, set and read in one call."""
import pytest

from scenes import *
from yadeblocks import export, pictures

joint = dict(kn=1e10, ks=4e9, cohesion=2e6, tension=1e6, frictionAngle=0.6)
labels = 'brick', 'mortar', 'stone'
pairs = [(a, b) for i, a in enumerate(labels) for b in labels[i:]]


def wall():
	"""Two bricks, a layer of mortar between them in two pieces, a stone upon it; widths and heights differ. Bonded, not inserted.

	         | stone          |   0.27..0.4
	         | mortar | mortar|   0.25..0.27, parted at x = 0.3
	         | brick  | brick |   0..0.25, parted at x = 0.2"""
	O.reset()
	for label in labels:
		O.materials.append(BlockMat(label=label, young=1e9, poisson=0.2, density=2000))
	model = BlockModel(thickness=0.1)
	for x0, y0, x1, y1, label in ((0, 0, 0.2, 0.25, 'brick'), (0.2, 0, 0.5, 0.25, 'brick'), (0, 0.25, 0.3, 0.27, 'mortar'),
					(0.3, 0.25, 0.5, 0.27, 'mortar'), (0, 0.27, 0.5, 0.4, 'stone')):
		model.addRegion(rectangle(x0, y0, x1, y1), label, zoneSize=0.5)
	model.bond([JointMat(material1=a, material2=b, **joint) for a, b in pairs])
	return model


def between(model, a, b):
	"""The same from what the model says of its blocks."""
	of = np.array(model.materialLabels)[np.asarray(model.blockMaterial)[np.asarray(model.segmentBlocks)]]
	return [i for i, two in enumerate(of) if sorted(two) == sorted((a, b))]


def middles(model):
	"""Of every joint, from where its contact points are now."""
	return model.contactPositions().reshape(-1, 2, 2).mean(axis=1)


def test_byPair():
	"""Each joint is of one pair, in either order."""
	model = wall()
	found = {pair: list(model.jointsWhere(pair=pair)) for pair in pairs}
	for (a, b), indices in found.items():
		assert indices == between(model, a, b) == list(model.jointsWhere(pair=[b, a])) == sorted(indices)
	assert sorted(sum(found.values(), [])) == list(range(model.contactCount // 2))
	assert found['stone', 'stone'] == [] == found['brick', 'stone'] and min(len(found['brick', 'brick']), len(found['mortar', 'mortar'])) > 0
	assert list(model.jointsWhere()) == list(range(model.contactCount // 2))


def test_byRegion():
	"""By the middle as it was built: the bed between brick and mortar lies along a side of the region, and what has moved counts where it was."""
	model = wall()
	x, y = middles(model).T
	low = model.jointsWhere(region=rectangle(0, 0, 0.5, 0.25))
	assert list(low) == list(np.flatnonzero(y < 0.251)) and len(low) == len(between(model, 'brick', 'brick')) + len(between(model, 'brick', 'mortar'))
	right = [(0.31, -1), (1, -1), (1, 1), (0.31, 1)]
	assert list(model.jointsWhere(region=np.array(right))) == list(np.flatnonzero(x > 0.31))
	both = model.jointsWhere(pair=('mortar', 'brick'), region=right)
	assert list(both) == [i for i in between(model, 'brick', 'mortar') if x[i] > 0.31] and 0 < len(both) < len(between(model, 'brick', 'mortar'))
	assert list(model.jointsWhere(region=rectangle(7, 7, 8, 8))) == []
	model.insert()
	model.displacement[:] = (3, 1)
	assert list(model.jointsWhere(region=rectangle(0, 0, 0.5, 0.25))) == list(low)


def test_setAndRead():
	"""In one call, one number or a column, and read back as columns; all others keep theirs."""
	model = wall()
	bed = between(model, 'brick', 'mortar')
	others = np.setdiff1d(np.arange(model.contactCount // 2), bed)
	model.setJoints(pair=('mortar', 'brick'), cohesion=1e5, tension=5e4 + np.arange(len(bed)))
	properties = model.jointProperties
	assert list(properties['tension'][model.jointsWhere(pair=('brick', 'mortar'))]) == list(5e4 + np.arange(len(bed)))
	assert (properties['cohesion'][bed] == 1e5).all() and (properties['cohesion'][others] == 2e6).all() and (properties['tension'][others] == 1e6).all()
	model.setJoints(region=rectangle(0, 0, 0.19, 1), pair=('brick', 'mortar'), ks=7e9)
	chosen = [i for i in bed if middles(model)[i, 0] < 0.19]
	assert list(np.flatnonzero(model.jointProperties['ks'] == 7e9)) == chosen and 0 < len(chosen) < len(bed)
	model.nameJoints('bed', model.jointsWhere(pair=('brick', 'mortar')))
	assert list(model.jointsNamed('bed')) == bed
	model.setJoints('bed', region=rectangle(0.35, 0, 1, 1), kn=3e10)
	right = [i for i in bed if middles(model)[i, 0] > 0.35]
	assert list(np.flatnonzero(model.jointProperties['kn'] == 3e10)) == right and len(right) == 1
	assert list(model.jointsWhere(joints='bed', region=rectangle(0, 0, 0.19, 1))) == chosen
	assert list(model.jointsWhere(joints=[chosen[0], others[0]], pair=('brick', 'mortar'))) == chosen[:1]


def test_whereverJointsAreTaken(tmp_path):
	"""Strengths that scatter, names, pictures, columns of contact points."""
	model = wall()
	bed = model.jointsWhere(pair=('mortar', 'brick'))
	assert len(model.scatterStrengths(cov=0.2, joints=bed)) == len(bed)
	assert (model.jointProperties['tension'] != 1e6).sum() == len(bed)
	assert export.pointsOf(model, bed).sum() == 2 * len(bed)
	pictures.drawCracks(tmp_path / 'bed.png', model, joints=bed)
	assert model.pointStatus.reshape(-1, 2)[bed].shape == (len(bed), 2)


def test_afterLoading(tmp_path):
	model = wall()
	chosen = list(model.jointsWhere(pair=('brick', 'mortar')))
	model.setJoints(pair=('brick', 'mortar'), cohesion=3e5)
	model.insert()
	O.save(str(tmp_path / 'wall.yade'))
	O.reset()
	O.load(str(tmp_path / 'wall.yade'))
	again = next(b.shape.model for b in O.bodies)
	assert list(again.jointsWhere(pair=('mortar', 'brick'))) == chosen == list(np.flatnonzero(again.jointProperties['cohesion'] == 3e5))


@pytest.mark.parametrize('method', ['jointsWhere', 'setJoints'])
@pytest.mark.parametrize(
	'more, words', [(dict(pair=('brick', 'clay')), 'no block is of the material "clay"; there are: brick, mortar, stone'),
			(dict(pair='brick'), "pair must be the labels of two materials, (label, label), got 'brick'"),
			(dict(pair=('brick', )), "pair must be the labels of two materials, (label, label), got ('brick',)"),
			(dict(pair=('brick', 3)), "pair must be the labels of two materials, (label, label), got ('brick', 3)"),
			(dict(pair=3), 'pair must be the labels of two materials, (label, label), got 3'),
			(dict(region=3), 'a polygon must be a list of points (x, y), got 3'), (dict(region=[(0, 0), (1, 0)]), '.region'),
			(dict(region=[(0, 0), (0, 1), (1, 0)]), '.region'), (dict(region=[(0, 0), (1, 1), (1, 0), (0, 1)]), '.region'),
			(dict(joints=[10**6]), 'no such joint'), (dict(joints='bed'), 'no joint has the name "bed"')]
)
def test_refusals(method, more, words):
	model = wall()
	with pytest.raises(ValueError) as caught:
		getattr(model, method)(**more, **(dict(kn=1.) if method == 'setJoints' else {}))
	assert words in str(caught.value) and (f'BlockModel.{method}' in str(caught.value) or more.get('region') == 3)
	assert (model.jointProperties['kn'] == 1e10).all()


def test_nothingThere():
	"""A choice may be empty, but what sets properties of nothing is a mistake."""
	model = wall()
	for more in dict(pair=('stone', 'stone')), dict(region=rectangle(7, 7, 8, 8)), dict(joints=[0], pair=('stone', 'brick')):
		assert len(model.jointsWhere(**more)) == 0
		with pytest.raises(ValueError, match='BlockModel.setJoints: no joint is between the two materials of pair and within region'):
			model.setJoints(kn=1, **more)
	with pytest.raises(RuntimeError, match=r'BlockModel.jointsWhere: there are no joints yet; call bond\(\) first'):
		BlockModel(thickness=1).jointsWhere()
