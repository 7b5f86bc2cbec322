// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/model/JointDetection.hpp>
#include <blocks/views/Block.hpp>
#include <blocks/views/BlockGeom.hpp>
#include <blocks/views/BlockModel.hpp>
#include <blocks/views/BlockState.hpp>
#include <blocks/views/JointPhys.hpp>
#include <core/Body.hpp>
#include <core/BodyContainer.hpp>
#include <core/Interaction.hpp>
#include <core/InteractionContainer.hpp>
#include <core/Omega.hpp>

namespace yade {

/// Tells which blocks touch, or nearly, and have no joint.
static void warnOfUnjoined(const blocks::BlockAssembly& a)
{
	const auto list = blocks::unjoinedBlocks(a);
	if (list.empty()) return;
	string           pairs;
	constexpr size_t shownAtMost = 5;
	for (size_t i = 0; i < std::min(list.size(), shownAtMost); ++i)
		pairs += (i ? "; " : "") + std::to_string(list[i].block[0]) + " and " + std::to_string(list[i].block[1]) + ", " + blocks::shown(list[i].gap, 3)
			+ " m apart";
	const string sentence = "BlockModel.insert: " + std::to_string(list.size()) + (list.size() == 1 ? " pair of blocks touches" : " pairs of blocks touch")
		+ ", or nearly, without a joint (blocks " + pairs + (list.size() > shownAtMost ? "; ..." : "")
		+ "): nothing but general contact keeps them from passing through each other. bond() after the last block joins what touches, "
		  "bond(tolerance=...) what is further apart";
	if (PyErr_WarnEx(PyExc_UserWarning, sentence.c_str(), 1)) throw py::error_already_set();
}

void BlockModel::insert(bool interactions)
{
	requireOpen("BlockModel.insert");
	if (assembly.blockCount() == 0) throw std::runtime_error("BlockModel.insert: the model has no blocks");
	Scene* scene = Omega::instance().getScene().get();
	for (const auto& body : *scene->bodies)
		if (body && body->shape && dynamic_cast<const Block*>(body->shape.get()))
			throw std::runtime_error("BlockModel.insert: the scene has blocks of another model already; one model holds all blocks of a scene");

	warnOfUnjoined(assembly);
	assembly.contacts.strangers = false; // until a script asks for an array that it may write
	size_t     rigid            = 0;
	const auto self             = YADE_PTR_CAST<BlockModel>(shared_from_this());
	for (int i = 0; i < assembly.blockCount(); ++i) {
		auto       shape    = shared_ptr<Block>(new Block);
		auto       body     = shared_ptr<Body>(new Body);
		const auto centroid = assembly.centroid(i);
		shape->model        = self;
		shape->index        = i;
		body->shape         = shape;
		const string& label = labelOf(i);
		for (const auto& material : scene->materials)
			if (material->label == label) body->material = material;
		const bool isRigid = rigid < assembly.state.rigid.size() && assembly.state.rigid[rigid].block == i;
		if (!isRigid) {
			auto state   = shared_ptr<BlockState>(new BlockState);
			state->model = self;
			state->index = i;
			body->state  = state;
		}
		body->state->pos = body->state->refPos = Vector3r(centroid.x(), centroid.y(), 0);
		if (isRigid) {
			const blocks::RigidBlock& r = assembly.state.rigid[rigid++];
			body->state->blockedDOFs    = State::DOF_Z | State::DOF_RX | State::DOF_RY;
			body->state->mass           = r.inertia;
			body->state->inertia        = Vector3r::Constant(r.rotaryInertia); // about z; the others only because YADE divides by them
		} else {
			body->state->blockedDOFs = State::DOF_ALL; // the grid points move, not the body
			for (int n = assembly.mesh.firstNode[i]; n < assembly.mesh.firstNode[i + 1]; ++n)
				body->state->mass += assembly.mesh.mass[n];
		}
		const int id = scene->bodies->insert(body);
		if (i == 0) firstBody = id;
		if (id != firstBody + i) throw std::runtime_error("BlockModel.insert: body ids are not consecutive; insert blocks before erasing bodies");
	}
	showsInteractions = interactions;
	for (size_t pair = 0; interactions && pair < assembly.joints.pairs.size(); ++pair) {
		const auto& block       = assembly.joints.pairs[pair].block;
		auto        interaction = shared_ptr<Interaction>(new Interaction(firstBody + block[0], firstBody + block[1]));
		auto        geom        = shared_ptr<BlockGeom>(new BlockGeom);
		geom->model             = self;
		geom->pair              = int(pair);
		interaction->geom       = geom; // O.save forgets interactions that have neither geom nor phys
		if (assembly.joints.kind[assembly.joints.pairs[pair].first] > 0) {
			auto phys         = shared_ptr<JointPhys>(new JointPhys);
			phys->model       = self;
			phys->pair        = int(pair);
			phys->fromBond    = true;
			interaction->phys = phys;
		}
		scene->interactions->insert(interaction);
	}
	stiffnessChanged();
}

} // namespace yade
