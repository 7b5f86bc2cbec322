# yade-blocks, GPL-2.0-or-later
"""Keys that all scenarios have, and keys that several have."""
import re

from .keys import Key, atLeastOne, notNegative, positive

common = {
	"seed": Key(1, "number of the first tessellation", rule=notNegative),
	"seeds": Key(1, "how many tessellations; results are their means", rule=atLeastOne),
	"threads": Key(1, "OpenMP threads", rule=atLeastOne),
	"tag": Key("", "makes the folder out/NAME-TAG", rule=(lambda t: re.fullmatch(r"[\w.,=+-]*", t), "must consist of letters, digits and . , = + - _")),
	"size": Key(2e-3, "size of the Voronoi cells", "m", positive),
	"sizeMeaning": Key("edge", "size is the mean edge length, or the root of the mean area", rule=("edge", "sqrtArea")),
	"lloyd": Key(2, "Lloyd iterations: how regular the cells are", rule=notNegative),
	"damping": Key("local", "damping of the motion", rule=("local", "adaptive", "none")),
	"alpha": Key(0.3, "coefficient of local damping", rule=(lambda a: 0 <= a < 1, "must lie in [0, 1)")),
	"safety": Key(
		0.7, "time step as a fraction of the stable one; with local damping at most 0.95/sqrt(1+alpha)",
		rule=(lambda s: 0 < s <= 0.95, "must lie in (0, 0.95]")
	),
	"steps": Key(40000, "time steps for the whole loading", rule=(lambda n: n >= 1000, "must be at least 1000")),
	"checkpoint": Key(0.0, "time between two checkpoints of a run that may be killed, of which resume=true goes on; 0: none", "s", notNegative),
	"resume": Key(False, "go on where a run with the same keys was killed or interrupted"),
	"plane": Key("strain", "plane strain or plane stress", rule=("strain", "stress")),
}

usual = {
	"units": Key("plain", "bricks are one elastic block each, or made of Voronoi blocks that could crack", rule=("plain", "voronoi")),
	"cells": Key("voronoi", "Voronoi cells, or triangles of the same size", rule=("voronoi", "triangles")),
	"edgeSegments": Key(1, "joints along an edge between two blocks", rule=atLeastOne),
	"solver": Key("steps", "time steps, or the exact path from failure to failure", rule=("steps", "events")),
	"unitYoung": Key(20e9, "Young's modulus of the units", "Pa", positive),
	"mortarYoung": Key(5e9, "Young's modulus of the mortar", "Pa", positive),
	"release": Key(
		"path", "solver=events: the load falls where that keeps the next point whole, or, under a held displacement, cascades break",
		rule=("path", "cascade")
	),
	"brickZone": Key(8e-3, "size of the zones in plain bricks, mean edge of the blocks in others", "m", positive),
	"merge": Key(0.1, "edges of Voronoi cells below this fraction of the size are merged", rule=(lambda f: 0 <= f < 1, "must lie in [0, 1)")),
	"jump": Key(True, "leap over the elastic part of the loading"),
	"servo": Key(False, "the unbalanced force sets the speed of loading"),
	"halfRate": Key(False, "repeat each run at half the loading rate and report the change"),
	"vtk": Key(True, "write files for ParaView"),
	"frames": Key(10, "frames of the loading in the files for ParaView, besides those at the peak and at the end", rule=notNegative),
	"movie": Key("none", "a movie of the cracks, of as many frames as are said; mp4 needs Debian's ffmpeg", rule=("none", "gif", "mp4")),
	"sheets": Key(True, "draw sheets of displacements, stresses and joints at the peak and at the end"),
	"pressSteps": Key(2000, "time steps in which the precompression comes on", rule=atLeastOne),
	"approach": Key(0.2, "speed up to the peak by that after it", rule=(lambda f: 0 < f <= 1, "must lie in (0, 1]")),
	"sigma": Key(0.5e6, "precompression", "Pa", notNegative),
	"stroke": Key(1e-3, "path of the loaded edge at which the run ends", "m", positive),
}


def commonParameters(**defaults):
	"""The keys that every scenario has: `seed seeds threads tag size sizeMeaning lloyd damping alpha safety steps checkpoint resume plane`, each a Key.
	Keyword arguments give a scenario's own defaults.

	Raises TypeError for a name that is not common to all scenarios."""
	return {**common, **_chosen(common, "common to all scenarios", defaults)}


def usualParameters(**defaults):
	"""Keys that more than one scenario has, with these defaults: `units cells unitYoung mortarYoung edgeSegments solver release brickZone merge jump servo
	halfRate vtk frames movie sheets pressSteps approach sigma stroke` and all the common ones.

	Raises TypeError for a name that is none of them."""
	return _chosen({**common, **usual}, "that several scenarios have", defaults)


def _chosen(known, what, defaults):
	strangers = set(defaults) - set(known)
	if strangers:
		raise TypeError(f"not a parameter {what}: {', '.join(sorted(strangers))}")
	return {key: known[key]._replace(default=default) for key, default in defaults.items()}
