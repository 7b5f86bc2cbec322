# yade-blocks, GPL-2.0-or-later
"""Movies of what other pictures show."""
from pathlib import Path

import numpy as np

from .. import files
from .._door import door
from .._words import requireOneOf
from .bars import onJoints, showBars, valuesOnJoints
from .contacts import showContacts
from .cracks import showCracks
from .crosses import showCrosses
from .field import fields, keptOf, showField, valuesOf
from .figure import blankFigure
from .panel import frame
from .reactions import showReactions
from .titles import titles
from .units import nearlyLargest
from .view import View


@door('rate', magnification='notNegative', path='file', states='models', what='str', window='box', title='str')
def drawMovie(path, states, what="cracks", magnification=None, window=None, title="", rate=5):
	"""A movie of Snapshots: one of `fields` or `onJoints`, 'cracks', 'crosses', 'contacts' or 'reactions'. path: .gif (Pillow) or .mp4 (needs Debian's
	ffmpeg); rate: frames a second. All frames have one window, one magnification and one range of colours. Returns the path."""
	import matplotlib.animation
	kinds = {"cracks": showCracks, "crosses": showCrosses, "contacts": showContacts, "reactions": showReactions}
	requireOneOf("what", what, (*fields, *onJoints, *kinds))
	writers = {".gif": matplotlib.animation.PillowWriter, ".mp4": matplotlib.animation.FFMpegWriter}
	path = Path(path)
	requireOneOf("path's ending", path.suffix, tuple(writers))
	if not len(states): raise ValueError("drawMovie: there are no states")
	if not rate > 0: raise ValueError(f"drawMovie.rate must be positive, got {rate!r}")
	if not writers[path.suffix].isAvailable():
		raise RuntimeError(f"a movie {path.suffix} needs {'ffmpeg: scripts/install.sh ffmpeg' if path.suffix == '.mp4' else 'Pillow'}")
	last = View(states[-1], magnification, window)
	views = [View(state, last.magnification, window) for state in states] # what is removed later is in the first ones
	low, high = np.min([view.low for view in views], axis=0), np.max([view.high for view in views], axis=0)
	for view in views:
		view.low, view.high = low, high
	if what in fields: most = max((nearlyLargest(valuesOf(view, what)[0][keptOf(view, what)]) for view in views), default=0)
	elif what in onJoints: most = max((nearlyLargest(valuesOnJoints(view.model, what)[view.there.points]) for view in views), default=0)
	draw = {**kinds, **dict.fromkeys(fields, lambda a, v: showField(a, v, what, most)),
		**dict.fromkeys(onJoints, lambda a, v: showBars(a, v, what, most))}[what]
	size = high - low
	width, height = size * min(5 / size[0], 5 / size[1])
	with files.replacing(path) as part:
		with blankFigure(width + 0.4, height + 1.2) as figure:
			film = writers[path.suffix](fps=rate)
			with film.saving(figure, str(part) + path.suffix, dpi=120):
				for view in views:
					figure.clear()
					axes = figure.add_axes((0.2 / (width + 0.4), 0.8 / (height + 1.2), width / (width + 0.4), height / (height + 1.2)))
					frame(axes, view, f"{title or titles.get(what, what)}, {view.model.time:.4g} s")
					draw(axes, view)
					film.grab_frame()
			Path(str(part) + path.suffix).replace(part)
	return path
