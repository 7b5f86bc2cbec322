# yade-blocks, GPL-2.0-or-later
"""A couplet that costevents.py loads, from event to event or by time steps; run by YADE. What is wanted stands in the variable COST, what came out is its last
line. The wish: experiment, size [m], seed, solver (events or steps), steps for the whole stroke."""
import json
import os
import resource
import time

import numpy as np

import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks import loading, masonry, running
from yadeblocks.engines import loopList
from yadeblocks.recording import Recorder
from yadeblocks.specimen import nodesWhere, rectangle

wish = json.loads(os.environ["COST"])
size, shears = wish["size"], wish["experiment"] == "shear"
couplet = masonry.shearCouplet if shears else masonry.tensionCouplet
joint = masonry.table5 if shears else masonry.table3
speed, sigma = 0.2e-3 if shears else 0.02e-3, 0.5e6 # [m/s], [Pa]
length, low, high = couplet.width, couplet.brickHeight, couplet.brickHeight + couplet.mortarHeight
area = length * couplet.thickness


def build():
	"""The couplet, loaded from its first step on."""
	O.materials.append(BlockMat(label='unit', **couplet.unit))
	O.materials.append(BlockMat(label='mortar', **couplet.mortar))
	model = BlockModel(thickness=couplet.thickness)
	model.addVoronoi(
		rectangle(0, low, length, high), 'mortar', size=size, lloyd=1 if shears else 0, seed=wish["seed"], mergeFraction=0.1 if shears else 0.2
	)
	for bottom in (0, high):
		model.addRegion(rectangle(0, bottom, length, bottom + low), 'unit', zoneSize=(2.3 if shears else 2) * size)
	model.bond([JointMat(material1=a, material2='mortar', **joint) for a in ('mortar', 'unit')])
	top = nodesWhere(model, lambda x, y: y > high + low - 1e-9)
	model.drive('bottom', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
	if shears: model.push('press', top, 'y', force=-sigma * area)
	model.drive('load', top, 'x' if shears else 'y', velocity=speed)
	model.insert()
	O.dt = couplet.stroke / speed / wish["steps"]
	O.engines = loopList(contact=shears, alpha=0.2 if shears else 0.8)
	return model


def byEvents(model):
	"""Highest force [N], pieces, broken contact points, why it ended."""
	path = model.follow('load', displacement=2 * couplet.stroke)
	return path['force'].max(), path['steps'], len(path['crackPoint']), path['ended']


def bySteps(model):
	"""The same, of time steps that set out at the first crack."""
	if shears: model.setThrottle('load', 0.2)
	model.elasticJump()
	stop = loading.Stop(drop=0.8, displacement=2 * couplet.stroke)
	record = Recorder(force=lambda: model.groupForce('load'), broken=lambda: np.count_nonzero(model.pointStatus))
	record()
	record.after(lambda row: stop(model.groupTravelled('load'), row.force, row.broken))
	O.engines += [record.engine(25)]
	running.run(100 * wish["steps"])
	return record['force'].max(), O.iter, np.count_nonzero(model.pointStatus), stop.reason


model, start = build(), time.process_time()
peak, count, broken, ended = (byEvents if wish["solver"] == "events" else bySteps)(model)
cpu = time.process_time() - start
rss = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024 # [MB]
print(
	"COST " + json.dumps(
		dict(
			zones=model.zoneCount, points=model.contactCount, start=start, cpu=cpu, peak=peak / area /
			1e6, count=int(count), broken=int(broken), rss=rss, ended=ended
		)
	)
)
