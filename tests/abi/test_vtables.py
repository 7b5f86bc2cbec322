"""The virtual functions of YADE's classes stand where pkg/yade-api believes them to be.

vtables.txt holds, per class, the functions of its primary and secondary table in order. They are compared
with what the installed libraries put there (the relocations of their vtable symbols), and with what the compiler
made of our headers in classes that derive from them (toys.cpp).
"""
import os
import re
import subprocess

import pytest

folder = os.environ['YADE_LIBRARY_DIR']
probe = os.environ['ABIPROBE']
toys = {
	'ToyShape': 'Shape', 'ToyState': 'State', 'ToyMat': 'FrictMat', 'ToyGeom': 'IGeom', 'ToyPhys': 'FrictPhys', 'ToyEngine': 'GlobalEngine',
	'ToyPartialEngine': 'PartialEngine', 'ToyPeriodicEngine': 'PeriodicEngine', 'ToyTimeStepper': 'TimeStepper', 'Bo1_ToyShape_Aabb': 'BoundFunctor',
	'Ig2_ToyShape_ToyShape_ToyGeom': 'IGeomFunctor', 'Ip2_ToyMat_ToyMat_ToyPhys': 'IPhysFunctor', 'Law2_ToyGeom_ToyPhys_Toy': 'LawFunctor'
}
recorded = {}
with open(os.path.join(os.path.dirname(__file__), 'vtables.txt')) as file:
	for line in file:
		if line.startswith('#') or not line.strip(): continue
		name, functions = line.split(':', 1)
		recorded[name] = functions.split()


def output(*command, input=None):
	return subprocess.run(command, input=input, capture_output=True, text=True, check=True).stdout


def shortName(mangled, demangled, className):
	"""`getClassName` if the class fills the slot, `Base::getClassName` if a base does; overloads carry their number of arguments."""
	thunk, name = re.fullmatch(r'(non-virtual thunk to )?yade::(.*)', demangled).groups()
	while '<' in name:
		name = re.sub(r'<[^<>]*>', '', name) # template arguments
	owner, function, arguments = re.fullmatch(r'(\w+)::([~\w]+)(?:\[abi:cxx11\])?\((.*)\)(?: const)?', name).groups()
	if function.startswith('~'): function = '~delete' if 'D0Ev' in mangled else '~'
	if function in ('go', 'goReverse'): function += str(arguments.count(',') + 1)
	return ('thunk-' if thunk else '') + (owner + '::' if owner != className else '') + function


def tables(path, wanted):
	"""Vtables of some classes in one library, as lists of short names; the second table follows the word 'and'."""
	slots = {}
	for line in output('readelf', '-rW', path).splitlines():
		found = re.match(r'([0-9a-f]{16})\s+\S+\s+R_X86_64_64\s+\S+\s+(\S+) \+ 0', line)
		if found: slots[int(found.group(1), 16)] = found.group(2)
	symbols = {}
	for line in output('readelf', '-W', '--dyn-syms', path).splitlines():
		found = re.search(r':\s+([0-9a-f]+)\s+(\d+)\s+OBJECT\s.*\s\d+ _ZTVN4yade\d+(\w+)E$', line)
		if found and found.group(3) in wanted: symbols[found.group(3)] = int(found.group(1), 16), int(found.group(2))

	mangled = sorted(set(slots.values()))
	demangled = dict(zip(mangled, output('c++filt', input='\n'.join(mangled)).splitlines()))
	result = {}
	for name, (start, size) in symbols.items():
		functions = []
		for address in range(start + 16, start + size, 8): # after the offset to the top and the type information
			function = slots.get(address)
			if function is None: functions.append('and') # the secondary table's offset to the top
			elif not function.startswith('_ZTI'): functions.append(shortName(function, demangled[function], name))
		result[name] = functions
	return result


@pytest.fixture(scope='module')
def installed():
	result = {}
	for library in 'libpkg_dem.so', 'libpkg_common.so', 'libyade.so': # the core has the last word
		result.update(tables(os.path.join(folder, library), recorded))
	return result


@pytest.mark.parametrize('name', recorded)
def test_installed_vtable(installed, name):
	assert installed[name] == recorded[name]


def test_number_of_slots_compared():
	assert sum(len(functions) - functions.count('and') for functions in recorded.values()) > 640


def withoutOwners(functions):
	return [re.sub(r'^(thunk-)?(\w+::)?', '', function) for function in functions]


@pytest.fixture(scope='module')
def compiled():
	return tables(probe, toys)


@pytest.mark.parametrize('toy', toys)
def test_vtable_by_our_headers(compiled, toy):
	ours, yades = withoutOwners(compiled[toy]), withoutOwners(recorded[toys[toy]])
	if 'and' in yades: # a functor's own go stands behind the inherited part of the primary table
		secondary = yades.index('and')
		assert ours[:secondary] == yades[:secondary]
		ours, yades = ours[ours.index('and'):], yades[secondary:]
	assert ours == yades
