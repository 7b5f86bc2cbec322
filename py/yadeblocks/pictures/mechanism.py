# yade-blocks, GPL-2.0-or-later
"""How rigid blocks move at once."""
import numpy as np

from .._door import door
from ..plane import left
from ..readings.blocks import areasAndCentroids, blockOfNodes
from .blocks import drawBlocks
from .figure import picture, textWidth
from .view import windowAround


@door(path='path', model='model', mechanism='motions', title='str')
def drawMechanism(path, model, mechanism, title=""):
	"""How rigid blocks move at once: a mechanism of `limitanalysis`, its largest displacement 5 % of the scene's size. mechanism: velocity of every block's
	centroid and its rotation, (blocks, 3). Returns the path."""
	mechanism = np.asarray(mechanism, float)
	if mechanism.shape != (model.blockCount, 3):
		raise ValueError(f"drawMechanism.mechanism must have the shape ({model.blockCount}, 3), got {mechanism.shape}")
	reference = np.asarray(model.reference)
	owner = blockOfNodes(model)
	arm = reference - areasAndCentroids(model)[1][owner]
	motion = mechanism[owner, :2] + mechanism[owner, 2:] * left(arm)
	size, largest = np.ptp(reference, axis=0).max(), np.hypot(*motion.T).max()
	shown = reference + (0.05 * size / largest * motion if largest > 0 else 0)
	low, high = windowAround(reference, shown)
	width, height = (high - low) * min(textWidth / (high - low)[0], 1.3 * textWidth / (high - low)[1])
	with picture(path, width, height) as figure:
		axes = figure.add_axes((0, 0, 1, 1), xlim=(low[0], high[0]), ylim=(low[1], high[1]))
		axes.axis("off")
		axes.set_title(title, fontsize=9)
		drawBlocks(axes, model, shown)
	return path
