# yade-blocks, GPL-2.0-or-later
"""A couplet or a prism whose steps cost.py times; run by YADE, with the Python package and the plugin of any checkout of this project, also of an old one.

What is wanted stands in the variable COST, when the command was given in BEGUN; what came out is the last line. The wish: size [m], contact, energy, and
broken: None for the couplet, 0 for the prism, 1 for the prism with a fifth of its points broken, 2 for the same with these joints all free contacts."""
import json
import os
import resource
import time

import numpy as np

import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks.specimen import nodesWhere, rectangle

wish = json.loads(os.environ["COST"])
size, contact, broken = wish["size"], wish["contact"], wish.get("broken")


def memory():
	"""What this process has now [bytes]."""
	return int(open("/proc/self/statm").read().split()[1]) * resource.getpagesize()


def run(steps):
	"""CPU and wall-clock time of so many steps [s]. O.run(steps, wait=True) would look every 40 ms only."""
	cpu, wall = time.process_time(), time.monotonic()
	O.run(steps)
	while O.running:
		time.sleep(0.01) # looking oftener takes two threads a share of their cores
	return time.process_time() - cpu, time.monotonic() - wall


O.materials.append(BlockMat(label='unit', young=16.7e9, poisson=0.15, density=2000))
O.materials.append(BlockMat(label='mortar', young=2.974e9, poisson=0.2, density=1250))
own, start = memory(), time.process_time()
model, length, low, high = BlockModel(thickness=0.05), 0.1, 0.05, 0.065
if broken and not hasattr(model, "setJoints"): # an old build, in which no fifth of the joints can be weak
	print("COST null", flush=True)
	os._exit(0)
if broken is None: # the couplet
	model.addVoronoi(rectangle(0, low, length, high), 'mortar', size=size, lloyd=2, seed=1)
	model.addRegion(rectangle(0, 0, length, low), 'unit', zoneSize=4 * size)
	model.addRegion(rectangle(0, high, length, high + low), 'unit', zoneSize=4 * size)
else: # a prism all of Voronoi blocks
	for k in range(5):
		model.addVoronoi(rectangle(0, 0.023 * k, length, 0.023 * (k + 1)), 'mortar' if k % 2 else 'unit', size=size, lloyd=2, seed=k + 1)
joints = [
	JointMat(material1=a, material2=b, kn=400e9, ks=200e9, cohesion=0.6e6, tension=0.6e6, frictionAngle=0.66)
	for a, b in (('unit', 'unit'), ('mortar', 'mortar'), ('unit', 'mortar'))
]
flat = 'BlockLoop' in globals()
if flat: model.bond(joints)
else: model.bond()
model.drive('bottom', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
model.drive('top', nodesWhere(model, lambda x, y: y > 0.115 - 1e-9), 'y', velocity=-1e-12, rampTime=100)
if broken: # so weak that they break as soon as they feel anything
	model.setJoints(np.arange(0, model.contactCount // 2, 5), tension=1e-12, cohesion=1e-12, frictionAngle=1e-6)
model.insert()
O.dt, O.trackEnergy = 1, wish["energy"]
if flat: O.engines = [BlockLoop(contact=contact), BlockMotion(alpha=0.3)]
else:
	O.engines = ([BlockContacts(), InsertionSortCollider([Bo1_Block_Aabb()], verletDist=0)] if contact else []) + [
		InteractionLoop([Ig2_Block_Block_BlockGeom()], [Ip2_BlockMat_BlockMat_JointPhys(joints=joints)], [Law2_BlockGeom_JointPhys_MohrCoulomb()]),
		BlockTimeStepper(),
		BlockForces(),
		BlockIntegrator(alpha=0.3)
	]
O.run(1, True)
first = time.monotonic() - float(os.environ["BEGUN"])
O.run(2, True)
setup = time.process_time() - start
if broken: O.run(3000, True)
if broken == 2: # with true masses a broken joint becomes a free contact at once
	O.engines[-1].quasiStatic = False
	O.run(2, True)
	O.engines[-1].quasiStatic, O.dt = True, 1
	O.run(100, True)

steps = 10
while (once := run(steps)[1]) < 0.1:
	steps *= 2
steps = max(steps, int(steps / once * 1))
cpu, wall = run(steps)
share = (model.pointStatus > 0).mean()
assert 0.15 < share < 0.3 if broken else share == 0, share
if broken == 2: assert (model.segmentArea == 0).mean() > 0.15
most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
print(
	"COST " + json.dumps(
		dict(
			us=1e6 * cpu / steps, wall_us=1e6 * wall /
			steps, start_s=first, setup_s=setup, zones=model.zoneCount, points=model.contactCount, bytes_zone=(most - own) / model.zoneCount
		)
	)
)
