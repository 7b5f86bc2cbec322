# yade-blocks, GPL-2.0-or-later
"""Joint laws of one's own that keep columns: in numpy and in C++, saved in the middle, on one thread and two, with what is refused."""
import pytest

import ownlaws
from scenes import *
from test_step import golden, scene
from yadeblocks.export import State
from yadeblocks.snapshot import Snapshot

w = 1e-6 # wear at which half of the shear stiffness is left [m]


def wear(columns):
	"""As WearLaw in OwnLaws.cpp."""
	kn, ks = (np.repeat(model().jointProperties[name], 2) for name in ('kn', 'ks'))
	columns['wear'] += abs(columns['slip'] - columns['slipBefore'])
	columns['slipBefore'][:] = columns['slip']
	columns['sigma'][:] = kn * columns['opening']
	columns['tau'][:] = ks * columns['slip'] / (1 + columns['wear'] / w)


def worn(law=None):
	m = scene('shear')
	O.engines[0].contact = False # what has come apart does not matter here
	O.engines[0].law = law or NumpyLaw(wear, columns=('wear', 'slipBefore'))
	return m


def test_columnsOfALawInNumpy():
	"""The way slid, step by step, against the slips of the model."""
	m = worn()
	assert m.lawColumns == {}
	way, last = np.zeros(m.contactCount), np.zeros(m.contactCount)
	for _ in range(200):
		O.run(1, True)
		way += abs(m.pointSlip - last)
		last = np.array(m.pointSlip)
	columns = m.lawColumns
	assert list(columns) == ['wear', 'slipBefore'] and all(column.shape == (m.contactCount, ) for column in columns.values())
	assert np.array_equal(columns['wear'], way) and np.array_equal(columns['slipBefore'], last) and (way > 0).all()
	assert not columns['wear'].flags.writeable and m.lawColumns['wear'] is not columns['wear'] # copies
	O.run(1, True)
	assert np.array_equal(columns['wear'], way)


@pytest.mark.parametrize('ending', ['yade.bz2', 'xml'])
def test_savedInTheMiddle(ending, tmp_path):
	"""Loaded, with the function given anew: the bits of a run in one go."""
	whole = worn()
	O.run(600, True)
	expected = whole.fingerprint(), whole.lawColumns['wear']
	worn()
	O.run(377, True)
	O.save(str(tmp_path / f'middle.{ending}'))
	O.reset()
	O.load(str(tmp_path / f'middle.{ending}'))
	law = O.engines[0].law
	assert law.function is None and law.columns == ['wear', 'slipBefore'] and model().lawColumns['wear'].any()
	law.function = wear
	O.run(600 - 377, True)
	assert model().fingerprint() == expected[0] and np.array_equal(model().lawColumns['wear'], expected[1])


def test_theColumnsAct():
	"""A law that forgets takes another way."""
	remembers = worn()
	O.run(300, True)
	tau = np.array(remembers.pointTau)

	def forgets(columns):
		columns['slipBefore'][:] = columns['slip']
		wear(columns)

	forgetful = worn(NumpyLaw(forgets, columns=['wear', 'slipBefore']))
	O.run(300, True)
	assert not forgetful.lawColumns['wear'].any() and abs(forgetful.pointTau).max() > 1.01 * abs(tau).max()


def test_scenesWithoutColumnsAreAsBefore(tmp_path):
	"""Their bits, and their files: format 7, which is read where nobody knows of columns."""
	m = scene('tension')
	O.run(3000, True)
	assert m.fingerprint() == golden['tension'] and m.lawColumns == {}
	O.unsealedSave(str(tmp_path / 'without.xml'), True)
	worn()
	O.run(1, True)
	O.unsealedSave(str(tmp_path / 'with.xml'), True)
	without, with_ = ((tmp_path / f'{name}.xml').read_text() for name in ('without', 'with'))
	assert '<format>7</format>' in without and 'lawColumns' not in without
	assert '<format>8</format>' in with_ and 'slipBefore' in with_


def test_shown():
	"""In ParaView's files and in Snapshots, under their names."""
	m = worn()
	O.run(50, True)
	for shown in m, Snapshot(m):
		cells = State(shown, 0).grids['joints'][-1]
		assert np.array_equal(cells['wear'], m.lawColumns['wear']) and np.array_equal(cells['slipBefore'], m.lawColumns['slipBefore'])
	assert not State(m, 0, untouched=True).grids['joints'][-1]['wear'].any()
	assert 'wear' not in State(couplet(), 0).grids['joints'][-1]


def test_otherColumnsAreRefused(tmp_path):
	worn()
	O.run(10, True)
	O.save(str(tmp_path / 'worn.yade'))
	rule = "must name the columns that the model has from an earlier joint law, in their order: 'wear', 'slipBefore', got "
	for columns, got in (['damaged'], "'damaged'"), ([], 'none'), (['slipBefore', 'wear'], "'slipBefore', 'wear'"):
		O.load(str(tmp_path / 'worn.yade'))
		O.engines[0].law = NumpyLaw(wear, columns=columns)
		with pytest.raises((ValueError, RuntimeError)) as caught:
			O.run(1, True)
		assert 'BlockLoop.law: NumpyLaw ' + rule + got in str(caught.value)
	O.load(str(tmp_path / 'worn.yade'))
	O.engines[0].law = None # without a law of one's own they stay as they are
	before = model().lawColumns['wear']
	O.run(10, True)
	assert np.array_equal(model().lawColumns['wear'], before)
	model().dropLawColumns()
	assert model().lawColumns == {}
	O.engines[0].law = NumpyLaw(lambda columns: columns['count'].__iadd__(1), columns=['count'])
	O.run(7, True)
	assert (model().lawColumns['count'] == 7).all()


@pytest.mark.parametrize(
	'call, error, words',
	[(lambda: NumpyLaw(wear, columns='wear'), TypeError, "NumpyLaw.columns must be a list, got 'wear'"),
		(lambda: NumpyLaw(wear, columns=3), TypeError, 'NumpyLaw.columns must be a list of names, got 3'),
		(lambda: NumpyLaw(wear, columns=['a', 3]), TypeError, "NumpyLaw.columns must be a list of names, got ['a', 3]"),
		(
			lambda: NumpyLaw(wear, columns=['a', 'slip']), ValueError,
			"NumpyLaw.columns: a column's name must not be that of a column that contact points have anyway ('opening', 'slip', "
		), (lambda: NumpyLaw(wear, columns=['a', 'a']), ValueError, "NumpyLaw.columns: no two columns may have one name, got 'a', 'a'"),
		(lambda: NumpyLaw(wear, columns=['']), ValueError, "NumpyLaw.columns: a column's name must be letters, digits and _, no digit first, got ''"),
		(lambda: setattr(NumpyLaw(), 'columns', ['tau']), ValueError, "NumpyLaw.columns: a column's name must not be that of"),
		(lambda: NumpyLaw(wear, ['wear']), ValueError, 'NumpyLaw takes one function, got 2 arguments; columns is a keyword')]
)
def test_namesThatCannotBe(call, error, words):
	with pytest.raises(error) as caught:
		call()
	assert str(caught.value).startswith(words), str(caught.value)


def test_putBack():
	"""A run that turns unstable goes back to its last good state, and the columns with it. There the law is asked once more at the same slips, which add no
	way: it goes on as if nothing had been."""
	m = worn()
	O.engines[-1].watchPeriod = 50
	O.run(220, True)
	m.velocity[3] = float('nan')
	with pytest.raises(RuntimeError, match='not a number'):
		O.run(500, True)
	assert O.iter == 200
	O.run(100, True)
	bits = m.fingerprint()
	whole = worn()
	O.run(300, True)
	assert whole.fingerprint() == bits and whole.lawColumns['wear'].any()


def test_theElasticJumpKeepsThem():
	m = worn()
	O.run(50, True)
	before = m.lawColumns
	m.elasticJump()
	assert all(np.array_equal(m.lawColumns[name], before[name]) for name in before) and before['wear'].any()


# ---- in C++


@ownlaws.built
def test_columnsOfALawInCpp(tmp_path):
	"""The law in numpy and the one in C++ make the same bits, saved in the middle or not."""
	m = worn()
	O.run(600, True)
	expected = m.fingerprint()
	m = worn(WearLaw(w=w))
	O.run(377, True)
	O.save(str(tmp_path / 'middle.yade.gz'))
	O.run(600 - 377, True)
	assert m.fingerprint() == expected
	O.reset()
	O.load(str(tmp_path / 'middle.yade.gz'))
	assert O.engines[0].law.w == w
	O.run(600 - 377, True)
	assert model().fingerprint() == expected


script = '''
import ownlaws
from scenes import *
from yadeblocks.engines import loopList
model = largeCouplet(glued())
model.drive('top', nodesWhere(model, isOnTop), 'xy', velocity=1e-4)
model.insert()
O.dt, O.engines = 1e-3, loopList(alpha=0.5, rescueFile='')
O.engines[0].law = WearLaw(w=1e-6)
O.run(100, True)
print('result', O.numThreads, model.fingerprint(), (model.lawColumns['wear'] > 0).mean() > 0.5)
'''


@ownlaws.built
def test_sameBitsOnOneThreadAndTwo(tmp_path):
	bits = []
	for threads in 1, 2:
		run = runYade(script, threads=threads, cwd=tmp_path)
		assert run.returncode == 0 and f'result {threads} ' in run.stdout, run.stdout[-1000:] + run.stderr[-2000:]
		bits.append([line.split()[2:] for line in run.stdout.splitlines() if line.startswith('result')])
	assert bits[0] == bits[1] and bits[0][0][1] == 'True'
