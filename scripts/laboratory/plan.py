# yade-blocks, GPL-2.0-or-later
"""What the benchmark runs: for each experiment lines of (knob, what changes the specimen, what changes only the way it is computed)."""
from math import degrees
from pathlib import Path

from yadeblocks.masonry import table3

calibrated = Path(__file__).resolve().parents[1] / "calibrated.json" # parameters of YADE's own models

# Of YADE: spheres, and polyhedra with MortarMat. Planes and MortarMat, which has no friction once broken, have nothing to offer to a prism whose bricks split.
modelsOf = {
	**dict.fromkeys(("tension", "shear"), ("jcfpm", "jcfpmSmooth", "cohfrict", "cpm", "lourenco", "polyhedra")), "compression": (
		"jcfpm", "cohfrict", "cpm"
	)
}

slow = { # steps of the reference; half of them show how far it is converged
	"quick": {"tension": 80000, "shear": 24000, "compression": 30000}, "full": {"tension": 320000, "shear": 96000, "compression": 120000}}
exact = ("tension", "shear") # whose references are the peaks from event to event; a residual behind them is that of so many steps
middle = ("tension", "shear 0.5", "compression") # of three stresses one is enough for slow runs of every specimen


def steps(*numbers):
	"""So many steps."""
	return [("steps", {}, {"steps": n}) for n in numbers]


def way(knob, n, *values, **more):
	"""A knob that changes the way it is computed, with n steps."""
	return [(knob, {}, {"steps": n, knob: value, **more}) for value in values]


def specimen(knob, n, *values):
	"""A knob that changes the specimen, with n steps."""
	return [(knob, value if isinstance(value, dict) else {knob: value}, {"steps": n}) for value in values]


def oneSet(n):
	"""The joints of tension in shear."""
	angle = degrees(table3["frictionAngle"])
	return [("one set", {"cohesion": table3["cohesion"], "tension": table3["tension"], "friction": angle, "residualFriction": angle}, {"steps": n})]


def soft(n, joints="measured", **more):
	"""A method of its own: in every mode compared with its own slow runs."""
	return [("softening", {"joints": joints, **more}, {"steps": steps}) for steps in n]


def layers(unit, mortar):
	"""Sizes of the blocks in bricks and mortar [m]."""
	return {"unitSize": unit, "mortarSize": mortar}


# A setting that a scenario refuses is in the table as failed.
quickTension = steps(2500, 5000, 10000, 20000) + way("alpha", 10000, 0.3) + way("jump", 10000, False) + way("servo", 10000, True)
quickShear = steps(1500, 3000, 6000) + way("alpha", 6000, 0.8) + way("servo", 1500, True)
quickTension += soft((2500, 10000), tail=0.5) # behind half the peak there is nothing to compare
quickShear += soft((3000, 6000))

fullTension = steps(1000, 2500, 5000, 10000, 20000, 40000, 80000) + way("alpha", 10000, 0.1, 0.3, 0.5) + way("alpha", 40000, 0.1, 0.3, 0.5)
fullTension += way("damping", 10000, "adaptive", "none") + way("damping", 40000, "adaptive", "none") + way("jump", 5000, False) + way("jump", 20000, False)
fullTension += way("servo", 2500, True) + way("servo", 10000, True) + way("servo", 10000, True, jump=False)
fullTension += way("safety", 20000, 0.4) + way("safety", 20000, 0.9, alpha=0.1) + way("alpha", 20000, 0.1)
fullTension += specimen("size", 40000, 1e-3, 1.5e-3, 3e-3, 6e-3) + specimen("plane", 40000, "stress") + specimen("units", 40000, "voronoi")
fullTension += soft((1000, 2500, 5000, 10000, 20000), tail=0.5)

fullShear = steps(1500, 3000, 6000, 12000, 24000, 48000) + oneSet(24000) + way("alpha", 12000, 0.1, 0.5, 0.8)
fullShear += way("damping", 12000, "adaptive", "none") + way("jump", 12000, False) + way("servo", 3000, True) + way("safety", 12000, 0.4, 0.85)
fullShear += specimen("size", 12000, 2.5e-3, 5e-3) + specimen("plane", 12000, "stress") + specimen("units", 12000, "voronoi")
fullShear += soft((1500, 3000, 6000, 12000, 24000))

fullCompression = steps(2500, 5000, 10000, 20000, 30000, 60000) + way("alpha", 30000, 0.1, 0.4, 0.8)
fullCompression += way("damping", 30000, "adaptive", "none") + way("jump", 10000, False) + way("servo", 5000, True) + way("safety", 20000, 0.4, 0.85)
fullCompression += specimen("size", 30000, layers(15e-3, 4.5e-3), layers(7e-3, 3e-3)) + specimen("plane", 30000, "stress") + specimen("units", 30000, "plain")
fullCompression += soft((5000, 10000, 20000), joints="calibrated")

blocks = {
	"quick": {
		"tension": quickTension + specimen("size", 10000, 6e-3), "shear 0.1": steps(6000), "shear 0.5": quickShear, "shear 1.0": steps(6000),
		"compression": steps(5000, 10000) + soft((5000, ), joints="calibrated")
	}, "full": {"tension": fullTension, **dict.fromkeys(("shear 0.1", "shear 0.5", "shear 1.0"), fullShear), "compression": fullCompression}
}
# Multiples of the steps and radius they were calibrated with (slow: of the references' steps where they are not 4; None: no references); packings: at most
# so many; without: what takes four times as long as the others.
spheres = {
	"quick": {"steps": (1, ), "slow": None, "radius": (), "stresses": ("0.5", ), "packings": 4, "without": [("lourenco", "shear"), ("polyhedra", "shear")]},
	"full": {
		"steps": (0.25, 0.5, 1), "slow": {"lourenco shear": None, "polyhedra shear": 2, "cohfrict shear": 2}, "radius": (0.7, ),
		"stresses": ("0.1", "0.5", "1.0"), "packings": 4, "without": []
	}
}
radius = {"tension": 1.5e-3, "shear": 2e-3, "compression": 2.5e-3} # of the spheres in the mortar [m], as in spheres.py
sphereSteps = {
	"tension": 20000, "shear": 8000, "compression": 10000, "cohfrict shear": 32000
} # as in spheres.py, but CohFrict: in 8000 it is twice as strong as when loaded slowly
