# yade-blocks, GPL-2.0-or-later
"""Points of the benchmark: the lines of its plan as settings, with what each is compared with."""
import json
from typing import NamedTuple, Optional

from .plan import blocks, calibrated, exact, middle, modelsOf, radius, slow, sphereSteps, spheres
from .study import inWords


class Point(NamedTuple):
	"""A line of the study for one case, and the slow run it is compared with."""
	case: str # tension, "shear 0.5", ...
	model: str
	knob: str
	label: str
	script: str
	settings: dict
	slow: Optional[dict] # settings of the reference, exact or slow, None without
	isReference: bool = False


def points(mode, experiment):
	"""All points of an experiment: blocks, their references (slow, and half as slow), YADE's own models."""
	known = json.loads(calibrated.read_text())
	for case, lines in blocks[mode].items():
		if case.split()[0] == experiment: yield from blockPoints(mode, case, lines)
	for case in ([experiment] if experiment != "shear" else ["shear " + stress for stress in spheres[mode]["stresses"]]):
		for model in modelsOf[experiment]:
			if (model, experiment) in spheres[mode]["without"]: continue
			if f"{model} {experiment}" in known: yield from yadePoints(mode, case, model, known)


def blockPoints(mode, case, lines):
	experiment, base = case.split()[0], {"vtk": False, "sheets": False, **stressOf(case)}
	whole, events = mode == "full" or case in middle, {"solver": "events"}
	cascades = {**events, "release": "cascade"} # what slow steps come down to
	alone = {"afterPeak": False} if experiment == "shear" else {} # nothing but the path, where that comes to the peak
	solver = {} if experiment not in exact else cascades if whole else {**cascades, **alone}
	known = lambda specimen: {} if "joints" in specimen else solver # the path from event to event is that of brittle joints
	reference = lambda specimen: {**base, **specimen, **known(specimen), "steps": slow[mode][experiment] // (2 if specimen else 1)}
	specimens = []
	for knob, specimen, way in lines:
		compared = knob == "softening" or (mode == "full" and case in middle and knob != "one set" and specimen != {"units": "plain"}
							) if specimen else (whole or experiment in exact) # plain bricks never crush
		label = inWords({**way, **specimen}) if knob != "one set" else inWords(way) + ", the joints of tension"
		yield Point(case, "blocks", knob, label, experiment, {**base, **specimen, **way}, reference(specimen) if compared else None)
		if compared and specimen not in specimens: specimens.append(specimen)
	for specimen in specimens:
		yield Point(
			case, "blocks", "reference",
			inWords({**known(specimen), **specimen} if known(specimen) else {"steps": reference(specimen)["steps"], **specimen}), experiment,
			reference(specimen), reference(specimen), True
		)
	ways = [("slow" if solver else "half as slow", {"steps": slow[mode][experiment] // (1 if solver else 2)})] if whole else []
	if experiment == "shear" and whole: # behind its peak there are steps, not quite so slow
		ways.append(("solver", {**cascades, "steps": slow[mode][experiment] // 4}))
	if experiment == "compression": # the path ends long before the peak: steps from there on
		ways += [("solver", {**events, "steps": n}) for n in (5000, 10000)]
	else:
		ways += [("solver", {**way, **alone}) for way in (events, cascades)]
	for knob, way in ways:
		yield Point(case, "blocks", knob, inWords(way), experiment, {**base, **way}, reference({}))


def yadePoints(mode, case, model, known):
	"""Those of one of YADE's own models."""
	experiment, wanted = case.split()[0], spheres[mode]
	script = "polyhedra" if model == "polyhedra" else "spheres"
	base = {"experiment": experiment, **({"model": model} if script == "spheres" else {}), **stressOf(case)}
	calibrated = known[f"{model} {experiment}"]["parameters"]
	factor = wanted["slow"] and wanted["slow"].get(f"{model} {experiment}", 4)
	slowest = {**base, **calibrated, "steps": factor * stepsOf(model, experiment)} if factor and case in middle else None
	for part in wanted["steps"] if case in middle else (1, ):
		way = {"steps": int(part * stepsOf(model, experiment))}
		yield Point(case, model, "steps", inWords(way), script, {**base, **calibrated, **way}, slowest)
	if slowest: yield Point(case, model, "reference", inWords({"steps": slowest["steps"]}), script, slowest, slowest, True)
	if script == "polyhedra": return # its cells are those of the blocks
	for factor in wanted["radius"] if case in middle and (model, experiment) not in spheres["quick"]["without"] else ():
		finer = {"steps": round(stepsOf(model, experiment) / factor), "radius": round(factor * radius[experiment], 7)} # waves need as many steps more
		yield Point(case, model, "radius", inWords(finer), script, {**base, **smaller(model, calibrated, factor), **finer}, None)
	if case == "shear 0.5" and model == "cpm": # whether any friction would give the residual
		way = {"steps": stepsOf(model, experiment), "friction": 5.0, "residualFriction": 5.0}
		yield Point(case, model, "low friction", "friction 5 degrees", script, {**base, **calibrated, **way}, None)
	if case in ("shear 0.5", "compression"
			) and (mode == "full" or model == "jcfpm") and f"{model} tension" in known: # what one set of parameters for all three gives
		foreign = smaller(model, known[f"{model} tension"]["parameters"], radius[experiment] / radius["tension"])
		foreign = {**foreign, "unitStrength": 10.7 if experiment == "compression" else 1000} # else the prism's bricks would never break
		yield Point(case, model, "one set", "the parameters found in tension", script, {**base, **foreign, "steps": stepsOf(model, experiment)}, None)


def stepsOf(model, experiment):
	"""Steps that one of YADE's models is calibrated with."""
	return sphereSteps.get(f"{model} {experiment}", sphereSteps[experiment])


def smaller(model, parameters, factor):
	"""Parameters for spheres of another radius: a bond's stiffness is E R, a plane's the joint's stiffness times pi R^2."""
	return {**parameters, "jointStiffness": parameters["jointStiffness"] / factor} if model == "jcfpmSmooth" else parameters


def stressOf(case):
	return {"sigma": float(case.split()[1]) * 1e6} if " " in case else {}


def seedsOf(point, mode, seeds):
	"""The tessellations of a point, of as many as are asked for; of YADE's own models there are a few packings only."""
	return range(1, 1 + (seeds if point.model == "blocks" else min(seeds, spheres[mode]["packings"])))
