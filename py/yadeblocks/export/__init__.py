# yade-blocks, GPL-2.0-or-later
"""Blocks and joints for ParaView.

	export = BlocksExport(p.folder)
	export.write(model, O.time)          # as often as wanted; blocks.pvd and joints.pvd can be opened after every call

What files show is read of a model by `yadeblocks.readings`; its functions have their names here, too."""
# flake8: noqa: F401
from ..readings.blocks import areasAndCentroids, blockOutlines
from ..readings.contacts import freeContactLines
from ..readings.joints import contactLines, jointMotion
from ..readings.names import jointNames, pairName, pointNames, pointsOf
from ..readings.present import Present
from ..readings.zones import outOfPlaneStress, principalStresses, vonMises, zoneStrains
from .paraview import BlocksExport, writeFilm, writeStates
from .state import State
