# yade-blocks, GPL-2.0-or-later
"""What `cmake --install` puts where, and a YADE that loads the plugin from there at its start."""
import json
from pathlib import Path

import pytest
import yade.config

from scenes import *

package = Path(yadeblocks.__file__).parent


@pytest.fixture(scope='module')
def installed(tmp_path_factory):
	"""An empty folder into which everything was installed, as the root of the file system: (files, prefix, YADE's library folder below it)."""
	root = tmp_path_factory.mktemp('root')
	build = Path(os.environ['YADEBLOCKS_PLUGIN']).parent
	# the component is everything; naming it leaves the list of files of a real installation alone
	subprocess.run(['cmake', '--install', build, '--component', 'Unspecified'], env={**os.environ, 'DESTDIR': str(root)}, check=True)
	files = {path.relative_to(root) for path in root.rglob('*') if path.is_file()}
	library, = root.rglob('libyadeblocks.so')
	return files, root, library.parent


def test_onlyThePluginAndItsPythonFiles(installed):
	files, root, libraries = installed
	assert str(libraries) == str(root) + yade.config.libDir
	python = {path for path in files if path.suffix == '.py'}
	assert {path.name for path in files - python} == {'libyadeblocks.so'}
	assert {path.relative_to('usr/lib/python3/dist-packages/yadeblocks') for path in python} == {
		path.relative_to(package) for path in package.rglob('*.py')
	}


def test_YADELoadsItAtItsStart(installed, tmp_path):
	"""No word of yadeblocks in the script, and a saved scene opens; a later import of the installed package changes nothing."""
	_, root, libraries = installed
	for entry in Path(yade.config.libDir).iterdir(): # YADE_PREFIX: YADE looks there for its libraries and plugins
		if not (libraries / entry.name).exists(): (libraries / entry.name).symlink_to(entry)
	couplet()
	O.run(20, True)
	O.save(str(tmp_path / 'saved.yade.bz2'))
	run = runYade(
		"""import json
O.load('saved.yade.bz2')
O.run(10, True)
plugin = {line.split()[-1] for line in open('/proc/self/maps') if 'libyadeblocks' in line}
before = BlockModel
import yadeblocks
print(json.dumps([O.iter, len(O.bodies), sorted(plugin), yadeblocks.__file__, before is BlockModel]))
""", cwd=tmp_path, env={'YADE_PREFIX': str(root / 'usr'), 'PYTHONPATH': str(root / 'usr/lib/python3/dist-packages'), 'YADEBLOCKS_PLUGIN': ''}
	)
	assert run.returncode == 0, run.stdout + run.stderr
	steps, bodies, plugin, imported, same = json.loads(run.stdout.splitlines()[-1])
	assert (steps, bodies, same) == (30, len(O.bodies), True)
	assert plugin == [str(libraries / 'libyadeblocks.so')] and imported.startswith(str(root))
