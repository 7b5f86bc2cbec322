# yade-blocks, GPL-2.0-or-later
"""The classes as Python sees them: documented, readable, writable where they should be, and no trap for those who look around."""
import copy
import pickle
import pydoc

import pytest
import yade

from scenes import *

# what can be set, with a value that is not the default
writable = {
	'Block': {},
	'BlockMat': dict(young=2e9, poisson=0.1, density=5., label='clay'),
	'BlockModel': dict(thickness=0.5, planeStress=True, smallStrain=True),
	'BlockGeom': {},
	'Ig2_Block_Block_BlockGeom': dict(label='a'),
	'JointMat': dict(
		material1='a', material2='b', kn=1., ks=2., frictionAngle=0.3, cohesion=4., tension=5., dilationAngle=0.6, frictionAngleResidual=0.7,
		cohesionResidual=8., tensionResidual=9., dilationLimitSlip=1e-3, bonded=False
	),
	'JointPhys': {},
	'Ip2_BlockMat_BlockMat_JointPhys': dict(label='a'),
	'Law2_BlockGeom_JointPhys_MohrCoulomb': dict(label='a'),
	'BlockTimeStepper': dict(safety=0.5, quasiStatic=False, active=False, label='a'),
	'BlockEngine': dict(dead=True, label='a'),
	'BlockForces': dict(dead=True, label='a'),
	'BlockLoop': dict(contact=True, dead=True, label='a'),
	'BlockLaw': {},
	'NumpyLaw': dict(columns=['wear']),
	'BlockState': {},
	'BlockMotion': dict(damping='none', alpha=0.7, watchPeriod=7, rescueFile='x.xml', safety=0.5, quasiStatic=False, dead=True, label='a'),
	'BlockIntegrator': dict(damping='none', alpha=0.7, watchPeriod=7, rescueFile='x.xml', dead=True, label='a'),
	'BlockServo': dict(groups=['a'], target=0.01, floor=3., least=0.5, period=7, dead=True, label='a'),
	'BlockCrackRecorder': dict(fileName='x.txt', iterPeriod=3, label='a'),
	'Bo1_Block_Aabb': dict(label='a'),
	'BlockContacts': dict(dead=True, label='a'),
	'Gl1_Block': dict(label='a'),
	'Gl1_BlockGeom': dict(label='a'),
	'Gl1_JointPhys': dict(label='a'),
}
readonly = {
	'Block': 'model index outline force nodes zones',
	'BlockModel': 'materialLabels firstBody showsInteractions jointProperties groups blockCount nodeCount zoneCount contactCount',
	'BlockGeom': 'model pair contact ends points positions normals areas openings slips',
	'JointPhys': 'model pair contact sigma tau status',
	'BlockTimeStepper': 'stableStep',
	'BlockMotion': 'stableStep',
	'BlockState': 'model index',
	'BlockServo': 'throttle',
	'BlockContacts': 'colliderRuns',
	'BlockCrackRecorder': 'points modes times positions events',
}
each = pytest.mark.parametrize('name', list(writable))


def test_noClassIsForgotten():
	known = yade.system.childClasses('Serializable')
	assert {name for name in known if 'Block' in name or name.startswith(('Joint', 'Gl1_Joint')) or name == 'NumpyLaw'} - {'BlockGen'} == set(writable)


@each
def test_everythingIsDocumented(name):
	cls = getattr(yade, name)
	assert len(cls.__doc__.strip()) > 20
	static = [member for member, value in vars(cls).items() if type(value).__name__ == 'StaticProperty'] # Boost gives these no text of their own
	assert [member for member in static if f'{member}:' not in cls.__doc__ and f'{member}``' not in cls.__doc__] == []
	undocumented = [
		member for member, value in vars(cls).items() if not member.startswith('_') and member not in static and
		(isinstance(value, property) or callable(value)) and len((value.__doc__ or '').split(':ydefault:')[0].strip()) < 5
	]
	assert undocumented == []
	text = pydoc.plain(pydoc.render_doc(cls))
	assert cls.__doc__.strip().split('.')[0][:40] in ' '.join(text.replace('|', ' ').split())


@each
def test_numbersHaveUnits(name):
	"""A length, force, stress or time without its unit is a trap: [m], [Pa], ... or what kind of number it is."""
	plain = 'bonded material1 material2 dead label ompThreads timingDeltas execTime execCount safety alpha active watchPeriod'.split()
	plain += 'poisson pair index firstBody points modes'.split()
	for member, value in vars(getattr(yade, name)).items():
		if not isinstance(value, property) or ':yattrtype:`Real`' not in (value.__doc__ or '') or member in plain: continue
		assert '[' in value.__doc__, member


@each
def test_attributes(name):
	cls = getattr(yade, name)
	one = cls(**writable[name]) # by keyword
	two = cls()
	for attribute, value in writable[name].items():
		assert getattr(one, attribute) == value
		assert getattr(two, attribute) != value
		setattr(two, attribute, value)
		assert getattr(two, attribute) == value
	for attribute in readonly.get(name, '').split():
		with pytest.raises(AttributeError):
			setattr(one, attribute, None)
	with pytest.raises(AttributeError, match='bogus'):
		cls(bogus=1)


@pytest.mark.parametrize('name', ['BlockMat', 'JointMat', 'BlockTimeStepper', 'BlockIntegrator', 'BlockServo', 'BlockCrackRecorder'])
@pytest.mark.parametrize('duplicate', [copy.deepcopy, lambda x: pickle.loads(pickle.dumps(x))], ids=['deepcopy', 'pickle'])
def test_duplicates(name, duplicate):
	twin = duplicate(getattr(yade, name)(**writable[name]))
	assert all(getattr(twin, attribute) == value for attribute, value in writable[name].items())


def test_keywordsOfTheFunctors():
	joints = glued()
	functor = Ip2_BlockMat_BlockMat_JointPhys(joints=joints, label='ip2')
	assert [j.material1 for j in functor.joints] == ['unit', 'unit', 'mortar'] and functor.label == 'ip2'
	functor.joints = joints[:1]
	assert len(functor.joints) == 1


def test_theSceneAsYadeShowsIt():
	m = couplet()
	O.run(400, True)
	assert len(O.bodies) == m.blockCount == 13 and m.firstBody == 0 and O.interactions.countReal() == len(O.interactions)
	for i, b in enumerate(O.bodies):
		assert isinstance(b.shape, Block) and b.shape.index == i and isinstance(b.mat, BlockMat) and b.mat.label == m.materialLabels[m.blockMaterial[i]]
		first, last = b.shape.nodes
		assert (first, last) == (m.firstNode[i], m.firstNode[i + 1]) and b.shape.zones == (m.firstZone[i], m.firstZone[i + 1])
		assert b.state.mass == pytest.approx(m.mass[first:last].sum(), rel=1e-14)
		weights = m.mass[first:last] / m.mass[first:last].sum()
		np.testing.assert_allclose(np.array(b.state.pos), [*(weights @ m.position[first:last]), 0], rtol=0, atol=1e-17 * 20) # 20 roundings of 0.04 m
		np.testing.assert_allclose(np.array(b.shape.force), m.force[first:last].sum(axis=0), atol=1e-13 * abs(m.force).max())
		edges = m.edgeNodes[m.firstEdge[i]:m.firstEdge[i + 1], 0]
		assert np.array_equal(np.array(b.shape.outline), m.position[edges])
	seen = []
	for i in O.interactions:
		assert isinstance(i.geom, BlockGeom) and isinstance(i.phys, JointPhys) and i.geom.pair == i.phys.pair
		points = slice(*i.geom.points)
		segments = np.arange(len(m.pointSigma))[points] // 2
		seen += range(*i.geom.points)
		assert {tuple(p) for p in m.segmentBlocks[segments]} == {(i.id1, i.id2)}
		for shown, array in ((i.geom.openings, m.pointOpening), (i.geom.slips, m.pointSlip), (i.phys.sigma, m.pointSigma), (i.phys.tau, m.pointTau),
					(i.phys.status, m.pointStatus)):
			assert np.array_equal(shown, array[points])
		assert np.array_equal(i.geom.areas, m.segmentArea[segments]) and np.array_equal(np.array(i.geom.normals), m.normal[segments])
		assert np.array_equal(np.array(i.geom.positions), m.contactPositions()[points])
		assert (i.phys.kn, i.phys.ks, i.phys.tension, i.phys.cohesion, i.phys.cohesionResidual) == (400e9, 200e9, 0.6e6, 0.6e6, 0)
		assert i.phys.frictionAngle == pytest.approx(radians(38), rel=1e-15) and i.phys.dilationAngle == pytest.approx(radians(4), rel=1e-15)
		assert i.phys.frictionAngleResidual == i.phys.frictionAngle
	assert sorted(seen) == list(range(m.contactCount))


def test_whatWasMadeByHandIsRefused(tmp_path):
	"""Blocks are made by BlockModel.insert; one made by hand has no model: an exception, and no crash of the whole program."""
	looks = [
		'Block().force', 'Block().outline', 'Block().nodes', 'Block().zones', 'BlockGeom().points', 'BlockGeom().areas', 'BlockGeom().positions',
		'JointPhys().kn', 'JointPhys().frictionAngle', 'JointPhys().sigma', 'JointPhys().status', 'setattr(JointPhys(), "kn", 1.)',
		'O.bodies.append(Body(shape=Block())); O.engines = [BlockForces()]; O.step()'
	]
	script = '''
import yadeblocks
from yade import *
for look in %r:
	try: exec(look)
	except RuntimeError as error: print('refused', look, error, flush=True)
''' % looks
	run = runYade(script, cwd=tmp_path)
	refused = [line for line in run.stdout.splitlines() if line.startswith('refused')]
	assert run.returncode == 0 and len(refused) == len(looks), run.stdout[-2000:] + run.stderr[-500:]
	assert all('model is empty' in line or 'no blocks' in line for line in refused), refused
