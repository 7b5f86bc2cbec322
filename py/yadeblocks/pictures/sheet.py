# yade-blocks, GPL-2.0-or-later
"""Many panels on one sheet."""
from .._door import door
from .bars import onJoints, showBars
from .cracks import showCracks
from .crosses import showCrosses
from .field import showField
from .figure import picture
from .panel import frame
from .titles import titles
from .view import View


@door(magnification='notNegative', path='path', model='model', window='box', title='str')
def drawSheet(path, model, magnification=None, window=None, title=""):
	"""Cracks, displacement, larger and smaller principal stress, crosses, and bars of the joints' sigma, tau, opening and slip, on one sheet."""
	view = View(model, magnification, window)
	panels = [("cracks", showCracks), (titles["u"], lambda a, v: showField(a, v, "u")), ("principal stresses", showCrosses),
			(titles["s1"], lambda a, v: showField(a, v, "s1")), (titles["s2"], lambda a, v: showField(a, v, "s2")),
			*((titles[what], lambda a, v, what=what: showBars(a, v, what)) for what in onJoints)]
	if not len(model.pointStatus): panels = panels[1:5]
	if not len(model.zoneNodes): panels = [panel for panel in panels if panel[0] not in (titles["s1"], titles["s2"], "principal stresses")]
	size = view.size
	columns = 3 if size[0] < 2.5 * size[1] else 2
	rows = -(-len(panels) // columns)
	width = 3.2
	height = min(width * size[1] / size[0], 2 * width)
	with picture(path, columns * width, rows * (height + 0.75) + 0.4) as figure:
		figure.suptitle(title, fontsize=10)
		for number, (name, draw) in enumerate(panels):
			axes = figure.add_axes(
				((number % columns + 0.03) / columns, ((rows - 1 - number // columns) * (height + 0.75) + 0.5) / (rows * (height + 0.75) + 0.4),
					0.94 / columns, height / (rows * (height + 0.75) + 0.4))
			)
			frame(axes, view, name)
			draw(axes, view)
	return path
