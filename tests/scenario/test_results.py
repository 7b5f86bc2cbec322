# yade-blocks, GPL-2.0-or-later
"""What a scenario is told and what it leaves behind: parameters, result.json, curve.csv, pictures, ParaView files, progress.

Only one test needs YADE: the model is a fake of three blocks in a column (a rigid platen, a unit of 3 x 1 mm, mortar) with
two joints, whose numbers are all different.
"""
import io
import json
import math
import os
import shutil
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from xml.etree import ElementTree

import numpy as np
import pytest

from yadeblocks import export, pictures, progress, results, scenario, snapshot
from yadeblocks.pictures import colours, cracks, view

package = Path(progress.__file__).parent


def column():
	"""Blocks 0 mortar (bottom), 1 unit, 2 platen without zones; mm-sized rectangles of width 3; joints 0-1 and 1-2."""
	corners = np.array([(0, 0), (3, 0), (3, 1), (0, 1)], float)
	reference = 1e-3 * np.vstack([corners + (0, i) for i in range(3)])
	edges = np.array([(4 * b + i, 4 * b + (i + 1) % 4) for b in range(3) for i in range(4)], np.int32)
	zones = np.array([(0, 1, 2), (0, 2, 3), (4, 5, 6), (4, 6, 7)], np.int32)
	position = reference.copy()
	position[4:] += (1e-6, 2e-6) # unit and platen have moved away from the mortar
	stress = np.array([(5., 1., 0.), (1., 2., 3.), (0., 0., 0.), (-4., -4., 0.)])
	return SimpleNamespace(
		thickness=0.05, reference=reference, position=position, velocity=np.full((12, 2),
												(0.1, 0.2)), zoneNodes=zones, firstNode=np.array([0, 4, 8, 12]),
		firstZone=np.array([0, 2, 4, 4]), firstEdge=np.array([0, 4, 8, 12]), blockMaterial=np.array([0, 1, 2], np.int32), materialLabels=[
			"mortar", "unit", "platen"
		], edgeNodes=edges, segmentNodes=np.array([(2, 3, 4, 5), (6, 7, 8, 9)], np.int32), segmentBlocks=np.array([(0, 1), (1, 2)], np.int32),
		segmentParameters=np.array([(0., 1., 1., 0.), (0., 1 / 3, 1., 2 / 3)]), segmentArea=np.array([75e-6, 25e-6]), pointOpening=np.array([
			1., 2., 3., 4.
		]), pointSlip=np.array([5., 6., 7., 8.]), pointSigma=np.array([9., 10., 11., 12.]), pointTau=np.array([13., 14., 15., 16.]),
		pointStatus=np.array([1, 2, 3, 3], np.uint8), pointDamage=np.array([1., 1., 0., 0.]), zoneStress=lambda: stress, cornerTriangles={
			2: np.array([(8, 9, 10), (8, 10, 11)], np.int32)
		}.get, planeStress=False, poisson=np.array([0.2, 0.3, 0.1]), normal=np.array([(0., 1.), (0.6, 0.8)]), removedBlocks=np.zeros(0, int)
	)


# ---- parameters

defaults = {**scenario.commonParameters(size=3.5e-3), "case": "TT1", "sigma": 1e5, "energy": False}
allowed = {"case": ("TT1", "TT2"), "sigma": scenario.notNegative}


def parsed(*words):
	return scenario.parse(words, defaults, allowed, "shear")


def test_parametersTakeTheTypesOfTheirDefaults():
	p = parsed("seed=7", "steps=4e4", "sigma=5e5", "case=TT2", "energy=true", "seeds=3", "tag=a=1")
	assert (p.seed, p.steps, p.sigma, p.case, p.energy) == (7, 40000, 5e5, "TT2", True)
	assert type(p.steps) is int and p.size == 3.5e-3 and p.plane == "strain"
	assert p.seedList == [7, 8, 9]
	assert p.folder == Path("out/shear-a=1") and parsed().folder == Path("out/shear")
	assert list(p.asDict()) == [key for key in defaults if key not in ("checkpoint", "resume")] # which change no result
	assert parsed("case='TT2'").case == "TT2" # as tables of yade-batch quote


@pytest.mark.parametrize(
	"word, line", [
		("lloid=3", "shear has no parameter lloid (did you mean lloyd?); known: seed seeds"),
		("seed", "shear: arguments must have the form key=value, got seed"),
		("seed=1.5", "shear.seed must be a whole number, got 1.5"),
		("seed=nan", "shear.seed must be a whole number, got nan"),
		("size=two", "shear.size must be a number, got two"),
		("size=nan", "shear.size must be a number, got nan"),
		("size=inf", "shear.size must be positive, got inf"),
		("size=-1e-3", "shear.size must be positive, got -0.001"),
		("seeds=0", "shear.seeds must be at least 1, got 0"),
		("alpha=1", "shear.alpha must lie in [0, 1), got 1.0"),
		("sigma=-1", "shear.sigma must not be negative, got -1.0"),
		("case=TT9", "shear.case must be one of TT1, TT2, got 'TT9'"),
		("plane=stres", "shear.plane must be one of strain, stress, got 'stres'"),
		("energy=maybe", "shear.energy must be true or false, got maybe"),
		("tag=../x", "shear.tag must consist of letters"),
	]
)
def test_badInputIsRefusedInOneLine(word, line):
	with pytest.raises(scenario.ParameterError) as error:
		parsed(word)
	assert str(error.value).startswith(line) and "\n" not in str(error.value)


def test_contradictionsAreRefused():
	with pytest.raises(scenario.ParameterError, match="seed must be given once"):
		parsed("seed=1", "seed=2")
	with pytest.raises(scenario.ParameterError, match="alpha must only be given with damping=local, got damping=none"):
		parsed("alpha=0.5", "damping=none")
	with pytest.raises(TypeError, match="not a parameter common"):
		scenario.commonParameters(sizes=1)


def test_commandLine(monkeypatch, capsys):
	monkeypatch.setattr(sys, "argv", ["scripts/shear.py", "sigma=-1"])
	with pytest.raises(SystemExit) as end:
		scenario.parameters(defaults, allowed)
	assert end.value.code == 2 and capsys.readouterr().err == "shear.sigma must not be negative, got -1.0\n"
	monkeypatch.setattr(sys, "argv", ["scripts/shear.py", "help"])
	with pytest.raises(SystemExit) as end:
		scenario.parameters(defaults, allowed)
	assert end.value.code == 0 and "case=TT1" in capsys.readouterr().out


@pytest.mark.skipif(not shutil.which("yade"), reason="needs YADE")
def test_parametersUnderYade(tmp_path):
	"""Script arguments, exit code and threads as YADE has them, and a table line as yade-batch passes it on."""
	(tmp_path / "shear.py").write_text(
		"""if True:
		from yadeblocks import scenario
		p = scenario.parameters({**scenario.commonParameters(), "case": "TT1"}, {"case": ("TT1", "TT2")})
		scenario.waitIfBatch()
		print(p.scenario, p.folder, p.case, p.seed, p.alpha, p.threads)"""
	)
	(tmp_path / "table").write_text("case seed alpha !THREADS\nTT2 3 * 1\n'TT1' 4 0.5 1\n")

	def yade(*words, batch=""):
		run = subprocess.run(["yade", "-n", "-x", *words], cwd=tmp_path, env={**os.environ, "YADE_BATCH": batch}, capture_output=True, text=True)
		return run.returncode, run.stdout.splitlines()[-1], run.stderr.splitlines()[-1]

	assert yade("-j2", "shear.py", "case=TT2", "seed=5")[:2] == (0, "shear out/shear TT2 5 0.3 2")
	assert yade("shear.py", "threads=2")[::2] == (2, "shear.threads must be what YADE was started with (yade -j2), got 2 with -j1")
	assert yade("shear.py", batch="table:2")[:2] == (0, "shear out/shear-case=TT2,seed=3,alpha=_,THREADS=1 TT2 3 0.3 1")
	assert yade("shear.py", batch="table:3")[:2] == (0, "shear out/shear-case=TT1,seed=4,alpha=0.5,THREADS=1 TT1 4 0.5 1")
	assert yade("shear.py", batch="table:9")[::2] == (2, "YADE_BATCH must name a line with parameters, got table:9")


# ---- results


def test_crackCountsByPairAndMode():
	model = column()
	assert results.Cracks(model).counts() == {"unit-mortar": {"tension": 1, "shear": 1}} # unit-platen was never bonded
	model.pointStatus[:] = 0, 2, 2, 0
	assert results.Cracks(model).counts() == {"platen-unit": {"tension": 0, "shear": 1}, "unit-mortar": {"tension": 0, "shear": 1}}


def test_cracksByAreaPlaceAndDirection():
	model = column() # areas of the points: 75, 75 between mortar and unit, 25, 25 between unit and platen
	model.contactPositions = lambda: np.array([(1., 2.), (3., 4.), (5., 6.), (7., 8.)])
	model.pointStatus = np.array([0, 0, 0, 0], np.uint8)
	model.reference[7] += (-2.9e-3, 5e-3) # the unit's upper edge, from node 6 to 7, now is steep: 5 mm up on 5.9 mm, 40 degrees
	cracks = results.Cracks(model)
	assert cracks.look() == 0 and cracks.first[1] == "" and math.isnan(cracks.first[0][0])
	assert math.isnan(cracks.share("unit-mortar")) and math.isnan(cracks.steepShare("unit-mortar"))
	model.pointStatus[:] = 0, 2, 1, 0
	assert cracks.look() == 2 and cracks.first == ((3., 4.), "unit-mortar")
	model.segmentArea[:] = 0 # released: areas count as they were bonded
	assert cracks.share("unit-mortar") == pytest.approx(0.75) and cracks.share("platen-unit") == pytest.approx(0.25)
	assert cracks.steepShare("platen-unit") == 0 # 40 degrees are less than 60
	model.reference[7] += (2.9e-3, 5e-3) # 10 mm up on 3 mm: 73 degrees
	again = results.Cracks(model)
	again.areas = cracks.areas
	assert again.steepShare("platen-unit") == 1 and again.steepShare("unit-mortar") == 0
	model.pointStatus[0] = 1 # what was first stays so
	assert cracks.look() == 3 and cracks.first[0] == (3., 4.)


def measured(p, peaks):
	found = results.Results(p)
	for seed, peak in zip(p.seedList, peaks):
		with found.run(seed) as run:
			with run.stepping():
				sum(range(200000)) # steps cost CPU time
			run.add("peak", "MPa", peak, expected=0.4, source="a book")
			run.add("stiffness", "N/mm3", np.float32(50))
			run.curve(displacement_mm=[0, 0.01], stress_MPa=[0, peak]) # rising to the end
			run.model(column(), steps=1000 * seed, ns_per_zone=5.)
			run.quality(unbalanced_ratio_max=1e-3 * seed, half_rate_change=-0.02 / seed)
	return found


def test_resultOfOneSeed(tmp_path, monkeypatch, capsys):
	monkeypatch.chdir(tmp_path)
	folder = measured(parsed("seed=3", "tag=x"), [0.5]).write()
	assert folder == Path("out/shear-x")
	result = json.loads((folder / "result.json").read_text())
	assert list(result) == ["scenario", "parameters", "seed", "complete", "quantities", "cost", "quality"]
	assert result["scenario"] == "shear" and result["seed"] == 3 and result["parameters"]["case"] == "TT1"
	assert result["quantities"][0] == {"name": "peak", "unit": "MPa", "measured": 0.5, "expected": 0.4, "source": "a book", "error": pytest.approx(0.25)}
	assert result["quantities"][1] == {"name": "stiffness", "unit": "N/mm3", "measured": 50, "expected": None, "source": None, "error": None}
	assert [q["name"] for q in result["quantities"][2:]] == ["cracks_unit-mortar_tension", "cracks_unit-mortar_shear"]
	assert result["quality"] == {"unbalanced_ratio_max": 0.003, "half_rate_change": pytest.approx(-0.02 / 3), "energy_error": None, "without_peak": [3]}
	cost = result["cost"]
	assert set(cost) == set("cpu_s wall_s steps us_per_step blocks nodes zones contacts peak_rss_mb threads ns_per_zone".split())
	assert (cost["steps"], cost["blocks"], cost["nodes"], cost["zones"], cost["contacts"], cost["threads"]) == (3000, 3, 12, 4, 4, 1)
	assert 0 < cost["us_per_step"] * cost["steps"] <= 1e6 * cost["cpu_s"] # stepping is a part of the run
	printed = capsys.readouterr().out
	assert "+25.0 %" in printed and "a book" in printed and "no peak in seed 3" in printed


def test_resultOfSeveralSeeds(tmp_path, monkeypatch, capsys):
	monkeypatch.chdir(tmp_path)
	found = measured(parsed("seed=2", "seeds=3"), [0.3, 0.4, 0.65])
	# mean 0.45; deviations -0.15, -0.05, 0.2: sample variance (0.0225 + 0.0025 + 0.04) / 2
	assert found["peak"].measured == pytest.approx(0.45) and found["peak"].scatter == pytest.approx(math.sqrt(0.0325))
	assert found["peak"].error == pytest.approx(0.125)
	result = json.loads((found.write() / "result.json").read_text())
	assert result["quantities"][0]["scatter"] == pytest.approx(math.sqrt(0.0325)) and result["cost"]["steps"] == 2000
	assert result["quality"]["half_rate_change"] == pytest.approx(-0.02 * (1 / 2 + 1 / 3 + 1 / 4) / 3
									) and result["quality"]["unbalanced_ratio_max"] == 0.004 # the mean; the worst of three
	assert "0.45 ± 0.18" in capsys.readouterr().out

	import pandas
	curve = pandas.read_csv("out/shear/curve.csv")
	assert list(curve) == ["seed", "displacement_mm", "stress_MPa"] and list(curve.seed) == [2, 2, 3, 3, 4, 4]
	assert list(curve.stress_MPa) == [0, 0.3, 0, 0.4, 0, 0.65]


@pytest.mark.parametrize(
	"stress, peak", [([0, 1, 0.94], True), ([0, 1, 0.96], False), ([0, 1, 0.5, 0.99], True), ([0, 0.9, 0.5, 1], False), ([0], False),
				([math.nan, 1, 0.5], True)]
)
def test_aPeakIsWhatStressFallsFrom(stress, peak):
	run = results.Run(1)
	run.curve(displacement_mm=list(range(len(stress))), stress_MPa=stress)
	assert run.hasPeak is peak
	run.curve(displacement_mm=[0.0, 1.0]) # no stress, no judgement
	assert run.hasPeak is None


def test_whatIsNotANumberBecomesNull(tmp_path, monkeypatch):
	monkeypatch.chdir(tmp_path)
	found = measured(parsed("seeds=2"), [0.4, math.nan])
	text = (found.write() / "result.json").read_text()
	peak = json.loads(text, parse_constant=pytest.fail)["quantities"][0]
	assert (peak["measured"], peak["scatter"], peak["error"], peak["expected"]) == (None, None, None, 0.4)
	assert results.jsonable({"a": np.int32(3), "b": [np.inf, np.bool_(True)], "c": np.array([1.5])}) == {"a": 3, "b": [None, True], "c": [1.5]}


def test_runsMustAgree():
	found = results.Results(parsed("seeds=2"))
	for expected in (1, 2):
		with found.run(1) as run:
			run.add("peak", "MPa", 1, expected)
			with pytest.raises(ValueError, match="added once"):
				run.add("peak", "MPa", 2)
	with pytest.raises(ValueError, match="one unit, expected value"):
		found.quantities


# ---- geometry, ParaView


def test_contactLinesCoverTheirSegment():
	model = column()
	lines = export.contactLines(model, model.reference)
	# joint 0-1: y = 1 mm, from x = 3 to 0; joint 1-2: y = 2 mm, from x = 3 to 2
	assert lines == pytest.approx(1e-3 * np.array([[(3, 1), (1.5, 1)], [(0, 1), (1.5, 1)], [(3, 2), (2.5, 2)], [(2, 2), (2.5, 2)]]))
	moved = export.contactLines(model, model.position)
	assert moved - lines == pytest.approx(np.repeat([(0.5e-6, 1e-6), (1e-6, 2e-6)], 4, axis=0).reshape(4, 2, 2)) # midway between the hosts


def test_outlinesWithHoles():
	model = SimpleNamespace(firstEdge=[0, 7, 10], edgeNodes=np.array([(0, 1), (5, 4), (1, 2), (2, 3), (4, 6), (3, 0), (6, 5), (7, 8), (8, 9), (9, 7)]))
	cyclic = lambda ring: tuple(np.roll(ring, -int(np.argmin(ring))))
	assert [sorted(map(cyclic, rings)) for rings in export.blockOutlines(model)] == [[(0, 1, 2, 3), (4, 6, 5)], [(7, 8, 9)]]


def readBack(path):
	"""The mesh, and its data over all cells."""
	import meshio
	mesh = meshio.read(path)
	return mesh, {name: np.concatenate(parts) for name, parts in mesh.cell_data.items()}


def test_exportReadsBack(tmp_path):
	model = column()
	blocks = export.BlocksExport(tmp_path / "out")
	for time in (0, 0.1):
		blocks.write(model, time)
		for name in ("blocks", "joints"): # valid after every write, with relative paths
			steps = ElementTree.parse(tmp_path / "out" / f"{name}.pvd").getroot().findall("Collection/DataSet")
			assert float(steps[-1].get("timestep")) == time
			assert all((tmp_path / "out" / step.get("file")).exists() for step in steps)
			ElementTree.parse(tmp_path / "out" / steps[-1].get("file"))
	assert len(steps) == 2

	mesh, cells = readBack(tmp_path / "out" / "blocks_0001.vtu")
	assert [(block.type, len(block.data)) for block in mesh.cells] == [("triangle", 6)] # four zones, two of the platen, which has none
	assert mesh.points[4] == pytest.approx((1e-6, 1e-3 + 2e-6, 0))
	assert list(mesh.cells[0].data[3]) == [4, 6, 7] and mesh.cells[0].data[4:].tolist() == [[8, 9, 10], [8, 10, 11]]
	points = mesh.point_data
	assert points["displacement"][3] == pytest.approx([0, 0, 0]) and points["displacement"][5] == pytest.approx([1e-6, 2e-6, 0])
	assert points["velocity"][0] == pytest.approx([0.1, 0.2, 0])
	assert list(cells["block"]) == [0, 0, 1, 1, 2, 2] and list(cells["material"]) == [0, 0, 1, 1, 2, 2]
	assert np.column_stack([cells[name] for name in ("sxx", "syy", "sxy")]) == pytest.approx(np.vstack([model.zoneStress(), np.zeros((2, 3))]))
	# Mohr's circle of (1, 2, 3): centre 1.5, radius sqrt(0.25 + 9)
	assert np.column_stack([cells["s1"], cells["s2"]])[:2] == pytest.approx(np.array([(5, 1), (1.5 + math.sqrt(9.25), 1.5 - math.sqrt(9.25))]))

	# plane strain: szz = nu (sxx + syy); von Mises by hand, for (5, 1, 0, 1.2): sqrt((16 + 0.04 + 14.44) / 2)
	assert list(cells["szz"]) == pytest.approx([1.2, 0.6, 0, -2.4, 0, 0]) and cells["vonMises"][0] == pytest.approx(math.sqrt(15.24))
	assert cells["vonMises"][1] == pytest.approx(math.sqrt((1 + 1.4**2 + 0.4**2) / 2 + 27)) # (1, 2, 3, 0.6)

	mesh, cells = readBack(tmp_path / "out" / "joints_0001.vtu")
	assert [(block.type, len(block.data)) for block in mesh.cells] == [("line", 4)]
	assert mesh.points[mesh.cells[0].data[1]] == pytest.approx(np.array([(0.5e-6, 1.001e-3, 0), (1.5e-3 + 0.5e-6, 1.001e-3, 0)]))
	for name in ("Opening", "Slip", "Sigma", "Tau", "Status"):
		assert list(cells[name.lower()]) == list(getattr(model, "point" + name))
	assert list(cells["firstBlock"]) == [0, 0, 1, 1] and list(cells["secondBlock"]) == [1, 1, 2, 2]
	assert list(cells["area"]) == [75e-6, 75e-6, 25e-6, 25e-6] and list(cells["damage"]) == [1, 1, 0, 0]
	assert cells["normal"][0] == pytest.approx([0, 1, 0]) and cells["normal"][3] == pytest.approx([0.6, 0.8, 0])


def test_removedBlocksAreInNoFile(tmp_path):
	"""Block 0 has been removed: its two zones, its four grid points and its joint are not in the files; in those of the untouched model they are."""
	model = column()
	model.removedBlocks = np.array([0])
	export.writeStates(tmp_path, export.State(model, 0, untouched=True), export.State(model, 1))
	for name, before, after in (("blocks", [0, 0, 1, 1, 2, 2], [1, 1, 2, 2]), ("joints", [0, 0, 1, 1], [1, 1])):
		for number, blocks in enumerate((before, after)):
			mesh, cells = readBack(tmp_path / f"{name}_{number:04}.vtu")
			assert cells["block" if name == "blocks" else "firstBlock"].tolist() == blocks
	mesh, cells = readBack(tmp_path / "blocks_0001.vtu")
	assert mesh.points[:, :2] == pytest.approx(model.position[4:]) and mesh.cells[0].data.min() == 0
	corners = mesh.points[mesh.cells[0].data][0, :, :2]
	assert corners == pytest.approx(model.position[model.zoneNodes[2]]) and cells["sxx"].tolist() == [0, -4, 0, 0]


def test_removedBlocksAreInNoPicture(tmp_path):
	"""The mortar, below, has been removed: nothing has its tone, and its cracks are neither drawn nor counted."""
	import matplotlib.image
	model = column()
	mortar = tuple(int(colours.blockTones["mortar"][i:i + 2], 16) / 255 for i in (1, 3, 5))
	share = lambda path: (np.abs(matplotlib.image.imread(path)[..., :3] - mortar).max(axis=2) < 2e-3).mean()
	assert share(pictures.drawCracks(tmp_path / "before.png", model)) > 0.1
	model.removedBlocks = np.array([0])
	assert share(pictures.drawCracks(tmp_path / "after.png", model)) == 0
	from matplotlib.figure import Figure
	axes = Figure().add_subplot()
	assert not cracks.drawCrackLines(axes, model, model.position) # joint 0-1 is broken, 1-2 never was bonded
	model.removedBlocks = np.array([2])
	assert len(cracks.drawCrackLines(axes, model, model.position)) == 2


def test_exportWithoutJoints(tmp_path):
	"""An empty set of cells is a file that can be read."""
	model = column()
	for name in (
		"segmentNodes", "segmentBlocks", "segmentParameters", "segmentArea", "normal", "pointOpening", "pointSlip", "pointSigma", "pointTau",
		"pointStatus"
	):
		setattr(model, name, getattr(model, name)[:0])
	export.BlocksExport(tmp_path).write(model, 0)
	piece = ElementTree.parse(tmp_path / "joints_0000.vtu").getroot().find("UnstructuredGrid/Piece") # meshio itself cannot read an empty file
	assert piece.attrib == {"NumberOfPoints": "0", "NumberOfCells": "0"}
	arrays = {array.get("Name"): array.attrib for array in piece.iter("DataArray")}
	assert {"Points", "connectivity", "offsets", "types", "opening", "normal", "damage"} <= set(arrays)
	assert arrays["normal"]["NumberOfComponents"] == "3" and arrays["status"]["type"] == "UInt8" and arrays["firstBlock"]["type"] == "Int32"


def test_filmHasThePeakAndItsFrames():
	"""A model that moves and goes on moving: what was taken stays as it was."""
	model = column()
	film = snapshot.Film(model, frames=4)
	for step, stress in enumerate([0, 1, 2, 5, 3, 4, 1]):
		model.position[5] = step
		film.look(step / 6, stress, 0.1 * step)
	assert [round(10 * some.time) for some in film.states()] == [0, 2, 3, 5, 6] and film.peak.time == pytest.approx(0.3)
	assert [some.position[5, 0] for some in film.states()] == [0, 2, 3, 5, 6] and film.peak.zoneStress()[0, 0] == 5
	alone = snapshot.Film(model)
	alone.look(0, 1, 0)
	assert len(alone.states()) == 1
	with pytest.raises(ValueError, match="frames must not be negative"):
		snapshot.Film(model, -1)


def test_exportBeginsAnew(tmp_path):
	for steps in (3, 1):
		blocks = export.BlocksExport(tmp_path)
		for step in range(steps):
			blocks.write(column(), step)
	assert sorted(path.name for path in tmp_path.iterdir()) == [
		f"{name}{end}" for name in ("blocks", "contacts", "joints") for end in (".pvd", "_0000.vtu")
	]


# ---- pictures


def test_chainsJoinWhatMeets():
	points = np.array([(0, 0), (1, 0), (2, 0), (3, 0), (2, 5)])
	lines = points[[(0, 1), (2, 1), (2, 3), (2, 4)]] # a fork at point 2, which no chain passes
	chains = cracks.chains(lines.astype(float), lines)
	assert sorted(len(chain) for chain in chains) == [2, 2, 4] and sum(len(chain) for chain in chains) == 8
	long = max(chains, key=len)[:, 0]
	assert list(long) in ([0, 1, 1, 2], [2, 1, 1, 0])
	ring = points[[(0, 1), (1, 4), (4, 0)]]
	assert [len(chain) for chain in cracks.chains(ring.astype(float), ring)] == [6]


@pytest.mark.parametrize("number, down", [(1, 1), (1.99, 1), (2, 2), (76, 50), (500, 500), (0.0049, 0.002), (99999, 50000)])
def test_roundNumbers(number, down):
	assert view.roundDown(number) == pytest.approx(down)


def test_magnificationShowsDisplacements():
	# a specimen of 1 m: 98 % of the displacements, 1 mm, may become 20 mm; an outlier does not count
	assert view.visible(1, np.array([(0, 1e-3)] * 999 + [(0, 5)])) == 20
	assert view.visible(1, np.zeros((9, 2))) == 1 and view.visible(1, np.ones((9, 2))) == 1


def test_picturesAreDrawn(tmp_path):
	pytest.importorskip("matplotlib")
	import pandas
	curves = pandas.DataFrame(dict(seed=[1, 1, 1, 2, 2, 2], u=[0, 1, 2] * 2, stress=[0, 3, 1, 0, 4, 1.]))
	references = [pictures.Reference("line", 3.5), pictures.Reference("band", (3, 4)), pictures.Reference("curve", [0, 3], [0, 1])]
	drawn = [
		pictures.drawCurve(tmp_path / "curve.png", curves, "u", "stress", references=references),
		pictures.drawCurve(tmp_path / "one.png", curves[:3], "u", "stress", labels=("u [m]", "stress [Pa]")),
		pictures.drawCracks(tmp_path / "cracks.png", column()),
		pictures.drawCracks(tmp_path / "part.png", column(), magnification=10, window=(0, 0, 2e-3, 1e-3)),
	]
	model = column()
	model.pointStatus[:] = 0
	drawn.append(pictures.drawCracks(tmp_path / "none.png", model))
	assert all(path.read_bytes().startswith(b"\x89PNG") and path.stat().st_size > 5000 for path in drawn)


def outsideYade(code):
	"""What a plain Python says that finds neither YADE nor a plugin."""
	environment = {**os.environ, "PYTHONPATH": str(package.parent), "YADE_PREFIX": "/nowhere", "YADEBLOCKS_PLUGIN": "/nowhere.so"}
	return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=environment)


def test_modulesNeedNoYade():
	"""Each module by itself, by either way of importing it; YADE is missed only by those who ask for it."""
	paths = [path.relative_to(package).with_suffix("") for path in package.rglob("[a-z]*.py")]
	paths += [path.relative_to(package).parent for path in package.rglob("*/__init__.py")]
	names = sorted(".".join(path.parts) for path in paths)
	assert {"curves", "results", "results.cracks"} <= set(names)
	within = [("yadeblocks." + name).rpartition(".") for name in names]
	for lines in [f"import yadeblocks.{name}" for name in names], [f"from {parent} import {name}" for parent, _, name in within]:
		code = f"""if True:
			import sys
			for name, line in zip({names}, {lines}):
				exec(line)
				assert 'yade' not in sys.modules and 'yadeblocks.' + name in sys.modules, name
				for ours in [known for known in sys.modules if known.startswith('yadeblocks')]: del sys.modules[ours]"""
		run = outsideYade(code)
		assert run.returncode == 0, run.stderr
	asked = outsideYade("import yadeblocks\nimport yade")
	assert asked.returncode and "yadeblocks needs YADE: there is no /nowhere/lib/*/yade-double/py" in asked.stderr


@pytest.mark.parametrize("name, now", [("jobs", "laboratory.jobs"), ("study", "laboratory.study and yadeblocks.provenance")])
def test_modulesThatHaveMoved(name, now):
	run = outsideYade(f"from yadeblocks import {name}")
	assert run.stderr.splitlines()[-1].startswith(f"ImportError: yadeblocks.{name} is {now} now; ")


def test_nothingHeavyIsImportedEarly():
	"""A scenario that does not draw does not pay for matplotlib, meshio and pandas (0.5 to 1 s each)."""
	modules = "scenario, results, pictures, export, progress, session, engines, recording"
	heavy = '[name for name in ("matplotlib", "meshio", "pandas", "scipy") if name in sys.modules]'
	run = outsideYade(f"from yadeblocks import {modules}\nimport sys; print({heavy})")
	assert run.stdout == "[]\n", run.stderr


# ---- progress


class Clock:
	now = 0.

	def monotonic(self):
		return self.now


def test_progressSpeaksEveryTenSeconds(monkeypatch):
	clock, stream, reports = Clock(), io.StringIO(), []
	monkeypatch.setattr(progress, "time", clock)
	with progress.Progress(1000, lambda: reports.append(1) or "u 1 mm", label="seed 1", stream=stream) as shown:
		for step in range(0, 900, 100): # 2 s per 100 steps
			shown(step)
			clock.now += 2
	assert stream.getvalue() == "seed 1   50 %  step 500  u 1 mm  0:10 left\n" and len(reports) == 1


def test_progressOnATerminal(monkeypatch):
	clock, stream = Clock(), io.StringIO()
	stream.isatty = lambda: True
	monkeypatch.setattr(progress, "time", clock)
	with progress.Progress(10, stream=stream) as shown:
		shown(0)
		clock.now = 3600
		shown(5)
	assert stream.getvalue() == "\r 50 %  step 5  1:00:00 left\x1b[K" + "\r\x1b[K"


def test_loadingLine():
	assert progress.loadingLine(1.5e-5, 3.2e5, column()) == "u 0.0150 mm  stress 0.320 MPa  broken 2"
