# yade-blocks, GPL-2.0-or-later
"""A figure in our style, and its way to a file."""
from contextlib import contextmanager

from .. import files

_style = {
	"font.size": 9, "legend.fontsize": 8, "legend.title_fontsize": 8, "legend.frameon": False, "axes.linewidth": 0.6, "xtick.major.width": 0.6,
	"ytick.major.width": 0.6, "xtick.direction": "in", "ytick.direction": "in", "xtick.major.pad": 5, "ytick.major.pad": 5, "axes.spines.top": False,
	"axes.spines.right": False
}
textWidth = 6.3 # of a page: the width of a picture [inch]
point = 1 / 72 # [inch]


@contextmanager
def blankFigure(width, height):
	"""A matplotlib figure of this size [inch] in our style; off pyplot, which belongs to YADE's own plots."""
	import matplotlib
	from matplotlib.backends.backend_agg import FigureCanvasAgg
	from matplotlib.figure import Figure
	with matplotlib.rc_context(_style):
		figure = Figure(figsize=(width, height))
		FigureCanvasAgg(figure)
		yield figure


@contextmanager
def picture(path, width, height):
	"""A matplotlib figure of this size [inch], saved at the end to a path or a binary file."""
	with blankFigure(width, height) as figure:
		yield figure
		save = lambda place: figure.savefig(place, format="png", dpi=300, bbox_inches="tight", pad_inches=0.06)
		if hasattr(path, "write"): return save(path)
		with files.replacing(path) as part:
			save(part)
