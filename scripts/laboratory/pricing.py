# yade-blocks, GPL-2.0-or-later
"""Measuring a step with one feature more: instructions, CPU times, two threads. Run by YADE."""
import json
import time

import numpy as np

import yadeblocks # noqa: F401 (loads the plugin)
from yade import O
from yadeblocks.checkpoint import sceneModel

from .instructions import Marks
from .switches import Row, recordEvery, rowsOf

bare = Row("bare", None)


class Pricing:
	"""Of a scene whose states are in a folder (pricescenes). window: steps; repetitions: of every timed window."""
	def __init__(self, folder, scene, window, repetitions):
		self.folder, self.scene, self.window, self.repetitions = folder, scene, window, repetitions
		self.rows = rowsOf(scene, folder, window)

	def start(self, row=bare):
		"""The scene's state, with one feature more; a few steps behind the switch, which may change masses."""
		O.load(str(self.folder / ((row.state or self.scene) + '.yade')))
		model = sceneModel()
		if row.switch: row.switch(model)
		O.run(recordEvery + 1, True)
		return model

	def counts(self):
		"""Instructions, counted by callgrind; the bare step twice."""
		marks = Marks('build/price/libmarks.so')
		for row in [bare, Row('bare again', None)] + self.rows:
			self.start(row)
			with marks.counting(row.name):
				O.run(self.window, True)

	def times(self):
		"""CPU times of a step [ns], one a turn; features take turns, because the machine's speed changes from second to second."""
		found = {}
		for _ in range(self.repetitions):
			for row in [bare] + self.rows:
				self.start(row)
				begun = time.process_time()
				O.run(self.window, True)
				found.setdefault(row.name, []).append(1e9 * (time.process_time() - begun) / self.window)
		(self.folder / (self.scene + '.times.json')).write_text(json.dumps(found))

	def threads(self):
		"""Wall-clock time of a step on as many threads as YADE has [ns]."""
		found = {}
		for count in (1, 2):
			self.start()
			for e in O.engines:
				e.ompThreads = count
			clock = []
			for _ in range(self.repetitions):
				begun = time.perf_counter()
				O.run(self.window, True)
				clock.append(time.perf_counter() - begun)
			found[count] = 1e9 * float(np.median(clock)) / self.window
		(self.folder / (self.scene + '.threads.json')).write_text(json.dumps(found))
