# yade-blocks, GPL-2.0-or-later
"""What a scenario leaves of its first run: pictures, a movie, files for ParaView, as its keys say."""
from ..export import writeFilm
from ..snapshot import Film, Snapshot
from .cracks import drawCracks
from .movie import drawMovie
from .sheet import drawSheet


def filmOf(parameters, model):
	"""A Film with as many frames as the keys `frames`, `vtk` and `movie` ask for."""
	return Film(model, parameters.frames if parameters.vtk or parameters.movie != "none" else 0)


def drawRun(session, film, model, title):
	"""cracks.png of the model as it is now, and what the Session's keys `sheets`, `movie` and `vtk` ask for, of it and of a Film."""
	from yade.wrapper import Omega
	p = session.parameters
	session.picture("cracks.png", drawCracks, model, title=title)
	if p.sheets: drawSheets(session, film, model, title)
	drawFilm(session, film, model, title)
	if p.vtk: session.later(writeFilm, p.folder, film, Snapshot(model, Omega().time))


def drawSheets(session, film, model, title):
	"""sheet-peak.png and sheet-end.png of a Session: picturesfields.drawSheet of a Film's peak and of the model as it is now."""
	if film.peak: session.picture("sheet-peak.png", drawSheet, film.peak, title=title + ", at the peak")
	session.picture("sheet-end.png", drawSheet, model, title=title + ", at the end")


def drawFilm(session, film, model, title):
	"""movie.gif or movie.mp4 of a Session whose key `movie` says so: the cracks in a Film's frames, at its peak and now."""
	from yade.wrapper import Omega
	p = session.parameters
	if p.movie == "none": return
	states = [*film.states(), Snapshot(model, Omega().time, like=film.peak)]
	session.later(drawMovie, session.folder / f"movie.{p.movie}", states, "cracks", title=title)
