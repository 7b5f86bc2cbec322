# yade-blocks, GPL-2.0-or-later
"""Blocks: filled in the tones of their materials, or their outlines."""
import numpy as np

from ..readings.blocks import blockOutlines
from ..readings.present import Present
from .colours import assigned, blockTones, spareTones


def drawBlocks(axes, model, shown):
	"""Fills the blocks; the legend's handles."""
	from matplotlib.collections import PathCollection
	from matplotlib.patches import Patch
	tones = assigned(model.materialLabels, blockTones, spareTones)
	there = Present(model).blocks
	colours = [tones[model.materialLabels[material]] for material in np.asarray(model.blockMaterial)[there]]
	axes.add_collection(PathCollection(_paths(model, shown, there), facecolors=colours, edgecolors="#9C958B", linewidths=0.25, zorder=1), autolim=False)
	present = [label for label in tones if tones[label] in colours]
	return [Patch(facecolor=tones[label], edgecolor="#9C958B", linewidth=0.5, label=label) for label in present]


def drawOutlines(axes, view, fill="none"):
	"""The boundaries of a View's blocks, and their insides in one colour."""
	from matplotlib.collections import PathCollection
	paths = _paths(view.model, view.shown, view.there.blocks)
	axes.add_collection(PathCollection(paths, facecolors=fill, edgecolors="#5F5F5F", linewidths=0.2, zorder=2 if fill == "none" else 1), autolim=False)


def _paths(model, shown, there):
	"""The boundaries of these blocks as matplotlib takes them. there: a mask of the blocks."""
	from matplotlib.path import Path
	outlines = [rings for rings, kept in zip(blockOutlines(model), there) if kept]
	return [Path.make_compound_path(*(Path(shown[np.append(ring, ring[0])], closed=True) for ring in rings)) for rings in outlines]
