# yade-blocks, GPL-2.0-or-later
"""Where the code of each optional feature is, for what it costs while it is off (pricetable.py)."""
import re
from pathlib import Path

from laboratory.instructions import Feature

features = {
	'general contact': Feature(
		'FreeContact FreeContacts ContactList ContactSearch Contacts ContactResults ContactViews BlockContacts EdgeContact EdgeContactLaw '
		'EdgeColumns EdgeShapes EdgeBatch EdgeDetection JointCorners JointEdges RaisedCorners Rests RestColumns CloseRests Waking '
		'Release Paths Odometer ContactMemory Tunnelling',
		r'[cC]ontact(?! ?[pP])|[rR]eleased|\bgone\b|[oO]dometer|\bfollow\b|fastest' # contact points are those of joints
	),
	'rigid blocks': Feature('RigidBodies RigidBlocks RigidBlock', r'\b[rR]igid'),
	'dilation': Feature(lines='[dD]ilation|uplift'),
	'residual friction': Feature(lines='[rR]esidual'),
	'joints that soften': Feature('SofteningLaw SofteningJoints', r'[sS]often|anyCap|beyondCap'),
	'small strain': Feature(lines='smallStrain|Strain::small'),
	'dead loads': Feature('Loads', r'\bload\b|loadWork'),
	'adaptive damping': Feature(lines='adaptive|viscous'),
	'stability watch': Feature('StabilityWatch', r'watch'),
	'energy accounts': Feature('Energy Dissipation', 'trackEnergy|account|dissipation'),
	'crack recorder': Feature('BlockCrackRecorder'),
	'servo': Feature('BlockServo', 'throttle'),
}


def stale(features, root):
	"""What the features name and no C++ file below `root` has any more: files, and alternatives of lines that match in none but their own files."""
	sources = [file for file in Path(root).rglob('*') if file.suffix in ('.cpp', '.hpp')]
	text = {file: file.read_text() for file in sources}
	missing = []
	for name, feature in features.items():
		elsewhere = [text[file] for file in sources if file.stem not in feature.files]
		missing += [f'{name}: {stem}' for stem in feature.files if stem not in {file.stem for file in sources}]
		missing += [f'{name}: {line}' for line in feature.lines.split('|') if line and not any(re.search(line, one) for one in elsewhere)]
	return missing
