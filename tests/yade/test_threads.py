# yade-blocks, GPL-2.0-or-later
"""The same bits on one thread and on two, and from run to run."""
from scenes import *

# 1050 cells, more than 6000 zones: BlockEngines' threadsFor then starts a second thread
script = '''
from scenes import *
import hashlib
materials()
model = BlockModel(thickness=0.05)
model.addVoronoi(rectangle(0, 0.01, 0.1, 0.025), 'mortar', size=1.2e-3)
model.addRegion(rectangle(0, 0, 0.1, 0.01), 'unit', zoneSize=5e-3)
model.addRegion(rectangle(0, 0.025, 0.1, 0.035), 'unit', zoneSize=5e-3)
model.bond()
model.drive('bottom', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
model.push('top', nodesWhere(model, lambda x, y: y > 0.035 - 1e-9), 'y', force=4e3, rampTime=0.2) # 0.8 MPa: beyond the strength
model.gravity((1, -9.81))
model.insert()
assert model.zoneCount > 6000
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
