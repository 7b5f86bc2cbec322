# yade-blocks, GPL-2.0-or-later
"""What every optional feature costs a step, switched off and on. To be started by scripts/price.sh:

	scripts/price.sh [quick=false]        about 8 minutes on two idle cores, and a build the first time; quick=false: longer windows, more repetitions

Three states are measured: a couplet in tension whose first joints are broken (TT2 of tension.py, bonded joints only), a masonry
prism in compression before its first crack (compression.py, half as wide) and the same prism crushed, with general contact. From
each, the same window of steps is run again and again, with one feature more every time. Instructions are counted in callgrind and
repeat to about 1e-4; times are medians of 15 turns, in each of which a feature is compared with the bare step.

Switched off, a feature leaves only the question whether it is on. To show it, the instructions of the bare scene are sorted by source
line: those in a feature's own files, or on lines elsewhere that speak of it, are its price while it is off: an upper bound.
"""
import sys
from pathlib import Path

import yadeblocks
from yadeblocks import scenario

house = Path(yadeblocks.__file__).resolve().parents[2] # __file__ is YADE itself
sys.path.insert(0, str(house / 'scripts'))
from laboratory.pricescenes import saveStates
from laboratory.pricetable import report
from laboratory.pricing import Pricing

p = scenario.parameters({'part': '', 'scene': 'tension', 'quick': True}, {
	'part': scenario.Rule(lambda part: part in ('states', 'times', 'counts', 'threads', 'table'), 'is set by scripts/price.sh, which starts this script'),
	'scene': ('tension', 'compression', 'crushed')
})
folder = Path('out/price')
window = 100 if p.quick else 400 # steps
folder.mkdir(parents=True, exist_ok=True)
pricing = Pricing(folder, p.scene, window, repetitions=15 if p.quick else 45)
if p.part == 'states': saveStates(folder)
elif p.part == 'table': report(folder, pricing.rows, window, house)
else: {'times': pricing.times, 'counts': pricing.counts, 'threads': pricing.threads}[p.part]()
