# yade-blocks, GPL-2.0-or-later
"""A part of a run that takes long, of which checkpoints are made."""
from . import running


class Stage:
	"""Made by Session.stage. `model`: that of the checkpoint from which the stage is resumed, else None."""
	def __init__(self, session, label):
		self.session, self.label, self.parts, self.model = session, label, {}, None
		self._kept = None

	def resume(self, model, kept):
		"""Goes on where a checkpoint was made: its model, and what it kept of this stage."""
		from yade.wrapper import Omega
		self.model, self._kept = model, kept["parts"]
		for engine, (time, count) in zip(Omega().engines, kept["times"]):
			engine.execTime, engine.execCount = time, count

	def keep(self, **parts):
		"""What a checkpoint keeps by name, besides the scene: objects with an attribute `kept` that json can write; those that are None are
		left out."""
		self.parts = {name: part for name, part in parts.items() if part is not None}
		if self._kept is not None:
			for name, part in self.parts.items():
				part.kept = self._kept[name]

	def run(self):
		"""Runs until something stops the run; see running.run."""
		running.run(pause=(lambda: self.session.keepStage(self)) if self.session.period else None, every=self.session.period)
