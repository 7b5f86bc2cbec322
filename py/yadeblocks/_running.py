# yade-blocks, GPL-2.0-or-later
"""What is said where a scene of blocks is run without an engine of ours: nothing would move, or YADE's own engines, with which the program begins, would meet
shapes that they do not know and abort it."""
import functools


def install(wrapper):
	"""Puts itself in front of O.run and O.step; once a session."""
	kind = wrapper.Omega
	if hasattr(kind.run, "__wrapped__"): return
	for name in "run", "step":
		setattr(kind, name, _looking(getattr(kind, name)))


def _looking(method):
	@functools.wraps(method, assigned=("__name__", "__doc__"), updated=())
	def call(self, *given, **named):
		_requireEngines(self)
		return method(self, *given, **named)

	return call


def _requireEngines(O):
	kinds = [type(engine).__name__ for engine in O.engines]
	if any(kind.startswith("Block") for kind in kinds) or not len(O.bodies): return
	for end in O.bodies[0], O.bodies[len(O.bodies) - 1]: # insert() puts blocks behind what is there; all bodies may be many
		if end is not None and type(end.shape).__name__ == "Block":
			there = ", ".join(kinds) or "nothing"
			raise RuntimeError(
				f"O.engines has no BlockLoop and no BlockMotion, so blocks would not move; it has {there}. See yadeblocks.engines.loopList"
			)
