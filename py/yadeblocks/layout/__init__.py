# yade-blocks, GPL-2.0-or-later
"""Blocks that a builder has laid out, and the names of the joints between them.

	wall = runningBond(bricks=5, courses=6, length=0.4, height=0.175)      # a Layout: nothing is in a model yet
	placed = wall.addTo(model, 'unit', zoneSize=0.1)                       # or rigid=True
	joints = placed.bond(model, [JointMat(...)], head=dict(tension=0))     # {'bed': array, 'head': array, ...}
	model.setJoints('bed', cohesion=0.35e6)                                # also later: the names are the model's
	Cracks(model), pictures.drawCracks(path, model)                        # results and pictures by name

Builders: brickwork, voussoirs, jointsets; their outlines are plain arrays, so that whatever can make polygons is one."""
# flake8: noqa: F401
from ..polygons import area, counterClockwise
from .layout import Layout
from .mortared import Mortared
from .placed import Placed
