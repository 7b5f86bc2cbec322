# yade-blocks, GPL-2.0-or-later
"""Files that are whole or not there, folders that are refused, checkpoints that are damaged. No test needs YADE."""
import errno
import json
import os
import subprocess
from pathlib import Path

import pytest

from yadeblocks import files
from yadeblocks.checkpoint import Checkpoints, Stranger


@pytest.fixture
def small(tmp_path):
	"""A disk of 64 kB, where one can be mounted."""
	disk = tmp_path / "disk"
	disk.mkdir()
	if subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", disk], capture_output=True).returncode:
		pytest.skip("no right to mount a small disk")
	yield disk
	subprocess.run(["umount", disk], check=True)


def test_wholeOrNotAtAll(tmp_path):
	path = tmp_path / "deep" / "file"
	files.replace(path, "old")
	with pytest.raises(KeyError), files.replacing(path) as part:
		part.write_text("half of it")
		assert path.read_text() == "old"
		raise KeyError
	assert path.read_text() == "old" and os.listdir(path.parent) == ["file"]
	files.replace(path, b"new")
	assert path.read_text() == "new" and os.listdir(path.parent) == ["file"]
	mask = os.umask(0o027)
	try:
		files.replace(path, "")
	finally:
		os.umask(mask)
	assert path.stat().st_mode & 0o777 == 0o640 # as other programs' files


def test_aFullDisk(small):
	files.replace(small / "file", "old")
	with pytest.raises(OSError) as full:
		files.replace(small / "file", b"x" * 100000)
	assert full.value.errno == errno.ENOSPC and (small / "file").read_text() == "old" and os.listdir(small) == ["file"]
	checkpoints = Checkpoints(small / "checkpoint", {})
	checkpoints.write({"a": 1}, scene=False)
	with pytest.raises(OSError):
		checkpoints.write({"a": "x" * 100000}, scene=False)
	assert checkpoints.newest() == {"a": 1} and os.listdir(small / "checkpoint") == ["000000"]


def test_linksAreNotFollowed(tmp_path, monkeypatch):
	monkeypatch.chdir(tmp_path)
	Path("theirs").mkdir()
	Path("theirs/precious").write_text("precious")
	Path("out").symlink_to("elsewhere")
	Path("elsewhere").mkdir()
	files.requireFolder(Path("out/mine")) # out itself may be a link
	assert Path("elsewhere/mine").is_dir()
	Path("out/mine/file").symlink_to(tmp_path / "theirs/precious")
	files.replace(Path("out/mine/file"), "ours")
	assert Path("theirs/precious").read_text() == "precious" and Path("out/mine/file").read_text() == "ours"
	Path("out/linked").symlink_to(tmp_path / "theirs")
	with pytest.raises(OSError, match="out/linked is a symbolic link"):
		files.requireFolder(Path("out/linked"))
	files.remove(Path("out/linked"))
	assert Path("theirs/precious").exists() and not Path("out/linked").exists()


def test_aFileWhereAFolderShouldBe(tmp_path, monkeypatch):
	monkeypatch.chdir(tmp_path)
	Path("out").write_text("")
	with pytest.raises(OSError, match="^out is no folder$"):
		files.requireFolder(Path("out/tension"))


def test_theLastTwoStay(tmp_path):
	checkpoints = Checkpoints(tmp_path / "c", {"code": "a"})
	assert checkpoints.newest() is None
	for n in range(4):
		checkpoints.write({"n": n}, scene=False)
	assert checkpoints.numbers() == [2, 3] and checkpoints.newest() == {"n": 3}
	(tmp_path / "c" / ".x.part").mkdir() # of a process that was killed while it wrote
	checkpoints.write({"n": 4}, scene=False)
	assert sorted(os.listdir(tmp_path / "c")) == ["000003", "000004"]


@pytest.mark.parametrize("damage", ["state.json", "scene.yade", "nothing"])
def test_aDamagedCheckpointIsPassedOver(tmp_path, damage):
	"""Whatever byte is changed: the one before is taken."""
	import hashlib
	checkpoints = Checkpoints(tmp_path / "c", {})
	for n in range(2):
		checkpoints.write({"n": n}, scene=False)
		place = tmp_path / "c" / f"{n:06}"
		scene = bytes(range(200))
		(place / "scene.yade").write_bytes(scene)
		content = {**json.loads((place / "state.json").read_text()), "scene": hashlib.sha256(scene).hexdigest()}
		(place / "state.json").write_text(json.dumps(content))
	if damage == "scene.yade": (place / damage).write_bytes(scene[:100] + b"!" + scene[101:])
	if damage == "state.json": (place / damage).write_text("{" + (place / damage).read_text()[:50])
	assert checkpoints.newest() == {"n": 1 if damage == "nothing" else 0}


def test_strangersAreRefused(tmp_path):
	Checkpoints(tmp_path, {"code": "a", "keys": {"steps": 1, "seed": 1}}).write({}, scene=False)
	assert Checkpoints(tmp_path, {"keys": {"seed": 1, "steps": 1}, "code": "a"}).newest() == {}
	with pytest.raises(Stranger, match="^steps=1 instead of 2$"):
		Checkpoints(tmp_path, {"code": "a", "keys": {"steps": 2, "seed": 1}}).newest()
	with pytest.raises(Stranger, match="^code$"):
		Checkpoints(tmp_path, {"code": "b", "keys": {"steps": 1, "seed": 1}}).newest()
