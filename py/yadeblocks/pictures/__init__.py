# yade-blocks, GPL-2.0-or-later
"""curve.png and cracks.png, fit to be printed.

	drawCurve(results.folder / "curve.png", results.curves, "displacement_mm", "stress_MPa",
	          labels=("displacement across the joint [mm]", "tensile stress [N/mm²]"),
	          references=[Reference("Van der Pluijm 1992", 0.35)])
	drawCracks(results.folder / "cracks.png", model)

What goes on within a specimen is drawn by `yadeblocks.picturesfields`."""
# flake8: noqa: F401
from .cracks import drawCracks
from .curve import Reference, drawCurve
from .mechanism import drawMechanism
from .session import drawFilm, drawRun, drawSheets, filmOf
