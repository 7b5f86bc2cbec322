// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/analysis/Removal.hpp>
#include <blocks/python/Follow.hpp>
#include <blocks/python/ModelPython.hpp>
#include <blocks/python/Sequences.hpp>
#include <blocks/views/Numpy.hpp>
#include <core/BodyContainer.hpp>
#include <core/Omega.hpp>
#include <limits>

/// What changes a scene at once: blocks that are taken out, the elastic jump, the path from event to event.
namespace yade {
namespace {

	/// Bodies go with their blocks, and their interactions with them.
	void removeBlocks(BlockModel& model, const py::object& blocks)
	{
		if (model.firstBody < 0)
			throw std::runtime_error("BlockModel.remove must come after BlockModel.insert(): leave out blocks that are not to be there");
		vector<int> list;
		for (long block : integers(blocks))
			list.push_back(inRange(block, "BlockModel.remove: a block"));
		blocks::removeBlocks(model.assembly, list);
		model.zonesChanged();
		Scene* scene = Omega::instance().getScene().get();
		for (int block : list)
			if (scene->bodies->exists(model.firstBody + block)) scene->bodies->erase(model.firstBody + block, false);
	}
	py::object removedBlocks(BlockModel& model)
	{
		vector<int> list;
		for (int block = 0; block < model.assembly.blockCount(); ++block)
			if (model.assembly.isRemoved(block)) list.push_back(block);
		return numpyOf(list, false).attr("copy")();
	}

} // namespace

void defineAnalysis(PythonModel& c)
{
	using py::arg;
	c.def("remove",
	      &removeBlocks,
	      (arg("blocks")),
	      "Takes deformable blocks (indices) out of a scene between two steps: excavation, stages. Their joints and contacts carry nothing any "
	      "more, "
	      "their bodies and interactions are gone, and indices of all others stay. What they held is 'blockRemoved' in ``O.energy``. All at once: "
	      "what they carried comes upon their neighbours within a step; take out few at a time, or damp (loading.settle), where joints could "
	      "break of it. "
	      "Errors: ValueError for rigid blocks, blocks that are gone, those with grid points of a group or of a viscous boundary (release it "
	      "first), or all "
	      "that are left; RuntimeError before insert(). elasticJump() and follow() know no such scenes.")
		.add_property("removedBlocks", &removedBlocks, "Indices of the blocks that have been removed, ascending. A copy.")
		.def("elasticJump",
	             &elasticJump,
	             (arg("fraction") = 0.97),
	             "Leaps over the elastic part of the loading: solves for the answer to all loads, pushed groups at their full force and driven groups up "
	             "to this fraction of the first failure, and goes on from there at full speed; no ramps, no settling. "
	             "Joints must have their properties (Mohr-Coulomb), from bond() or from a first step. Returns {'time': of loading at full speed that "
	             "was leapt over [s], 'point': the contact point that will fail first}. "
	             "Rigid blocks move along, those with a prescribed velocity as driven ones. "
	             "Errors: RuntimeError where joints are broken or never were bonded, blocks are not held, nothing is driven, or the loads alone break a "
	             "joint; nothing is changed then.")
		.def("follow",
	             &follow,
	             (arg("group"),
	              arg("peak")         = false,
	              arg("drop")         = 0.5,
	              arg("displacement") = std::numeric_limits<Real>::infinity(),
	              arg("cracks")       = std::numeric_limits<int>::max(),
	              arg("release")      = "path",
	              arg("gauges")       = py::list(),
	              arg("progress")     = py::object()),
	             followDoc);
}

} // namespace yade
