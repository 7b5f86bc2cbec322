# yade-blocks, GPL-2.0-or-later
"""Counting instructions: callgrind's profiles, and which of them belong to which feature. Counts repeat where times scatter.

	marks = Marks('build/price/libmarks.so')                    # in a YADE that runs in callgrind, with --instr-atstart=no
	with marks.counting('energy'): O.run(100, True)
	profile = readProfiles('out/price/tension.callgrind')['energy']
	profile.total / 100                                         # instructions per step
"""
import ctypes
import glob
import re
from collections import Counter
from contextlib import contextmanager
from pathlib import Path


class Marks:
	"""Switches callgrind's counting on and off from within; the library is built by scripts/price.sh."""
	def __init__(self, library):
		self.library = ctypes.CDLL(str(library))

	@contextmanager
	def counting(self, name):
		"""Counts what happens inside the block, as the profile `name`."""
		self.library.startCounting()
		yield
		self.library.stopCounting(name.encode())


class Profile:
	"""Instructions by place: a Counter over (function, source file, line), each line's own cost."""
	def __init__(self, places=()):
		self.places = Counter(places)

	@property
	def total(self):
		return sum(self.places.values())

	def byFunction(self):
		"""A Counter over the functions' names, most expensive first in most_common()."""
		functions = Counter()
		for (function, _, _), count in self.places.items():
			functions[function] += count
		return functions

	def inFeature(self, feature, source):
		"""Instructions in the files of a feature, or on other lines that speak of it. `source(file)` returns a list of lines, empty for
		unknown files. An upper bound: a line that speaks of a feature may do something else too."""
		count = 0
		for (_, file, line), cost in self.places.items():
			if Path(file).stem in feature.files: count += cost
			elif feature.lines:
				text = source(file)
				if 0 < line <= len(text) and re.search(feature.lines, text[line - 1]): count += cost
		return count


class Feature:
	"""Where a feature's code is: the names of its own source files, without their ends, and a regular expression for lines elsewhere,
	alternatives without groups."""
	def __init__(self, files='', lines=''):
		self.files, self.lines = set(files.split()), lines


def sourceLines(root):
	"""The function `source` for Profile.inFeature: lines of the project's own files below `root`, read once."""
	root, known = str(Path(root).resolve()), {}

	def source(file):
		if file not in known: known[file] = Path(file).read_text().splitlines() if file.startswith(root) and Path(file).is_file() else []
		return known[file]

	return source


def readProfiles(file):
	"""All profiles that one run in callgrind has left in FILE.1, FILE.2 ...: {name: Profile}, those without a name left out."""
	profiles = {}
	for part in glob.glob(glob.escape(str(file)) + '.*'):
		with open(part) as lines:
			name, profile = parseProfile(lines)
		if name: profiles[name] = profile
	return profiles


def parseProfile(lines):
	"""One profile in callgrind's format with whole names and absolute positions (--compress-strings=no --compress-pos=no): its name,
	None if no Marks asked for it, and the Profile. Inclusive costs of calls are left out, so that everything counts once."""
	name, places = None, Counter()
	file = function = None
	inclusive = False
	for line in lines:
		line = line.rstrip('\n')
		if inclusive: # the line after calls=
			inclusive = False
		elif line[:1].isdigit():
			position, cost = line.split()[:2]
			places[function, file, int(position)] += int(cost)
		elif line.startswith('calls='):
			inclusive = True
		elif line.startswith(('fl=', 'fi=', 'fe=')):
			file = line[3:]
		elif line.startswith('fn='):
			function = line[3:]
		elif line.startswith('desc: Trigger: Client Request: '):
			name = line[31:]
		elif line.startswith('positions:') and line != 'positions: line':
			raise ValueError('callgrind profile with %s, expected "positions: line"' % line)
	return name, Profile(places)
