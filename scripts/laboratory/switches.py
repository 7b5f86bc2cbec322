# yade-blocks, GPL-2.0-or-later
"""Optional features of a step, and how each is switched on (price.py). Run by YADE."""
from math import radians

import numpy as np

import yadeblocks # noqa: F401 (loads the plugin)
from yade import BlockCrackRecorder, BlockServo, O
from yadeblocks.engines import addBehindForces, find
from yadeblocks.recording import Recorder, runner
from yadeblocks.specimen import Gauge

from .pricescenes import addGeneralContact, native, segments

writeEvery, lookEvery, recordEvery = 1000, 100, 50 # steps between ParaView files, looks at the stability, gauge readings


class Row:
	"""A feature: its name, how it is switched on, how often it works (1: as often as in the window), and the state it has if it is not the scene's."""
	def __init__(self, name, switch, share=1, state=''):
		self.name, self.switch, self.share, self.state = name, switch, share, state


def rowsOf(scene, folder, window):
	"""The features to be measured in a scene, whose files are in a folder; window: steps."""
	rows = [
		Row('general contact', lambda model: addGeneralContact()),
		Row("YADE's InteractionLoop", native),
		Row('small strain instead of large displacement', lambda model: setattr(model, 'smallStrain', True)),
		Row('dilation', lambda model: model.setJoints(frictionAngleResidual=radians(4), dilationAngle=radians(4))), # it may not exceed it
		Row('residual friction', lambda model: model.setJoints(frictionAngleResidual=radians(30))),
		Row('joints that soften, none does', lambda model: model.setJoints(GfI=1000, GfII=1e4)),
		Row('joints that soften, up to a fifth do', softenAFifth),
		Row('joints that soften, with a cap, none yields', addCap),
		Row('strengths that scatter', lambda model: model.scatterStrengths(cov=0.01)),
		Row('gravity (dead loads)', lambda model: model.gravity((0, -9.81))),
		Row('adaptive damping instead of local', lambda model: setattr(find('BlockMotion'), 'damping', 'adaptive')),
		Row('no damping instead of local', lambda model: setattr(find('BlockMotion'), 'damping', 'none')),
		Row('stability watch, every %d steps' % lookEvery, lambda model: setattr(find('BlockMotion'), 'watchPeriod', lookEvery)),
		Row('energy accounts (O.trackEnergy)', lambda model: setattr(O, 'trackEnergy', True)),
		Row('crack recorder, every step', lambda model: addBehindForces(BlockCrackRecorder())),
		Row('gauge in a PyRunner, every %d steps' % recordEvery, addGauge),
		Row('ParaView files, every %d steps' % writeEvery, lambda model: addExport(model, folder, window), window / writeEvery)
	]
	rows.append(Row('servo', lambda model: addBehindForces(BlockServo(groups=[model.groups[-1]], floor=1))))
	if scene == 'tension': rows += [Row('edges in %d joints' % n, None, state='tension-%d' % n) for n in segments]
	if scene == 'crushed': rows = [row for row in rows if 'general contact' not in row.name]
	return rows


def softenAFifth(model):
	"""Joints that soften, a fifth of which have less tensile strength than stress, so that they begin to in the next step."""
	model.setJoints(GfI=1000, GfII=1e4)
	stress = np.reshape(model.pointSigma, (-1, 2)).min(axis=1)
	chosen = np.argsort(stress)[-len(stress) // 5:]
	model.setJoints(chosen[stress[chosen] > 0], tension=0.95 * stress[chosen[stress[chosen] > 0]])


def addCap(model):
	model.setJoints(GfI=1000, GfII=1e4, capStrength=1e9, capFirst=1e9, capResidual=1e9, capPeakClosure=1e-3, capEnergy=1e6, capShear=9)


def addGauge(model):
	nodes = np.arange(model.nodeCount)
	read = Recorder(opening=Gauge(model, nodes[:40], nodes[-40:]), force=lambda: model.groupForce(model.groups[-1]))
	O.engines = O.engines + [read.engine(recordEvery)]


def addExport(model, folder, window):
	from yadeblocks.export import BlocksExport
	export = BlocksExport(folder / 'vtk')
	export.write(model, O.time) # imports what it needs
	O.engines = O.engines + [runner('export', lambda: export.write(model, O.time), window)]
