# yade-blocks, GPL-2.0-or-later
"""Joints and blocks of very different stiffness and mass."""
import math

import pytest

from looks import *


@pytest.mark.parametrize('ratio', [1e-3, 1, 1e3, 1e6])
@case('joint stiffness x{ratio:g}', 'springs in series; undamped at safety 0.95 for 20,000 steps the energy stays')
def test_jointStiffness(look, ratio):
	seriesAndKick(look, [0.2] * 3, [young] * 3, ratio * young / 0.2)


@case('modulus ratio 1e6', 'springs in series; undamped at safety 0.95 for 20,000 steps the energy stays')
def test_modulusRatio(look):
	seriesAndKick(look, [0.2] * 3, [young, 1e-6 * young, young], young / 0.2)


@case('density ratio 1e6', 'a heavy block on a light one: the period of a mass on a spring')
def test_densityRatio(look):
	begin(light=dict(density=2), heavy=dict(density=2e6))
	model = column([0.2, 0.2], labels=['light', 'heavy'])
	model.drive('low', level(model, 0), 'xy')
	model.drive('sides', nodesWhere(model, lambda x, y: y > 1e-9), 'x')
	model.insert()
	heavy = np.arange(model.firstNode[1], model.firstNode[2])
	kn, mass = young / 0.2, model.mass[heavy].sum()
	O.engines = engines(joints(kn, labels=('light', 'heavy')), dict(quasiStatic=False, safety=0.7), damping='none')
	# Springs in series; of its own flexibility a third counts at the heavy block's inertia (Rayleigh), and of the light one's mass (1e-6) nothing.
	# Rayleigh's quotient errs by the square of what the shape errs by: (1/3 of the three compliances)^2 ~ 1e-2 of the part, below 1 % in all.
	stiffness = 0.2 / (0.2 / young + 1 / kn + 0.2 / young / 3)
	period = 2 * math.pi * math.sqrt(mass / stiffness)
	model.velocity[heavy, 1] = 1e-3
	O.step()
	steps = int(2.2 * period / O.dt)
	heights = []
	for _ in range(2200):
		look.run(max(1, steps // 2200), samples=1)
		heights.append((model.mass[heavy] * (model.position[heavy, 1] - model.reference[heavy, 1])).sum() / mass)
	heights = np.array(heights)
	down = np.flatnonzero((heights[:-1] > 0) & (heights[1:] <= 0))
	cross = [i + heights[i] / (heights[i] - heights[i + 1]) for i in down]
	look.equal('period', (cross[1] - cross[0]) * (steps // 2200) * O.dt, period, 0.01)
