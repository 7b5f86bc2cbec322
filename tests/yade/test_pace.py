# yade-blocks, GPL-2.0-or-later
"""Whether a run is slow enough: strain energy against the accounts, and when the watch speaks."""
import io

import pytest

from scenes import *
from yadeblocks.pace import Pace, strainEnergy
from yadeblocks.progress import loadingLine


@pytest.mark.parametrize('planeStress', [False, True])
def test_strainEnergyIsThatOfTheAccounts(planeStress):
	"""Before anything breaks; the accounts are of the positions before the last motion, as the stresses are."""
	materials()
	model = BlockModel(thickness=0.05, planeStress=planeStress)
	for label, low in (('unit', 0), ('mortar', 0.02)):
		model.addRegion(rectangle(0, low, 0.04, low + 0.02), label, zoneSize=0.02)
	model.bond(strong())
	model.drive('bottom', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
	model.drive('top', nodesWhere(model, lambda x, y: y > 0.04 - 1e-9), 'y', velocity=1e-5)
	model.drive('side', nodesWhere(model, lambda x, y: y > 0.04 - 1e-9), 'x', velocity=2e-5)
	model.insert()
	O.trackEnergy, O.dt, O.engines = True, 1e-4, [BlockLoop(), BlockMotion(alpha=0.3)]
	O.run(2000, True)
	entries = dict(O.energy.items())
	assert entries['blockJoints'] > 0.01 * entries['blockZones'] > 0
	assert strainEnergy(model) == pytest.approx(entries['blockZones'] + entries['blockJoints'], rel=1e-3) # large displacement in the accounts
	known = {}
	assert strainEnergy(model, known) == strainEnergy(model, known) == strainEnergy(model) and set(known) == {'E', 'nu', 'kn', 'ks'}
	stiffer = {**known, 'E': 2 * known['E']}
	assert strainEnergy(model, stiffer) < strainEnergy(model) # what is known belongs to the dictionary that is given


class Fake:
	"""A model of no blocks whose energies are said."""
	kinetic, planeStress, zoneVolume, segmentArea = 0.0, True, np.array([2.0]), np.zeros(0)
	pointSigma = pointTau = np.zeros(0)
	pointStatus = np.zeros(1)
	reference = position = segmentBlocks = materialLabels = () # what makes a model for those who look at arguments

	def kineticEnergy(self):
		return self.kinetic

	def zoneStress(self):
		return np.array([(1.0, 0, 0)]) # energy of 1 J with a modulus of 1

	def unbalancedRatio(self):
		return 0.01


def watched(kinetic=0.0, reaction=100.0, broken=1, looks=12, falling=False):
	"""What a Pace says of looks alike, the reaction rising a little from look to look."""
	model, said, now = Fake(), io.StringIO(), [reaction]
	model.kinetic = kinetic
	pace = Pace(model, lambda: -100.0, lambda: now[0], 'seed 7', said)
	pace._known = dict(E=np.array([1.0]), nu=np.array([0.0]), kn=np.zeros(0), ks=np.zeros(0))
	for look in range(looks):
		now[0] = reaction * (0.9**look if falling else 1 + 1e-3 * look)
		pace(broken)
	return said.getvalue(), pace


def test_saysWhatIsTooFast():
	assert watched()[0] == '' and watched(kinetic=0.049)[0] == '' and watched(reaction=90.1)[0] == ''
	assert watched(kinetic=0.051)[0].startswith('seed 7: kinetic energy is 5.1 % of the strain energy: the loading is too fast')
	said = watched(reaction=80, looks=40)[0]
	assert said.startswith('seed 7: load and reaction are 19.6 % apart: ') and said.count('\n') == 1 # once
	assert 'kinetic energy is 20 %' in watched(kinetic=0.2, reaction=50)[0] and 'and load and reaction are' in watched(kinetic=0.2, reaction=50)[0]


def test_staysSilentBeforeTheFirstCrackAndBehindThePeak():
	assert watched(kinetic=0.5, broken=0)[0] == ''
	assert watched(kinetic=0.5, looks=9)[0] == '' # single looks tell of waves
	assert watched(kinetic=0.5, falling=True)[0] == ''


def test_looksAtTheFirstCrackThoughAWaveCarriedMore():
	"""As a notched beam at 0.5 mm/s did: its supports were pulled and pressed by waves before it cracked, and it ended soon after, without a word."""
	pace = watched(kinetic=0.5, broken=0)[1]
	pace.reaction = lambda: 1000.0
	pace(0)
	pace.reaction = lambda: 90.0
	pace(1)
	assert 'kinetic energy is 50 % of the strain energy' in pace.said
	slow = watched(kinetic=0.01, broken=0)[1]
	for broken in (0, 1, 1):
		slow(broken)
	assert slow.said == ''


def test_isInTheProgressLine():
	pace = watched(kinetic=0.02, reaction=99)[1]
	assert loadingLine(1e-3, 2e6, pace.model, pace).endswith('broken 0  unbalanced 0.01  kinetic/strain 0.02  reaction/load 1.001')
	assert loadingLine(1e-3, 2e6, pace.model) == 'u 1.0000 mm  stress 2.000 MPa  broken 0'


def test_aRunThatIsTooFastSaysSo():
	"""The couplet of the tests torn in 200 steps, and in 12,000."""
	for share, spoken in ((60, True), (1, False)):
		model, said = couplet(steps=12000 // share), io.StringIO()
		pace = Pace(model, lambda: model.groupForce('top'), lambda: model.groupForce('bottom', axis='y'), stream=said)
		for _ in range(150):
			O.run(max(1, 80 // share), True)
			pace((model.pointStatus > 0).sum())
		assert bool(said.getvalue()) == spoken, said.getvalue()
