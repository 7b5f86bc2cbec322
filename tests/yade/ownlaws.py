# yade-blocks, GPL-2.0-or-later
"""The plugin OwnLaws.cpp, loaded behind yadeblocks: WearLaw, CutOffLaw, Law2_BlockGeom_JointPhys_CutOff. A test that needs it is left out where ctest has not
built it."""
import os

import pytest

import yadeblocks # noqa: F401 (loads the plugin)
import yade
from yadeblocks import _plugin

if 'OWNLAWS' in os.environ:
	_plugin.load(os.environ['OWNLAWS'], yade)
	_plugin.publish(yade)

built = pytest.mark.skipif('OWNLAWS' not in os.environ, reason='OwnLaws.cpp is not built')
