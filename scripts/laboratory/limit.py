# yade-blocks, GPL-2.0-or-later
"""What slow time steps come down to, beside the exact path: the peak and the first crack of tension or shear, seed by seed.

	scripts/study.sh limit tension|shear [slow=N] [seeds=N] [key=value[,value ...] ...]

The exact peak is that of cascades (release=cascade): steps, too, hold a displacement while cracks run. The slow run has `slow` steps, alpha 0.95, and no
general contact. What it is known to is what it shows itself: the sum of its change from half as many steps (rate) and of its change from alpha 0.8 (inertia).
A peak by events agrees if it lies within that. A first crack agrees if it is at the same contact point.
Results: study.json, limit.md, limit.csv.
"""
import pandas

from yadeblocks import scenario

from .command import StudyError, good, product, reasons
from .study import settingsKey

usual = {"tension": 1280000, "shear": 1536000} #: Steps for the scenario's whole stroke.
runs = { #: What is run: its settings over the study's.
	"events": lambda steps: {"solver": "events", "release": "cascade"},
	"slow": lambda steps: {"steps": steps, "alpha": 0.95, "safety": 0.65},
	"half": lambda steps: {"steps": steps // 2, "alpha": 0.95, "safety": 0.65},
	"damped less": lambda steps: {"steps": steps, "alpha": 0.8, "safety": 0.65},
}
keys = {"slow": 0}
rules = {"slow": scenario.notNegative}
meanings = {"slow": "steps of the slow run over the whole stroke; 0: 1,280,000 in tension, 1,536,000 in shear"}


def study(command):
	p = command.p
	if command.stem not in usual: raise StudyError(f"study: limit knows tension and shear, got {command.stem}")
	base = {**command.settings, **({"afterPeak": False, "contact": False, "sheets": False} if command.stem == "shear" else {})}
	points, steps = product(base), p.slow or usual[command.stem]
	asked = [{**point, **settings(steps)} for point in points for settings in runs.values()]
	measured = command.measure(asked, range(p.seed, p.seed + p.seeds))
	why, each = reasons(record for records in measured for record in records.values()), iter(measured)
	varied = [key for key in base if len({str(point[key]) for point in points}) > 1]
	rows = []
	for point in points:
		found = {name: next(each) for name in runs}
		label = settingsKey({key: point[key] for key in varied}) or command.stem
		rows += [
			row(label, seed, {name: records[seed]["reported"] for name, records in found.items()}) for seed in found["events"]
			if all(seed in good(records) for records in found.values())
		]
	if not rows: raise StudyError("study: no seed has all its runs: " + "; ".join(why))
	frame = pandas.DataFrame(rows)
	frame.to_csv(command.folder / "limit.csv", index=False, float_format="%.6g")
	text = markdown(rows, why)
	(command.folder / "limit.md").write_text(text)
	command.write(slow=steps, rows=rows, failed=why)
	print(text)


def row(label, seed, reported):
	"""One seed's comparison: peaks, what the slow run is known to, whether events lie within it, and the first cracks."""
	peak = {name: next(value for quantity, value in values.items() if quantity.startswith("peak_")) for name, values in reported.items()}
	slow, events = peak["slow"], peak["events"]
	rate, inertia = slow / peak["half"] - 1, slow / peak["damped less"] - 1
	known = abs(rate) + abs(inertia)
	first = {name: (values["first_crack_point"], values["first_crack_stress"]) for name, values in reported.items()}
	return {
		"point": label, "seed": seed, "events": events, "slow": slow, "off": slow / events - 1, "rate": rate, "inertia": inertia, "known_to": known,
		"agrees": abs(slow - events) <= known * slow, "same_first_crack": first["slow"][0] == first["events"][0],
		"first_crack_off": first["slow"][1] / first["events"][1] - 1
	}


def markdown(rows, why):
	lines = [
		"| | seed | events | slow steps | off [%] | from rate [%] | from inertia [%] | known to [%] | agrees | same first crack | its stress off [%] |",
		"|---|---|---|---|---|---|---|---|---|---|---|"
	]
	for r in rows:
		percent = [f"{100 * r[name]:+.2f}" for name in ("off", "rate", "inertia", "first_crack_off")]
		agrees, first = ("yes" if r[name] else "no" for name in ("agrees", "same_first_crack"))
		cells = [
			r["point"],
			str(r["seed"]), f"{r['events']:.5f}", f"{r['slow']:.5f}", *percent[:3], f"{100 * r['known_to']:.2f}", agrees, first, percent[3]
		]
		lines.append(f"| {' | '.join(cells)} |")
	lines += ["", f"- Peaks agree in {sum(r['agrees'] for r in rows)} of {len(rows)}, first cracks in {sum(r['same_first_crack'] for r in rows)}."
			] + [f"- {count} failed: {reason}" for reason, count in why.items()]
	return "\n".join(lines) + "\n"
