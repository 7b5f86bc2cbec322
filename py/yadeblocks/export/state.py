# yade-blocks, GPL-2.0-or-later
"""What ParaView files show of a model at a time: copied, so that it can be written later."""
import numpy as np

from .._door import door
from ..readings.blocks import rigidBlocks
from ..readings.contacts import freeContactLines
from ..readings.joints import contactLines
from ..readings.present import Present
from ..readings.status import intact, neverBonded
from ..readings.zones import outOfPlaneStress, principalStresses, vonMises, zoneStrains
from .vtu import spatial


class State:
	"""What BlocksExport writes of a model at a time [s]: copied, so that it can be written later, whatever has become of the model.

	untouched: as the model was before anything moved, broke or was removed."""
	@door(model='model', time='float', untouched='flag')
	def __init__(self, model, time, untouched=False):
		self.time = float(time)
		self.names = list(getattr(model, "jointNames", ()))
		self.grids = {"blocks": _zones(model, untouched), "joints": _joints(model, untouched), "contacts": _contacts(model, untouched)}


def _zones(model, untouched):
	"""Arguments of writeGrid."""
	there = Present(model, everything=untouched)
	rigid = rigidBlocks(model)
	triangles = [np.reshape(model.zoneNodes, (-1, 3)), *map(model.cornerTriangles, rigid.tolist())]
	blocks = np.repeat([*range(len(model.blockMaterial)), *rigid], [*np.diff(model.firstZone), *map(len, triangles[1:])]).astype(np.int32)
	stress = np.zeros((len(blocks), 3)) # none in rigid blocks
	if not untouched: stress[:len(triangles[0])] = model.zoneStress()
	position = model.reference if untouched else model.position
	displacement, velocity = spatial(position - model.reference), spatial((0.0 if untouched else 1.0) * model.velocity)
	cells = {"block": blocks, "material": np.asarray(model.blockMaterial, np.int32)[blocks], **dict(zip(("sxx", "syy", "sxy"), stress.T))}
	strain = np.zeros((len(blocks), 3))
	if not untouched: strain[:len(triangles[0])] = zoneStrains(model)
	cells.update(zip(("exx", "eyy", "exy"), strain.T))
	szz = np.zeros(len(blocks))
	szz[:len(model.zoneNodes)] = outOfPlaneStress(model, stress[:len(model.zoneNodes)])
	cells.update(zip(("s1", "s2"), principalStresses(stress).T), szz=szz, vonMises=vonMises(stress, szz))
	triangles, kept = np.concatenate(triangles), there.blocks[blocks]
	number = np.cumsum(there.nodes) - 1 # of the grid points that are left
	cells = {name: values[kept] for name, values in cells.items()}
	pointData = {"displacement": displacement[there.nodes], "velocity": velocity[there.nodes]}
	return np.array(position)[there.nodes], "triangle", number[triangles[kept]], pointData, cells


def _joints(model, untouched):
	"""Arguments of writeGrid."""
	lines = contactLines(model, model.reference if untouched else model.position)
	first, second = np.repeat(np.asarray(model.segmentBlocks, np.int32), 2, axis=0).T
	cells = {
		"firstBlock": first, "secondBlock": second, "normal": spatial(np.repeat(model.normal, 2, axis=0)),
		"area": np.repeat(np.asarray(model.segmentArea), 2), "name": np.full(len(first), -1, np.int32)
	}
	if getattr(model, "jointNames", ()): cells["name"] = np.repeat(np.asarray(model.segmentName, np.int32), 2)
	for name in ("opening", "slip", "sigma", "tau", "damage"):
		values = np.array(getattr(model, "point" + name.capitalize()))
		cells[name] = np.zeros_like(values) if untouched else values
	for name, values in getattr(model, "lawColumns", {}).items():
		cells[name] = np.zeros_like(values) if untouched else values
	status = np.array(model.pointStatus, np.uint8)
	cells["status"] = np.where(status == neverBonded, status, intact).astype(np.uint8) if untouched else status # never bonded stays so
	kept = Present(model, everything=untouched).points
	lines, cells = lines[kept], {name: values[kept] for name, values in cells.items()}
	return lines.reshape(-1, 2), "line", np.arange(2 * len(lines)).reshape(-1, 2), {}, cells


def _contacts(model, untouched):
	"""Arguments of writeGrid."""
	lines, blocks, force = freeContactLines(model)
	if untouched: lines, blocks, force = lines[:0], blocks[:0], force[:0]
	first, second = np.asarray(blocks, np.int32).T
	cells = {"firstBlock": first, "secondBlock": second, "force": spatial(force)}
	return lines.reshape(-1, 2), "line", np.arange(2 * len(lines)).reshape(-1, 2), {}, cells
