# yade-blocks, GPL-2.0-or-later
"""The sheets and the movie of a scenario."""
from ..snapshot import Snapshot
from .movie import drawMovie
from .sheet import drawSheet


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
