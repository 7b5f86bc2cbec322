# yade-blocks, GPL-2.0-or-later
"""What goes on in a specimen: displacements, stresses, joints; one call for a picture, one for all on a sheet.

	drawField(folder / 'stress.png', model, 's1')          # contours of a displacement or a stress, see `fields`
	drawCrosses(folder / 'crosses.png', model)             # principal stresses
	drawJoints(folder / 'slip.png', model, 'slip')         # bars on the joints: sigma, tau, opening or slip
	drawJoints(folder / 'bed.png', model, 'tau', joints='bed')   # of joints of a name alone
	drawNames(folder / 'names.png', model)                 # joints, coloured by name
	drawContacts(folder / 'contacts.png', model)           # edges that touch without a bond, and their forces
	drawReactions(folder / 'reactions.png', model)         # forces of groups and of held rigid blocks
	drawSheet(folder / 'peak.png', film.peak, title='at the peak')
	drawMovie(folder / 'film.gif', film.states(), 's1')    # or film.mp4

`model` is a BlockModel or a Snapshot of one. Shapes are deformed, as in pictures.drawCracks."""
import numpy as np

from . import files, pictures
from ._calls import door
from .export import (Present, blockOutlines, contactLines, freeContactLines, jointMotion, outOfPlaneStress, pointNames, pointsOf, principalStresses, vonMises)
from .snapshot import reactionsOf

#: What contours can show: displacements u, ux, uy of the grid points and stresses of the zones.
fields = ("u", "ux", "uy", "sxx", "syy", "sxy", "szz", "s1", "s2", "vonMises")
#: What bars can show.
onJoints = ("sigma", "tau", "opening", "slip")

_names = {
	"u": "displacement", "ux": "displacement along x", "uy": "displacement along y", "sxx": "stress sxx", "syy": "stress syy", "sxy": "shear stress sxy",
	"szz": "stress out of the plane szz", "s1": "larger principal stress", "s2": "smaller principal stress", "vonMises": "stress of von Mises",
	"sigma": "normal stress of the joints", "tau": "shear stress of the joints", "opening": "opening of the joints", "slip": "slip of the joints"
}
_crosses = 900 # so many crosses at most
_red, _blue = "#B2182B", "#2166AC" # tension and compression, also at the ends of the colour map


@door(magnification='notNegative', path='path', model='model', window='box', title='str', what='str')
def drawField(path, model, what, magnification=None, window=None, title=""):
	"""Contours of one of `fields` on the deformed specimen. magnification, window: as in pictures.drawCracks. Returns the path."""
	_known("what", what, fields)
	return _alone(path, model, lambda axes, view: _field(axes, view, what), magnification, window, title or _names[what])


@door(magnification='notNegative', path='path', model='model', window='box', title='str')
def drawCrosses(path, model, magnification=None, window=None, title="principal stresses"):
	"""Principal stresses as crosses along their directions, as long as they are large; tension red, compression blue; of at most 900 zones,
	evenly spread."""
	return _alone(path, model, _cross, magnification, window, title)


@door(magnification='notNegative', path='path', model='model', window='box', title='str', what='str', joints='joints')
def drawJoints(path, model, what, magnification=None, window=None, title="", joints=None):
	"""Bars on the joints, as high as one of `onJoints` is large: a bar for each contact point, over its half of the joint; positive values
	(tension, opening)
	on the side of the joint's second block. Joints that have become free contacts show no stress. joints: which, a name, a list of names or
	indices, by default all."""
	_known("what", what, onJoints)
	title = title or _names[what] + (f": {joints}" if isinstance(joints, str) else "")
	return _alone(path, model, lambda axes, view: _bars(axes, view, what, joints=joints), magnification, window, title)


@door(magnification='notNegative', path='path', model='model', window='box', title='str', joints='joints')
def drawNames(path, model, magnification=None, window=None, title="joints by name", joints=None):
	"""Joints as lines, coloured by their names (BlockModel.nameJoints; else by their pairs of materials), with how many each name has. joints: which, a
	name, a list of names or indices, by default all."""
	return _alone(path, model, lambda axes, view: _joints(axes, view, joints), magnification, window, title, drop=9)


@door(magnification='notNegative', path='path', model='model', window='box', title='str')
def drawContacts(path, model, magnification=None, window=None, title="free contacts"):
	"""Edges that touch without a bond, as of the last step: where they face each other, and the force between them as an arrow on each side. Needs
	BlockLoop(contact=True) or BlockContacts in the run."""
	return _alone(path, model, _contacts, magnification, window, title)


@door(magnification='notNegative', path='path', model='model', window='box', title='str')
def drawReactions(path, model, magnification=None, window=None, title="reactions"):
	"""Forces on the blocks of groups and of rigid blocks that are held: an arrow at the middle of each, with its two components."""
	return _alone(path, model, _reactions, magnification, window, title)


@door('rate', magnification='notNegative', path='file', states='models', what='str', window='box', title='str')
def drawMovie(path, states, what="cracks", magnification=None, window=None, title="", rate=5):
	"""A movie of Snapshots: one of `fields` or `onJoints`, 'cracks', 'crosses', 'contacts' or 'reactions'. path: .gif (Pillow) or .mp4 (needs Debian's
	ffmpeg); rate: frames a second. All frames have one window, one magnification and one range of colours. Returns the path."""
	from pathlib import Path

	import matplotlib.animation
	kinds = {"cracks": _cracks, "crosses": _cross, "contacts": _contacts, "reactions": _reactions}
	_known("what", what, (*fields, *onJoints, *kinds))
	writers = {".gif": matplotlib.animation.PillowWriter, ".mp4": matplotlib.animation.FFMpegWriter}
	path = Path(path)
	_known("path's ending", path.suffix, tuple(writers))
	if not len(states): raise ValueError("drawMovie: there are no states")
	if not rate > 0: raise ValueError(f"drawMovie.rate must be positive, got {rate!r}")
	if not writers[path.suffix].isAvailable():
		raise RuntimeError(f"a movie {path.suffix} needs {'ffmpeg: scripts/install.sh ffmpeg' if path.suffix == '.mp4' else 'Pillow'}")
	last = _View(states[-1], magnification, window)
	views = [_View(state, last.magnification, window) for state in states] # what is removed later is in the first ones
	low, high = np.min([view.low for view in views], axis=0), np.max([view.high for view in views], axis=0)
	for view in views:
		view.low, view.high = low, high
	if what in fields: most = max((_most(_values(view, what)[0][_kept(view, what)]) for view in views), default=0)
	elif what in onJoints: most = max((_most(_onJoints(view.model, what)[view.there.points]) for view in views), default=0)
	draw = {**kinds, **dict.fromkeys(fields, lambda a, v: _field(a, v, what, most)), **dict.fromkeys(onJoints, lambda a, v: _bars(a, v, what, most))}[what]
	size = high - low
	width, height = size * min(5 / size[0], 5 / size[1])
	with files.replacing(path) as part:
		with pictures._figure(width + 0.4, height + 1.2) as figure:
			film = writers[path.suffix](fps=rate)
			with film.saving(figure, str(part) + path.suffix, dpi=120):
				for view in views:
					figure.clear()
					axes = figure.add_axes((0.2 / (width + 0.4), 0.8 / (height + 1.2), width / (width + 0.4), height / (height + 1.2)))
					_frame(axes, view, f"{title or _names.get(what, what)}, {view.model.time:.4g} s")
					draw(axes, view)
					film.grab_frame()
			Path(str(part) + path.suffix).replace(part)
	return path


@door(magnification='notNegative', path='path', model='model', window='box', title='str')
def drawSheet(path, model, magnification=None, window=None, title=""):
	"""Cracks, displacement, larger and smaller principal stress, crosses, and bars of the joints' sigma, tau, opening and slip, on one sheet."""
	view = _View(model, magnification, window)
	panels = [("cracks", _cracks), (_names["u"], lambda a, v: _field(a, v, "u")), ("principal stresses", _cross),
			(_names["s1"], lambda a, v: _field(a, v, "s1")), (_names["s2"], lambda a, v: _field(a, v, "s2")),
			*((_names[what], lambda a, v, what=what: _bars(a, v, what)) for what in onJoints)]
	if not len(model.pointStatus): panels = panels[1:5]
	if not len(model.zoneNodes): panels = [panel for panel in panels if panel[0] not in (_names["s1"], _names["s2"], "principal stresses")]
	size = view.high - view.low
	columns = 3 if size[0] < 2.5 * size[1] else 2
	rows = -(-len(panels) // columns)
	width = 3.2
	height = min(width * size[1] / size[0], 2 * width)
	with pictures._picture(path, columns * width, rows * (height + 0.75) + 0.4) as figure:
		figure.suptitle(title, fontsize=10)
		for number, (name, draw) in enumerate(panels):
			axes = figure.add_axes(
				((number % columns + 0.03) / columns, ((rows - 1 - number // columns) * (height + 0.75) + 0.5) / (rows * (height + 0.75) + 0.4),
					0.94 / columns, height / (rows * (height + 0.75) + 0.4))
			)
			_frame(axes, view, name)
			draw(axes, view)
	return path


class _View:
	"""Where everything is drawn."""
	def __init__(self, model, magnification, window):
		self.model, reference = model, np.asarray(model.reference)
		displacement = model.position - reference
		self.displacement = displacement
		self.there = Present(model)
		self.carried = np.median(displacement[self.there.nodes], axis=0) # what the whole has moved by
		displacement = displacement - self.carried
		self.magnification = pictures._visible(
			np.ptp(reference[self.there.nodes], axis=0).max(), displacement[self.there.nodes]
		) if magnification is None else magnification
		self.shown = reference + self.magnification * displacement
		self.low, self.high = pictures._window(reference, self.shown, self.there.nodes) if window is None else pictures._corners(window)


def _alone(path, model, draw, magnification, window, title, drop=38):
	view = _View(model, magnification, window)
	size = view.high - view.low
	width, height = size * min(pictures._textWidth / size[0], 1.2 * pictures._textWidth / size[1])
	with pictures._picture(path, width, height) as figure:
		axes = figure.add_axes((0, 0, 1, 1))
		_frame(axes, view, title)
		draw(axes, view)
		pictures._drawScale(axes, view.magnification, drop=drop)
	return path


def _frame(axes, view, title):
	axes.set(xlim=(view.low[0], view.high[0]), ylim=(view.low[1], view.high[1]), aspect="equal")
	axes.axis("off")
	axes.set_title(title, fontsize=8)


def _known(name, value, choices):
	if value not in choices: raise ValueError(f"{name} must be one of {', '.join(choices)}, got {value!r}")


def _outlines(axes, view, fill="none"):
	from matplotlib.collections import PathCollection
	from matplotlib.path import Path
	outlines = [rings for rings, kept in zip(blockOutlines(view.model), view.there.blocks) if kept]
	paths = [Path.make_compound_path(*(Path(view.shown[np.append(ring, ring[0])], closed=True) for ring in rings)) for rings in outlines]
	axes.add_collection(PathCollection(paths, facecolors=fill, edgecolors="#5F5F5F", linewidths=0.2, zorder=2 if fill == "none" else 1), autolim=False)


def _cracks(axes, view):
	pictures._drawBlocks(axes, view.model, view.shown)
	handles = pictures._drawCrackLines(axes, view.model, view.shown)
	axes.legend(handles=handles, title="" if handles else "no broken joints", loc="upper center", bbox_to_anchor=(0.5, -0.01), fontsize=5, ncol=2)


def _values(view, what):
	"""Values for each zone or grid point, and the unit."""
	if what in ("u", "ux", "uy"):
		d = view.displacement
		return (np.hypot(*d.T) if what == "u" else d[:, "xy".index(what[1])]), "m"
	stress = np.asarray(view.model.zoneStress())
	if what in ("s1", "s2"): return principalStresses(stress)[:, int(what[1]) - 1], "Pa"
	if what == "szz": return outOfPlaneStress(view.model, stress), "Pa"
	if what == "vonMises": return vonMises(stress, outOfPlaneStress(view.model, stress)), "Pa"
	return stress[:, ("sxx", "syy", "sxy").index(what)], "Pa"


def _kept(view, what):
	"""Which of _values are of blocks that have not been removed."""
	return view.there.nodes if what in ("u", "ux", "uy") else view.there.zones


def _scale(most, unit):
	"""A size in a unit in which it is neither tiny nor huge, the factor of that unit, and its name."""
	prefixes = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"))
	factor, prefix = next(((factor, prefix) for factor, prefix in prefixes if most >= factor), (1, ""))
	return most / factor, factor, prefix + unit


def _most(values):
	"""The size that only a hundredth of the values exceeds; that of the largest if most are nothing."""
	values = np.abs(values)
	return (np.percentile(values, 99) or values.max()) if len(values) else 0


def _field(axes, view, what, most=None):
	"""Colours: to both sides of zero for what has two signs; the largest hundredth shares the last colour. most: the end of the range, by default of this
	state."""
	from matplotlib.collections import PolyCollection
	model = view.model
	values, unit = _values(view, what)
	most, factor, unit = _scale(_most(values[_kept(view, what)]) if most is None else most, unit)
	values = values / factor
	_outlines(axes, view, "#EDEDED")
	if what in ("u", "ux", "uy"):
		rigid = np.flatnonzero(np.diff(model.firstZone) == 0).tolist()
		triangles = np.concatenate([np.reshape(model.zoneNodes, (-1, 3))[view.there.zones], *map(model.cornerTriangles, rigid)])
		colours = axes.tripcolor(*view.shown.T, triangles, values, shading="gouraud", cmap="viridis" if what == "u" else "RdBu_r", zorder=1.5)
	else:
		if not len(values): return
		colours = PolyCollection(
			view.shown[model.zoneNodes[view.there.zones]], array=values[view.there.zones], cmap="viridis" if what == "vonMises" else "RdBu_r",
			linewidths=0, zorder=1.5
		)
		colours.set_edgecolor("face")
		axes.add_collection(colours, autolim=False)
	most = most or 1
	colours.set_clim(0 if what in ("u", "vonMises") else -most, most)
	_outlines(axes, view)
	_bar(axes, colours, unit)


def _pointsHigh(axes):
	"""Height of the axes on the paper [points]: what stands below them keeps its distance whatever their size."""
	return axes.get_position().height * axes.figure.get_figheight() / pictures._point


def _bar(axes, colours, unit):
	points = _pointsHigh(axes)
	place = axes.inset_axes((0.1, -12 / points, 0.8, 4 / points))
	bar = axes.figure.colorbar(colours, cax=place, orientation="horizontal", extend="both")
	bar.ax.tick_params(labelsize=6, width=0.4, length=2, pad=1)
	bar.ax.set_xlabel(f"[{unit}]", fontsize=6, labelpad=1)
	bar.outline.set_linewidth(0.4)


def _cross(axes, view):
	from matplotlib.collections import LineCollection
	model = view.model
	_outlines(axes, view, "#F7F7F7")
	stress = np.asarray(model.zoneStress())
	if not len(stress): return
	stress, middles = stress[view.there.zones], view.shown[model.zoneNodes[view.there.zones]].mean(axis=1)
	chosen = _spread(middles, view, _crosses)
	stress, middles = stress[chosen], middles[chosen]
	principal = principalStresses(stress)
	_, factor, unit = _scale(np.abs(principal).max(), "Pa")
	principal = principal / factor
	angle = np.arctan2(2 * stress[:, 2], stress[:, 0] - stress[:, 1]) / 2
	spacing = np.sqrt(np.prod(view.high - view.low) / max(len(chosen), 1))
	most = np.percentile(np.abs(principal).max(axis=1), 99) or 1
	for column, turn in ((0, 0), (1, np.pi / 2)):
		half = 0.6 * spacing * np.clip(principal[:, column] / most, -1.5, 1.5)[:, None] * np.column_stack([np.cos(angle + turn), np.sin(angle + turn)])
		axes.add_collection(
			LineCollection(
				np.stack([middles - half, middles + half], axis=1), colors=np.where(principal[:, column] > 0, _red, _blue), linewidths=0.6,
				zorder=3
			), autolim=False
		)
	_note(axes, f"red tension, blue compression; the longest {most:.3g} {unit}")


def _spread(places, view, most):
	"""Indices of places, one in each cell of a grid of about so many."""
	if len(places) <= most: return np.arange(len(places))
	size = view.high - view.low
	cell = np.sqrt(np.prod(size) / most)
	columns = int(np.ceil(size[0] / cell)) + 1
	index = np.floor((places - view.low) / cell).astype(int)
	return np.unique(index[:, 1] * columns + index[:, 0], return_index=True)[1]


def _onJoints(model, what):
	"""A value for each contact point; openings and slips of free contacts, too."""
	values = np.array(getattr(model, "point" + what.capitalize()))
	if what not in ("opening", "slip") or not len(values): return values
	return np.where(np.repeat(np.asarray(model.segmentArea) > 0, 2), values, jointMotion(model)[onJoints[2:].index(what)])


def _bars(axes, view, what, most=None, joints=None):
	from matplotlib.collections import PolyCollection
	model = view.model
	_outlines(axes, view, "#F7F7F7")
	values = _onJoints(model, what)
	if not len(values): return
	there = np.repeat(np.asarray(model.segmentArea) > 0, 2)
	if what in ("opening", "slip"): there[:] = True
	there &= view.there.points & pointsOf(model, joints)
	lines, values = contactLines(model, view.shown)[there], values[there]
	if not len(values): return _note(axes, "none")
	normals = np.repeat(model.normal, 2, axis=0)[there]
	most, factor, unit = _scale(_most(values) if most is None else most, "Pa" if what in ("sigma", "tau") else "m")
	values = values / factor
	if not most > 0: return
	along = lines[:, 1] - lines[:, 0]
	across = np.column_stack([-along[:, 1], along[:, 0]])
	across /= np.maximum(np.hypot(*across.T), 1e-300)[:, None]
	across *= np.sign((across * normals).sum(axis=1))[:, None]
	tall = min(0.035 * (view.high - view.low).max(), 2 * np.median(np.hypot(*along.T))) # bars of small joints stay among them
	height = tall * np.clip(values / most, -1, 1)[:, None] * across
	corners = np.stack([lines[:, 0], lines[:, 1], lines[:, 1] + height, lines[:, 0] + height], axis=1)
	colours = np.where(values > 0, _red, _blue)
	axes.add_collection(PolyCollection(corners, facecolors=colours, edgecolors=colours, linewidths=0.1, alpha=0.8, zorder=3), autolim=False)
	sense = {"sigma": "red tension, blue compression", "opening": "red open, blue closed"}.get(what, "red and blue: the two senses")
	_note(axes, f"{sense}; the highest {most:.3g} {unit}")


def _joints(axes, view, joints):
	from matplotlib.collections import LineCollection
	from matplotlib.lines import Line2D
	pictures._drawBlocks(axes, view.model, view.shown)
	there = view.there.points & pointsOf(view.model, joints)
	names, lines = pointNames(view.model)[there], contactLines(view.model, view.shown)[there]
	colours = pictures._assigned(sorted(set(names)), pictures._jointColours, pictures._spareColours)
	for name, colour in colours.items():
		axes.add_collection(LineCollection(lines[names == name], colors=colour, linewidths=1.2, zorder=2), autolim=False)
	handles = [Line2D([], [], color=colour, linewidth=1.2, label=f"{name} ({np.count_nonzero(names == name) // 2})") for name, colour in colours.items()]
	below = -26 * pictures._point / axes.figure.get_figheight()
	axes.legend(handles=handles, title="" if handles else "no joints", loc="upper center", bbox_to_anchor=(0.5, below), borderaxespad=0, ncol=4)


def _contacts(axes, view):
	from matplotlib.collections import LineCollection
	pictures._drawBlocks(axes, view.model, view.shown)
	lines, blocks, force = freeContactLines(view.model)
	if not len(lines): return _note(axes, "no edges touch without a bond")
	size, before = np.hypot(*force.T), _referenceOf(view, lines)
	drawn = (_facing(view) > 0.5) | (size > 0.01 * size.max()) # edges at a corner stand across each other and carry next to nothing
	lines, force, before = lines[drawn], force[drawn], before[drawn]
	if not len(lines): return _note(axes, "no edges touch without a bond")
	moved = view.magnification * (lines.mean(axis=1) - before - view.carried)
	shown = before[:, None] + moved[:, None] + (lines - lines.mean(axis=1, keepdims=True))
	axes.add_collection(LineCollection(shown, colors="black", linewidths=1.2, zorder=2), autolim=False)
	size = np.hypot(*force.T)
	most, factor, unit = _scale(size.max(), "N")
	if not most > 0: return
	reach = 0.06 * (view.high - view.low).max() / size.max()
	middle = shown.mean(axis=1)
	for sign in (-1, 1):
		axes.quiver(*middle.T, *(sign * reach * force).T, color=_blue, angles="xy", scale_units="xy", scale=1, width=0.003, pivot="tip", zorder=3)
	_note(axes, f"arrows: forces between edges that touch without a bond; the longest {most:.3g} {unit}")


def _facing(view):
	"""How straight the two edges of each free contact face each other: 1 parallel, 0 at a right angle."""
	a0, a1, b0, b1 = np.moveaxis(np.asarray(view.model.position)[view.model.freeContacts()["nodes"]], 1, 0)
	unit = lambda edge: edge / np.maximum(np.hypot(*edge.T), 1e-300)[:, None]
	return -(unit(a1 - a0) * unit(b1 - b0)).sum(axis=1)


def _referenceOf(view, lines):
	"""Where the middles of free contacts were in the reference state."""
	nodes = view.model.freeContacts()["nodes"]
	moved = np.asarray(view.model.position) - np.asarray(view.model.reference)
	return lines.mean(axis=1) - moved[nodes].mean(axis=1)


def _reactions(axes, view):
	pictures._drawBlocks(axes, view.model, view.shown)
	found = [some for some in reactionsOf(view.model) if np.hypot(*some[2]) > 0]
	if not found: return _note(axes, "no reactions")
	largest = max(np.hypot(*force) for _, _, force in found)
	most, factor, unit = _scale(largest, "N")
	reach = 0.2 * (view.high - view.low).max()
	middle = (view.low + view.high) / 2
	for name, place, force in found:
		place, arrow = np.clip(place, view.low, view.high), reach * force / largest
		tail = place - arrow # the arrow ends where the force acts, or begins there, where it would leave the picture
		if not ((tail >= view.low) & (tail <= view.high)).all(): tail = place
		axes.annotate("", tail + arrow, tail, arrowprops=dict(arrowstyle="-|>", color=_red, linewidth=1.6, shrinkA=0, shrinkB=0), zorder=4)
		shown = [0 if abs(component) < 1e-3 * largest else component / factor for component in force]
		right = (tail + arrow / 2)[0] > middle[0]
		axes.annotate(
			f"{name}: {shown[0]:.3g}, {shown[1]:.3g} {unit}", tail + arrow / 2, (-6 if right else 6, 0), textcoords="offset points", fontsize=7,
			ha="right" if right else "left", va="center", zorder=5, bbox=dict(facecolor="white", alpha=0.7, linewidth=0, pad=1)
		)
	_note(axes, "forces on the blocks along x and y")


def _note(axes, text):
	axes.text(0.5, -7 / _pointsHigh(axes), text, transform=axes.transAxes, ha="center", va="center", fontsize=6)
