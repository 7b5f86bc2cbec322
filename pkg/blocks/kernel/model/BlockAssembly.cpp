// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/geometry/Polygon.hpp>
#include <blocks/kernel/model/BlockAssembly.hpp>

namespace blocks {

int BlockAssembly::addMaterial(const Material& m)
{
	require(m.young > 0 && std::isfinite(m.young), "BlockMat.young must be positive and finite [Pa]", m.young);
	require(m.poisson > -1 && m.poisson < 0.5, "BlockMat.poisson must lie in (-1, 0.5)", m.poisson);
	require(m.density > 0 && std::isfinite(m.density), "BlockMat.density must be positive and finite [kg/m3]", m.density);
	mesh.materials.push_back(m);
	return int(mesh.materials.size()) - 1;
}

int BlockAssembly::addBlock(
	const std::vector<Vec2>& points, const std::vector<std::vector<int>>& rings, const std::vector<std::array<int, 3>>& triangles, int material)
{
	require(thickness > 0 && std::isfinite(thickness), "thickness must be positive and finite [m]", thickness);
	require(material >= 0 && material < int(mesh.materials.size()), "a block's material must be the index of a known one", material);
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
		const Real area = twiceArea(points[t[0]], points[t[1]], points[t[2]]) / 2;
		require(area > 0, "a zone's area must be positive (counter-clockwise) [m2]", area);
		for (int node : t)
			nodalMass[node] += area * thickness * mesh.materials[material].density / 3;
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
		const AreaSum sum = moments(points, edges.begin(), edges.end());
		require(sum.area() > 0, "a rigid block's holes must be smaller than itself; area [m2]", sum.area());
		rigidBlock.block  = blockCount();
		rigidBlock.origin = rigidBlock.centre = sum.centroid();
		rigidBlock.mass = rigidBlock.inertia = sum.area() * thickness * mesh.materials[material].density;
		rigidBlock.moment = rigidBlock.rotaryInertia = sum.secondMoment() * thickness * mesh.materials[material].density;
	}

	// everything is as it should be: from here on nothing can fail half-way
	for (const auto& t : triangles)
		mesh.zoneNodes.push_back({ base + t[0], base + t[1], base + t[2] });
	for (const auto& ring : rings)
		for (size_t i = 0; i < ring.size(); ++i)
			mesh.edgeNodes.push_back({ base + ring[i], base + ring[(i + 1) % ring.size()] });
	mesh.reference.insert(mesh.reference.end(), points.begin(), points.end());
	mesh.mass.insert(mesh.mass.end(), nodalMass.begin(), nodalMass.end());
	mesh.blockMaterial.push_back(material);
	mesh.firstNode.push_back(nodeCount());
	mesh.firstZone.push_back(zoneCount());
	mesh.firstEdge.push_back(int(mesh.edgeNodes.size()));

	state.displacement.resize(nodeCount(), Vec2::Zero());
	state.velocity.resize(nodeCount(), Vec2::Zero());
	state.inertia.insert(state.inertia.end(), nodalMass.begin(), nodalMass.end());
	if (triangles.empty()) state.rigid.push_back(rigidBlock);
	for (Real m : nodalMass)
		supports.mobility.push_back(Vec2::Constant(m > 0 ? 1 / m : 0));
	if (!supports.load.empty()) supports.load.resize(nodeCount(), Vec2::Zero());
	forces.nodal.resize(nodeCount(), Vec2::Zero());

	contacts.started = false; // nobody has looked at it yet
	rebuildZones(blockCount() - 1);
	return blockCount() - 1;
}

int BlockAssembly::blockOfNode(int node) const
{
	return int(std::upper_bound(mesh.firstNode.begin(), mesh.firstNode.end(), node) - mesh.firstNode.begin()) - 1;
}

std::vector<int> BlockAssembly::presentBlocks() const
{
	std::vector<int> list;
	for (int b = 0; b < blockCount(); ++b)
		if (!isRemoved(b)) list.push_back(b);
	return list;
}

Vec2 BlockAssembly::centroid(int block) const
{
	const int first = mesh.firstNode[block], last = mesh.firstNode[block + 1];
	if (isRigid(block)) {
		std::vector<Vec2> points;
		for (int n = first; n < last; ++n)
			points.push_back(between(first, n));
		std::vector<std::array<int, 2>> edges(mesh.edgeNodes.begin() + mesh.firstEdge[block], mesh.edgeNodes.begin() + mesh.firstEdge[block + 1]);
		for (auto& edge : edges)
			edge[0] -= first, edge[1] -= first;
		return position(first) + moments(points, edges.begin(), edges.end()).centroid();
	}
	if (isRemoved(block)) return position(first); // it has no mass any more
	Vec2 sum   = Vec2::Zero();
	Real total = 0;
	for (int n = first; n < last; ++n) {
		sum += mesh.mass[n] * between(first, n);
		total += mesh.mass[n];
	}
	return position(first) + sum / total;
}

void BlockAssembly::rebuildZones(int firstBlock)
{
	mesh.zoneGradient.resize(zoneCount());
	mesh.zoneVolume.resize(zoneCount());
	mesh.isFan.resize(blockCount());
	for (int block = firstBlock; block < blockCount(); ++block) {
		const int node = mesh.firstNode[block], corners = mesh.firstNode[block + 1] - node - 1, zone = mesh.firstZone[block];
		bool      fan = mesh.firstZone[block + 1] - zone == corners;
		for (int z = zone; z < mesh.firstZone[block + 1]; ++z) {
			const auto& n  = mesh.zoneNodes[z];
			const Vec2 &x0 = mesh.reference[n[0]], &x1 = mesh.reference[n[1]], &x2 = mesh.reference[n[2]];
			mesh.zoneGradient.set(z, zoneGradients(x0, x1, x2));
			mesh.zoneVolume[z] = thickness * twiceArea(x0, x1, x2) / 2;
			const int k        = z - zone;
			fan                = fan && n[0] == node + k && n[1] == node + (k + 1) % corners && n[2] == node + corners;
		}
		mesh.isFan[block] = fan;
	}
}

void BlockAssembly::rebuild()
{
	rebuildZones(0);
	rebuildJoints();
	rebuildContacts(*this);
	forces.nodal.resize(nodeCount(), Vec2::Zero());
	supports.mobility.resize(nodeCount());
	updateMobility();
}

void BlockAssembly::restore(const State& earlier)
{
	state = earlier;
	if (!forces.before.status.empty()) forces.before.take(state); // nothing is dissipated on the way back
	noteKinds(0, joints.count());
	rebuildContacts(*this);
	updateMobility();
}

int BlockAssembly::firstBadNode() const
{
	for (int n = 0; n < nodeCount(); ++n)
		if (!state.displacement[n].allFinite() || !state.velocity[n].allFinite()) return n;
	return -1;
}

} // namespace blocks
