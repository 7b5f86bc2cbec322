# yade-blocks, GPL-2.0-or-later
"""CPU time of a step of the couplet in tension, from 1,300 to 800,000 zones: scripts/cost.sh [sizes=2e-3,1e-3] [turns=3] [threads=1] [other=FOLDER].

A mortar layer of Voronoi blocks (sqrt(area) = sizes [m], Lloyd 2) between two bricks whose zones are four times as large; the load is small, so nothing
breaks. Bare, with general contact, and with energy accounts; set-up seconds and bytes a zone. other=FOLDER: a checkout of this project with its own build/
(say an earlier commit), measured in turn with this one; then ratios are printed. Every number is a median over the turns; one turn takes as many steps as fit
into a second. Leaves out/cost/cost.csv and cost.png."""
import csv
import json
import os
import statistics
import subprocess
import sys
from pathlib import Path

root = Path(__file__).resolve().parent.parent
features = {
	"bare": {}, "contact": {"contact": True}, "energy": {"energy": True}, "prism": {"contact": True, "broken": 0}, "broken": {"contact": True, "broken": 1}
}

scene = r'''
import json, os, resource, sys, time
import numpy as np
import yadeblocks
from yade import *
from yadeblocks.specimen import nodesWhere, rectangle
wish = json.loads(os.environ["COST"])
size, contact, broken = wish["size"], wish.get("contact", False), wish.get("broken")
O.materials.append(BlockMat(label='unit', young=16.7e9, poisson=0.15, density=2000))
O.materials.append(BlockMat(label='mortar', young=2.974e9, poisson=0.2, density=1250))
start, model, length, low, high = time.process_time(), BlockModel(thickness=0.05), 0.1, 0.05, 0.065
if broken is None: # the couplet
	model.addVoronoi(rectangle(0, low, length, high), 'mortar', size=size, lloyd=2, seed=1)
	model.addRegion(rectangle(0, 0, length, low), 'unit', zoneSize=4 * size)
	model.addRegion(rectangle(0, high, length, high + low), 'unit', zoneSize=4 * size)
else: # a prism all of Voronoi blocks
	for k in range(5):
		model.addVoronoi(rectangle(0, 0.023 * k, length, 0.023 * (k + 1)), 'mortar' if k % 2 else 'unit', size=size, lloyd=2, seed=k + 1)
joints = [JointMat(material1=a, material2=b, kn=400e9, ks=200e9, cohesion=0.6e6, tension=0.6e6, frictionAngle=0.66)
          for a, b in (('unit', 'unit'), ('mortar', 'mortar'), ('unit', 'mortar'))]
flat = 'BlockLoop' in globals()
if flat: model.bond(joints)
else: model.bond()
model.drive('bottom', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
model.drive('top', nodesWhere(model, lambda x, y: y > 0.115 - 1e-9), 'y', velocity=-1e-12, rampTime=100)
if broken: # so weak that they break as soon as they feel anything
	model.setJoints(np.arange(0, model.contactCount // 2, 5), tension=1e-12, cohesion=1e-12, frictionAngle=1e-6)
model.insert()
O.dt, O.trackEnergy = 1, wish.get("energy", False)
if flat: O.engines = [BlockLoop(contact=contact), BlockMotion(alpha=0.3)]
else:
	O.engines = ([BlockContacts(), InsertionSortCollider([Bo1_Block_Aabb()], verletDist=0)] if contact else []) + [
		InteractionLoop([Ig2_Block_Block_BlockGeom()], [Ip2_BlockMat_BlockMat_JointPhys(joints=joints)], [Law2_BlockGeom_JointPhys_MohrCoulomb()]),
		BlockTimeStepper(), BlockForces(), BlockIntegrator(alpha=0.3)]
O.run(3000 if broken else 3, True)
setup = time.process_time() - start
def run(steps): # O.run(steps, wait=True) looks every 40 ms only
	cpu, wall = time.process_time(), time.monotonic()
	O.run(steps)
	while O.running: time.sleep(0.01) # looking oftener takes two threads a share of their cores
	return time.process_time() - cpu, time.monotonic() - wall
steps = 10
while (once := run(steps)[1]) < 0.1: steps *= 2
steps = max(steps, int(steps / once * 1))
cpu, wall = run(steps)
share = (model.pointStatus > 0).mean()
assert 0.15 < share < 0.3 if broken else share == 0, share
rss = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
print("COST " + json.dumps(dict(us=1e6 * cpu / steps, wall_us=1e6 * wall / steps, setup_s=setup, zones=model.zoneCount, points=model.contactCount, rss=rss)))
'''


def measure(folder, threads, **wish):
	"""One run of the scene with the plugin of a checkout."""
	environment = dict(
		os.environ,
		COST=json.dumps(wish),
		PYTHONPATH=str(folder / "py"),
		YADEBLOCKS_PLUGIN=str(folder / "build/libyadeblocks.so"),
		GOMP_SPINCOUNT="20000" # as scripts/run.sh
	)
	script = root / "out/cost/scene.py"
	run = subprocess.run(["yade", "-n", "-x", "-j", str(threads), str(script)], env=environment, capture_output=True, text=True)
	lines = [line for line in run.stdout.splitlines() if line.startswith("COST ")]
	if not lines: raise SystemExit(f"cost: the run with {folder} failed:\n{run.stdout[-1500:]}{run.stderr[-1500:]}")
	return json.loads(lines[0][5:])


def main(arguments):
	keys = dict(sizes="3e-3,2e-3,1e-3", turns="3", threads="1", other="")
	for argument in arguments:
		key, sign, value = argument.partition("=")
		if not sign or key not in keys: raise SystemExit(f"cost: '{argument}' is not KEY=VALUE with one of the keys {' '.join(keys)}")
		keys[key] = value
	builds = {"this": root, **({"other": Path(keys["other"]).resolve()} if keys["other"] else {})}
	folder = root / "out/cost"
	folder.mkdir(parents=True, exist_ok=True)
	(folder / "scene.py").write_text(scene)
	rows = []
	for size in map(float, keys["sizes"].split(",")):
		for feature, wish in features.items():
			if "broken" in wish and size < 1e-3: continue # a prism has six times the zones of a couplet
			# before joints had properties of their own, no fifth of them could be weak
			able = {name: checkout for name, checkout in builds.items() if name == "this" or not wish.get("broken")}
			turns = {name: [] for name in able}
			for _ in range(int(keys["turns"])):
				for name, checkout in able.items():
					turns[name].append(measure(checkout, int(keys["threads"]), size=size, **wish))
			for name, runs in turns.items():
				median = {key: statistics.median(run[key] for run in runs) for key in runs[0]}
				rows.append(
					dict(
						build=name, feature=feature, size=size, threads=int(keys["threads"]),
						ns_zone=1e3 * median["us"] / median["zones"], **median
					)
				)
			if len(able) == 2:
				ratios = [a["us"] / b["us"] for a, b in zip(turns["this"], turns["other"])]
				rows[-2]["ratio"] = statistics.median(ratios)
			for row in rows[-len(able):]:
				print(
					f"{row['build']:6} {feature:8} {row['zones']:8.0f} zones {row['us']:10.1f} us a step,"
					f" wall {row['wall_us']:10.1f}, {row['ns_zone']:6.1f} ns a zone, set-up {row['setup_s']:5.2f} s,"
					f" {row['rss'] / row['zones']:8.0f} bytes a zone with YADE's own" +
					(f", {row['ratio']:.2f} of the other" if "ratio" in row else ""), flush=True
				)
	with open(folder / "cost.csv", "w", newline="") as file:
		writer = csv.DictWriter(file, ["build", "feature", "size", "threads", "zones", "points", "us", "wall_us", "ns_zone", "setup_s", "rss", "ratio"])
		writer.writeheader()
		writer.writerows(rows)
	draw(rows, folder / "cost.png")


def draw(rows, path):
	import matplotlib
	matplotlib.use("Agg")
	import matplotlib.pyplot as plt
	figure, axes = plt.subplots(figsize=(7, 5))
	for build in dict.fromkeys(row["build"] for row in rows):
		for feature in features:
			some = [row for row in rows if row["build"] == build and row["feature"] == feature]
			if not some: continue
			axes.loglog([row["zones"] for row in some], [row["ns_zone"] for row in some], "o-" if build == "this" else "s--",
					label=f"{build}: {feature}")
	axes.set_xlabel("zones")
	axes.set_ylabel("CPU time of a step [ns a zone]")
	axes.grid(True, which="both", alpha=0.3)
	axes.legend(loc="upper left", bbox_to_anchor=(1.02, 1)) # beside the curves
	figure.savefig(path, dpi=120, bbox_inches="tight")


main(sys.argv[1:])
