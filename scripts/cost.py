# yade-blocks, GPL-2.0-or-later
"""What a step costs, from 1,300 to 800,000 zones: scripts/cost.sh [sizes=3e-3,2e-3,1e-3] [turns=3] [threads=1] [other=FOLDER]. Some ten minutes.

Couplet in tension: a mortar layer of Voronoi blocks (sqrt(area) = sizes [m], Lloyd 2; sizes=all: 3e-3,2e-3,1e-3,3e-4,1.1e-4) between two bricks whose zones
are four times as large. Prism: five layers of such blocks, from 1e-3 on only, for it has six times the zones; intact, with a fifth of its
points broken, and ("freed", with contact) with these joints all free contacts, as those are whose edges have moved on.
The load is so small that nothing else breaks. Each with general contact off and on, with energy accounts off and on, and on as many threads as are listed
(threads=1,2). Every number is a median over the turns, in which builds and threads take turns; one turn takes as many steps as fit into a second.

- CPU and wall time of a step [us]; ns by zones and by contact points are CPU time on one thread and wall time on several, for threads that wait spin.
- set-up: CPU seconds of building and the first three steps; B/zone: the most memory, less what YADE itself had when building began.
- of first: share of the wall time on the first number of threads. of other: share of the cost in another checkout of this project with its own build/ (say an
  earlier commit), other=FOLDER.
- start: seconds from the command yade to the end of the first step, of a small couplet and of a script without engines.

Leaves out/cost/cost.csv and cost.png."""
import csv
import json
import os
import statistics
import subprocess
import sys
import time
from itertools import product
from pathlib import Path

root = Path(__file__).resolve().parent.parent
folder = root / "out/cost"
scenes = {"couplet": {}, "prism": {"broken": 0}, "broken": {"broken": 1}, "freed": {"broken": 2}}
allSizes, small = "3e-3,2e-3,1e-3,3e-4,1.1e-4", 3e-3 # [m]
columns = "build scene contact energy size threads zones points us wall_us ns_zone ns_point start_s setup_s bytes_zone of_other of_first".split()


def measure(checkout, threads, **wish):
	"""One run of the scene with the plugin of a checkout; None if it is too old for it. Without a checkout: of YADE itself, with nothing to do."""
	own = dict(PYTHONPATH=str(checkout / "py"), YADEBLOCKS_PLUGIN=str(checkout / "build/libyadeblocks.so")) if checkout else {}
	script = root / "scripts/laboratory" / ("stepscene.py" if checkout else "emptyscene.py")
	# BEGUN is on the clock of the whole machine; spinning as in scripts/run.sh
	environment = dict(os.environ, **own, COST=json.dumps(wish), GOMP_SPINCOUNT="20000", BEGUN=str(time.monotonic()))
	run = subprocess.run(["yade", "-n", "-x", "-j", str(threads), str(script)], env=environment, capture_output=True, text=True)
	lines = [line for line in run.stdout.splitlines() if line.startswith("COST ")]
	if not lines: raise SystemExit(f"cost: the run with {checkout or 'YADE alone'} failed, {wish}:\n{run.stdout[-1500:]}{run.stderr[-1500:]}")
	return json.loads(lines[0][5:])


def cost(run, threads):
	"""CPU time of a step on one thread, wall time on several [us]."""
	return run["us" if threads == 1 else "wall_us"]


def medians(turns):
	"""A row for every build and number of threads, of {(build, threads): a run every turn}."""
	rows, first = [], next(iter(turns))[1]
	ratio = lambda mine, others: statistics.median(a / b for a, b in zip(mine, others))
	for (build, threads), runs in turns.items():
		if None in runs: continue
		row = dict(build=build, threads=threads, **{key: statistics.median(run[key] for run in runs) for key in runs[0]})
		row.update(ns_zone=1e3 * cost(row, threads) / row["zones"], ns_point=1e3 * cost(row, threads) / row["points"])
		others = turns.get(("other", threads), [None])
		if build == "this" and None not in others:
			row["of_other"] = ratio([cost(run, threads) for run in runs], [cost(run, threads) for run in others])
		if threads != first: row["of_first"] = ratio([run["wall_us"] for run in runs], [run["wall_us"] for run in turns[build, first]])
		rows.append(row)
	return rows


def startSeconds(builds, turns):
	"""A row for YADE and every build: from the command to the end of the first step."""
	runs = {"yade": [], **{build: [] for build in builds}}
	measure(None, 1) # the first one reads YADE from the disk
	for _ in range(turns):
		for build in runs:
			runs[build].append(measure(builds.get(build), 1, size=small, contact=False, energy=False))
	median = lambda build: statistics.median(run["start_s"] for run in runs[build])
	return [dict(build=build, scene="start", size=small, start_s=median(build)) for build in runs]


def show(row):
	ratios = "".join(f"{row[key]:9.2f}" if key in row else "        -" for key in ("of_other", "of_first"))
	print(
		f"{row['build']:6}{row['scene']:8}{row['contact']:>8}{row['energy']:>7}{row['threads']:8}{row['zones']:9.0f}{row['points']:9.0f}"
		f"{row['us']:10.1f}{row['wall_us']:10.1f}{row['ns_zone']:9.1f}{row['ns_point']:10.1f}{row['setup_s']:10.3f}{row['bytes_zone']:8.0f}{ratios}",
		flush=True
	)


def keep(rows):
	with open(folder / "cost.csv", "w", newline="") as file:
		writer = csv.DictWriter(file, columns)
		writer.writeheader()
		writer.writerows(rows)


def numbers(keys, key, kind):
	try:
		found = [kind(word) for word in keys[key].split(",")]
	except ValueError:
		found = [0]
	if not all(0 < number < float("inf") for number in found):
		raise SystemExit(f"cost: {key} must be {'whole ' if kind is int else ''}numbers > 0, got '{keys[key]}'")
	return found


def main(arguments):
	keys = dict(sizes="3e-3,2e-3,1e-3", turns="3", threads="1", other="")
	for argument in arguments:
		key, sign, value = argument.partition("=")
		if not sign or key not in keys: raise SystemExit(f"cost: '{argument}' is not KEY=VALUE with one of the keys {' '.join(keys)}")
		keys[key] = value
	if keys["sizes"] == "all": keys["sizes"] = allSizes
	sizes, threads, turns = numbers(keys, "sizes", float), numbers(keys, "threads", int), numbers(keys, "turns", int)[0]
	builds = {"this": root, **({"other": Path(keys["other"]).resolve()} if keys["other"] else {})}
	folder.mkdir(parents=True, exist_ok=True)
	rows = startSeconds(builds, turns)
	print("start: seconds from the command to the end of the first step: " + ", ".join(f"{row['build']} {row['start_s']:.2f}" for row in rows))
	print("build scene    contact energy threads    zones   points    CPU us   wall us  ns/zone  ns/point  set-up s  B/zone of other of first")
	for size, (name, wish), contact, energy in product(sizes, scenes.items(), (False, True), (False, True)):
		if "broken" in wish and size < 1e-3: continue # a prism has six times the zones of a couplet
		if name == "freed" and not contact: continue
		runs = {(build, count): [] for build in builds for count in threads}
		for _ in range(turns):
			for build, count in runs:
				runs[build, count].append(measure(builds[build], count, size=size, contact=contact, energy=energy, **wish))
		for row in medians(runs):
			row.update(scene=name, contact="on" if contact else "off", energy="on" if energy else "off", size=size)
			show(row)
			rows.append(row)
		keep(rows)
	draw([row for row in rows if row["scene"] != "start"], threads)


def draw(rows, threads):
	"""Cost over size, a panel for every number of threads: scenes by colour, features by line, builds by mark."""
	import matplotlib
	matplotlib.use("Agg")
	import matplotlib.pyplot as plt
	figure, panels = plt.subplots(1, len(threads), figsize=(1 + 5 * len(threads), 5), sharey=True, squeeze=False)
	colours, lines = dict(zip(scenes, ("C0", "C2", "C3"))), {("off", "off"): "-", ("on", "off"): "--", ("off", "on"): ":", ("on", "on"): "-."}
	for axes, count in zip(panels[0], threads):
		for build, (name, colour), (features, line) in product(("this", "other"), colours.items(), lines.items()):
			some = [
				row for row in rows
				if (row["build"], row["threads"], row["scene"], row["contact"], row["energy"]) == (build, count, name, *features)
			]
			if not some: continue
			what = [name, *(word for word, state in zip(("contact", "energy"), features) if state == "on")]
			axes.loglog([row["zones"] for row in some], [row["ns_zone"] for row in some], line, color=colour,
					marker="o" if build == "this" else "s", markerfacecolor=colour if build == "this" else "none",
					label=" + ".join(what) + ("" if build == "this" else ", other"))
		axes.set_xlabel("zones")
		axes.set_title("one thread, CPU time" if count == 1 else f"{count} threads, wall time")
		axes.grid(True, which="both", alpha=0.3)
	panels[0][0].set_ylabel("cost of a step [ns a zone]")
	panels[0][-1].legend(loc="upper left", bbox_to_anchor=(1.02, 1)) # beside the curves
	figure.savefig(folder / "cost.png", dpi=120, bbox_inches="tight")


main(sys.argv[1:])
