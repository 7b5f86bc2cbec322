// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/Parallel.hpp>
#include <blocks/kernel/geometry/Polygon.hpp>
#include <blocks/kernel/step/TimeStep.hpp>
#include <blocks/views/Block.hpp>
#include <blocks/views/BlockModel.hpp>
#include <blocks/views/BlockState.hpp>
#include <core/Body.hpp>
#include <core/BodyContainer.hpp>
#include <limits>

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
