# yade-blocks, GPL-2.0-or-later
"""The same bits on one thread and on two, by either list of engines, after saving in the middle, and from run to run; and the bits that a scene of two threads
had when this was written."""
import pytest

from scenes import *

# 1050 cells, more than 6000 zones: BlockEngines' threadsFor then starts a second thread
script = '''
from scenes import *
import hashlib
model = largeCouplet()
model.push('top', nodesWhere(model, isOnTop), 'y', force=4e3, rampTime=0.2) # 0.8 MPa: beyond the strength
model.gravity((1, -9.81))
model.insert()
O.dt, O.engines = 1e-3, engines(glued(), alpha=0.5)
def digest():
	return ' '.join(name + ':' + hashlib.sha256(value.tobytes()).hexdigest()[:16] for name, value in state(model).items())
O.run(200, True)
print('bits', digest(), np.count_nonzero(model.pointStatus))
O.trackEnergy = True
O.engines[3].damping = 'adaptive'
O.run(100, True)
print('bits', digest(), np.count_nonzero(model.pointStatus))
print('threads', O.numThreads)
'''


def test_sameBitsOnOneThreadAndTwo(tmp_path):
	bits = []
	for threads in 1, 2, 2:
		run = runYade(script, threads=threads, cwd=tmp_path)
		assert run.returncode == 0 and 'threads %d' % threads in run.stdout, run.stdout[-1000:] + run.stderr[-2000:]
		bits.append([line.split() for line in run.stdout.splitlines() if line.startswith('bits')])
	assert bits[0] == bits[1] == bits[2]
	assert 0 < int(bits[0][0][-1]) < int(bits[0][1][-1]) # joints broke, and went on breaking
	assert bits[0][0][1:-1] != bits[0][1][1:-1]


def test_sameBitsFromRunToRun():
	def run():
		m = couplet(damping='adaptive', trackEnergy=True)
		O.run(1400, True)
		return state(m)

	assert differences(run(), run()) == []


# A couplet with general contact, pressed and sheared: a quarter of its points breaks in 400 steps.
goldenScript = '''
import hashlib, time
from scenes import *
from scenes import model as presentModel
from yadeblocks.engines import loopList

steps, middle = 400, 237

def scene(native):
	materials()
	model = BlockModel(thickness=0.05)
	model.addVoronoi(rectangle(0, 0.01, 0.1, 0.025), 'mortar', size=1.2e-3, seed=3)
	model.addRegion(rectangle(0, 0, 0.1, 0.01), 'unit', zoneSize=5e-3)
	model.addRegion(rectangle(0, 0.025, 0.1, 0.035), 'unit', zoneSize=5e-3)
	joints = glued(cohesion=0.3e6)
	model.bond([] if native else joints)
	top = nodesWhere(model, isOnTop)
	model.drive('bottom', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
	model.push('press', top, 'y', force=-4e3, rampTime=0.05) # 0.8 MPa
	model.drive('top', top, 'x', velocity=1e-3, rampTime=0.05)
	model.gravity((1, -9.81)) # no force begins with zero, from where two summands have no order
	model.insert()
	O.trackEnergy = True
	O.dt = 1e-3
	motion = dict(alpha=0.3, rescueFile='')
	O.engines = engineList(joints, contact=True, **motion) if native else loopList(contact=True, **motion)

def processorTimes():
	return {task: time.clock_gettime(~int(task) << 3 | 6) for task in os.listdir('/proc/self/task')} # Linux' clock of a thread [s]

for path in 'flat', 'native':
	for saved in False, True:
		scene(path == 'native')
		O.run(middle, True)
		if saved:
			O.save('middle.yade.bz2')
			O.reset()
			O.load('middle.yade.bz2')
		before, energies = processorTimes(), hashlib.sha256()
		while O.iter < steps:
			O.step() # not O.run(), whose threads end with it
			energies.update(repr([(name, value) for name, value in sorted(O.energy.items()) if name != 'blockJoints']).encode())
		spent = [now - before.get(task, 0) for task, now in processorTimes().items()]
		model = presentModel()
		print('result', path, 'saved' if saved else 'whole', model.fingerprint(), energies.hexdigest()[:16], model.zoneCount,
			np.count_nonzero(model.pointStatus), len(model.freeContacts()['blocks']), O.energy['blockFriction'], 1 - max(spent) / sum(spent))
'''

# Fingerprint of the state in the end, and of the accounts in the steps behind the middle. They change only where CHANGELOG says that bits have moved, as those
# in test_step.py do.
golden = ['5cb3af1463e7a7ca', 'd8cae31b66d7e112']


@pytest.mark.parametrize('threads', [1, 2])
def test_goldenFingerprintsOfASceneForTwoThreads(threads, tmp_path):
	run = runYade(goldenScript, threads=threads, cwd=tmp_path)
	assert run.returncode == 0, run.stdout[-1000:] + run.stderr[-2000:]
	results = [line.split()[1:] for line in run.stdout.splitlines() if line.startswith('result')]
	assert [r[:2] for r in results] == [['flat', 'whole'], ['flat', 'saved'], ['native', 'whole'], ['native', 'saved']]
	for path, saved, *bits, zones, broken, touching, friction, others in results:
		assert bits == golden, (path, saved)
		assert int(zones) >= 6000 # threadsFor in BlockEngine.cpp: a thread for every 3000
		assert int(broken) > 1000 and int(touching) > 50 and float(friction) > 0
		# Of the processor time all threads but one take some 0.4 where the work is shared out, and less than 0.001 where it is not.
		assert (float(others) > 0.1) == (threads == 2), (path, saved, others)
