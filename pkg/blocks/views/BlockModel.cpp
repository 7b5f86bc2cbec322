// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/Parallel.hpp>
#include <blocks/kernel/geometry/Polygon.hpp>
#include <blocks/kernel/model/JointDetection.hpp>
#include <blocks/kernel/step/TimeStep.hpp>
#include <blocks/views/BlockModel.hpp>
#include <blocks/views/BlockState.hpp>
#include <blocks/views/JointPhys.hpp>
#include <blocks/views/Materials.hpp>
#include <core/Body.hpp>
#include <core/BodyContainer.hpp>
#include <core/Interaction.hpp>
#include <core/InteractionContainer.hpp>
#include <core/Omega.hpp>
#include <limits>
#include <set>

namespace yade {

BlockModel::~BlockModel() = default;

std::atomic<long> BlockModel::lastVersion { 0 };

void BlockModel::postLoad(BlockModel&)
{
	const Real          wanted = thickness;
	const blocks::Plane plane  = planeStress ? blocks::Plane::stress : blocks::Plane::strain;
	thickness                  = assembly.thickness; // what is refused must not stay
	planeStress                = assembly.plane == blocks::Plane::stress;
	blocks::require(wanted > 0 && std::isfinite(wanted), "BlockModel.thickness must be positive and finite [m]", wanted);
	if (assembly.blockCount() > 0 && (wanted != assembly.thickness || plane != assembly.plane))
		throw std::invalid_argument("BlockModel.thickness and BlockModel.planeStress must be set before the first block is added");
	assembly.thickness = thickness = wanted;
	assembly.plane                 = plane;
	planeStress                    = plane == blocks::Plane::stress;
	assembly.strain                = smallStrain ? blocks::Strain::small : blocks::Strain::large;
	stiffnessChanged();
}

const shared_ptr<BlockModel>& BlockModel::of(const Scene* scene)
{
	for (const auto& body : *scene->bodies)
		if (body && body->shape)
			if (const auto* block = dynamic_cast<const Block*>(body->shape.get()))
				if (block->model) return block->model;
	throw std::runtime_error("no blocks in the scene: build a BlockModel and call its insert() before the first step");
}

const vector<Real>& BlockModel::stiffness()
{
	if (knownVersion != version) {
		knownVersion = version;
		if (int(zoneStiffness.size()) != assembly.nodeCount()) zoneStiffness = blocks::zoneStiffness(assembly);
		knownStiffness = blocks::nodalStiffness(assembly, zoneStiffness);
	}
	return knownStiffness;
}

void BlockModel::complain(const std::string& sentence)
{
	const std::lock_guard<std::mutex> lock(complaintMutex);
	if (complaint.empty() || sentence < complaint) complaint = sentence; // the same one, whichever thread comes first
}

void BlockModel::throwComplaint()
{
	if (complaint.empty()) return;
	const std::string sentence = std::move(complaint);
	complaint.clear();
	throw std::runtime_error(sentence);
}

blocks::Material materialOf(const BlockModel& model, const std::string& label)
{
	const auto known = std::find(model.materialLabels.begin(), model.materialLabels.end(), label);
	if (known != model.materialLabels.end()) return model.assembly.mesh.materials[known - model.materialLabels.begin()];

	for (const auto& material : Omega::instance().getScene()->materials)
		if (material->label == label) {
			const auto* mat = dynamic_cast<const BlockMat*>(material.get());
			if (!mat) throw std::invalid_argument("material \"" + label + "\" must be a BlockMat, got " + material->getClassName());
			return { mat->young, mat->poisson, mat->density };
		}
	throw std::invalid_argument("no material labelled \"" + label + "\" in O.materials: append a BlockMat(label=\"" + label + "\", ...) first");
}

int BlockModel::materialIndex(const std::string& label)
{
	const auto known = std::find(materialLabels.begin(), materialLabels.end(), label);
	if (known != materialLabels.end()) return int(known - materialLabels.begin());
	const int index = assembly.addMaterial(materialOf(*this, label));
	materialLabels.push_back(label);
	return index;
}

void BlockModel::requireFree(const blocks::Polygon& region) const
{
	for (size_t i = 0; i < regions.size(); ++i) {
		const blocks::Polygon& other    = regions[i];
		const Real             rounding = 16 * std::numeric_limits<Real>::epsilon() * blocks::largestCoordinate(region);
		const Real             touching = 1e-6 * std::min(blocks::meanWidth(region), blocks::meanWidth(other)) + rounding; // as near as that
		if (blocks::overlapDepth(region, other) > touching)
			throw std::invalid_argument("regions must not overlap: the new one overlaps region " + std::to_string(i) + " (the first is 0)");
	}
}

void BlockModel::requireOpen(const char* what) const
{
	if (firstBody >= 0) throw std::runtime_error(std::string(what) + " must come before BlockModel.insert(): the arrays are in use by now");
}

bool BlockModel::isIn(const Scene* scene) const
{
	int first = firstBody;
	while (first >= 0 && first - firstBody < assembly.blockCount() && assembly.isRemoved(first - firstBody))
		++first;
	if (first < 0 || size_t(first) >= scene->bodies->size()) return false;
	const auto& body  = (*scene->bodies)[first];
	const auto* block = body ? dynamic_cast<const Block*>(body->shape.get()) : nullptr;
	return block && block->model.get() == this;
}

int BlockModel::bond(const vector<shared_ptr<JointMat>>& list, Real tolerance)
{
	requireOpen("BlockModel.bond");
	blocks::BlockAssembly& a           = assembly;
	const int              materials   = int(materialLabels.size());
	auto                   found       = blocks::detectSegments(a, tolerance);
	const auto             materialsOf = [&](const std::array<int, 2>& block) -> std::array<int, 2> {
                return { a.mesh.blockMaterial[block[0]], a.mesh.blockMaterial[block[1]] };
	};
	if (!list.empty()) {
		std::set<std::array<int, 2>> touching;
		for (const blocks::Segment& g : found)
			touching.insert(materialsOf(g.block));
		for (const auto& [one, other] : touching) {
			const string &first = materialLabels[one], &second = materialLabels[other];
			if (!jointBetween(list, first, second))
				throw std::invalid_argument(
					"BlockModel.bond: joints has no JointMat for the pair of materials \"" + std::min(first, second) + "\" and \""
					+ std::max(first, second) + "\", whose blocks touch");
		}
	}
	for (const auto& joint : list) // a label that no block has is a mistake
		for (const string& label : { joint->material1, joint->material2 })
			if (std::find(materialLabels.begin(), materialLabels.end(), label) == materialLabels.end())
				throw std::invalid_argument("BlockModel.bond: a JointMat names the material \"" + label + "\", which no block has");
	a.bond(std::move(found));
	jointMats = list;
	a.joints.ofMaterials.assign(materials * materials, 0);
	for (const auto& joint : list) {
		auto index = [&](const string& label) { return int(std::find(materialLabels.begin(), materialLabels.end(), label) - materialLabels.begin()); };
		const int first = index(joint->material1), second = index(joint->material2), kind = a.addKind(blocks::neverBonded(joint->params()));
		a.joints.ofMaterials[first * materials + second] = a.joints.ofMaterials[second * materials + first] = kind;
	}
	if (!list.empty()) {
		const auto& pairs = a.joints.pairs;
		for (size_t pair = 0, next; pair < pairs.size(); pair = next) { // many have the same two materials one after another
			const auto of = materialsOf(pairs[pair].block);
			for (next = pair + 1; next < pairs.size() && materialsOf(pairs[next].block) == of;)
				++next;
			setJoints(pairs[pair].first, pairs[next - 1].last, *jointBetween(list, materialLabels[of[0]], materialLabels[of[1]]));
		}
	}
	return int(a.joints.pairs.size());
}

void BlockModel::setJoint(int pair, const JointMat& joint, const vector<shared_ptr<JointMat>>& all)
{
	const std::lock_guard<std::mutex> lock(complaintMutex);
	// all kinds at once, before any thread reads one of them: a list that grows later would move
	for (const auto& other : all)
		assembly.addKind(other->params(), other->softening());
	const auto& p = assembly.joints.pairs[pair];
	setJoints(p.first, p.last, joint);
}

void BlockModel::setJoints(int first, int last, const JointMat& joint)
{
	assembly.setJoints(first, last, joint.params(), joint.bonded ? blocks::Joint::intact : blocks::Joint::unbonded, joint.softening());
	stiffnessChanged();
}

string BlockModel::withoutJoint(int contact) const
{
	const blocks::FreeContact& c = assembly.state.contacts[contact];
	if (c.joint.kn > 0 || c.active.empty()) return "";
	const string first = materialLabels[assembly.mesh.blockMaterial[c.block[0]]], second = materialLabels[assembly.mesh.blockMaterial[c.block[1]]];
	return "there is no JointMat for the pair of materials \"" + std::min(first, second) + "\" and \"" + std::max(first, second) + "\", whose blocks "
		+ std::to_string(c.block[0]) + " and " + std::to_string(c.block[1]) + " touch and would pass through each other";
}

void BlockModel::requireProperties()
{
	if (propertiesKnown == version) return;
	const auto& joints = assembly.joints;
	for (int i = 0; i < joints.count(); ++i)
		if (joints.kind[i] == 0)
			throw std::runtime_error(
				"the joint between blocks " + std::to_string(joints.segments[i].block[0]) + " and "
				+ std::to_string(joints.segments[i].block[1])
				+ " has no properties: give JointMats to BlockModel.bond(), or use an InteractionLoop with Ip2_BlockMat_BlockMat_JointPhys and "
				  "BlockForces");
	propertiesKnown = version;
}

void BlockModel::requireBodies(const Scene* scene, int threads) const
{
	const auto& bodies = scene->bodies->body;
	blocks::forEachInParallel(assembly.blockCount(), threads, [&](int i) {
		const size_t id = firstBody + i;
		if ((id >= bodies.size() || !bodies[id]) && !assembly.isRemoved(i))
			throw std::runtime_error(
				"body " + std::to_string(id) + " was erased, but blocks cannot leave their model; BlockModel.remove takes them out of it");
	});
}

void BlockModel::writeCentroids(Scene* scene, int threads)
{
	blocks::forEachInParallel(assembly.blockCount(), threads, [&](int i) {
		if (assembly.isRigid(i) || assembly.isRemoved(i)) return; // it was the body that moved, or there is none
		const auto&        body     = (*scene->bodies)[firstBody + i];
		const blocks::Vec2 centroid = assembly.centroid(i);
		body->state->pos            = Vector3r(centroid.x(), centroid.y(), 0);
	});
}

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
		const string& label = materialLabels[assembly.mesh.blockMaterial[i]];
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

blocks::MotionGroup& BlockModel::group(const std::string& name)
{
	string known;
	for (blocks::MotionGroup& g : assembly.state.groups) {
		if (g.name == name) return g;
		known += (known.empty() ? "" : ", ") + g.name;
	}
	throw std::invalid_argument("no motion group \"" + name + "\"; there are: " + known);
}

int BlockModel::bodyOf(int block) const
{
	if (firstBody < 0) throw std::runtime_error("BlockModel.bodyOf: blocks have no bodies before BlockModel.insert()");
	blocks::require(block >= 0 && block < assembly.blockCount(), "BlockModel.bodyOf needs the index of a block", block);
	blocks::require(!assembly.isRemoved(block), "BlockModel.bodyOf: the block has been removed", block);
	return firstBody + block;
}

YADE_PLUGIN((BlockModel));

} // namespace yade
