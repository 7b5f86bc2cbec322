# yade-blocks, GPL-2.0-or-later
"""What `O.energy` says of the blocks, added up [J]; `O.trackEnergy` must have been on from the first step.

	energies.spent() / section      # work that is neither stored nor kinetic: what has become heat [J/m2 = N/m]
	energies.dissipated()           # where: {"mode_I": ..., "mode_II": ..., "friction": ..., "cap": ..., "brittle": ..., "damping": ...}
	energies.error()                # by how much the causes miss the sum, as a share of it
"""
import math

#: Names in `O.energy` by what they mean; without joints that soften the first two and the cap are missing there, as are the
#: last three in scenes that have none of them.
sinks = {
	"mode_I": "blockModeI", "mode_II": "blockModeII", "friction": "blockFriction", "cap": "blockCap", "brittle": "blockFracture", "damping": "blockDamping",
	"stiffness": "blockStiffness", "viscous": "blockViscous", "removed": "blockRemoved"
}


def _entries():
	from yade.wrapper import Omega
	entries = dict(Omega().energy.items())
	if "blockWork" not in entries: raise RuntimeError("energies: O.energy is empty; set O.trackEnergy before the first step")
	return entries


def stored():
	"""Elastic energy of zones, joints and contacts, and kinetic energy."""
	entries = _entries()
	return sum(entries[name] for name in ("blockZones", "blockJoints", "blockKinetic"))


def spent():
	"""The work of loads and groups less what is stored: it must be what was dissipated. Kinetic energy that scaled masses brought is no work."""
	entries = _entries()
	return -entries["blockWork"] - entries["blockScaling"] - stored()


def dissipated():
	"""By cause: opening, slip without friction, friction and crushing of joints, breaking of brittle ones, damping of the motion and proportional to
	stiffness; what waves took out through viscous boundaries, and what removed blocks held."""
	entries = _entries()
	return {cause: entries.get(name, 0.0) for cause, name in sinks.items()}


def addDissipated(run, unit, by=1.0):
	"""Adds what was dissipated to a results.Run, a quantity for each cause: energies [J] by a number, an area, say."""
	for cause, energy in dissipated().items():
		run.add("dissipated_" + cause, unit, energy / by)


def error():
	"""What `dissipated` adds up to, less what was spent, by what was spent; NaN if nothing was."""
	heat = spent()
	return (sum(dissipated().values()) - heat) / heat if heat else math.nan
