# yade-blocks, GPL-2.0-or-later
"""Running so that an interrupt acts at once, and that a checkpoint is made now and then.

	with running.interrupts():                   # Ctrl-C and SIGTERM raise Interrupted
		running.run(100000, pause=save, every=600)    # save() every ten minutes, between two steps
"""
import signal
import threading
import time
from contextlib import contextmanager


class Interrupted(KeyboardInterrupt):
	"""The program was asked to end, by this signal; its exit code is 128 + signal."""
	def __init__(self, number):
		super().__init__(number)
		self.signal = number

	def __str__(self):
		return signal.Signals(self.signal).name


@contextmanager
def interrupts():
	"""SIGINT and SIGTERM raise Interrupted inside the block, the first of them; a second one ends the program as it would without."""
	asked = signal.SIGINT, signal.SIGTERM

	def interrupt(number, frame):
		for number_ in asked:
			signal.signal(number_, signal.SIG_DFL)
		raise Interrupted(number)

	before = [signal.signal(number, interrupt) for number in asked] # also where a shell has SIGINT ignored
	try:
		yield
	finally:
		for number, handler in zip(asked, before):
			signal.signal(number, handler)


look = 0.1 # seconds between two looks for signals


def run(steps=None, pause=None, every=0):
	"""Runs so many steps, or until something stops the run. What stops it with an error is raised, as by O.run(steps, True).

	O.run(steps, True) waits inside YADE, where Python gets to see no signal. Here YADE runs in the background, and this thread looks for signals ten times
	a second; an interrupt ends the run after the step that is going on. pause: a function that is called every so many seconds, between two steps."""
	from yade.wrapper import Omega
	O = Omega()
	O.stopAtIter = 0 # of an earlier run
	start = time.monotonic()
	while not _stretch(O, steps, start + every if pause else None):
		pause()
		steps, start = None, time.monotonic()


def _stretch(O, steps, until):
	"""Runs on; whether this was all. If not, the run rests between two steps because the time `until` has come."""
	errors, asked = [], False

	def work():
		try:
			O.run(-1 if steps is None else steps, True)
		except BaseException as error:
			errors.append(error)

	thread = threading.Thread(target=work, daemon=True)
	thread.start()
	try:
		while thread.is_alive():
			thread.join(look if until is None or asked else max(0, min(look, until - time.monotonic())))
			if until is not None and not asked and time.monotonic() >= until:
				asked = True
				O.pause()
	except BaseException:
		O.pause()
		thread.join()
		raise
	if errors: raise errors[0]
	return not asked or O.stopAtIter == O.iter > 0
