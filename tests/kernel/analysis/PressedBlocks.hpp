// yade-blocks, GPL-2.0-or-later
#pragma once
#include <Specimens.hpp>
#include <blocks/kernel/analysis/StabilityWatch.hpp>

/// Blocks that go into each other.
namespace pressed {

using namespace specimens;

/// Two unequally meshed rectangles, 0.6 x 0.2 m below 0.6 x 0.4 m; zones behind the joint are 0.1 and 0.08 m high.
inline BlockAssembly twoMeshes()
{
	BlockAssembly a;
	a.addMaterial(stone());
	addGrid(a, { 0, 0 }, 0.6, 0.2, 3, 2);
	addGrid(a, { 0, 0.2 }, 0.6, 0.4, 2, 5);
	bondAll(a, elasticJoint(100e9, 40e9));
	return a;
}

/// A square of 1 m that was never bonded, `depth` deep in another one, with the contact's forces.
struct Pressed {
	BlockAssembly a;
	Pressed()
	{
		a.addMaterial(stone());
		addGrid(a, { 0, 0 }, 1, 1, 2, 2);
		addGrid(a, { 0.1, 1 }, 1, 1, 2, 2);
		a.contacts.wanted = true;
		prepareContacts(a);
		JointParams joint = elasticJoint(1e9, 5e8);
		joint.cohesion = joint.tension = 0;
		setContactJoint(a, 0, joint);
	}
	void put(Real depth)
	{
		for (int n = a.mesh.firstNode[1]; n < a.mesh.firstNode[2]; ++n)
			a.place(n, a.mesh.reference[n] - Vec2(0, depth));
		blocks::computeForces(a, Brittle {}, 1e-9);
	}
};

} // namespace pressed
