# yade-blocks, GPL-2.0-or-later
"""Wrong types, typing errors in keywords and attributes, and what is left out: a sentence with the name, the rule and the value, for every call."""
import importlib
import inspect
import math
import pkgutil

import pytest

from scenes import *
from yadeblocks import _calls, _kinds, brickwork, jointsets, layout, loading, outlines, pictures, picturesfields, platen, rubble, snapshot, voussoirs

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
	assert loading.Stop(drop=None, displacement=1.).drop is None and brickwork.runningBond(np.int64(2), 2, np.float32(1),
												1).counts == {'whole': 3, 'part': 2}
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


# ---- functions in Python

#: Modules whose functions and classes a script calls with values of its own; the others are for scenarios' own machinery, or take what these return.
forScripts = (
	'bisection brickwork engines export jointsets layout limitanalysis loading outlines pace packing pictures picturesfields platen recording rubble '
	'snapshot specimen voussoirs window'
).split()
#: What has no door: parts of others, and what is given to them by these.
inner = {
	'export': 'pairName pointNames jointNames pointsOf Present blockOutlines contactLines principalStresses jointMotion freeContactLines zoneStrains '
	'outOfPlaneStress vonMises', 'engines': 'contactEngines find addBehindForces', 'layout': 'area counterClockwise Placed', 'pace': 'strainEnergy',
	'pictures': 'drawSheets drawFilm drawRun filmOf', 'recording': 'runner known call Recorder', 'snapshot': 'poissonOf reactionsOf', 'specimen': 'addCells'
}
#: Arguments that may be anything, or are looked at within.
free = {
	'Layout.addTo.region', 'Pace.stream', 'Motion.values', 'Gauge.axis', 'drawCurve.labels', 'Placed.bond.properties', 'Mortared.addTo.voronoi',
	'group.nodes'
}


def doors():
	"""Every public function of the modules for scripts, and every class's __init__, with where it stands; of a room, what is imported from its folder."""
	for module in forScripts:
		there = importlib.import_module('yadeblocks.' + module)
		room = hasattr(there, '__path__') or module == 'picturesfields'
		for name, it in vars(there).items():
			home = getattr(it, '__module__', '') or ''
			if name.startswith('_') or name in inner.get(module,
									'').split() or not (home == there.__name__ or room and home.startswith('yadeblocks.')):
				continue
			if inspect.isclass(it) and issubclass(it, tuple): continue # a namedtuple
			yield f'{module}.{name}', vars(it)['__init__'] if inspect.isclass(it) else it


def test_everyFunctionHasADoor():
	"""Each public function of a module for scripts looks at its arguments, and knows a kind for each of them."""
	assert {name for _, name, _ in pkgutil.iter_modules(importlib.import_module('yadeblocks').__path__)} >= set(forScripts)
	missing = [(module, name) for module, names in inner.items() for name in names.split()
			if not hasattr(importlib.import_module('yadeblocks.' + module), name)]
	assert missing == []
	without = [name for name, function in doors() if len(inspect.signature(function).parameters) and not hasattr(function, 'door')]
	assert without == []
	kinds = {
		f"{function.__qualname__.removesuffix('.__init__')}.{word}": kind for _, function in doors() for word, kind, _ in getattr(function, 'door', ())
	}
	assert {name for name, kind in kinds.items() if not kind} <= free and {kind for kind in kinds.values() if kind} <= set(_kinds.kinds)
	assert len(kinds) > 200


def test_everyDoorSaysWhatIsWrong():
	"""For each argument of each function values of other types, and numbers that are none: a sentence with name, rule and value, and nothing is done."""
	wrongs = (object(), 'x', 3, True, math.nan, math.inf, None, [1, 'a'], {'a': 1}, b'x', [[1, 2], [3]], lambda: 0, int)
	count = 0
	for _, function in doors():
		parameters = getattr(function, 'door', ())
		name = function.__qualname__.removesuffix('.__init__')
		for word, kind, default in parameters:
			for value in wrongs:
				if not kind or _kinds.fits(value, kind) or value is None and default is None: continue
				right = {other: _right[kind] for other, kind, default in parameters if default is inspect.Parameter.empty and kind}
				free = {other: None for other, kind, default in parameters if default is inspect.Parameter.empty and not kind}
				own = {'self': None} if 'self' in inspect.signature(function).parameters else {}
				with pytest.raises((TypeError, ValueError)) as caught:
					function(*own.values(), **{**free, **right, word: value})
				assert str(caught.value).startswith(f'{name}.{word} must be ') and 'got ' in str(caught.value), (name, word, value)
				count += 1
	assert count > 500


class _Stands:
	"""Something with the attributes that kinds ask for."""
	reference = position = segmentBlocks = materialLabels = groupPushForce = outlines = pieces = states = peak = groupby = setThrottle = ()


_right = {
	**dict.fromkeys(('finite', 'float', 'whole', 'notNegative'), 1), 'flag': False, 'str': 'a', 'path': 'a', 'file': 'a', 'point': (0, 1),
	'numbers': [0, 1], 'points': [(0, 1)], 'motions': [(0, 1, 2)], 'polygon': box, 'polygons': [], 'box': (0, 0, 1, 1), 'boxes': [], 'sequence': [],
	'mapping': {}, 'mappingOrNone': None, 'function': len, 'functionOfPlace': len, 'nodes': [0], 'joints': 'a',
	**dict.fromkeys(('model', 'blockModel', 'throttled', 'layout', 'film', 'table'), _Stands()), 'models': []
}


@pytest.mark.parametrize(
	'call, error, words',
	[
		(lambda m: picturesfields.drawField(), TypeError, 'drawField needs path and model and what: drawField(path, model, what, '),
		(lambda m: picturesfields.drawField(3, m, 'u'), TypeError, 'drawField.path must be a path or a binary file, got 3'),
		(lambda m: picturesfields.drawField('a.png', 3, 'u'), TypeError, 'drawField.model must be a BlockModel or a Snapshot of one, got 3'),
		(lambda m: picturesfields.drawField('a.png', m, 'u', window=3), TypeError, 'drawField.window must be a rectangle (x0, y0, x1, y1), got 3'),
		(
			lambda m: picturesfields.drawField('a.png', m, 'u', window=(1, 0, 0, 1)), ValueError,
			'window must have x0 < x1 and y0 < y1, got (1, 0, 0, 1)'
		),
		(
			lambda m: picturesfields.drawField('a.png', m, 'u', magnification=-1), ValueError,
			'drawField.magnification must be a finite number, and not negative, got -1'
		),
		(lambda m: picturesfields.drawField('a.png', m, 'ux', magnification='x'), TypeError, "drawField.magnification must be a number, got 'x'"),
		(lambda m: picturesfields.drawField('a.png', m, 'w'), ValueError, "what must be one of u, ux, uy, sxx"),
		(
			lambda m: pictures.drawCracks('a.png', m, joints=3.5), TypeError,
			'drawCracks.joints must be a name of joints, a list of names or a list of indices'
		),
		(lambda m: pictures.drawCracks('a.png', m, joints=[10**6]), ValueError, 'joints: indices must lie in [0, '),
		(lambda m: pictures.drawCurve('a.png', 3, 'x', 'y'), TypeError, 'drawCurve.curves must be a DataFrame, got 3'),
		(lambda m: picturesfields.drawMovie('a.avi', [snapshot.Snapshot(m)]), ValueError, "path's ending must be one of .gif, .mp4, got '.avi'"),
		(lambda m: picturesfields.drawMovie('a.gif', [3]), TypeError, 'drawMovie.states must be a list of Snapshots, got [3]'),
		(lambda m: snapshot.Film(m, frames=1.5), ValueError, 'Film.frames must be a whole number, got 1.5'),
		(lambda m: platen.Platen(m, 0, 3), TypeError, 'Platen.velocity must be a pair of finite numbers (x, y), got 3'),
		(lambda m: nodesWhere(m, lambda x, y: x), ValueError, 'nodesWhere.rule must return True or False for each of '),
		(lambda m: brickwork.runningBond(math.inf, 2, 1, 1), ValueError, 'runningBond.bricks must be a finite number, got inf'), # it ran for ever
		(lambda m: brickwork.runningBond(2, 2, 1, 1, crack='yes'), TypeError, "brickwork.crack must be True or False, got 'yes'"),
		(
			lambda m: brickwork.runningBond(2, 2, 1, 1, openings=(0, 0, 1, 1)), TypeError,
			'brickwork.openings must be a list of rectangles (x0, y0, x1, y1), '
		),
		(lambda m: brickwork.runningBond(2, 2, 1, 1, openings=[(0, 0, 2, 2)]), ValueError, 'brickwork.openings must leave something of the wall, got '),
		(
			lambda m: brickwork.brickwork(1, 2, 0.1, [5]), TypeError,
			'brickwork.pattern must be a list of pairs of numbers, length and shift of a course, got [5]'
		),
		(lambda m: voussoirs.arch(1, 0.1, 10, centre=3), TypeError, 'arch.centre must be a pair of finite numbers (x, y), got 3'),
		(
			lambda m: voussoirs.arch(1, 0.1, 1, angle=3), ValueError,
			'arch.chords must be so many that each spans a right angle at most, got 1 for 1 voussoirs'
		),
		(lambda m: rubble.rubble(box, 0.2, seed=-1), ValueError, 'rubble.seed must be a whole number >= 0, got -1'),
		(lambda m: rubble.rubble('box', 0.2), TypeError, "rubble.outline must be a polygon, a list of at least three points (x, y), got 'box'"),
		(lambda m: rubble.rubble(box, 0.2, holes=3), TypeError, 'rubble.holes must be a list of polygons, '),
		(lambda m: cut(jointsets.JointSet('a', 20, 1)), TypeError, 'cut.sets must be a list of JointSets, got JointSet('),
		(lambda m: cut([3]), TypeError, 'cut.sets must be a list of JointSets, and one is 3'),
		(lambda m: cut([jointsets.JointSet('a', 20, 1, seed=-1)]), ValueError, "JointSet.seed must not be negative, got -1 in 'a'"),
		(
			lambda m: cut([jointsets.JointSet('a', 20, 1, through=3)]), TypeError,
			"JointSet.through must be a pair of finite numbers (x, y), got 3 in 'a'"
		),
		(lambda m: cut([jointsets.JointSet(3, 20, 1)]), TypeError, 'JointSet.name must be a text, got 3'),
		(
			lambda m: cut([jointsets.JointSet('a', 20, 1e-9)]), ValueError,
			'JointSet.spacing and length must be so large that there are 100000 joints at most'
		),
		(lambda m: cut([], cracks={'f': [(0, 0.5)]}), ValueError, "cut.cracks: 'f' must have at least two points, each away from the one before, got "),
		(lambda m: cut([], cracks={'f': [(5, 5), (6, 5)]}), ValueError, "cut.cracks: 'f' must reach the polygon, got "),
		(lambda m: cut([], cracks={'f': 3}), TypeError, "cut.cracks: 'f' must be a list of points (x, y), got 3"),
		(lambda m: cut([], least=-1), ValueError, 'cut.least must not be negative, got -1'),
		(lambda m: layout.Mortared(3, 0.1), TypeError, 'Mortared.layout must be a Layout, got 3'),
		(lambda m: outlines.read(3), TypeError, 'read.path must be a path, got 3'),
		(lambda m: outlines.read('nowhere.dxf'), FileNotFoundError, '[Errno 2] No such file'),
		(lambda m: m.follow('a', gauges=3), ValueError, 'BlockModel.follow.gauges must be a list of Gauges, got 3'),
		(lambda m: m.follow('a', gauges=[3]), ValueError, 'BlockModel.follow.gauges must be a list of Gauges, got [3]'),
		(lambda m: m.follow(2.5), ValueError, 'BlockModel.follow.group must be the name of a group or the index of a rigid block, got 2.5')
	]
)
def test_whatFunctionsSay(model, call, error, words):
	two = BlockModel(thickness=0.05)
	for x in (0, 1):
		two.addRegion([(x, 0), (x + 1, 0), (x + 1, 1), (x, 1)], 'unit', 0.5)
	two.bond(strong()[:1])
	two.drive('a', [0], 'x')
	with pytest.raises(error) as caught:
		call(two)
	assert str(caught.value).startswith(words), str(caught.value)


def cut(sets, **more):
	return jointsets.cut(box, sets, **more)


@pytest.mark.parametrize(
	'ending, content, words', [('dxf', b'hello', 'a.dxf cannot be read as DXF: '), ('svg', b'<svg', 'a.svg cannot be read as SVG: '),
					('csv', b'\xff\xfe\x00', 'a.csv cannot be read as CSV: '),
					('csv', b'0,0\n1,nan\n1,1', 'line 2 of a.csv must be x,y or x,y,name, got 1,nan'),
					('csv', b'0,0,left\n1,0,left', 'polygon 1 of a.csv (left): an outline must be a polygon')]
)
def test_filesThatAreNoDrawings(ending, content, words, tmp_path):
	path = tmp_path / f'a.{ending}'
	path.write_bytes(content)
	with pytest.raises(ValueError) as caught:
		outlines.read(path)
	assert str(caught.value).startswith('outlines.read: ' + words), str(caught.value)


def test_jointSetsFarFromTheirPoint():
	"""Surveyors' coordinates: as many blocks as near the origin, at once."""
	for far in (0, 5e5):
		rock = jointsets.cut([(x + far, y + far) for x, y in box], [jointsets.JointSet('a', 0, 0.25), jointsets.JointSet('b', 90, 0.5, scatter=0.1)])
		assert len(rock.outlines) == pytest.approx(8, abs=4) and sum(rock.areas) == pytest.approx(1, rel=1e-3)
