# yade-blocks, GPL-2.0-or-later
"""Checkpoints: the scene and what recorders hold, saved between two steps, so that a run that was killed goes on with the same bits.

	checkpoints = Checkpoints('out/mine/checkpoint', identity={'code': ..., 'keys': ...})
	running.run(pause=lambda: checkpoints.write({'record': record.kept}, scene=True), every=600)
	state = checkpoints.newest()            # later, in another process: what was written last, None if there is nothing
	model = checkpoints.loadScene(state)

Each one is a folder that appears at once, whole and on the disk; the last two stay. O.save, by contrast, writes in place, and from within a step."""
import hashlib
import json
import os
import re
import tempfile
from pathlib import Path

from . import files


class Stranger(ValueError):
	"""A checkpoint of another code or of other keys."""


class Checkpoints:
	"""The checkpoints in `folder`. identity: a dictionary of what must be the same when a run is resumed."""
	kept = 2

	def __init__(self, folder, identity):
		self.folder, self.identity = Path(folder), json.loads(json.dumps(identity))

	def numbers(self):
		"""Of the checkpoints that are there, the oldest first."""
		if not self.folder.is_dir() or self.folder.is_symlink(): return []
		return sorted(int(entry.name) for entry in self.folder.iterdir() if re.fullmatch(r"\d+", entry.name) and not entry.is_symlink())

	def write(self, state, scene):
		"""Adds a checkpoint: a dictionary that json can write and, if asked for, the present scene; not to be called within a step."""
		before = self.numbers()
		number = before[-1] + 1 if before else 0
		content = {"identity": self.identity, "state": state}
		self.folder.mkdir(parents=True, exist_ok=True)
		part = Path(tempfile.mkdtemp(prefix=".", suffix=".part", dir=self.folder))
		try:
			if scene:
				from yade.wrapper import Omega
				saved = Omega().sceneToString()
				content["scene"] = hashlib.sha256(saved).hexdigest()
				files.replace(part / "scene.yade", saved)
			files.replace(part / "state.json", json.dumps(content))
			os.rename(part, self.folder / f"{number:06}")
		except BaseException:
			files.remove(part)
			raise
		files.sync(self.folder)
		for old in before[:1 - self.kept or None]:
			files.remove(self.folder / f"{old:06}")
		for rest in self.folder.glob(".*.part"):
			files.remove(rest) # of a run that was killed

	def newest(self):
		"""The state that was written last and is whole; None if there is none. Raises Stranger if it is that of another run."""
		for number in reversed(self.numbers()):
			try:
				content = json.loads((self.folder / f"{number:06}" / "state.json").read_text())
				scene = (self.folder / f"{number:06}" / "scene.yade").read_bytes() if "scene" in content else None
			except (OSError, ValueError):
				continue
			if scene is not None and hashlib.sha256(scene).hexdigest() != content["scene"]: continue
			other = [name for name, value in self.identity.items() if content["identity"].get(name) != value]
			if other: raise Stranger(", ".join(self._difference(name, content["identity"].get(name)) for name in other))
			self._scene = scene
			return content["state"]
		return None

	def _difference(self, name, then):
		now = self.identity[name]
		if not (isinstance(now, dict) and isinstance(then, dict)): return name
		changed = [key for key in {**then, **now} if then.get(key) != now.get(key)]
		return ", ".join(f"{key}={then.get(key)} instead of {now.get(key)}" for key in changed)

	def loadScene(self):
		"""Makes the scene of the newest checkpoint the present one; its model."""
		from yade.wrapper import Omega
		Omega().stringToScene(self._scene)
		self._scene = None
		return sceneModel()

	def clear(self):
		"""Removes all checkpoints: the run has come to its end."""
		files.remove(self.folder)


def sceneModel():
	"""The BlockModel of the present scene."""
	from yade.wrapper import Omega
	for body in Omega().bodies:
		if type(body.shape).__name__ == "Block": return body.shape.model
	raise ValueError("there is no block in the scene")
