# yade-blocks, GPL-2.0-or-later
"""What engines cost."""


def engineCosts(model, steps):
	"""What the hot engines took, if O.timingEnabled was set: {"ns_per_zone": of BlockLoop and BlockMotion (or of BlockForces), "ns_per_contact": of an
	InteractionLoop, for each contact point} in a step, wall-clock time; an empty dictionary otherwise."""
	from yade.wrapper import Omega
	if not Omega().timingEnabled or not steps:
		return {}
	times = {type(engine).__name__: engine.execTime for engine in Omega().engines}
	if "BlockLoop" in times: return {"ns_per_zone": (times["BlockLoop"] + times["BlockMotion"]) / steps / max(1, model.zoneCount)}
	return {
		"ns_per_zone": times["BlockForces"] / steps / max(1, model.zoneCount),
		"ns_per_contact": times["InteractionLoop"] / steps / max(1, model.contactCount)
	}
