# yade-blocks, GPL-2.0-or-later
"""Scenes and looks that several tests inside YADE share."""
import os
import subprocess
from math import radians

import numpy as np

import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks.engines import engineList
from yadeblocks.specimen import nodesWhere, rectangle

brick = dict(young=16.7e9, poisson=0.2, density=1900)
mortar = dict(young=3e9, poisson=0.2, density=1250)
glue = dict(kn=400e9, ks=200e9, frictionAngle=radians(38), cohesion=0.6e6, tension=0.6e6, dilationAngle=radians(4))


def glued(**changes):
	"""Joints for all pairs of the materials 'unit' and 'mortar'."""
	return [JointMat(material1=a, material2=b, **{**glue, **changes}) for a, b in (('unit', 'unit'), ('unit', 'mortar'), ('mortar', 'mortar'))]


def strong(**changes):
	"""The same, but nothing breaks."""
	return glued(**{'cohesion': 1e15, 'tension': 1e15, **changes})


def engines(joints, stepper={}, **integrator):
	"""The list of a time step; what is in `integrator` goes to BlockIntegrator. Nothing is written where tests are run."""
	return engineList(joints, stepper=stepper, **{'rescueFile': '', **integrator})


def materials(reset=True, **changes):
	"""Empties all scenes; then there are 'unit' and 'mortar' in the present one."""
	if reset: O.reset()
	O.materials.append(BlockMat(label='unit', **{**brick, **changes}))
	O.materials.append(BlockMat(label='mortar', **{**mortar, **changes}))


def largeCouplet(joints=()):
	"""More than 6000 zones, enough for two threads; held at the bottom. To be moved at `isOnTop` and inserted."""
	materials()
	model = BlockModel(thickness=0.05)
	model.addVoronoi(rectangle(0, 0.01, 0.1, 0.025), 'mortar', size=1.2e-3)
	model.addRegion(rectangle(0, 0, 0.1, 0.01), 'unit', zoneSize=5e-3)
	model.addRegion(rectangle(0, 0.025, 0.1, 0.035), 'unit', zoneSize=5e-3)
	model.bond(joints)
	model.drive('bottom', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
	assert model.zoneCount > 6000 # BlockEngine's threadsFor wants 3000 a thread
	return model


def isOnTop(x, y):
	"""Grid points on top of a largeCouplet."""
	return y > 0.035 - 1e-9


def couplet(size=6e-3, steps=3000, stroke=0.012e-3, trackEnergy=False, **integrator):
	"""Two bricks and a layer of Voronoi mortar, pulled apart; joints break from step 1250 on.

	40 x 10 x 50 mm each layer; 13 blocks, 78 zones. The model, inserted, with engines; nothing has run yet."""
	materials()
	model = BlockModel(thickness=0.05)
	model.addVoronoi(rectangle(0, 0.01, 0.04, 0.02), 'mortar', size=size, seed=3)
	model.addRegion(rectangle(0, 0, 0.04, 0.01), 'unit', zoneSize=5e-3)
	model.addRegion(rectangle(0, 0.02, 0.04, 0.03), 'unit', zoneSize=5e-3)
	model.bond()
	duration = 1.5 # [s]
	model.drive('bottom', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
	model.drive('top', nodesWhere(model, lambda x, y: y > 0.03 - 1e-9), 'y', velocity=stroke / duration, rampTime=0.05 * duration)
	model.insert()
	O.trackEnergy = trackEnergy
	O.dt = duration / steps
	O.engines = engines(glued(), **integrator)
	return model


def column(heights=(0.3, 0.5), labels=None, width=0.4, thickness=0.2, zoneSize=0.2):
	"""Rectangular blocks one upon the other, bonded, not inserted: boundary conditions are the test's."""
	model, y = BlockModel(thickness=thickness), 0
	for height, label in zip(heights, labels or ['unit'] * len(heights)):
		model.addRegion(rectangle(0, y, width, y + height), label, zoneSize=zoneSize, zoning='regular')
		y += height
	model.bond()
	return model


def model():
	"""The model of the present scene."""
	return next(b.shape.model for b in O.bodies if isinstance(b.shape, Block))


def forces(model, group):
	"""Of a group along each of the axes that it acts along [N]."""
	found = []
	for axis in 'xy':
		try:
			found.append(model.groupForce(group, axis=axis))
		except ValueError: # not along this one
			pass
	return found


def state(model):
	"""All that a step changes, as copies: arrays of numbers by name."""
	names = 'position velocity inertia pointOpening pointSlip pointSigma pointTau pointStatus'.split()
	out = {name: np.array(getattr(model, name)) for name in names}
	out['groups'] = np.array([(sum(forces(model, g)), model.groupVelocity(g), model.groupTravelled(g), model.groupWork(g)) for g in model.groups])
	out['bodies'] = np.array([tuple(b.state.pos) for b in O.bodies])
	out['viscosity'] = np.array([e.viscosity for e in O.engines if isinstance(e, BlockIntegrator)])
	out['energy'] = np.array([value for _, value in sorted(O.energy.items())])
	return out


def differences(a, b):
	"""Names of what differs in a single bit between two states."""
	return [name for name in a if a[name].shape != b[name].shape or a[name].tobytes() != b[name].tobytes()]


def runYade(script, *arguments, threads=1, cwd=None, env={}):
	"""The program yade with a script (a path, or text that becomes one in cwd): CompletedProcess."""
	if '\n' in str(script):
		path = os.path.join(cwd, 'script.py')
		with open(path, 'w') as file:
			file.write(script)
		script = path
	path = os.environ['PYTHONPATH'] + ':' + os.path.dirname(os.path.abspath(differences.__code__.co_filename))
	environment = {**os.environ, 'PYTHONPATH': path, 'OMP_WAIT_POLICY': 'passive', **env}
	environment.pop('OMP_NUM_THREADS', None) # -j decides
	command = ['yade', '-n', '-x', '-j', str(threads), str(script), *arguments]
	return subprocess.run(command, cwd=cwd, env=environment, capture_output=True, text=True, timeout=300)
