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
_lock, _ending = threading.Lock(), threading.Event()


def end():
	"""Ends the run after the step that is going on; for what a step calls, such as loading.Stop."""
	from yade.wrapper import Omega
	O = Omega()
	with _lock: # a run that is to rest for a checkpoint must not forget this
		_ending.set()
		O.stopAtIter = O.iter + 1


def run(steps=None, pause=None, every=0):
	"""Runs so many steps, or until something stops the run. What stops it with an error is raised, as by O.run(steps, True).

	O.run(steps, True) waits inside YADE, where Python gets to see no signal. Here YADE runs in the background, and this thread looks for signals ten times
	a second; an interrupt ends the run after the step that is going on. pause: a function that is called every so many seconds, between two steps.

	O.pause() does not do for that: it returns while a step is going on, and O.run(wait=True) then returns up to 40 ms later, be the step done or not. Saved
	in the middle of a step, a scene moves once more than it should. Only a run that comes to its O.stopAtIter rests between two steps."""
	from yade.wrapper import Omega
	O = Omega()
	last, start = O.iter + steps if steps else 0, time.monotonic()
	_ending.clear()
	while not _stretch(O, last, start + every if pause else None):
		pause()
		start = time.monotonic()
	for body in O.bodies: # the last steps of a run that was stopped by an engine behind BlockMotion
		if type(body.shape).__name__ == "Block":
			body.shape.model.requireSound()
			break


def _stretch(O, last, until):
	"""Runs on; whether this was all. If not, the run rests between two steps because the time `until` has come. last: the step to stop at, 0 for none."""
	errors, asked, O.stopAtIter = [], False, last
	over = threading.Event() # not Thread.join: interrupted, it takes the thread for one that has ended (Python 3.11)
	given = threading.Lock() # the thread runs YADE only if it is the first to take this
	mine = lambda: given.acquire(blocking=False)

	def work():
		try:
			if mine(): O.run(-1, True)
		except BaseException as error:
			errors.append(error)
		finally:
			over.set()

	first, began = O.iter, time.monotonic()
	try:
		threading.Thread(target=work, daemon=True).start() # an interrupt may come in here, before the thread begins or behind
		while not over.wait(look if until is None else max(0, min(look, until - time.monotonic()))):
			if until is not None and time.monotonic() >= until:
				asked = True
				_rest(O, over, last, began, first)
	except BaseException:
		if not mine(): _rest(O, over, last, began, first)
		raise
	if errors: raise errors[0]
	return not asked or _ending.is_set() or O.iter == last > 0


def _rest(O, over, last, began, first):
	"""Ends the run between two steps, soon. began, first: when it began, and at which step; over: set where it has ended."""
	soon = 0.01 # seconds ahead; more where the run has passed the step before it could be stopped there
	while not over.is_set():
		with _lock:
			speed = (O.iter - first) / max(time.monotonic() - began, 1e-3)
			at, other = O.iter + 1 + int(soon * speed), O.stopAtIter # YADE makes it negative when it has stopped
			ends = _ending.is_set() or O.iter < last <= at or other > O.iter and other != last
			if not ends: O.stopAtIter = at
		while not over.is_set() and (ends or O.iter <= at):
			over.wait(0.002)
		soon *= 2
