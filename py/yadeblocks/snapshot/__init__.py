# yade-blocks, GPL-2.0-or-later
"""A model as it was at a moment, for pictures and files that are made later; and those of a run, its peak among them.

	film = Film(model, frames=10)
	record.after(lambda row: film.look(path() / stroke, row.stress, O.time))
	film.peak, film.states()     # Snapshots: at the highest stress so far; all frames and the peak, in order of time"""
# flake8: noqa: F401
from ..readings.materials import poissonOf
from ..readings.reactions import reactionsOf
from .film import Film
from .snapshot import Snapshot
