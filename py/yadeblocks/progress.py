# yade-blocks, GPL-2.0-or-later
"""One line that tells how far a long run has come.

	record = Recorder(displacement=gauge, stress=lambda: model.groupForce("top") / area)
	with Progress(p.steps, lambda: loadingLine(record.last.displacement, record.last.stress, model), label="seed 1") as progress:
		record.after(lambda row: progress(O.iter))
"""
import sys
import time

from .readings.status import isBroken


class Progress:
	"""`progress(step)` shows percent, step, `report()` and the time left on stderr: five times a second on a terminal, in place;
	else every ten seconds, a line each. Between these it costs one look at the clock. `report` is only called to be shown.

	steps: the number of the last step; report: a function without arguments that returns text; label: what is running."""
	def __init__(self, steps, report=None, label="", stream=None):
		self.steps, self.report, self.label = steps, report, label
		self.stream = stream or sys.stderr
		self.terminal = self.stream.isatty()
		self.period = 0.2 if self.terminal else 10 # [s]
		self.start = time.monotonic()
		self.due = self.start + self.period
		self.firstStep = None

	def __call__(self, step):
		if self.firstStep is None:
			self.firstStep, self.start = step, time.monotonic()
		if time.monotonic() >= self.due:
			self.show(step)

	def show(self, step):
		"""Shows the line now."""
		now = time.monotonic()
		self.due = now + self.period
		done = step - (self.firstStep or 0)
		left = (now - self.start) * max(self.steps - step, 0) / done if done > 0 else None
		parts = [self.label, f"{100 * step / self.steps:3.0f} %", f"step {step}"]
		if self.report:
			parts.append(self.report())
		if left is not None:
			parts.append(f"{_clock(left)} left")
		line = "  ".join(filter(None, parts))
		self.stream.write(f"\r{line}\x1b[K" if self.terminal else line + "\n")
		self.stream.flush()

	def close(self):
		"""Takes the line away from a terminal; a run may end early."""
		if self.terminal:
			self.stream.write("\r\x1b[K")
			self.stream.flush()

	def __enter__(self):
		return self

	def __exit__(self, *error):
		self.close()


def loadingLine(displacement, stress, model, pace=None):
	"""The usual report of a strength test: displacement [m], stress [Pa], broken contact points and, with a pace.Pace, what it says."""
	broken = isBroken(model.pointStatus).sum()
	return f"u {displacement * 1e3:.4f} mm  stress {stress / 1e6:.3f} MPa  broken {broken}" + (f"  {pace.words()}" if pace else "")


def _clock(seconds):
	minutes, seconds = divmod(int(seconds + 0.5), 60)
	hours, minutes = divmod(minutes, 60)
	return f"{hours}:{minutes:02}:{seconds:02}" if hours else f"{minutes}:{seconds:02}"
