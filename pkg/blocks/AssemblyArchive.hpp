// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/analysis/Energy.hpp>
#include <boost/serialization/array.hpp>
#include <boost/serialization/nvp.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

/// What O.save keeps of an assembly. What can be computed again (forces, frames, sides, zone gradients) is not kept.
namespace boost {
namespace serialization {

#define KEEP(member) ar& make_nvp(#member, x.member)

	template <class Archive> void serialize(Archive& ar, blocks::Material& x, unsigned) { KEEP(young), KEEP(poisson), KEEP(density); }

	template <class Archive> void serialize(Archive& ar, blocks::Segment& x, unsigned) { KEEP(node), KEEP(block), KEEP(s1), KEEP(s2), KEEP(area); }

	template <class Archive> void serialize(Archive& ar, blocks::ContactPoint& x, unsigned)
	{
		KEEP(opening), KEEP(slip), KEEP(sigma), KEEP(tau), KEEP(bondOpening), KEEP(bondSlip);
		KEEP(joint.slipPlastic), KEEP(joint.uplift);
		int status = int(x.joint.status);
		ar& make_nvp("status", status);
		x.joint.status = blocks::Joint(status);
	}

	template <class Archive> void serialize(Archive& ar, blocks::Pair& x, unsigned) { KEEP(block), KEEP(first), KEEP(last); }

	template <class Archive> void serialize(Archive& ar, blocks::JointParams& x, unsigned)
	{
		KEEP(kn), KEEP(ks), KEEP(cohesion), KEEP(tanPhi), KEEP(tension);
		KEEP(cohesionResidual), KEEP(tanPhiResidual), KEEP(tensionResidual), KEEP(tanDilation), KEEP(dilationLimitSlip);
	}

	template <class Archive> void serialize(Archive& ar, blocks::EdgePair& x, unsigned)
	{
		KEEP(edge), KEEP(slip), KEEP(sigma), KEEP(tau), KEEP(area), KEEP(uplift);
	}

	template <class Archive> void serialize(Archive& ar, blocks::FreeContact& x, unsigned) { KEEP(block), KEEP(joint), KEEP(edges), KEEP(friction); }

	template <class Archive> void serialize(Archive& ar, blocks::FreeContacts& x, unsigned)
	{
		KEEP(all), KEEP(detectedAt), KEEP(releasable), KEEP(requests), KEEP(lostFriction);
	}

	template <class Archive> void serialize(Archive& ar, blocks::MotionGroup& x, unsigned)
	{
		int drive = int(x.drive);
		ar& make_nvp("drive", drive);
		x.drive = blocks::MotionGroup::Drive(drive);
		KEEP(name), KEEP(dofs), KEEP(target), KEEP(startTime), KEEP(rampTime), KEEP(throttle);
		KEEP(velocity), KEEP(travelled), KEEP(force), KEEP(work), KEEP(workTurnover), KEEP(pendingWork);
	}

	template <class Archive> void serialize(Archive& ar, blocks::ReleasedWork& x, unsigned) { KEEP(work), KEEP(turnover); }

	template <class Archive> void serialize(Archive& ar, blocks::RigidBlock& x, unsigned)
	{
		KEEP(block), KEEP(origin), KEEP(mass), KEEP(moment), KEEP(inertia), KEEP(rotaryInertia), KEEP(load), KEEP(free);
		KEEP(centre), KEEP(halfTurn), KEEP(velocity), KEEP(work), KEEP(workTurnover), KEEP(pendingWork);
	}

	template <class Archive> void serialize(Archive& ar, blocks::JointDissipation::Before& x, unsigned)
	{
		KEEP(opening), KEEP(slip), KEEP(sigma), KEEP(tau);
		int status = int(x.status);
		ar& make_nvp("status", status);
		x.status = blocks::Joint(status);
	}

	template <class Archive> void serialize(Archive& ar, blocks::JointDissipation& x, unsigned) { KEEP(friction), KEEP(fracture), KEEP(before); }

	template <class Archive> void serialize(Archive& ar, blocks::BlockAssembly& x, unsigned)
	{
		int plane = int(x.plane), strain = int(x.strain);
		ar& make_nvp("plane", plane);
		ar& make_nvp("strain", strain);
		x.plane = blocks::Plane(plane), x.strain = blocks::Strain(strain);
		KEEP(thickness), KEEP(materials);
		KEEP(reference), KEEP(position), KEEP(velocity), KEEP(force), KEEP(load), KEEP(mass), KEEP(inertia);
		KEEP(zoneNodes), KEEP(firstNode), KEEP(firstZone), KEEP(firstEdge), KEEP(blockMaterial), KEEP(edgeNodes);
		KEEP(segments), KEEP(points), KEEP(pairs), KEEP(joints), KEEP(groups), KEEP(released), KEEP(contacts), KEEP(rigid);
		if (Archive::is_loading::value) x.rebuild();
	}

#undef KEEP

} // namespace serialization
} // namespace boost
