# yade-blocks, GPL-2.0-or-later
"""Files that are there whole or not at all, and a folder that results may be written to.

What is written goes to a temporary name beside its place and is renamed when it is on the disk. So a kill or a full disk never leaves half a file,
and a symbolic link of that name is replaced, not followed."""
import os
import shutil
import tempfile
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def replacing(path):
	"""A path to write to; what is there at the end of the block takes the place of `path`, at once. A block that fails changes nothing.

	Makes the folder again if someone has deleted it."""
	path = Path(path)
	path.parent.mkdir(parents=True, exist_ok=True)
	handle, part = tempfile.mkstemp(prefix=f".{path.name}.", suffix=".part", dir=path.parent)
	try:
		os.fchmod(handle, 0o666 & ~_umask())
		os.close(handle)
		yield Path(part)
		with open(part, "rb") as written:
			os.fsync(written.fileno())
		os.replace(part, path)
	except BaseException:
		Path(part).unlink(missing_ok=True)
		raise
	sync(path.parent)


def replace(path, content):
	"""Writes text or bytes to a file, all or nothing."""
	with replacing(path) as part:
		part.write_bytes(content.encode() if isinstance(content, str) else content)


def sync(folder):
	"""Names in the folder reach the disk."""
	handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
	try:
		os.fsync(handle)
	finally:
		os.close(handle)


def requireFolder(folder):
	"""Makes a folder below the current directory and sees whether it can be written to; OSError with a sentence if not.

	Its first part (`out`) may be a symbolic link to a folder elsewhere; links below would lead into what belongs to others."""
	folder, place = Path(folder), Path()
	for depth, part in enumerate(folder.parts):
		place /= part
		if depth and place.is_symlink(): raise OSError(f"{place} is a symbolic link, and what it leads to may be somebody else's")
		if place.exists() and not place.is_dir(): raise OSError(f"{place} is no folder")
	try:
		folder.mkdir(parents=True, exist_ok=True)
		tempfile.TemporaryFile(dir=folder).close()
	except OSError as error:
		raise OSError(f"{folder} cannot be written to: {error.strerror}") from None


def remove(folder):
	"""Deletes a folder with all that is in it; of a symbolic link only the link."""
	folder = Path(folder)
	if folder.is_symlink() or folder.is_file(): folder.unlink()
	elif folder.exists(): shutil.rmtree(folder)


def _umask():
	mask = os.umask(0)
	os.umask(mask)
	return mask
