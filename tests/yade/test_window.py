# yade-blocks, GPL-2.0-or-later
"""YADE's window draws blocks: a real window on a virtual screen, and a look at its pictures."""
import os
import shutil
import subprocess

import matplotlib.image
import numpy as np
import pytest

import yadeblocks

scene = r'''
import os, sys
from yade import *
from yade import qt # before the plugin: a window that is open already
import yadeblocks
from yadeblocks import window
from yadeblocks.specimen import nodesWhere, rectangle
O.materials.append(BlockMat(label='rock', young=1e9, poisson=0.2, density=2000))
m = BlockModel(thickness=.1)
m.addVoronoi(rectangle(0, 0, 1, 1), 'rock', size=.2)
m.addRegion(rectangle(0, 1, 1, 1.2), 'rock', zoneSize=.2)
m.addRigid(rectangle(0, -.2, 1, 0), 'rock')
m.bond([JointMat(material1='rock', material2='rock', kn=1e12, ks=1e12, tension=1e3, cohesion=1e3, frictionAngle=.5)])
m.drive('top', nodesWhere(m, lambda x, y: y > 1.19), 'y', velocity=.2)
m.insert()
O.bodies[len(O.bodies) - 1].state.blockedDOFs = 'xyzXYZ'
O.engines = [ForceResetter(), BlockLoop(), NewtonIntegrator(damping=0), BlockMotion()]
O.run(200, True)
folder = sys.argv[-1] if os.path.isdir(sys.argv[-1]) else os.environ['PICTURES']
def picture(name, **how):
    window.show(**how)
    window.snapshot(os.path.join(folder, name + '.png'))
picture('whole')
picture('zones', zones=True)
picture('stress', colour='sigma1')
low, high = Gl1_Block.shownRange
s = m.zoneStress()
largest = (s[:, 0] + s[:, 1]) / 2 + np.hypot((s[:, 0] - s[:, 1]) / 2, s[:, 2])
assert abs(low - largest.min()) < 1e-9 * abs(high) and abs(high - largest.max()) < 1e-9 * abs(high), (low, high, largest.min(), largest.max())
picture('joints', joints=True, stresses=True)
O.run(6000, True)
assert (m.pointStatus > 0).any()
picture('cracked')
picture('damage', colour='damage')
try: window.show(colour='blue')
except ValueError as error: print('REFUSED', error)
O.bodies[0].shape.color = (0, 0, 1)
picture('own')
m.remove(list(range(m.blockCount - 2)))
O.bodies[m.bodyOf(m.blockCount - 2)].shape.color = (0, 1, 0)
picture('removed')
picture('removedStress', colour='sxx')
left = m.zoneStress()[m.firstZone[m.blockCount - 2]:, 0]
assert Gl1_Block.shownRange == (left.min(), left.max()), (Gl1_Block.shownRange, left)
print('DRAWN')
sys.stdout.flush()
os._exit(0)
'''.replace("import os, sys\n", "import os, sys\nimport numpy as np\n", 1)


@pytest.mark.skipif(shutil.which('xvfb-run') is None, reason='no virtual screen: Debian\'s xvfb and xauth')
def test_blocksAreDrawnInARealWindow(tmp_path):
	(tmp_path / 'scene.py').write_text(scene)
	folder = os.path.dirname(os.path.dirname(yadeblocks.__file__))
	environment = dict(os.environ, PICTURES=str(tmp_path), PYTHONPATH=folder, XDG_RUNTIME_DIR=str(tmp_path), LIBGL_ALWAYS_SOFTWARE='1')
	run = subprocess.run(['xvfb-run', '-a', 'yade', '-x', '-j1', str(tmp_path / 'scene.py')], env=environment, capture_output=True, text=True, timeout=300)
	assert 'DRAWN' in run.stdout, run.stdout[-3000:] + run.stderr[-3000:]
	assert "Gl1_Block.colour must be one of 'material', 'displacement'" in run.stdout

	def shareOf(name, colour, off=0.08):
		"""The share of a picture's points that have about this colour."""
		picture = matplotlib.image.imread(tmp_path / (name + '.png'))[..., :3]
		return (np.abs(picture - colour).max(axis=2) < off).mean()

	rock, red, green = (0.80, 0.52, 0.38), (0.85, 0.1, 0.1), (0.1, 0.6, 0.2)
	assert shareOf('whole', rock) > 0.3 # of a square window, of which the blocks fill five sixths
	assert shareOf('whole', red) == 0 and shareOf('whole', green) == 0
	assert shareOf('zones', (0.45, 0.45, 0.45)) > 5 * shareOf('whole', (0.45, 0.45, 0.45)) + 0.002
	assert shareOf('stress', rock) < 0.01
	assert shareOf('stress', (0.6, 0.6, 0.6)) > 0.05 # the rigid block has none
	assert shareOf('joints', green) > 0.001 and shareOf('joints', (0.85, 0.15, 0.1)) > 0.001
	assert shareOf('cracked', red) > 0.0005
	assert shareOf('damage', (0.2, 0.3, 1)) > 0.02 # what is whole is blue
	assert shareOf('own', (0, 0, 1)) > 0.003
	assert shareOf('removed', red) == 0 and shareOf('removed', (0, 0, 1)) == 0 and shareOf('removed', (0, 1, 0)) > 0.01
