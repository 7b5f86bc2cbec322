# yade-blocks, GPL-2.0-or-later
"""Edges in several joints, and triangles beside Voronoi cells."""
import numpy as np
import pytest

import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks.engines import loopList
from yadeblocks.specimen import addCells, nodesWhere, rectangle

from scenes import materials, strong

shapes = pytest.mark.parametrize('cells', ['voronoi', 'triangles'])


def filled(cells, edgeSegments, size=0.02, **options):
	materials()
	model = BlockModel(thickness=0.5)
	made = addCells(model, cells, rectangle(0, 0, 0.2, 0.1), 'mortar', size=size, edgeSegments=edgeSegments, **options)
	return model, made


@shapes
def test_everyEdgeGetsSoManyJoints(cells):
	"""As many blocks, n times the joints, and the same surface between the blocks: rounding of some 500 areas."""
	joints, surfaces = [], []
	for n in 1, 2, 4:
		model, made = filled(cells, n)
		model.bond(strong()[2:])
		joints.append(model.contactCount // 2)
		surfaces.append(2 * model.segmentArea.sum())
		assert made['blocks'] == (0, model.blockCount)
		assert model.zoneVolume.sum() == pytest.approx(0.2 * 0.1 * 0.5, rel=1e-13)
	assert joints[1] == 2 * joints[0] and joints[2] == 4 * joints[0]
	assert surfaces[1] == pytest.approx(surfaces[0], rel=1e-12) and surfaces[2] == pytest.approx(surfaces[0], rel=1e-12)


def test_triangles():
	"""Three corners each, one zone each unless fans are asked for, and of the size that was asked for: 0.2 x 0.1 / 0.005^2 = 800 within 10 %, since
	cells at the outline have fewer edges than six."""
	model, made = filled('triangles', 1, size=0.005)
	assert set(np.diff(model.firstEdge)) == {3} and set(np.diff(model.firstZone)) == {1}
	assert 0.9 < model.blockCount / 800 < 1.1 and 0.9 < made['meanSqrtArea'] / 0.005 < 1.1
	assert filled('triangles', 1, seed=2)[1] != filled('triangles', 1, seed=3)[1]
	fans, _ = filled('triangles', 2, zoning='fan')
	assert set(np.diff(fans.firstEdge)) == {6} and set(np.diff(fans.firstZone)) == {6}


@shapes
@pytest.mark.parametrize(
	'options, words', [(dict(edgeSegments=0), ['edgeSegments', '[1, 100]', '0']), (dict(edgeSegments=1, size=-1), ['size', '-1']),
				(dict(edgeSegments=1, sizeMeaning='root'), ['sizeMeaning', 'root']),
				(dict(edgeSegments=1, zoning='regular'), ['zoning', 'regular']), (dict(edgeSegments=1, seed=-1), ['seed', '-1'])]
)
def test_refusalsAddNothing(cells, options, words):
	with pytest.raises(ValueError) as caught:
		filled(cells, **options)
	assert all(word in str(caught.value) for word in words), caught.value
	model = BlockModel()
	with pytest.raises(ValueError, match='cross'):
		addCells(model, cells, [(0, 0), (2, 0), (2, 1), (1, -1)], 'mortar', size=0.1)
	assert model.blockCount == 0


def test_pointsInsideEdgesSeeTheStress():
	"""Uniform tension through Voronoi blocks: at junctions of three joints stresses scatter however stiff the joints, inside edges they do not.

	1 MPa on either end of 0.2 x 0.1 m, ends held in line, sides free: joints across the pull, more than a cell from the outline. With four joints an edge
	the inner points' scatter must be below a third of that of the points at the junctions."""
	model, _ = filled('voronoi', 4)
	model.bond([JointMat(material1='mortar', material2='mortar', kn=3e13, ks=1.5e13, cohesion=1e15, tension=1e15)])
	left, right = nodesWhere(model, lambda x, y: x < 1e-9), nodesWhere(model, lambda x, y: x > 0.2 - 1e-9)
	model.drive('left', left, 'x')
	model.drive('one', left[:1], 'y')
	model.push('right', right, 'x', force=1e6 * 0.05)
	model.insert()
	O.dt, O.engines = 1, loopList(alpha=0.5, rescueFile='')
	for _ in range(40):
		O.run(500, True)
		if model.unbalancedRatio() < 1e-5: break
	assert model.unbalancedRatio() < 1e-5
	normal, place = np.repeat(model.normal, 2, axis=0), model.contactPositions()
	inside = (abs(place[:, 0] - 0.1) < 0.06) & (abs(place[:, 1] - 0.05) < 0.03)
	error = model.pointSigma / 1e6 - normal[:, 0]**2 # of the exact stress vector's normal part
	ends = np.rint(model.contactPositions() / 1e-7).astype(int) # a junction: where points of three joints or more meet
	_, which, count = np.unique(ends, axis=0, return_inverse=True, return_counts=True)
	junction = count[which.ravel()] > 2
	rms = lambda chosen: np.sqrt(np.mean(error[chosen & inside]**2))
	assert (junction & inside).sum() > 50 and (~junction & inside).sum() > 100
	assert rms(~junction) < rms(junction) / 3, (rms(~junction), rms(junction))
