# yade-blocks, GPL-2.0-or-later
"""O.save and O.load for scenes of blocks: whole files or none, and damaged ones are refused by name, in every format.

Behind what YADE writes O.save puts a seal, a checksum over all of it, in a form that YADE and other programs skip: a comment in XML, a member of its own
in .gz and .bz2, bytes behind the archive else. O.load looks at it first: one changed byte anywhere is found, also within the seal. A file without one, of
a session without yadeblocks, must at least be a whole compressed or XML file; the rest is as YADE does it.

What a PyRunner saves within a step goes on with the same bits, or is refused."""
import bz2
import errno
import gzip
import hashlib
import os
import re
import tempfile
from pathlib import Path

from . import files

_reach = 512 # bytes at the end of a file in which a seal would be
_begins = {".gz": b"\x1f\x8b\x08", ".bz2": b"BZh9", "": b"<!--"}
_pieces = {".bz2": rb"BZh9|1AY&SY", ".gz": rb"yadeblocks, |sha256 |[0-9a-f]{40}", "": rb"yadeblocks, |sha256 |[0-9a-f]{40}"}


def _packing(path):
	return next((packing for packing in (".gz", ".bz2") if str(path).endswith(packing)), "")


def _packed(content, path, level=9):
	packing = _packing(path)
	if packing == ".gz": return gzip.compress(content, compresslevel=level, mtime=0)
	return bz2.compress(content) if packing == ".bz2" else content


def sealOf(content, path):
	"""What goes behind the content of a file of this name."""
	return _packed(b"<!-- yadeblocks, sha256 %s -->\n" % hashlib.sha256(content).hexdigest().encode(), path, level=0)


def verify(path):
	"""Raises ValueError, with the file's name, if the file is damaged as far as can be seen. Whether it has a seal."""
	content, packing = Path(path).read_bytes(), _packing(path)
	first = max(10, len(content) - _reach) # a file's own beginning is no seal
	for found in re.finditer(re.escape(_begins[packing]), content[first:]):
		at = first + found.start()
		if sealOf(content[:at], path) == content[at:]: return True
	if re.search(_pieces[packing], content[first:]): raise ValueError(f"{path} is damaged: its checksum does not fit")
	try:
		plain = gzip.decompress(content) if packing == ".gz" else bz2.decompress(content) if packing == ".bz2" else content
		whole = not _isXml(path) or plain.rstrip().endswith(b"</boost_serialization>")
	except (OSError, EOFError, ValueError, gzip.zlib.error):
		whole = False
	if not whole: raise ValueError(f"{path} is damaged: it is no whole file of its kind")
	return False


def _isXml(path):
	return re.search(r"\.xml(\.gz|\.bz2)?$", str(path)) is not None


def write(path, save):
	"""Saves the present scene, whole or not at all, with a seal. save: YADE's own Omega.save. Raises OSError if the file cannot be written.

	YADE's own way in cannot be trusted: into a folder that is not there nothing is saved and nothing said, and on a full disk its compressors never end."""
	from yade.wrapper import Omega
	path = Path(path)
	if not path.parent.is_dir(): raise FileNotFoundError(2, "No such folder", str(path))
	if _isXml(path):
		with tempfile.TemporaryDirectory(prefix="." + path.name, dir=path.parent) as folder:
			try:
				save(Omega(), str(Path(folder) / "scene.xml"), True)
			except RuntimeError as error: # "output stream error", whatever the reason
				disk = os.statvfs(folder) # what was written is still there
				full = disk.f_bavail * disk.f_frsize < len(Omega().sceneToString())
				raise OSError(*((errno.ENOSPC, os.strerror(errno.ENOSPC)) if full else (errno.EIO, str(error))), str(path)) from error
			plain = (Path(folder) / "scene.xml").read_bytes()
		if not plain.rstrip().endswith(b"</boost_serialization>"): raise OSError(28, "No space left on device", str(path))
	else:
		plain = Omega().sceneToString()
	content = _packed(plain, path)
	files.replace(path, content + sealOf(content, path))


def _models(O):
	"""The models of the present scene: one, or none."""
	return next(([body.shape.model] for body in O.bodies if type(body.shape).__name__ == "Block"), [])


def _leave(models, file):
	"""A model whose scene was replaced is not to be taken for the one that was loaded."""
	for model in models:
		_guard(type(model)) # not before there is something to guard: it makes every look at a model 3 us longer
		model._gone = (
			f"this model belongs to the scene that was there before {file} was loaded: "
			"the loaded one is next(b.shape.model for b in O.bodies if isinstance(b.shape, Block))"
		)


def _leaveScene(O):
	"""YADE never frees engines that were in O.engines: ours let go of what is large."""
	for engine in O.engines:
		if hasattr(engine, "_leaveScene"): engine._leaveScene()


def _guard(kind):
	"""Everything of a model that was left behind refuses, except for what begins with an underscore."""
	plain = kind.__getattribute__
	if plain.__name__ == "guarded": return

	def guarded(self, name):
		if not name.startswith("_") and (gone := plain(self, "_gone")): raise RuntimeError(gone)
		return plain(self, name)

	kind.__getattribute__ = guarded


def install():
	"""O.save seals, O.load and O.reload look, and say to models of the scene that was there that they are none any more; once a session."""
	from yade.wrapper import Omega
	if hasattr(Omega, "unsealedSave"): return
	save, load, name, saved = Omega.save, Omega.load, Omega.filename, []

	def saveSealed(self, file, quiet=False):
		"""Saves the scene, whole or not at all, with a checksum; see yadeblocks.saving. Formats by the name, as in YADE: .yade or .xml, and
		.gz or .bz2 behind. Within a step, as by a PyRunner, it must be called behind BlockMotion, and what is saved is the beginning of the next
		step, or before BlockLoop."""
		if file.startswith(":memory:"): return save(self, file, quiet)
		betweenSteps = next((model._betweenSteps for model in _models(self)), lambda save: save())
		betweenSteps(lambda: write(file, save))
		saved[:] = [file]

	def loadSealed(self, file, quiet=False):
		"""Loads a scene; a damaged file is refused, see yadeblocks.saving."""
		if not file.startswith(":memory:") and os.path.isfile(file): verify(file)
		before = _models(self)
		_leaveScene(self)
		load(self, file, quiet)
		saved.clear()
		_leave(before, file)

	def reloadSealed(self, quiet=False):
		"""Loads the scene anew from where it was saved or loaded last."""
		if not self.filename: raise RuntimeError("O.reload: the scene was not saved or loaded")
		loadSealed(self, self.filename, quiet)

	loadTmp = Omega.loadTmp

	def loadTmpAndLeave(self, mark="", quiet=False):
		"""Loads a scene that O.saveTmp kept in memory."""
		before = _models(self)
		loadTmp(self, mark, quiet)
		_leave(before, f"{mark or 'the scene'} of O.saveTmp")

	reset = Omega.reset

	def resetAndLeave(self):
		"""Empties all scenes."""
		_leaveScene(self)
		reset(self)

	Omega.reset = resetAndLeave
	Omega.loadTmp = loadTmpAndLeave
	filename = property(
		lambda self: saved[0] if saved else name.__get__(self), doc="Filename under which the simulation was saved or loaded last; None if not."
	)
	Omega.unsealedSave, Omega.unsealedLoad = save, load
	Omega.save, Omega.load, Omega.reload, Omega.filename = saveSealed, loadSealed, reloadSealed, filename
