# yade-blocks, GPL-2.0-or-later
"""Packings of spheres in one layer, for comparisons with YADE's bonded-sphere models: discs in rectangles.

	centres, radii = randomPacking(0.1, 0.05, radius=1.5e-3, seed=1)
	centres, radii = hexagonalPacking(0.1, 0.05, radius=1.5e-3)
"""
import numpy as np

from ._door import door

solidity = 0.86 # share of the area that discs may take; more than random close packing, so that some have to go


@door('width', 'height', 'radius', 'spread', seed='whole')
def randomPacking(width, height, radius, seed, spread=0.2):
	"""Discs with radii between (1 - spread) and (1 + spread) radius, dense and without order, inside a rectangle with its
	lower left corner at the origin [m]. Returns centres (n, 2) and radii (n).

	They start anywhere and push each other apart; while overlaps are more than a fiftieth of the radius in the mean, the most
	squeezed ones are taken out. Bonds between near neighbours take the state that is left as free of force."""
	random = np.random.default_rng(seed)
	count = max(1, round(solidity * width * height / (np.pi * radius**2 * (1 + spread**2 / 3)))) # mean square of a uniform spread
	radii = radius * random.uniform(1 - spread, 1 + spread, count)
	centres = random.uniform(0, 1, (count, 2)) * (width, height)
	centres, squeezed = _pushApart(centres, radii, (width, height), sweeps=300)
	while squeezed.mean() > 0.02 * radius and len(radii) > 1:
		kept = np.sort(np.argsort(squeezed)[:-max(1, len(radii) // 50)])
		radii = radii[kept]
		centres, squeezed = _pushApart(centres[kept], radii, (width, height), sweeps=100)
	return centres, radii


def _pushApart(centres, radii, size, sweeps):
	"""Moves discs that overlap away from each other, within the walls. The new centres, and the largest overlap of each disc."""
	from scipy.spatial import cKDTree
	low, high = radii[:, None], np.array(size) - radii[:, None]
	for sweep in range(sweeps):
		if sweep % 5 == 0:
			i, j = cKDTree(centres).query_pairs(2.3 * radii.max(), output_type="ndarray").T
		between = centres[j] - centres[i]
		distance = np.maximum(np.hypot(*between.T), 1e-9 * radii.max())
		overlap = np.maximum(radii[i] + radii[j] - distance, 0)
		push = (0.25 * overlap / distance)[:, None] * between # half each would overshoot where many push
		for axis in range(2):
			centres[:, axis] += np.bincount(j, push[:, axis], len(radii)) - np.bincount(i, push[:, axis], len(radii))
		centres = np.clip(centres, low, high)
	squeezed = np.zeros(len(radii))
	np.maximum.at(squeezed, i, overlap)
	np.maximum.at(squeezed, j, overlap)
	return centres, squeezed


@door('width', 'height', 'radius', seed='whole')
def hexagonalPacking(width, height, radius, seed=1):
	"""Equal discs that just touch, in rows; as many rows and discs as fit, centred. The seed shifts the rows by a part of a diameter."""
	rows = 1 + int((height - 2 * radius) / (np.sqrt(3) * radius) + 1e-9)
	shift = np.random.default_rng(seed).uniform(0, 2 * radius)
	bottom = (height - (rows - 1) * np.sqrt(3) * radius) / 2
	centres = []
	for row in range(rows):
		x = np.arange(-2, width / (2 * radius) + 2) * 2 * radius + shift + row % 2 * radius
		x = x[(x >= radius * (1 - 1e-9)) & (x <= width - radius * (1 - 1e-9))]
		centres.append(np.column_stack([x, np.full(len(x), bottom + row * np.sqrt(3) * radius)]))
	centres = np.vstack(centres)
	return centres, np.full(len(centres), float(radius))
