"""The module abiprobe with its toy classes, loaded into YADE as a plugin is."""
import ctypes
import os
import sys

import yade # noqa: F401
from yade import system, wrapper

path = os.environ['ABIPROBE']
library = ctypes.PyDLL(path, os.RTLD_GLOBAL | os.RTLD_NOW)
library.yadeRegisterNewClasses()
sys.path.insert(0, os.path.dirname(path))
import abiprobe # noqa: F401

toys = {name: getattr(wrapper, name) for name in system.childClasses('Serializable') if 'Toy' in name}
