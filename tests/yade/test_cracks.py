# yade-blocks, GPL-2.0-or-later
"""BlockCrackRecorder: which contact point broke, when, where and how."""
import pytest

from scenes import *

header = 'step time x y nx ny mode body1 body2 material1 material2 damage name'


def recorded(tmp_path, steps, file='cracks.txt', size=6e-3, **attributes):
	m = couplet(size=size)
	O.engines += [BlockCrackRecorder(fileName=str(tmp_path / file) if file else '', label='recorder', **attributes)]
	O.run(steps, True)
	return m, O.engines[-1]


def lines(path):
	first, *rest = path.read_text().splitlines()
	assert first == header
	return [line.split() for line in rest]


def test_eventsAreTheBrokenPoints(tmp_path):
	m, recorder = recorded(tmp_path, 1700)
	events, status = recorder.events, m.pointStatus
	assert len(events) == np.count_nonzero(status) > 10
	assert sorted(recorder.points) == np.flatnonzero(status).tolist() # each once
	assert [e['point'] for e in events] == list(recorder.points) and [e['time'] for e in events] == list(recorder.times)
	assert list(recorder.modes) == [status[p] for p in recorder.points] # a joint does not break again in another mode
	assert [e['mode'] for e in events] == [{1: 'tension', 2: 'shear'}[int(status[p])] for p in recorder.points]
	steps = [e['step'] for e in events]
	assert steps == sorted(steps) and 1200 < steps[0] < steps[-1] < 1700
	for e in events:
		assert tuple(e['ids']) == tuple(m.segmentBlocks[e['point'] // 2]) and e['time'] == pytest.approx(e['step'] * O.dt, rel=1e-12)
		assert e['materials'] == tuple(m.materialLabels[m.blockMaterial[b]] for b in e['ids'])
		moved = np.hypot(*(np.array(e['position']) - m.contactPositions()[e['point']]))
		assert moved < 2e-5 # the whole stroke is 1.2e-5
	file = lines(tmp_path / 'cracks.txt')
	assert len(file) == len(events)
	for line, e in zip(file, events):
		assert int(line[0]) == e['step'] and float(line[1]) == pytest.approx(e['time'], rel=1e-8) and line[6] == e['mode']
		assert (float(line[2]), float(line[3])) == pytest.approx(tuple(e['position']), rel=1e-8)
		assert tuple(map(int, line[7:9])
				) == tuple(e['ids']) and tuple(line[9:11]) == e['materials'] and float(line[11]) == e['damage'] == 1 and line[12:] == ['-']
		assert np.hypot(float(line[4]), float(line[5])) == pytest.approx(1, rel=1e-8)


def test_theStepIsRight(tmp_path):
	"""A run stopped right before the first event has no broken point, one step later it has."""
	_, recorder = recorded(tmp_path, 1500)
	first = recorder.events[0]
	m, recorder = recorded(tmp_path, first['step'])
	assert O.iter == first['step'] and not m.pointStatus.any() and recorder.events == []
	O.run(1, True)
	assert np.count_nonzero(m.pointStatus) == len(recorder.events
							) == len([e for e in [first]] + [e for e in recorder.events if e['step'] == first['step']]) - 1


def test_longerPeriodMissesNothing(tmp_path):
	m, recorder = recorded(tmp_path, 1701, file='', iterPeriod=100)
	assert sorted(recorder.points) == np.flatnonzero(m.pointStatus).tolist() and {e['step'] % 100 for e in recorder.events} == {0}
	assert not list(tmp_path.iterdir())


def test_acrossSaveAndLoad(tmp_path):
	m, recorder = recorded(tmp_path, 1700, file='whole.txt')
	expected = recorder.events
	first = expected[len(expected) // 2]['step'] # in the middle of the cracking
	m, recorder = recorded(tmp_path, first + 1, file='parts.txt')
	O.save(str(tmp_path / 'half.yade'))
	O.reset()
	O.load(str(tmp_path / 'half.yade'))
	assert 0 < len(O.engines[-1].events) < len(expected)
	O.run(1700 - O.iter, True)
	assert O.engines[-1].events == expected
	assert (tmp_path / 'whole.txt').read_text() == (tmp_path / 'parts.txt').read_text()


def test_clockSetBackForgetsNothing(tmp_path):
	"""O.resetTime() is no rescue: what happened stays, and what follows is added."""
	m, recorder = recorded(tmp_path, 1310) # in the middle of the cracking
	before = recorder.events
	assert len(before) > 3
	O.resetTime()
	O.run(200, True)
	events = O.engines[-1].events
	assert events[:len(before)] == before and len(events) > len(before) and {e['step'] <= 200 for e in events[len(before):]} == {True}
	assert sorted(recorder.points) == np.flatnonzero(m.pointStatus).tolist() and len(lines(tmp_path / 'cracks.txt')) == len(events)


def test_whatIsBrokenAlreadyIsNoEvent(tmp_path):
	m = couplet()
	O.run(1350, True)
	before = np.flatnonzero(m.pointStatus)
	assert len(before) >= 3
	O.engines += [BlockCrackRecorder()]
	O.run(300, True)
	recorder = O.engines[-1]
	assert len(recorder.events) and not set(recorder.points) & set(before.tolist())


def test_dryJointsAreNoEvents(tmp_path):
	materials()
	m = column()
	m.drive('low', nodesWhere(m, lambda x, y: y < 1e-9), 'xy')
	m.insert()
	O.dt, O.engines = 1e-3, engines(glued(bonded=False)) + [BlockCrackRecorder()]
	O.run(20, True)
	assert (m.pointStatus == 3).all() and O.engines[-1].events == []


def test_afterARescue(tmp_path):
	"""An instability that is taken back takes its cracks back too; afterwards events and statuses agree again."""
	file = str(tmp_path / 'rescue.yade')
	m = couplet(rescueFile=file)
	O.engines += [BlockCrackRecorder(fileName=str(tmp_path / 'cracks.txt'))]
	O.run(1250, True)
	while np.count_nonzero(m.pointStatus) < 2:
		O.run(20, True)
	m.velocity[3] = float('nan')
	with pytest.raises(RuntimeError, match='unstable'):
		O.run(1000, True)
	good = O.iter
	for put in 'back', 'loaded':
		if put == 'loaded': O.load(file)
		assert O.iter == good
		O.run(300, True)
		m, recorder = model(), O.engines[-1]
		assert sorted(recorder.points) == np.flatnonzero(m.pointStatus).tolist() and set(recorder.modes) <= {1, 2}
		steps = [e['step'] for e in recorder.events]
		assert steps == sorted(steps) and len(steps) > 2


@pytest.mark.parametrize('room, events', [('4k', 'some'), ('full', 'none')])
def test_fullDisk(tmp_path, room, events):
	"""One line that says what is full; the lines that fit are whole, and all events are still there."""
	if subprocess.run(['mount', '-t', 'tmpfs', '-o', 'size=4k', 'tmpfs', tmp_path], capture_output=True).returncode:
		pytest.skip('no right to mount a small disk')
	try:
		if room == 'full': (tmp_path / 'filler').write_bytes(b'x' * 4096)
		with pytest.raises(RuntimeError, match='BlockCrackRecorder.fileName: cannot write to .*cracks.txt: No space left on device'):
			recorded(tmp_path, 3000, size=2e-3)
		recorder = O.engines[-1]
		text = (tmp_path / 'cracks.txt').read_text()
		if events == 'none': assert text == '' and O.iter < 2
		else:
			assert text.endswith('\n') and 3000 < len(text) <= 4096 # no half line
			written = lines(tmp_path / 'cracks.txt')
			assert all(len(line) == 13 for line in written) and 0 < len(written) < len(recorder.events)
			assert [int(line[0]) for line in written] == [event['step'] for event in recorder.events][:len(written)]
	finally:
		subprocess.run(['umount', tmp_path], check=True)
