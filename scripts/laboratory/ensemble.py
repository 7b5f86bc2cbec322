# yade-blocks, GPL-2.0-or-later
"""A scenario over seeds, and over tables of parameters: how its quantities scatter.

	scripts/study.sh ensemble NAME [seeds=N] [until=PERCENT] [table=FILE] [quantities=a,b] [key=value[,value ...] ...]

Each quantity gets its mean, the scatter, the interval that holds the mean with 95 % confidence, and the characteristic value (5 % fractile, EN 1990 D7.2).
until=2 stops once this interval is within 2 % of the mean for every quantity asked for, but not below five seeds and not above `seeds`. Who stops so looks
several times, and the interval then holds the mean a little less often than it says.
A key with several values, or a line of the table, gives a point of its own. Results: study.json, table.md, table.csv, runs.csv, band.csv, ensemble.png.
"""
import math

import pandas

from yadeblocks import scenario

from . import studypicture
from .command import demandResults, good, listed, product, quantitiesOf, reasons, table
from .statistics import band, summary, valuesNeeded
from .study import settingsKey

keys = {"seeds": 30, "until": 0.0, "table": ""}
rules = {"until": scenario.notNegative}
meanings = {
	"seeds": "the most tessellations a point gets", "until": "percent of the mean to which it is to be known; 0: all seeds are run",
	"table": "file of parameters: names in the first line, values below"
}
fewest = 5 #: Seeds before a scatter is believed.


def study(command):
	p = command.p
	points = [{**command.settings, **line} for line in table(p.table)] if p.table else [command.settings]
	points = [point for line in points for point in product(line)]
	wanted = listed(p.quantities)
	measured = [{} for _ in points]
	counts = [min(p.seeds, fewest) if p.until else p.seeds] * len(points)
	while True:
		waiting = [i for i, count in enumerate(counts) if len(measured[i]) < count]
		if not waiting: break
		for count in sorted({counts[i] for i in waiting}):
			group = [i for i in waiting if counts[i] == count]
			for i, records in zip(group, command.measure([points[i] for i in group], range(p.seed, p.seed + count))):
				measured[i] = records
		demandResults(measured)
		units = quantitiesOf(measured, wanted)
		if p.until: counts = [next_(measured[i], units, p, counts[i]) for i in range(len(points))]
	report(command, points, measured, units)


def next_(records, units, p, count):
	"""How many seeds a point needs: those it has if every mean is known well enough."""
	needed = count
	for name in units:
		known = summary([record["reported"].get(name) for record in good(records).values()])
		if known and known.scatter != 0 and known.halfWidth > p.until / 100: needed = max(needed, valuesNeeded(known, p.until / 100), count + 1)
	return min(needed, p.seeds, 2 * count)


def report(command, points, measured, units):
	rows, runs, bands = [], [], []
	varied = [key for key in points[0] if len({str(point.get(key)) for point in points}) > 1]
	labels = [settingsKey({key: point[key] for key in varied if key in point}) or command.stem for point in points]
	for point, label, records in zip(points, labels, measured):
		fine = good(records)
		for name, unit in units.items():
			found = summary([record["reported"].get(name) for record in fine.values()])
			rows.append({
				"point": label, "quantity": name, "unit": unit, "failed": len(records) - len(fine),
				**(found._asdict() if found else {"n": 0}), "mean_known_to_percent": 100 * found.halfWidth if found else math.inf
			})
		for seed, record in records.items():
			runs.append({
				"point": label, "seed": seed, **record.get("reported", {}), "cpu_s": record.get("cost", {}).get("cpu_s"),
				"failed": record.get("failed"), "command": record["command"]
			})
		curves = [record["curve"] for record in fine.values() if record["curve"]]
		columns = next((record["columns"] for record in fine.values() if record["curve"]), None)
		bands.append((label, columns, band(curves), curves) if curves else None)
	folder = command.folder
	pandas.DataFrame(rows).to_csv(folder / "table.csv", index=False, float_format="%.6g")
	pandas.DataFrame(runs).to_csv(folder / "runs.csv", index=False, float_format="%.8g")
	flat = [pandas.DataFrame({"point": each[0], **each[2]}) for each in bands if each]
	if flat: pandas.concat(flat).to_csv(folder / "band.csv", index=False, float_format="%.6g")
	why = reasons(record for records in measured for record in records.values())
	text = markdown(command, rows, why)
	(folder / "table.md").write_text(text)
	studypicture.drawEnsemble(folder / "ensemble.png", [each for each in bands if each], rows, title=f"{command.stem}: {len(runs)} runs")
	command.write(
		until_percent=command.p.until or None,
		points=[{"label": label, "settings": point, "quantities": {row["quantity"]: row for row in rows if row["point"] == label}}
			for label, point in zip(labels, points)], failed=why
	)
	print(text)


def markdown(command, rows, why):
	lines = [
		f"# {command.stem}", "", "| point | quantity | unit | runs | mean | 95 % interval of the mean | scatter | 5 % fractile | smallest | largest |",
		"|---|---|---|---|---|---|---|---|---|---|"
	]
	for row in rows:
		if not row["n"]:
			lines.append(f"| {row['point']} | {row['quantity']} | {row['unit']} | 0 | | | | | | |")
			continue
		share = 100 * row["scatter"] / abs(row["mean"]) if row["mean"] else math.nan
		lines.append(
			f"| {row['point']} | {row['quantity']} | {row['unit']} | {row['n']} | {row['mean']:.4g} | {row['low']:.4g} to {row['high']:.4g} "
			f"(± {row['mean_known_to_percent']:.1f} %) | {row['scatter']:.3g} ({share:.1f} %) | {row['characteristic']:.4g} | "
			f"{row['smallest']:.4g} | "
			f"{row['largest']:.4g} |"
		)
	lines += [""] + [f"- {count} failed: {reason}" for reason, count in why.items()]
	until = command.p.until
	if until:
		short = [
			f"{row['quantity']} ({row['point']})" for row in rows if row["n"] and row["scatter"] != 0 and not row["mean_known_to_percent"] <= until
		]
		lines.append(
			f"- Means known to {until:g} %, as asked for."
			if not short else f"- Not known to {until:g} % with {command.p.seeds} seeds: {', '.join(short)}."
		)
	return "\n".join(lines) + "\n"
