# yade-blocks, GPL-2.0-or-later
"""What callgrind counted, read and sorted (scripts/price.py). Without callgrind: the profile is written by hand."""
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / 'scripts'))
from laboratory import instructions
from laboratory.features import features, stale

profile = """# callgrind format
version: 1
desc: Timerange: Basic block 0 - 10
desc: Trigger: Client Request: {name}
positions: line
events: Ir
summary: 1170

ob=/lib/plugin.so
fl=ROOT/law.hpp
fn=advance(Joint)
2 100
fi=ROOT/Energy.hpp
7 30
fe=ROOT/law.hpp
3 40
cfi=ROOT/other.hpp
cfn=sqrt
calls=5 12
3 1000

fl=???
fn=0x00000000000012ab
0 1000

totals: 1170
"""


@pytest.fixture
def files(tmp_path):
	(tmp_path / 'law.hpp').write_text('// the law\nsigma = kn * (un - dilation);\ntau = ks * us;\n')
	text = profile.replace('ROOT', str(tmp_path))
	(tmp_path / 'run.1').write_text(text.format(name='bare'))
	(tmp_path / 'run.2').write_text(text.format(name='with energy').replace('\n7 30\n', '\n7 60\n'))
	(tmp_path / 'run.3').write_text(text.replace('desc: Trigger: Client Request: {name}', 'desc: Trigger: Program termination'))
	return tmp_path


def test_ownCostOnly(files):
	"""The inclusive cost of the call (1000) counts where it arises, not where the call stands; the sum is callgrind's own."""
	bare = instructions.readProfiles(files / 'run')['bare']
	assert bare.total == 1170
	assert bare.byFunction() == {'advance(Joint)': 170, '0x00000000000012ab': 1000}
	assert bare.places['advance(Joint)', str(files / 'Energy.hpp'), 7] == 30 # an inlined line belongs to its own file


def test_namedProfilesOnly(files):
	assert set(instructions.readProfiles(files / 'run')) == {'bare', 'with energy'}
	assert instructions.readProfiles(files / 'run')['with energy'].total == 1200


def test_featuresByFileAndLine(files):
	bare, source = instructions.readProfiles(files / 'run')['bare'], instructions.sourceLines(files)
	count = lambda **where: bare.inFeature(instructions.Feature(**where), source)
	assert count(files='Energy') == 30
	assert count(files='Ener') == 0
	assert count(lines='dilation') == 100
	assert count(files='Energy', lines='ks') == 70
	assert count(lines='friction') == 0


def test_featuresAreWhereTheyAreLookedFor():
	"""A file that is renamed would make the price of what is off too small, without a word."""
	assert stale(features, Path(__file__).resolve().parents[2] / 'pkg/blocks') == []


def test_staleIsWhatNobodyHas(files):
	(files / 'Energy.hpp').write_text('kept\n')
	some = {'energy': instructions.Feature('Energy Gone', 'tau|kept|nowhere')}
	assert stale(some, files) == ['energy: Gone', 'energy: kept', 'energy: nowhere'] # 'kept' stands in its own file only


def test_otherFormatsAreRefused():
	with pytest.raises(ValueError, match='positions: line'):
		instructions.parseProfile(['positions: instr line\n'])
