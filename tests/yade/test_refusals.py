# yade-blocks, GPL-2.0-or-later
"""Bad input: a Python exception of one line that names the attribute, the rule and the value, and nothing of the model has changed."""
import pytest

from scenes import *

nan, inf = float('nan'), float('inf')
square, unit = rectangle(0, 0, 1, 1), 'unit'
bowtie = [(0, 0), (3, 2), (3, 0), (0, 1)]
star = [(0, 0), (4, 0), (4, 3), (1, -1), (1, 3)]


def refusal(action):
	"""The text of the exception that `action` gives."""
	with pytest.raises((ValueError, RuntimeError, TypeError)) as caught:
		action()
	text = str(caught.value)
	assert 0 < len(text) < 350 and '\n' not in text.strip(), 'not one line: ' + text
	return text


def says(text, *words):
	missing = [word for word in words if word not in text]
	assert not missing, '%s not in: %s' % (missing, text)


# ---- materials and the model


@pytest.mark.parametrize(
	'attribute, value, rule', [
		*[('young', v, 'positive') for v in (0., -1., nan, inf)], *[('poisson', v, '(-1, 0.5)') for v in (0.5, -1., 0.7, nan)],
		*[('density', v, 'positive') for v in (0., -5., nan, inf)]
	]
)
def test_material(attribute, value, rule):
	O.reset()
	O.materials.append(BlockMat(label='unit', **{**brick, attribute: value}))
	m = BlockModel()
	for add in lambda: m.addRegion(square, unit, zoneSize=1), lambda: m.addVoronoi(square, unit, size=0.3):
		says(refusal(add), 'BlockMat.' + attribute, rule, '%.17g' % value)
	assert m.blockCount == 0 and list(m.materialLabels) == []


@pytest.mark.parametrize('value', [0., -0.1, nan, inf])
def test_thickness(value):
	says(refusal(lambda: BlockModel(thickness=value)), 'BlockModel.thickness', 'positive', '%.17g' % value)
	m = BlockModel(thickness=0.3)
	says(refusal(lambda: setattr(m, 'thickness', value)), 'BlockModel.thickness')
	assert m.thickness == 0.3


def test_whatIsSetTooLate():
	materials()
	m = BlockModel(thickness=0.3)
	m.addRegion(square, unit, zoneSize=1)
	says(refusal(lambda: setattr(m, 'thickness', 0.4)), 'BlockModel.thickness', 'before')
	says(refusal(lambda: setattr(m, 'planeStress', True)), 'BlockModel.planeStress', 'before')
	assert (m.thickness, m.planeStress) == (0.3, False)
	m.insert()
	for what, action in (('addVoronoi', lambda: m.addVoronoi(rectangle(2, 0, 3, 1), unit, size=0.3)),
				('addRegion', lambda: m.addRegion(rectangle(2, 0, 3, 1), unit, zoneSize=1)), ('bond', m.bond), ('insert', m.insert)):
		says(refusal(action), 'BlockModel.' + what, 'insert')
	assert m.blockCount == len(O.bodies) == 1


def test_oneModelPerScene():
	materials()
	column().insert()
	says(refusal(column().insert), 'BlockModel.insert', 'another model')
	assert len(O.bodies) == 2


def test_nothingToInsert():
	O.reset()
	says(refusal(BlockModel().insert), 'BlockModel.insert', 'no blocks')


def test_materialLabels():
	materials()
	O.materials.append(FrictMat(label='sand'))
	m = BlockModel()
	says(refusal(lambda: m.addRegion(square, 'brick', zoneSize=1)), '"brick"', 'O.materials')
	says(refusal(lambda: m.addRegion(square, 'sand', zoneSize=1)), '"sand"', 'BlockMat', 'FrictMat')
	m.addRegion(square, unit, zoneSize=1)
	says(refusal(lambda: nodesWhere(m, lambda x, y: y < 1, label='mortar')), 'mortar', 'unit')


# ---- regions


@pytest.mark.parametrize(
	'outline, words', [(bowtie, ['cross']), (star, ['cross']), ([], ['3']), ([(0, 0), (1, 0)], ['3']), ([(0, 0), (1, 0), (2, 0)], []),
				([(0, 0), (1, 0), (nan, 1)], []), (square[::-1], ['counter-clockwise']), ([(0, 0), (1, 0), (1, 0), (0, 1)], [])]
)
@pytest.mark.parametrize('method', ['addVoronoi', 'addRegion'])
def test_polygons(method, outline, words):
	materials()
	m = BlockModel()
	text = refusal(lambda: m.addVoronoi(outline, unit, size=0.3) if method == 'addVoronoi' else m.addRegion(outline, unit, zoneSize=0.3))
	says(text, 'region', *words)
	assert m.blockCount == m.nodeCount == 0


@pytest.mark.parametrize(
	'holes', [[rectangle(0.5, 0.5, 1.5, 0.7)[::-1]], [rectangle(2, 2, 3, 3)[::-1]],
			[rectangle(0.2, 0.2, 0.6, 0.6)[::-1], rectangle(0.4, 0.4, 0.8, 0.8)[::-1]], [bowtie]]
)
@pytest.mark.parametrize('method', ['addVoronoi', 'addRegion'])
def test_holes(method, holes):
	materials()
	m = BlockModel()
	refusal(lambda: m.addVoronoi(square, unit, size=0.2, holes=holes) if method == 'addVoronoi' else m.addRegion(square, unit, zoneSize=0.3, holes=holes))
	assert m.blockCount == m.nodeCount == 0


@pytest.mark.parametrize(
	'change, words', [(dict(size=0), ['size', 'positive']), (dict(size=-1), ['size']), (dict(size=nan), ['size', 'nan']), (dict(size=inf), ['size']),
				(dict(size=3.), ['size', '3']), (dict(sizeMeaning='diameter'), ['sizeMeaning', 'sqrtArea', 'diameter']),
				(dict(lloyd=-1), ['lloyd', '-1']), (dict(seed=-2), ['seed', '-2']), (dict(mergeFraction=1.5), ['mergeFraction', '1.5']),
				(dict(mergeFraction=nan), ['mergeFraction']), (dict(zoning='hexagons'), ['zoning', 'hexagons']),
				(dict(seeds=[(5, 5)]), ['seed']), (dict(seeds=[(nan, 0.5)]), ['seed'])]
)
def test_voronoi(change, words):
	materials()
	m = BlockModel()
	says(refusal(lambda: m.addVoronoi(**{**dict(outline=square, material=unit, size=0.3), **change})), *words)
	assert m.blockCount == m.nodeCount == 0
	m.addVoronoi(square, unit, size=0.3) # what was refused does not claim its place


@pytest.mark.parametrize(
	'change, words', [(dict(zoneSize=0), ['zoneSize', 'positive']), (dict(zoneSize=-1), ['zoneSize']), (dict(zoneSize=nan), ['zoneSize', 'nan']),
				(dict(zoneSize=0, zoning='regular'), ['zoneSize']), (dict(zoning='hexagons'), ['zoning', 'hexagons']),
				(dict(outline=[(0, 0), (2, 0), (1, 1)], zoning='regular'), ['rectangle'])]
)
def test_region(change, words):
	materials()
	m = BlockModel()
	says(refusal(lambda: m.addRegion(**{**dict(outline=square, material=unit, zoneSize=0.3), **change})), *words)
	assert m.blockCount == m.nodeCount == 0
	m.addRegion(square, unit, zoneSize=1)


@pytest.mark.parametrize(
	'other', [
		rectangle(0.5, 0.5, 1.5, 1.5),
		rectangle(0.2, 0.2, 0.8, 0.8),
		rectangle(-1, -1, 2, 2), square,
		rectangle(0.5, 0, 1.5, 1),
		rectangle(-1, 0.4, 2, 0.6), [(0.5, -0.5), (1.5, 0.5), (0.5, 1.5), (-0.5, 0.5)]
	], ids=['corner', 'inside', 'around', 'same', 'half', 'cross', 'diamond']
)
@pytest.mark.parametrize('method', ['addVoronoi', 'addRegion'])
def test_overlappingRegions(method, other):
	materials()
	m = BlockModel()
	m.addRegion(square, unit, zoneSize=0.3)

	def build():
		m.addVoronoi(other, unit, size=0.15) if method == 'addVoronoi' else m.addRegion(other, unit, zoneSize=0.3)
		m.bond()

	says(refusal(build), 'overlap')


def test_aRegionInAnothersHoleIsNone():
	materials()
	m = BlockModel()
	hole = rectangle(0.25, 0.25, 0.75, 0.75)
	m.addRegion(square, unit, zoneSize=0.25, holes=[hole[::-1]])
	m.addRegion(hole, 'mortar', zoneSize=0.25)
	assert m.bond() == 1
	np.testing.assert_allclose(2 * m.segmentArea.sum(), 4 * 0.5, rtol=1e-12) # thickness 1


@pytest.mark.parametrize('tolerance', [0, -1, nan, 0.5])
def test_bond(tolerance):
	materials()
	m = column()
	says(refusal(lambda: m.bond(tolerance=tolerance)), 'tolerance', '%.17g' % tolerance)


# ---- boundary conditions


@pytest.mark.parametrize(
	'action, words',
	[
		(lambda m: m.drive('b', [0, 1], 'xy', velocity=1) or m.drive('c', [1, 2], 'y'), ['"c"', '"b"']),
		(lambda m: m.drive('b', [0], 'x') or m.drive('b', [1], 'x'), ['"b"', 'already']),
		(lambda m: m.drive('b', [], 'x'), ['"b"', 'at least one']),
		(lambda m: m.drive('b', [0], ''), ['"b"', 'at least one']),
		(lambda m: m.drive('b', [0], 'z'), ['axes', "'z'"]),
		(lambda m: m.drive('b', [10**6], 'x'), ['"b"', 'degree of freedom']),
		(lambda m: m.drive('b', [-1], 'x'), ['"b"', 'degree of freedom']),
		(lambda m: m.drive('b', [0, 0], 'x'), ['"b"', 'twice']),
		(lambda m: m.drive('b', [0], 'x', velocity=nan), ['"b"', 'finite', 'nan']),
		(lambda m: m.drive('b', [0], 'x', rampTime=-1), ['"b"', 'rampTime', '-1']),
		(lambda m: m.drive('b', [0], 'x', rampTime=nan), ['"b"', 'rampTime']),
		(lambda m: m.drive('b', [0], 'x', startTime=nan), ['"b"', 'startTime']),
		(lambda m: m.drive('b', [0.5], 'x'), []),
		(lambda m: m.drive('b', m.reference[:, 1] < 1e-9, 'x'), []), # a mask is no list of indices
		(lambda m: m.push('b', [0], 'xy', force=1), ['"b"', "'xy'"]),
		(lambda m: m.push('b', [0], 'x', force=inf), ['"b"', 'finite']),
		(lambda m: m.release('nobody'), ['"nobody"', 'low']),
		(lambda m: m.groupForce('nobody'), ['"nobody"', 'low']),
		(lambda m: m.setTarget('nobody', 1), ['"nobody"']),
		(lambda m: m.setTarget('low', nan), ['"low"', 'finite', 'nan']),
		(lambda m: m.setThrottle('low', 1.5), ['"low"', '[0, 1]', '1.5']),
		(lambda m: m.setThrottle('low', nan), ['"low"', '[0, 1]']),
		(lambda m: m.gravity((0, nan)), ['gravity', 'finite']),
		(lambda m: m.traction([], (0, 1)), ['traction', 'no edges']),
		(lambda m: m.traction([10**6], (0, 1)), ['traction', 'edge', '1000000']),
		(lambda m: m.traction([-1], (0, 1)), ['traction', '-1']),
		(lambda m: m.traction([0], (inf, 0)), ['traction', 'finite']),
		(lambda m: nodesWhere(m, lambda x, y: x > 1e9), ['no grid point']),
		(lambda m: nodesWhere(m, lambda x, y: x > 0, label='clay'), ['clay'])
	]
)
def test_boundaryConditions(action, words):
	materials()
	m = column()
	m.drive('low', [m.nodeCount - 1], 'xy')
	says(refusal(lambda: action(m)), *words)
	m.drive('still works', [3, 4], 'x')


# ---- joints


@pytest.mark.parametrize(
	'change, words', [
		*[({name: v}, [name, 'positive', '%.17g' % v]) for name in ('kn', 'ks') for v in (0., -400e9, nan, inf)],
		*[({name: v}, [name, 'negative', '%.17g' % v]) for name in ('cohesion', 'tension', 'cohesionResidual', 'tensionResidual') for v in (-1., nan)],
		*[({name: v}, [name, 'pi/2', '%.17g' % v]) for name in ('frictionAngle', 'dilationAngle', 'frictionAngleResidual')
			for v in (-0.1, 1.6, 38., nan)], (dict(cohesionResidual=1e6), ['cohesionResidual', 'exceed']),
		(dict(tensionResidual=1e6), ['tensionResidual', 'exceed']), (dict(dilationLimitSlip=-0.5), ['dilationLimitSlip', '-0.5']),
		(dict(dilationLimitSlip=nan), ['dilationLimitSlip']),
		(dict(dilationAngle=0.25, frictionAngleResidual=0.125), ['dilationAngle', 'frictionAngleResidual', '0.25', '0.125']),
		(dict(dilationAngle=0.75, frictionAngle=0.5), ['dilationAngle', 'frictionAngleResidual', '0.75', '0.5']),
		(dict(material1=''), ['material1', '""'])
	]
)
def test_jointProperties(change, words):
	joint = JointMat(**{'material1': 'a', 'material2': 'b', **glue, **change})
	says(refusal(lambda: Ip2_BlockMat_BlockMat_JointPhys(joints=[joint])), *words)
	functor = Ip2_BlockMat_BlockMat_JointPhys(joints=glued())
	says(refusal(lambda: setattr(functor, 'joints', [joint])), *words)
	assert len(functor.joints) == 3


def test_jointsTwiceAndOtherThings():
	a, b = (JointMat(material1=x, material2=y, **glue) for x, y in ('ab', 'ba'))
	says(refusal(lambda: Ip2_BlockMat_BlockMat_JointPhys(joints=[a, b])), 'two', '"a"', '"b"')
	refusal(lambda: Ip2_BlockMat_BlockMat_JointPhys(joints=[1]))
	refusal(lambda: Ip2_BlockMat_BlockMat_JointPhys(joints=a))


@pytest.mark.parametrize(
	'name, value', [('kn', 0.), ('kn', nan), ('ks', -1.), ('cohesion', -1.), ('tension', nan), ('tensionResidual', 1e7), ('frictionAngle', 2.),
			('dilationAngle', -0.1), ('frictionAngleResidual', nan), ('dilationLimitSlip', -1.)]
)
def test_jointOfOnePair(name, value):
	couplet()
	O.run(1, True)
	phys = next(iter(O.interactions)).phys
	before = getattr(phys, name)
	text = refusal(lambda: setattr(phys, name, value))
	says(text, 'angle' if 'Angle' in name else name)
	assert getattr(phys, name) == before


# ---- engines


@pytest.mark.parametrize(
	'attribute, value, words',
	[('damping', 'viscous', ['local', 'adaptive', 'none', 'viscous']), *[('alpha', v, ['[0, 1)', '%.17g' % v]) for v in (-0.1, 1., nan, inf)],
		('watchPeriod', -1, ['negative', '-1'])]
)
def test_integrator(attribute, value, words):
	says(refusal(lambda: BlockIntegrator(**{attribute: value})), 'BlockIntegrator.' + attribute, *words)
	engine = BlockIntegrator(damping='none', alpha=0.6, watchPeriod=50)
	says(refusal(lambda: setattr(engine, attribute, value)), 'BlockIntegrator.' + attribute, *words)
	assert (engine.damping, engine.alpha, engine.watchPeriod) == ('none', 0.6, 50)


def steps(run):
	"""Actions that a user would take after building: both forms of running; each must complain, not only one of them."""
	return {'step': O.step, 'run': lambda: O.run(10, True)}[run]


running = pytest.mark.parametrize('run', ['step', 'run'])


def standing(joints=None, **integrator):
	materials()
	m = column(labels=['unit', 'mortar'])
	m.drive('low', nodesWhere(m, lambda x, y: y < 1e-9), 'xy')
	m.insert()
	O.dt, O.engines = 1e-3, engines(strong() if joints is None else joints, **integrator)
	return m


@running
def test_missingPair(run):
	standing(joints=strong()[:1])
	text = refusal(steps(run))
	says(text, 'Ip2_BlockMat_BlockMat_JointPhys.joints', '"unit"', '"mortar"')
	refusal(steps(run)) # and it does not run on the second time either
	assert not model().velocity.any()


@running
def test_jointSpoiltAfterItWasHandedOver(run):
	joints = strong()
	standing(joints=joints)
	joints[1].kn = -1
	says(refusal(steps(run)), 'kn', 'positive', '-1')
	refusal(steps(run))


@running
@pytest.mark.parametrize('without, words', [(0, ['InteractionLoop']), (2, ['BlockForces'])])
def test_missingEngine(without, words, run):
	standing()
	O.engines = O.engines[:without] + O.engines[without + 1:]
	says(refusal(steps(run)), *words)


@running
def test_twoEnginesThatMove(run):
	standing()
	O.engines = O.engines + [BlockIntegrator(rescueFile='')]
	says(refusal(steps(run)), 'O.engines', 'one BlockMotion or BlockIntegrator', 'two')
	standing()
	O.engines = O.engines + [NewtonIntegrator(), NewtonIntegrator()]
	says(refusal(steps(run)), 'O.engines', 'one NewtonIntegrator', 'two')
	standing()
	O.engines = O.engines + [NewtonIntegrator(), NewtonIntegrator(dead=True), BlockIntegrator(dead=True)]
	O.run(10, True) # one for other bodies, and those that do nothing


@running
def test_gravityThatBlocksWouldNotFeel(run):
	standing()
	O.engines = O.engines + [NewtonIntegrator(gravity=(0, -9.75, 0))]
	says(refusal(steps(run)), 'NewtonIntegrator.gravity', 'BlockModel.gravity', '-9.75')
	O.engines[-1].gravity = (0, 0, 0)
	O.run(10, True)
	O.engines[-1].gravity = (0, -9.75, 0) # noticed within 100 steps
	says(refusal(lambda: O.run(100, True)), 'NewtonIntegrator.gravity')


def test_decimalPointInEveryLocale(tmp_path):
	"""Numbers in messages and files, in a language that writes 0,25."""
	source = subprocess.run(['localedef', '-i', 'de_DE', '-f', 'UTF-8', str(tmp_path / 'de_DE.UTF-8')], capture_output=True, text=True)
	if not (tmp_path / 'de_DE.UTF-8').exists(): pytest.skip('no locales to try: ' + source.stderr)
	run = runYade(
		"""
from scenes import *
import locale
locale.setlocale(locale.LC_ALL, 'de_DE.UTF-8')
print('comma', locale.str(0.5))
for wrong in -0.5, 1e-9, 0.1:
	try: BlockModel(thickness=-abs(wrong))
	except ValueError as error: print(error)
""", cwd=tmp_path, env=dict(LOCPATH=str(tmp_path))
	)
	assert 'comma 0,5' in run.stdout, run.stdout + run.stderr
	for shown in 'got -0.5', 'got -1.0000000000000001e-09', 'got -0.10000000000000001':
		assert shown in run.stdout, run.stdout + run.stderr


@running
def test_noBlocks(run):
	O.reset()
	O.engines = engines(strong())
	says(refusal(steps(run)), 'no blocks', 'insert')


@running
@pytest.mark.parametrize('safety', [0., -1., 1., nan])
def test_safety(safety, run):
	standing()
	O.engines[1].safety = safety
	says(refusal(steps(run)), 'BlockTimeStepper.safety', '(0, 0.95]', '%.17g' % safety)


@running
def test_safetyWithMuchLocalDamping(run):
	standing(alpha=0.9)
	O.engines[1].safety = 0.9
	says(refusal(steps(run)), 'safety', '0.9', 'local', '%.4g' % (0.95 / 1.9**0.5))
	O.engines[1].safety = 0.68
	O.run(10, True)


@running
def test_stepAboveTheStableLimit(run):
	standing()
	O.engines[1].quasiStatic = False
	O.run(10, True)
	O.engines[1].dead = True
	O.dt *= 1.5 # 1.05 of the limit
	says(refusal(steps(run)), 'O.dt', 'stable', '1.0')


@running
@pytest.mark.parametrize('dt', [0., nan, inf]) # a negative one asks YADE for its time stepper
def test_step(dt, run):
	standing()
	O.dt = dt
	says(refusal(steps(run)), 'O.dt', 'positive', '%.17g' % dt)


@running
def test_erasedBody(run):
	standing()
	O.run(10, True)
	O.bodies.erase(1)
	says(refusal(steps(run)), '1', 'erased')


def test_crackFile(tmp_path):
	couplet(steps=3000)
	O.run(1200, True)
	O.engines += [BlockCrackRecorder(fileName=str(tmp_path / 'nowhere' / 'cracks.txt'))]
	says(refusal(lambda: O.run(400, True)), 'BlockCrackRecorder.fileName', 'nowhere')
