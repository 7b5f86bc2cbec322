# yade-blocks, GPL-2.0-or-later
"""Wrong types, typing errors in keywords and attributes, and what is left out: a sentence with the name, the rule and the value, for every call."""
import inspect

import pytest

from scenes import *
from yadeblocks import _calls

box = [(0, 0), (1, 0), (1, 1), (0, 1)]


@pytest.fixture
def model():
	materials()
	model = BlockModel(thickness=0.05)
	model.addRegion(box, 'unit', 0.5)
	return model


@pytest.mark.parametrize(
	'call, error, words',
	[(
		lambda m: m.addRegion(box, 'unit', zonesize=1), TypeError,
		'BlockModel.addRegion has no argument zonesize (did you mean zoneSize?); known: outline material'
	), (lambda m: m.addRegion(box, 'unit'), TypeError, "BlockModel.addRegion needs zoneSize: BlockModel.addRegion(outline, material, zoneSize, holes=(), "),
		(lambda m: m.addRegion(box, 'unit', 'fine'), TypeError, "BlockModel.addRegion.zoneSize must be a number, got 'fine'"),
		(lambda m: m.addRegion(box, 3, 1), TypeError, 'BlockModel.addRegion.material must be a text, got 3'),
		(lambda m: m.addRegion(7, 'unit', 1), ValueError, 'a polygon must be a list of points (x, y), got 7'),
		(lambda m: m.addRegion([(0, 0), (1, 'a'), (1, 1)], 'unit', 1), ValueError, 'a polygon must be a list of points (x, y), got [(0, 0)'),
		(lambda m: m.drive('a', [0], 'x', velocty=1), TypeError, 'BlockModel.drive has no argument velocty (did you mean velocity?)'),
		(lambda m: m.drive('a', [0], 'x', 1, 2, 3, 4), TypeError, 'BlockModel.drive takes 6 arguments at most, got 7'),
		(lambda m: m.drive('a', [0], 'x', axes='y'), TypeError, "BlockModel.drive.axes must be given once, got 'x' and 'y'"),
		(lambda m: m.gravity(9.81), TypeError, 'BlockModel.gravity.g must be a vector (x, y), got 9.81'),
		(lambda m: m.gravity((0, 'down')), TypeError, "BlockModel.gravity.g must be a vector (x, y), got (0, 'down')"),
		(lambda m: m.groupForce(), TypeError, "BlockModel.groupForce needs name: BlockModel.groupForce(name, axis='')"),
		(lambda m: m.zoneStress(3), TypeError, 'BlockModel.zoneStress takes 0 arguments at most, got 1'),
		(lambda m: m.insert(interaction=True), TypeError, 'BlockModel.insert has no argument interaction (did you mean interactions?)'),
		(lambda m: m.bond(strong()[0]), ValueError, 'joints must be a list of JointMat, got <JointMat'),
		(lambda m: m.addVoronoi(box, 'unit', size=1, lloyd=1.5), TypeError, 'BlockModel.addVoronoi.lloyd must be a whole number, got 1.5'),
		(lambda m: BlockMat(yong=1), AttributeError, 'BlockMat has no attribute yong (did you mean young?); known: '),
		(lambda m: BlockMat(label='a', young='stiff'), TypeError, "BlockMat.young must be a number, got 'stiff'"),
		(lambda m: JointMat(material1=3), TypeError, 'JointMat.material1 must be a text, got 3'),
		(lambda m: BlockLoop(contact='yes'), TypeError, "BlockLoop.contact must be True or False, got 'yes'"),
		(lambda m: BlockMotion(damping=0.3), TypeError, 'BlockMotion.damping must be a text, got 0.3'),
		(lambda m: setattr(O.materials[0], 'young', 'stiff'), TypeError, "BlockMat.young must be a number, got 'stiff'"),
		(lambda m: setattr(O.materials[0], 'yong', 1), AttributeError, 'BlockMat has no attribute yong (did you mean young?)'),
		(lambda m: setattr(m, 'thicknes', 1), AttributeError, 'BlockModel has no attribute thicknes (did you mean thickness?)')]
)
def test_sentences(model, call, error, words):
	with pytest.raises(error) as caught:
		call(model)
	said = str(caught.value)
	assert said.startswith(words) and 'C++' not in said and 'converter' not in said and 'basic_string' not in said


def test_allMethodsOfOurClasses():
	"""Each that Boost made has its arguments and its words; wrong calls of any say no C++."""
	import yade.wrapper as known
	count = 0
	for name, kind in vars(known).items():
		if not _calls._ours.match(name): continue
		for method, member in vars(kind).items():
			assert type(member).__module__ != 'Boost.Python' or method.startswith('_') or type(member).__name__ != 'function', (name, method)
			if not inspect.isfunction(member) or method.startswith('_'): continue
			count += 1
			assert member.__doc__ and member.__name__ == method
			if method == 'setJoints': continue
			with pytest.raises(TypeError) as caught:
				member(kind(), nosuchword=1)
			assert 'C++' not in str(caught.value) and f'{name}.{method}' in str(caught.value), (name, method, str(caught.value))
	assert count > 30


def test_whatIsRightGoesThrough(model):
	assert str(inspect.signature(BlockModel.drive)) == '(self, name, nodes, axes, velocity=0.0, rampTime=0.0, startTime=0.0)'
	assert str(inspect.signature(BlockModel.follow)).startswith("(self, group, peak=False, drop=0.5, displacement=inf, cracks=2147483647, release='path', ")
	model.drive('a', np.array([0]), 'x', velocity=np.float64(2)) # numpy's numbers are numbers
	model.addVoronoi([(2, 0), (3, 0), (3, 1), (2, 1)], 'unit', size=np.float32(0.5), lloyd=np.int64(1))
	with pytest.raises(ValueError, match='there is a motion group "a" already'): # what the model itself says is left alone
		model.drive('a', [0], 'x')
	with pytest.raises(RuntimeError, match='no joints yet'):
		model.setJoints(kn=1)
