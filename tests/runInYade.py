# yade-blocks, GPL-2.0-or-later
"""Runs pytest on a file or a folder in a process where YADE is running: runInYade.py PATH [arguments of pytest].

The project's Python folder is on PYTHONPATH (ctest puts it there). A test file may say `from yade import *`; the plugin is loaded behind YADE.
"""
import os
import sys

import pytest

path = os.path.abspath(sys.argv[1])
if '--without-plugin' in sys.argv: sys.argv.remove('--without-plugin') # tests of the interface headers bring a plugin of their own
else: import yadeblocks # noqa: F401 (finds YADE, too)

import yade # noqa: F401

sys.path.insert(0, path if os.path.isdir(path) else os.path.dirname(path)) # for modules beside the test
# importlib: `from yade import *` overwrites a module's __file__, which pytest's other ways of importing do not bear
options = ['--import-mode=importlib', '-p', 'no:cacheprovider', '--rootdir', os.path.dirname(os.path.abspath(__file__))]
outcome = pytest.main(options + sys.argv[1:])
sys.stdout.flush()
sys.stderr.flush()
os._exit(outcome) # YADE's threads and libraries are not made for an orderly end of Python
