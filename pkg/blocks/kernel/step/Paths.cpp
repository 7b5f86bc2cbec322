// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/step/Paths.hpp>

namespace blocks {
namespace {

	/// Lengths of the paths of those blocks that have contacts.
	void followMotion(BlockAssembly& a)
	{
		FreeContacts& f       = a.contacts;
		Real          longest = 0;
		for (int b : f.blocksInContact) {
			Real farthest = 0;
			for (int n = a.mesh.firstNode[b]; n < a.mesh.firstNode[b + 1]; ++n) {
				farthest             = std::max(farthest, (a.state.displacement[n] - f.odometer.seenAt[n]).squaredNorm());
				f.odometer.seenAt[n] = a.state.displacement[n];
			}
			f.odometer.path[b] += std::sqrt(farthest);
			longest = std::max(longest, std::sqrt(farthest));
		}
		f.odometer.longest += longest;
		f.odometer.unseen = 0, f.odometer.steps = 0;
	}

	/// Paths are brought up to date every so many steps. In between, only the fastest grid point counts.
	constexpr int stepsUnseen = 8;

} // namespace

void followAll(BlockAssembly& a)
{
	followMotion(a);
	a.contacts.odometer.seenAt = a.state.displacement;
}

void followContacts(BlockAssembly& a)
{
	FreeContacts& f = a.contacts;
	if (f.strangers || ++f.odometer.steps >= stepsUnseen) followMotion(a);
}

} // namespace blocks
