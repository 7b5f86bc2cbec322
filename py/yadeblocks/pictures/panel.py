# yade-blocks, GPL-2.0-or-later
"""The axes of a panel, and what stands below them."""
from .colours import black
from .figure import picture, point, textWidth
from .view import View, roundDown


def drawAlone(path, model, draw, magnification, window, title, drop=38):
	"""A picture of one panel: draw(axes, view) fills it; drop: of the scale below it [points]. Returns the path."""
	view = View(model, magnification, window)
	width, height = view.size * min(textWidth / view.size[0], 1.2 * textWidth / view.size[1])
	with picture(path, width, height) as figure:
		axes = figure.add_axes((0, 0, 1, 1))
		frame(axes, view, title)
		draw(axes, view)
		drawScale(axes, view.magnification, drop=drop)
	return path


def frame(axes, view, title):
	"""Makes axes show a View, under a title."""
	axes.set(xlim=(view.low[0], view.high[0]), ylim=(view.low[1], view.high[1]), aspect="equal")
	axes.axis("off")
	axes.set_title(title, fontsize=8)


def note(axes, text):
	"""A line below the axes."""
	axes.text(0.5, -7 / pointsHigh(axes), text, transform=axes.transAxes, ha="center", va="center", fontsize=6)


def pointsHigh(axes):
	"""Height of the axes on the paper [points]: what stands below them keeps its distance whatever their size."""
	return axes.get_position().height * axes.figure.get_figheight() / point


def drawScale(axes, magnification, drop=9):
	"""So many points below the specimen: a bar of a round length and what was done to the displacements."""
	from matplotlib.transforms import ScaledTranslation, blended_transform_factory
	left, right = axes.get_xlim()
	width = right - left
	length = roundDown(width / 5)
	below = blended_transform_factory(axes.transData, axes.transAxes) + ScaledTranslation(0, -drop * point, axes.figure.dpi_scale_trans)
	left, right = left + 0.015 * width, right - 0.015 * width
	axes.plot([left, left + length], [0, 0], transform=below, color=black, linewidth=1.5, solid_capstyle="butt", clip_on=False)
	axes.text(left + length + 0.015 * width, 0, f"{length:g} m" if length >= 1 else f"{1e3 * length:g} mm", transform=below, va="center")
	text = "displacements to scale" if magnification == 1 else f"displacements × {magnification:g}"
	axes.text(right, 0, text, transform=below, va="center", ha="right")
