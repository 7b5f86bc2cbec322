# yade-blocks, GPL-2.0-or-later
"""What it costs to go from event to event, beside time steps: scripts/cost.sh events [tension=3e-3,2e-3,1e-3] [shear=3.3e-3,1.7e-3] [seed=1] [steps=true].

Couplets in tension (Table 3 for all joints, Lloyd 0) and in shear (Table 5, 0.5 N/mm2, Lloyd 1), sizes = sqrt(area) [m] of the blocks in the mortar; the
bricks' zones grow with them. Each solver has a process of its own (eventscene.py). `follow` goes on until the force has fallen to half of the peak (in the
snap-backs before it, it falls by less), the steps, which set out at the first crack, to 0.8 of it. Their number is what gives 1 % at the usual sizes (40,000
for 0.03 mm in tension, 48,000 for 1 mm in shear up to the peak at a fifth of that speed), and more for smaller blocks, through which waves take more steps.
CPU seconds are those of `follow`, or of jump and steps; start is that of YADE with building the specimen. MB is the largest memory of the process, of which
YADE itself has 250 or so. steps=false leaves them out: at 148,000 zones (tension=0.3e-3) they take some ten minutes. Leaves out/cost/events.csv and a table in
Markdown on the terminal."""
import csv
import json
import os
import subprocess
import sys
from pathlib import Path

root = Path(__file__).resolve().parents[2]

usual = {"tension": (2e-3 * 1.61, 40000), "shear": (3.5e-3, 48000)} # sqrt(area) of the blocks, steps that give 1 % (README)


def measure(**wish):
	environment = dict(
		os.environ, COST=json.dumps(wish), PYTHONPATH=str(root / "py"), YADEBLOCKS_PLUGIN=str(root / "build/libyadeblocks.so"),
		OMP_WAIT_POLICY="passive"
	)
	run = subprocess.run(["yade", "-n", "-x", "-j", "1", str(root / "scripts/laboratory/eventscene.py")], env=environment, capture_output=True, text=True)
	lines = [line for line in run.stdout.splitlines() if line.startswith("COST ")]
	if not lines: raise SystemExit(f"cost: the run with {wish} failed:\n{run.stdout[-1500:]}{run.stderr[-1500:]}")
	return json.loads(lines[0][5:])


def main(arguments):
	keys = dict(tension="3e-3,2e-3,1e-3", shear="3.3e-3,1.7e-3", seed="1", steps="true")
	for argument in arguments:
		key, sign, value = argument.partition("=")
		if not sign or key not in keys: raise SystemExit(f"cost: '{argument}' is not KEY=VALUE with one of the keys {' '.join(keys)}")
		keys[key] = value
	if keys["steps"] not in ("true", "false"): raise SystemExit(f"cost: steps must be true or false, got {keys['steps']}")
	folder = root / "out/cost"
	folder.mkdir(parents=True, exist_ok=True)
	rows = []
	print(
		"| experiment | zones | points | broken | pieces | CPU s | ms a piece | start s | MB | time steps | CPU s | MB | peak |\n|" + "---|" * 13,
		flush=True
	)
	for experiment in ("tension", "shear"):
		size0, steps0 = usual[experiment]
		for size in map(float, keys[experiment].split(",") if keys[experiment] else ()):
			wish = dict(experiment=experiment, size=size, seed=int(keys["seed"]), steps=1000 * round(steps0 * max(1, size0 / size) / 1000))
			exact = measure(solver="events", **wish)
			slow = measure(solver="steps", **wish) if keys["steps"] == "true" else None
			rows.append(dict(experiment=experiment, size=size, **exact))
			if slow: rows[-1].update({"steps " + name: value for name, value in slow.items() if name not in ("zones", "points")})
			cells = [experiment] + [f"{exact[name]:,}" for name in ("zones", "points", "broken", "count")] + [
				f"{exact['cpu']:.2g}", f"{1e3 * exact['cpu'] / exact['count']:.2g}", f"{exact['start']:.2g}", f"{exact['rss']:.0f}"
			]
			cells += [f"{slow['count']:,}", f"{slow['cpu']:.2g}", f"{slow['rss']:.0f}", f"{100 * (slow['peak'] / exact['peak'] - 1):+.1f} %"
					] if slow else ["", "", "", ""]
			print("| " + " | ".join(cells) + " |", flush=True)
	with open(folder / "events.csv", "w", newline="") as file:
		writer = csv.DictWriter(file, list(dict.fromkeys(key for row in rows for key in row)))
		writer.writeheader()
		writer.writerows(rows)


if __name__ == "__main__":
	main(sys.argv[1:])
