# yade-blocks, GPL-2.0-or-later
"""Loads libyadeblocks.so into YADE and puts its classes where YADE's own classes are.

Nothing to do if YADE has loaded the plugin itself, because it is installed below YADE's library folder.
Otherwise the plugin is the one built in this checkout (build/libyadeblocks.so), or the file named by the
environment variable YADEBLOCKS_PLUGIN.
"""
import ctypes
import glob
import importlib.abc
import importlib.util
import os
import re
import sys

libraryName = 'libyadeblocks.so'


def loadedFrom(name):
	"""The path of the library of that name in this process, or None."""
	with open('/proc/self/maps') as maps:
		paths = {line.split(maxsplit=5)[5].rstrip('\n') for line in maps if line.rstrip('\n').endswith('/' + name)}
	return paths.pop() if paths else None


def checkVersion(path, yade):
	"""A plugin built for another YADE would crash, so look into the file before loading it."""
	with open(path, 'rb') as file:
		found = re.search(rb'plugin built for YADE ([^\0]+)\0', file.read())
	if not found: raise ImportError('%s is no plugin for YADE' % path)
	builtFor = found.group(1).decode()
	if builtFor != yade.config.version:
		raise ImportError('%s was built for YADE %s, but this is YADE %s' % (path, builtFor, yade.config.version))


def builtPlugin():
	"""The plugin that this checkout or YADEBLOCKS_PLUGIN provides, or None."""
	if 'YADEBLOCKS_PLUGIN' in os.environ: return os.environ['YADEBLOCKS_PLUGIN']
	checkout = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
	path = os.path.join(checkout, 'build', libraryName)
	return path if os.path.exists(path) else None


def load(path, yade):
	"""Loads a plugin into a running YADE and registers its classes."""
	checkVersion(path, yade)
	plugin = ctypes.PyDLL(path, os.RTLD_GLOBAL | os.RTLD_NOW)
	plugin.yadeRegisterNewClasses()
	if 'yade.qt' in sys.modules: plugin.yadeDrawNewClasses(ctypes.py_object(sys.modules['yade.qt'].Renderer()))


def publish(yade):
	"""Puts classes that YADE has come to know since its start into the namespaces that YADE fills at its start."""
	known = yade.system.childClasses('Serializable')
	classes = {name: getattr(yade.wrapper, name) for name in sorted(known - yade.system._allSerializables)}
	yade.system._allSerializables |= known
	vars(yade).update(classes)
	yade.__all__ += classes
	session = vars(sys.modules['__main__'])
	if session.get('Shape') is yade.wrapper.Shape: session.update(classes) # it has done `from yade import *`
	return classes


def ensure(yade):
	"""Loads the plugin into this YADE, if YADE has not done so itself."""
	import yade.config
	import yade.system
	import yade.wrapper
	path, built = loadedFrom(libraryName), builtPlugin()
	if path is None:
		if built is None: raise ImportError('%s is not built: run scripts/setup.sh, or install the package yade-blocks' % libraryName)
		if not os.path.exists(built): raise ImportError('there is no %s (from YADEBLOCKS_PLUGIN)' % built)
		load(built, yade)
	elif built and os.path.realpath(built) != os.path.realpath(path):
		print('yadeblocks: YADE has loaded %s already, %s is not used' % (path, built), file=sys.stderr)
	publish(yade)
	from . import _calls, _running, group, saving
	_calls.install(yade.wrapper)
	_running.install(yade.wrapper)
	group.install(yade.wrapper)
	saving.install()


class _Follower(importlib.abc.MetaPathFinder):
	"""Waits for the import of YADE in a Python that was not started by the program `yade`; the plugin is loaded behind it."""
	def find_spec(self, name, path=None, target=None):
		if name != 'yade': return None
		sys.meta_path.remove(self)
		spec = importlib.util.find_spec('yade')
		if spec is None or spec.loader is None: spec = self._installed() # a folder of that name has no loader
		execute = spec.loader.exec_module

		def executeAndLoad(module):
			execute(module)
			ensure(module)

		spec.loader.exec_module = executeAndLoad
		return spec

	def _installed(self):
		"""YADE where its package puts it, which is not where Python looks."""
		prefix = os.environ.get('YADE_PREFIX', '/usr')
		folders = glob.glob(prefix + '/lib/*/yade-double/py')
		if not folders: raise ImportError('yadeblocks needs YADE: there is no %s/lib/*/yade-double/py' % prefix)
		os.environ.setdefault('OMP_NUM_THREADS', '1') # as the program `yade` does
		sys.path.append(folders[0])
		return importlib.util.find_spec('yade')


def follow():
	"""Loads the plugin now if YADE is running, else behind YADE."""
	if 'yade' in sys.modules: ensure(sys.modules['yade'])
	else: sys.meta_path.insert(0, _Follower())
