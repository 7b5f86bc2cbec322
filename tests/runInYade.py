"""Runs pytest on one file in a process where YADE is running: runInYade.py FILE [arguments of pytest].

ctest puts YADE's Python folder and this project's on PYTHONPATH. A test file begins with
`import yadeblocks` (which loads the plugin) and then may say `from yade import *`.
"""
import os
import sys

import pytest
import yade

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[1]))) # for modules beside the test
# importlib: `from yade import *` overwrites a module's __file__, which pytest's other ways of importing do not bear
options = ['--import-mode=importlib', '-p', 'no:cacheprovider', '--rootdir', os.path.dirname(os.path.abspath(__file__))]
outcome = pytest.main(options + sys.argv[1:])
sys.stdout.flush()
sys.stderr.flush()
os._exit(outcome) # YADE's threads and libraries are not made for an orderly end of Python
