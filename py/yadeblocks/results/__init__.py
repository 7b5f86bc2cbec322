# yade-blocks, GPL-2.0-or-later
"""What a scenario found: result.json, curve.csv and the table on the terminal.

	results = Results(p)
	for seed in p.seedList:
		with results.run(seed) as run:           # CPU and wall-clock time
			model = build(seed)
			with run.stepping():                 # the part that us_per_step speaks of
				O.run(p.steps, True)
			run.add("peak_tensile_stress", "MPa", stress.max() / 1e6, expected=0.35, source="Van der Pluijm 1992, Fig. 6")
			run.curve(displacement_mm=1e3 * displacement, stress_MPa=stress / 1e6)
			run.model(model, steps=O.iter)       # cost and cracks
			run.quality(unbalanced_ratio_max=ratio)
	results.write()"""
# flake8: noqa: F401
from ..readings.status import brokenInShear, brokenInTension, intact, modes, neverBonded
from .collected import Results
from .costs import engineCosts
from .cracks import Cracks
from .jsonable import jsonable
from .quantity import Quantity
from .run import Run
