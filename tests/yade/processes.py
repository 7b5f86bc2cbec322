# yade-blocks, GPL-2.0-or-later
"""Scenarios that run beside a test, which interrupts or kills them."""
import json
import time
from pathlib import Path

import pytest

from scenes import *

scripts = Path(differences.__code__.co_filename).parents[2] / 'scripts'


class Process:
	"""A scenario that is running in a folder."""
	def __init__(self, folder, name, *words):
		environment = {**os.environ, 'OMP_WAIT_POLICY': 'passive'}
		environment.pop('OMP_NUM_THREADS', None)
		script = name if str(name).endswith('.py') else scripts / (name + '.py')
		self.start, self.log = time.monotonic(), open(Path(folder) / 'log', 'w+')
		command = ['yade', '-n', '-x', '-j1', str(script), *words]
		self.popen = subprocess.Popen(command, cwd=folder, env=environment, stdout=self.log, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)

	def wait(self):
		"""Exit code, and what it said."""
		code = self.popen.wait(600)
		self.log.seek(0)
		return code, self.log.read()

	def until(self, condition):
		"""Waits until something is so; False if the process has ended before."""
		while not condition():
			if self.popen.poll() is not None: return False
			time.sleep(0.01)
		return True


def result(folder, name):
	return json.loads((Path(folder) / 'out' / name / 'result.json').read_text())


def withoutCost(found):
	return {key: value for key, value in found.items() if key != 'cost'}


@pytest.fixture
def mounted(tmp_path):
	"""Mounts a disk as out/."""
	(tmp_path / 'out').mkdir()

	def mount(options):
		if subprocess.run(['mount', '-t', 'tmpfs', '-o', options, 'tmpfs', tmp_path / 'out'], capture_output=True).returncode:
			pytest.skip('no right to mount a disk')
		mount.done = True

	mount.done = False
	yield mount
	if mount.done: subprocess.run(['umount', tmp_path / 'out'], check=True)
