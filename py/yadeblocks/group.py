# yade-blocks, GPL-2.0-or-later
"""A handle of some grid points of a model, in place of a name in every call.

	top = model.group('top', lambda x, y: y > 0.2 - 1e-9)      # or indices of grid points
	top.drive('y', velocity=-1e-3)
	O.run(1000, True)
	print(top.force, top.moment((0, 0)), top.displacement)
	top = model.group('top')                                   # a motion group that is there, after O.load, say

Every call is one of BlockModel's (`drive`, `groupForce`, ...), and these go on working with the name."""
import numpy as np

from ._door import door


class Group:
	"""Grid points of a model with a name, as BlockModel.group returns them. `name`, `nodes` (ascending indices), `model`.

	It may be held, driven or pushed (then it is one of model.groups), or only read."""
	def __init__(self, model, name, nodes):
		self.model, self.name, self.nodes = model, name, nodes

	def __repr__(self):
		return f"<Group {self.name!r}, {len(self.nodes)} grid points, {'moves along ' + self.axes if self.moves else 'free'}>"

	@property
	def moves(self):
		"""Whether it is held, driven or pushed."""
		return self.name in self.model.groups

	# ---- what it does

	def drive(self, axes, velocity=0.0, rampTime=0.0, startTime=0.0):
		"""Prescribes its velocity [m/s] along 'x', 'y' or 'xy'; 0: held. As BlockModel.drive. Returns itself."""
		self.model.drive(self.name, self.nodes, axes, velocity, rampTime, startTime)
		return self

	def push(self, axis, force, rampTime=0.0, startTime=0.0):
		"""Moves it along one axis as one, by a force [N]. As BlockModel.push. Returns itself."""
		self.model.push(self.name, self.nodes, axis, force, rampTime, startTime)
		return self

	def motion(self, values):
		"""loading.Motion of it: a function of the time [s], or a table (times, values), of its velocity [m/s] or force [N]; its `engine()`
		stands first in O.engines."""
		from .loading.motion import Motion
		return Motion(self.model, self.name, values)

	def setTarget(self, target, rampTime=0.0):
		"""A new velocity [m/s] or force [N]. As BlockModel.setTarget."""
		self.model.setTarget(self.name, target, rampTime)

	def setThrottle(self, throttle):
		"""A factor in [0, 1] on its velocity. As BlockModel.setThrottle."""
		self.model.setThrottle(self.name, throttle)

	def release(self):
		"""Lets it go. As BlockModel.release; it can be read, driven and pushed from then on, too."""
		self.model.release(self.name)

	# ---- what is read

	@property
	def axes(self):
		"""Along which it is held, driven or pushed: 'x', 'y' or 'xy'. ValueError if it is not."""
		return self.model.groupAxes(self.name)

	@property
	def force(self):
		"""What it puts on the blocks, along x and y, in the last step [N], an array; 0 along an axis on which it does not act. ValueError if it is not
		held, driven or pushed."""
		return np.array([self.model.groupForce(self.name, axis=axis) if axis in self.axes else 0.0 for axis in "xy"])

	def moment(self, about):
		"""Moment of its forces on the blocks about a point (x, y) [m], counter-clockwise, in the last step [N m]. ValueError as for `force`."""
		return self.model.groupMoment(self.name, about)

	@property
	def displacement(self):
		"""Mean displacement of its grid points (ux, uy) [m], an array; also of a group that is only read."""
		return self.model.displacement[self.nodes].mean(axis=0)

	@property
	def velocity(self):
		"""Mean velocity of its grid points half a step ago (vx, vy) [m/s], an array; also of a group that is only read."""
		return self.model.velocity[self.nodes].mean(axis=0)

	@property
	def travelled(self):
		"""How far it has come along its axes since it is held, driven or pushed [m]. ValueError if it is not."""
		return self.model.groupTravelled(self.name)

	@property
	def work(self):
		"""Work that it has done on the blocks [J]. ValueError if it is not held, driven or pushed."""
		return self.model.groupWork(self.name)


def group(self, name, nodes=None):
	"""group(name, nodes=None) -> yadeblocks.group.Group: a handle, `top.force` in place of `model.groupForce('top')`.

	nodes: indices of grid points, or a function of x and y in the reference state that says which (specimen.nodesWhere); None: those of the motion
	group of this name. Errors: ValueError for grid points that are not there, none at all, other ones than the motion group of this name has, and
	where nodes are left out and there is no such group; TypeError where the name is no text."""
	if not isinstance(name, str): raise TypeError(f"BlockModel.group.name must be a text, got {name!r}")
	if nodes is None: return Group(self, name, self.groupNodes(name))
	if callable(nodes):
		from .specimen import nodesWhere
		nodes = nodesWhere(self, nodes)
	given = np.asarray(nodes)
	if not given.size: raise ValueError(f"BlockModel.group {name!r}: there must be at least one grid point")
	if given.ndim != 1 or given.dtype.kind not in 'iuf' or not (given == np.round(given)).all():
		raise ValueError(f"BlockModel.group {name!r}: nodes must be indices of grid points or a function of x and y, got {nodes!r}")
	chosen = np.unique(given.astype(int))
	if chosen[0] < 0 or chosen[-1] >= self.nodeCount:
		raise ValueError(f"BlockModel.group {name!r}: grid points lie in [0, {self.nodeCount}), got {chosen[0] if chosen[0] < 0 else chosen[-1]}")
	if name in self.groups and not np.array_equal(self.groupNodes(name), chosen):
		raise ValueError(f"BlockModel.group {name!r}: there is a motion group of this name with other grid points")
	return Group(self, name, chosen)


def install(wrapper):
	"""BlockModel.group."""
	group.__qualname__ = "BlockModel.group"
	wrapper.BlockModel.group = door()(group)
