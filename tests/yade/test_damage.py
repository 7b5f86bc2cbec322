# yade-blocks, GPL-2.0-or-later
"""Damaged files are refused, with their name, before YADE gets to read them; what was not damaged loads with the same bits."""
import random
import re

import pytest

from scenes import *
from yadeblocks import checkpoint, saving

formats = 'yade', 'yade.gz', 'yade.bz2', 'xml', 'xml.gz', 'xml.bz2'


def scene():
	"""Two bonded blocks that have moved."""
	O.reset()
	O.materials.append(BlockMat(label='rock', young=1e9, poisson=0.2, density=2000))
	model = BlockModel(thickness=0.1)
	model.addRegion(rectangle(0, 0, 1, 1), 'rock', zoneSize=0.5)
	model.addRegion(rectangle(1, 0, 2, 1), 'rock', zoneSize=0.5)
	model.bond()
	model.insert()
	O.engines = engineList([JointMat(material1='rock', material2='rock', kn=1e10, ks=1e10, cohesion=1e6, tension=1e6)])
	O.dt = 1e-4
	model.gravity((0, -10))
	O.run(5, True)
	return model


@pytest.mark.parametrize('format', formats)
def test_oneChangedByte(format, tmp_path):
	"""At 60 places, by turns any of the eight bits; the seal's own bytes among them."""
	whole, damaged = str(tmp_path / ('whole.' + format)), str(tmp_path / ('damaged.' + format))
	bits = scene().fingerprint()
	O.save(whole)
	O.reset()
	O.load(whole)
	assert checkpoint.sceneModel().fingerprint() == bits and O.iter == 5
	content, dice = open(whole, 'rb').read(), random.Random(format)
	seal = len(content) - len(saving.sealOf(b'', whole)) # about where it begins
	places = [dice.randrange(len(content)) for _ in range(40)] + [dice.randrange(seal, len(content)) for _ in range(18)] + [0, len(content) - 1]
	for number, place in enumerate(places):
		changed = bytearray(content)
		changed[place] ^= 1 << number % 8
		open(damaged, 'wb').write(changed)
		with pytest.raises(ValueError, match='damaged.' + format + ' is damaged'):
			O.load(damaged)
	assert O.iter == 5 and checkpoint.sceneModel().fingerprint() == bits # nothing was touched


@pytest.mark.parametrize('format', formats)
def test_anEndThatIsMissing(format, tmp_path):
	whole, damaged = str(tmp_path / ('whole.' + format)), str(tmp_path / ('damaged.' + format))
	scene()
	O.save(whole)
	content = open(whole, 'rb').read()
	for missing in (1, 30, len(content) // 2) if format != 'yade' else (1, 30): # without a seal an archive does not say how long it is
		open(damaged, 'wb').write(content[:-missing])
		with pytest.raises(ValueError, match='is damaged'):
			O.load(damaged)


@pytest.mark.parametrize('format', formats)
def test_withoutASeal(format, tmp_path):
	"""What YADE alone has saved is loaded; and YADE alone loads what has a seal."""
	file, bits = str(tmp_path / ('theirs.' + format)), scene().fingerprint()
	O.unsealedSave(file, True)
	O.reset()
	O.load(file)
	assert checkpoint.sceneModel().fingerprint() == bits
	O.save(file)
	O.reset()
	O.unsealedLoad(file, True)
	assert checkpoint.sceneModel().fingerprint() == bits


@pytest.mark.parametrize(
	'pattern, other, words', [
		(r'<format>\d+</format>', '<format>6</format>', 'another version of yade-blocks (format 6'),
		(r'<density>[^<]*</density>', '<density>2001</density>', 'fingerprint does not fit'),
	]
)
def test_whatNoSealSees(pattern, other, words, tmp_path):
	"""A file without a seal that says something else: of another format, or with one number that is not what it was."""
	file = tmp_path / 'theirs.xml'
	scene()
	O.unsealedSave(str(file), True)
	text = file.read_text()
	assert re.findall(pattern, text)
	at = [m for m in re.finditer(pattern, text)][-1] # of the materials the model's own come last
	file.write_text(text[:at.start()] + other + text[at.end():])
	with pytest.raises((RuntimeError, ValueError)) as caught:
		O.load(str(file))
	assert words in str(caught.value)


@pytest.mark.parametrize('format', formats)
def test_theOldFileIsNotWrittenInto(format, tmp_path):
	"""A file is whole at any moment, whenever the program is killed: the new one is another file that takes the old one's name."""
	file, kept = tmp_path / ('scene.' + format), tmp_path / ('kept.' + format)
	scene()
	O.save(str(file))
	content = file.read_bytes()
	os.link(file, kept) # the file, by another name
	O.run(5, True)
	O.save(str(file))
	assert kept.read_bytes() == content != file.read_bytes()


def test_whereNothingCanBeSaved(tmp_path):
	scene()
	with pytest.raises(OSError, match='nowhere'):
		O.save(str(tmp_path / 'nowhere/scene.yade'))
	O.save(str(tmp_path / 'scene.yade.bz2'))
	assert O.filename == str(tmp_path / 'scene.yade.bz2') and sorted(os.listdir(tmp_path)) == ['scene.yade.bz2']
	bits = checkpoint.sceneModel().fingerprint()
	O.run(3, True)
	O.reload()
	assert O.iter == 5 and checkpoint.sceneModel().fingerprint() == bits
