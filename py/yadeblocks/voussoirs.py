# yade-blocks, GPL-2.0-or-later
"""Arches of voussoirs: circular, with radial joints.

	ring = arch(radius=1, thickness=0.11, count=27)       # of the centre line; semicircular
	placed = ring.addTo(model, 'stone', rigid=True)

Joints are named 'radial' (see layout.Placed.joints); those with the supports are 'platen'. Voussoirs are numbered from the right springing to the left."""
import math

import numpy as np

from ._door import door
from .layout import Layout
from .plane import unit


@door('radius', 'thickness', 'count', 'angle', 'chords', centre='point')
def arch(radius, thickness, count, angle=math.pi, chords=1, centre=(0.0, 0.0)):
	"""A circular arch, symmetric about the vertical through its centre -> layout.Layout with blocks of the kind 'voussoir'.

	radius: of the centre line [m]; thickness: radial [m]; count: of voussoirs; angle: of opening [rad], pi for a semicircle; chords: straight
	pieces of each voussoir's inner and outer side, each over a right angle at most; centre [m]. notes: `joints`, the (count + 1, 2, 2) inner and outer
	ends of all joints, springings included [m]."""
	for name, value, fulfilled, rule in (('radius', radius, radius > 0,
						'be positive'), ('thickness', thickness, 0 < thickness < 2 * radius, 'lie in (0, 2 radius)'),
						('count', count, count >= 1 and count == int(count),
							'be a whole number > 0'), ('angle', angle, 0 < angle < 2 * math.pi, 'lie in (0, 2 pi)'),
						('chords', chords, chords >= 1 and chords == int(chords), 'be a whole number > 0')):
		if not fulfilled: raise ValueError(f'arch.{name} must {rule}, got {value!r}')
	if angle > count * chords * math.pi / 2:
		raise ValueError(
			f'arch.chords must be so many that each spans a right angle at most, got {chords!r} for {count!r} voussoirs over {angle!r} rad'
		)
	count, chords = int(count), int(chords)
	at = np.pi / 2 + angle * (np.arange(count * chords + 1) / (count * chords) - 0.5)
	inner, outer = (np.asarray(centre) + (radius + side * thickness / 2) * unit(at) for side in (-1, 1))
	outlines = [np.vstack([outer[i:i + chords + 1], inner[i:i + chords + 1][::-1]]) for i in range(0, count * chords, chords)]
	return Layout(
		outlines, ['voussoir'] * count, np.arange(count), lambda normals, ends, samePiece: np.full(len(normals), 'radial'),
		joints=np.stack([inner[::chords], outer[::chords]], axis=1)
	)
