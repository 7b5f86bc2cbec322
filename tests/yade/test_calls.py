# yade-blocks, GPL-2.0-or-later
"""Wrong types, typing errors in keywords and attributes, and what is left out: a sentence with the name, the rule and the value, for every call."""
import inspect

import pytest

from scenes import *
from yadeblocks import _calls, brickwork, jointsets, loading, pictures, rubble, voussoirs

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
		(lambda m: setattr(m, 'thicknes', 1), AttributeError, 'BlockModel has no attribute thicknes (did you mean thickness?)'),
		(lambda m: m.drive('a', 'all', 'x'), ValueError, "indices must be whole numbers, got 'all'"),
		(lambda m: m.drive('a', [0.5], 'x'), ValueError, 'indices must be whole numbers, got 0.5'),
		(lambda m: m.drive('a', None, 'x'), ValueError, 'indices must be whole numbers, got None'),
		(lambda m: m.traction('top', (0, 1)), ValueError, "indices must be whole numbers, got 'top'"),
		(
			lambda m: m.viscous('a', [0], impedance=3), ValueError,
			'viscous boundary "a": impedance must be a pair of numbers, normal and tangential, got 3'
		),
		(
			lambda m: m.viscous('a', [0], impedance=('a', 1)), ValueError,
			'viscous boundary "a": impedance must be a pair of numbers, normal and tangential, '
		), (lambda m: m.addRegion(box, 'unit', 0.5, holes=3), ValueError, 'holes must be a list of polygons, got 3'),
		(lambda m: setattr(m, 'displacement', 3), AttributeError, 'BlockModel.displacement cannot be set; write into it'),
		(lambda m: setattr(m, 'position', 3), AttributeError, 'BlockModel.position cannot be set'),
		(lambda m: m.groupWerk('a'), AttributeError, 'BlockModel has no attribute groupWerk (did you mean groupWork?)'),
		(lambda m: BlockServo(groups='top'), TypeError, "BlockServo.groups must be a list, got 'top'"),
		(lambda m: BlockServo(groups=[1]), TypeError, 'BlockServo.groups must be a list, each of it a text, got [1]'),
		(lambda m: setattr(BlockServo(), 'groups', 'top'), TypeError, "BlockServo.groups must be a list, got 'top'"),
		(lambda m: BlockCrackRecorder(iterPeriod='x'), TypeError, "BlockCrackRecorder.iterPeriod must be a whole number, got 'x'"),
		(lambda m: NumpyLaw(3), TypeError, 'NumpyLaw.function must be a function of the columns, got 3'),
		(lambda m: m.group(), TypeError, 'BlockModel.group needs name: BlockModel.group(name, nodes=None)'),
		(lambda m: m.group('a', knots=[0]), TypeError, 'BlockModel.group has no argument knots (did you mean nodes?)'),
		(
			lambda m: loading.settle(m, ratoi=1), TypeError,
			'settle has no argument ratoi (did you mean ratio?); known: model ratio floor period maxSteps'
		), (lambda m: loading.settle(m, ratio='x'), TypeError, "settle.ratio must be a number, got 'x'"),
		(lambda m: loading.Stop(dorp=1), TypeError, 'Stop has no argument dorp (did you mean drop?)'),
		(lambda m: loading.Stop(drop='x'), TypeError, "Stop.drop must be a number, got 'x'"),
		(lambda m: loading.Motion(m, 'top', 3), ValueError, 'Motion.values must be a function of the time or a table (times, values), got 3'),
		(lambda m: loading.Approach(m, 'top', slow='x'), TypeError, "Approach.slow must be a number, got 'x'"),
		(lambda m: brickwork.runningBond('x', 2, 1, 1), TypeError, "runningBond.bricks must be a number, got 'x'"),
		(lambda m: brickwork.runningBond(2, 2, 1, 1, openigns=()), TypeError, 'brickwork has no argument openigns (did you mean openings?)'),
		(lambda m: voussoirs.arch('x', 1, 2), TypeError, "arch.radius must be a number, got 'x'"),
		(lambda m: jointsets.cut(box, [jointsets.JointSet('a', 'steep', 1)]), TypeError, "JointSet.dip must be a number, got 'steep' in 'a'"),
		(lambda m: rubble.rubble(box, 'x'), TypeError, "rubble.size must be a number, got 'x'"),
		(lambda m: pictures.drawCracks('a.png', m, magnificaton=1), TypeError, 'drawCracks has no argument magnificaton (did you mean magnification?)'),
		(lambda m: nodesWhere(m, 3), TypeError, 'nodesWhere.rule must be a function of x and y, got 3')]
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
	assert not hasattr(model, 'somethingElse') and list(BlockServo(groups=['a']).groups) == ['a']
	with pytest.raises(ValueError, match="BlockModel.setJoints: kn must be one number or one for each joint, 1, got 'x'"):
		two = BlockModel(thickness=1)
		for x in (0, 1):
			two.addRigid([(x, 0), (x + 1, 0), (x + 1, 1), (x, 1)], 'unit')
		two.bond([JointMat(material1='unit', material2='unit', kn=1, ks=1)])
		two.setJoints(kn='x')
