// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/geometry/Polygon.hpp>
#include <blocks/kernel/model/BlockAssembly.hpp>
#include <blocks/kernel/step/ContactKinematics.hpp>
#include <numeric>

namespace blocks {
namespace {

	/// What lies to the left of closed lines, given as edges.
	template <class Iterator> AreaSum momentsOf(const std::vector<Vec2>& points, Iterator begin, Iterator end)
	{
		AreaSum sum(points[(*begin)[0]]);
		for (; begin != end; ++begin)
			sum.add(points[(*begin)[0]], points[(*begin)[1]]);
		return sum;
	}

} // namespace

int BlockAssembly::addMaterial(const Material& m)
{
	require(m.young > 0 && std::isfinite(m.young), "BlockMat.young must be positive and finite [Pa]", m.young);
	require(m.poisson > -1 && m.poisson < 0.5, "BlockMat.poisson must lie in (-1, 0.5)", m.poisson);
	require(m.density > 0 && std::isfinite(m.density), "BlockMat.density must be positive and finite [kg/m3]", m.density);
	materials.push_back(m);
	return int(materials.size()) - 1;
}

int BlockAssembly::addBlock(
	const std::vector<Vec2>& points, const std::vector<std::vector<int>>& rings, const std::vector<std::array<int, 3>>& triangles, int material)
{
	require(thickness > 0 && std::isfinite(thickness), "thickness must be positive and finite [m]", thickness);
	require(material >= 0 && material < int(materials.size()), "a block's material must be the index of a known one", material);
	const int base = nodeCount(), count = int(points.size());
	for (const Vec2& p : points)
		require(p.allFinite(), "a block's points must be finite", p.allFinite() ? 0 : std::nan(""));

	require(!rings.empty(), "a block needs an outline; rings", 0);
	for (size_t r = 0; r < rings.size(); ++r) {
		require(rings[r].size() >= 3, "a block's outline needs at least 3 points", Real(rings[r].size()));
		Ring ring;
		for (int node : rings[r]) {
			require(node >= 0 && node < count, "an outline's node must be one of the block's points", node);
			ring.push_back(points[node]);
		}
		for (size_t i = 0; i < ring.size(); ++i)
			require(ring[i] != ring[(i + 1) % ring.size()], "a block's edges must have a length [m]", 0);
		const Real area = signedArea(ring);
		require(r == 0 ? area > 0 : area < 0, "a block's outline must be counter-clockwise and its holes clockwise; signed area [m2]", area);
	}
	std::vector<Real> nodalMass(points.size(), 0);
	for (const auto& t : triangles) {
		for (int node : t)
			require(node >= 0 && node < count, "a zone's node must be one of the block's points", node);
		const Real area = cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]) / 2;
		require(area > 0, "a zone's area must be positive (counter-clockwise) [m2]", area);
		for (int node : t)
			nodalMass[node] += area * thickness * materials[material].density / 3;
	}
	if (!triangles.empty())
		for (Real m : nodalMass)
			require(m > 0, "every point of a deformable block must belong to a zone; mass [kg]", m);

	RigidBlock rigidBlock;
	if (triangles.empty()) {
		std::vector<std::array<int, 2>> edges;
		for (const auto& ring : rings)
			for (size_t i = 0; i < ring.size(); ++i)
				edges.push_back({ ring[i], ring[(i + 1) % ring.size()] });
		const AreaSum sum = momentsOf(points, edges.begin(), edges.end());
		require(sum.area() > 0, "a rigid block's holes must be smaller than itself; area [m2]", sum.area());
		rigidBlock.block  = blockCount();
		rigidBlock.origin = rigidBlock.centre = sum.centroid();
		rigidBlock.mass = rigidBlock.inertia = sum.area() * thickness * materials[material].density;
		rigidBlock.moment = rigidBlock.rotaryInertia = sum.secondMoment() * thickness * materials[material].density;
	}

	// everything is as it should be: from here on nothing can fail half-way
	for (const auto& t : triangles)
		zoneNodes.push_back({ base + t[0], base + t[1], base + t[2] });
	for (const auto& ring : rings)
		for (size_t i = 0; i < ring.size(); ++i)
			edgeNodes.push_back({ base + ring[i], base + ring[(i + 1) % ring.size()] });
	reference.insert(reference.end(), points.begin(), points.end());
	position.insert(position.end(), points.begin(), points.end());
	velocity.resize(position.size(), Vec2::Zero());
	force.resize(position.size(), Vec2::Zero());
	mass.insert(mass.end(), nodalMass.begin(), nodalMass.end());
	inertia.insert(inertia.end(), nodalMass.begin(), nodalMass.end());
	for (Real m : nodalMass)
		mobility.push_back(Vec2::Constant(m > 0 ? 1 / m : 0));
	if (!load.empty()) load.resize(position.size(), Vec2::Zero());
	if (triangles.empty()) rigid.push_back(rigidBlock);

	rebuildZones(zoneCount() - int(triangles.size()));

	blockMaterial.push_back(material);
	firstNode.push_back(nodeCount());
	firstZone.push_back(zoneCount());
	firstEdge.push_back(int(edgeNodes.size()));
	firstSide.push_back(int(sides.size()));
	return blockCount() - 1;
}

int BlockAssembly::blockOfNode(int node) const { return int(std::upper_bound(firstNode.begin(), firstNode.end(), node) - firstNode.begin()) - 1; }

Vec2 BlockAssembly::centroid(int block) const
{
	if (firstZone[block] == firstZone[block + 1])
		return momentsOf(position, edgeNodes.begin() + firstEdge[block], edgeNodes.begin() + firstEdge[block + 1]).centroid();
	Vec2 sum   = Vec2::Zero();
	Real total = 0;
	for (int n = firstNode[block]; n < firstNode[block + 1]; ++n) {
		sum += mass[n] * (position[n] - position[firstNode[block]]);
		total += mass[n];
	}
	return position[firstNode[block]] + sum / total;
}

Polygon BlockAssembly::outline(int block) const
{
	std::vector<Ring> rings;
	for (int e = firstEdge[block], first = -1; e < firstEdge[block + 1]; ++e) {
		if (first < 0) rings.emplace_back(), first = edgeNodes[e][0];
		rings.back().push_back(position[edgeNodes[e][0]]);
		if (edgeNodes[e][1] == first) first = -1;
	}
	return { rings[0], { rings.begin() + 1, rings.end() } };
}

void BlockAssembly::bond(std::vector<Segment> found)
{
	std::stable_sort(found.begin(), found.end(), [](const Segment& a, const Segment& b) { return a.block < b.block; });
	segments = std::move(found);
	pairs.clear();
	for (int i = 0; i < int(segments.size()); ++i) {
		if (pairs.empty() || pairs.back().block != segments[i].block) pairs.push_back({ segments[i].block, i, i });
		pairs.back().last = i + 1;
	}
	joints.assign(pairs.size(), {});
	points.assign(2 * segments.size(), {});
	rebuildJoints();
	for (size_t i = 0; i < points.size(); ++i) {
		const Vec2 d          = hostDistance(segments[i / 2], frames[i / 2], position.data(), int(i % 2));
		points[i].bondOpening = d.x();
		points[i].bondSlip    = d.y();
	}
}

void BlockAssembly::rebuildZones(int first)
{
	zoneGradient.resize(zoneCount());
	zoneVolume.resize(zoneCount());
	for (int z = first; z < zoneCount(); ++z) {
		const Vec2 &x0 = reference[zoneNodes[z][0]], &x1 = reference[zoneNodes[z][1]], &x2 = reference[zoneNodes[z][2]];
		zoneGradient[z] = zoneGradients(x0, x1, x2);
		zoneVolume[z]   = thickness * cross(x1 - x0, x2 - x0) / 2;
	}
}

void BlockAssembly::rebuildJoints()
{
	const int count = int(segments.size());
	frames.resize(count);
	segmentForce.assign(count, { Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero() });
	for (int i = 0; i < count; ++i)
		frames[i] = segmentFrame(segments[i], position.data());
	listSides();
}

void BlockAssembly::listSides()
{
	firstSide.assign(blockCount() + 1, 0);
	for (const Segment& g : segments)
		if (!g.released())
			for (int block : g.block)
				++firstSide[block + 1];
	std::partial_sum(firstSide.begin(), firstSide.end(), firstSide.begin());
	sides.resize(firstSide.back());
	std::vector<int> next(firstSide.begin(), firstSide.end() - 1);
	for (int i = 0; i < int(segments.size()); ++i)
		if (!segments[i].released())
			for (int side : { 0, 1 })
				sides[next[segments[i].block[side]]++] = 2 * i + side;
}

void BlockAssembly::rebuild()
{
	rebuildZones(0);
	rebuildJoints();
	rebuildContacts(*this);
	mobility.resize(nodeCount());
	updateMobility();
}

int BlockAssembly::addGroup(MotionGroup group)
{
	std::sort(group.dofs.begin(), group.dofs.end());
	require(!group.dofs.empty(), "motion group \"" + group.name + "\" must hold at least one degree of freedom; count", 0);
	require(std::isfinite(group.target), "motion group \"" + group.name + "\": target must be finite", group.target);
	require(group.rampTime >= 0 && std::isfinite(group.rampTime), "motion group \"" + group.name + "\": rampTime must not be negative [s]", group.rampTime);
	require(std::isfinite(group.startTime), "motion group \"" + group.name + "\": startTime must be finite [s]", group.startTime);
	for (size_t i = 0; i < group.dofs.size(); ++i) {
		const int dof = group.dofs[i];
		require(dof >= 0 && dof < 2 * nodeCount(), "motion group \"" + group.name + "\": no such degree of freedom", dof);
		require(i == 0 || group.dofs[i - 1] != dof, "motion group \"" + group.name + "\" names a degree of freedom twice", dof);
		require(mass[dof / 2] > 0,
		        "motion group \"" + group.name + "\" holds a grid point of a rigid block, which moves with its body; grid point",
		        dof / 2);
		for (const MotionGroup& other : groups)
			require(!std::binary_search(other.dofs.begin(), other.dofs.end(), dof),
			        "motion group \"" + group.name + "\" overlaps \"" + other.name + "\" at degree of freedom (2 node + axis)",
			        dof);
	}
	groups.push_back(std::move(group));
	updateMobility();
	return int(groups.size()) - 1;
}

void BlockAssembly::releaseGroup(int group)
{
	const MotionGroup& g = groups[group];
	released.work += g.work + g.pendingWork; // the half step since the last time of forces is past, too
	released.turnover += g.workTurnover + std::abs(g.pendingWork);
	groups.erase(groups.begin() + group);
	updateMobility();
}

void BlockAssembly::updateMobility()
{
	for (int n = 0; n < nodeCount(); ++n)
		mobility[n] = Vec2::Constant(inertia[n] > 0 ? 1 / inertia[n] : 0);
	for (const MotionGroup& g : groups)
		for (int dof : g.dofs)
			mobility[dof / 2][dof % 2] = 0;
}

int BlockAssembly::firstBadNode() const
{
	for (int n = 0; n < nodeCount(); ++n)
		if (!position[n].allFinite() || !velocity[n].allFinite()) return n;
	return -1;
}

} // namespace blocks
