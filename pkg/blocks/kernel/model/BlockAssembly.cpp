// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/geometry/Polygon.hpp>
#include <blocks/kernel/laws/JointKinematics.hpp>
#include <blocks/kernel/model/BlockAssembly.hpp>
#include <cassert>
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
		const Real area = cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]) / 2;
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
		const AreaSum sum = momentsOf(points, edges.begin(), edges.end());
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
		return position(first) + momentsOf(points, edges.begin(), edges.end()).centroid();
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

void BlockAssembly::bond(std::vector<Segment> found)
{
	std::stable_sort(found.begin(), found.end(), [](const Segment& a, const Segment& b) { return a.block < b.block; });
	joints.segments = std::move(found);
	joints.pairs.clear();
	for (int i = 0; i < joints.count(); ++i) {
		auto& pairs = joints.pairs;
		if (pairs.empty() || pairs.back().block != joints.segments[i].block) pairs.push_back({ joints.segments[i].block, i, i });
		pairs.back().last = i + 1;
	}
	joints.kinds.assign(1, JointParams());
	joints.ofMaterials.clear(); // its kinds are no more
	joints.softening.clear();
	joints.inSituOpening.clear(), joints.inSituSlip.clear();
	joints.names.clear(), joints.nameOf.clear();
	state.softened   = {};
	state.lawColumns = {};
	joints.kind.assign(joints.count(), 0);
	for (auto* column : { &state.opening, &state.slip, &state.sigma, &state.tau, &state.slipPlastic, &state.uplift })
		column->assign(pointCount(), 0);
	state.status.assign(pointCount(), Joint::intact);
	state.released.assign(joints.count(), false);
	rebuildJoints();
}

int BlockAssembly::addKind(const JointParams& params, const SofteningParams& softening)
{
	validate(params);
	validate(params, softening);
	auto& kinds = joints.kinds;
	if (softening.softens() && !joints.anySoftens()) {
		joints.softening.resize(kinds.size());
		state.softened.start(pointCount());
	}
	constexpr int remembered = 64; // where every joint has its own properties, looking for equal ones is in vain
	const int     count      = int(kinds.size());
	for (int kind = std::max(0, count - remembered); kind < count; ++kind)
		if (kinds[kind] == params && (!joints.anySoftens() || joints.softening[kind] == softening)) return kind;
	kinds.push_back(params);
	if (joints.anySoftens()) joints.softening.push_back(softening);
	joints.anyCap = joints.anyCap || softening.cap.strength > 0;
	return count;
}

void BlockAssembly::setJoints(int first, int last, const JointParams& params, Joint status, const SofteningParams& softening)
{
	const int kind = addKind(params, softening);
	for (int i = first; i < last; ++i) {
		joints.kind[i] = kind;
		for (int k : { 0, 1 })
			state.status[2 * i + k] = status;
		if (status != Joint::intact) forces.broke[i / Joints::batch] = true;
	}
	noteKinds(first, last);
}

void BlockAssembly::nameJoints(const std::string& name, const std::vector<int>& which)
{
	if (name.empty()) throw std::invalid_argument("a name of joints must not be empty");
	for (int i : which)
		require(i >= 0 && i < joints.count(), "name of joints \"" + name + "\": there is no such joint", i);
	if (which.empty()) throw std::invalid_argument("name of joints \"" + name + "\": there must be at least one joint");
	auto& names = joints.names;
	joints.nameOf.resize(joints.count(), Joints::unnamed);
	const int number = int(std::find(names.begin(), names.end(), name) - names.begin());
	if (number == int(names.size())) names.push_back(name);
	for (int i : which)
		joints.nameOf[i] = number;

	std::vector<int> left(names.size(), 0); // of each name, how many joints have it
	for (int of : joints.nameOf)
		if (of != Joints::unnamed) ++left[of];
	for (int k = int(names.size()) - 1; k >= 0; --k) {
		if (left[k]) continue;
		names.erase(names.begin() + k);
		for (int& of : joints.nameOf)
			if (of > k) --of;
	}
}

void BlockAssembly::requireChangeable(int joint, const JointParams& params, const SofteningParams& softening) const
{
	validate(params);
	validate(params, softening);
	for (int p : { 2 * joint, 2 * joint + 1 })
		require(softening.softens() || state.status[p] != Joint::softening, "a joint that has begun to soften cannot become brittle; joint", joint);
}

void BlockAssembly::changeJoint(int joint, const JointParams& params, const SofteningParams& softening)
{
	requireChangeable(joint, params, softening);
	if (softening.softens() && !joints.softens(joint)) { // what has broken stays broken
		addKind(params, softening);                  // the columns are there now
		for (int p : { 2 * joint, 2 * joint + 1 })
			if (state.status[p] != Joint::intact && state.status[p] != Joint::unbonded) state.softened.k[p] = softeningEnd;
	}
	joints.kind[joint] = addKind(params, softening);
	noteKinds(joint, joint + 1);
}

void BlockAssembly::releaseJoint(int joint)
{
	state.released[joint] = true;
	noteKinds(joint, joint + 1);
}

void BlockAssembly::noteKinds(int first, int last)
{
	for (int i = first; i < last; ++i) {
		joints.effective[i]    = state.released[i] ? releasedKind : joints.kind[i];
		joints.columns.area[i] = state.released[i] ? 0 : joints.segments[i].area;
	}
	for (int b = first / Joints::batch; b * Joints::batch < last; ++b) {
		const auto begin      = joints.effective.begin() + b * Joints::batch;
		const auto end        = joints.effective.begin() + std::min((b + 1) * Joints::batch, joints.count());
		joints.kindOfBatch[b] = std::all_of(begin, end, [&](int kind) { return kind == *begin; }) ? *begin : mixedKinds;
	}
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
			mesh.zoneVolume[z] = thickness * cross(x1 - x0, x2 - x0) / 2;
			const int k        = z - zone;
			fan                = fan && n[0] == node + k && n[1] == node + (k + 1) % corners && n[2] == node + corners;
		}
		mesh.isFan[block] = fan;
	}
}

/// Whether the first edge is all that the columns say of a joint.
static bool isMatched(const JointColumns& c, int i)
{
	for (int k : { 0, 1 })
		if (c.s1[k][i] != k || c.s2[k][i] != 1 - k || c.bondOpening[k][i] != 0 || c.bondSlip[k][i] != 0) return false;
	return c.e2x[i] == -c.e1x[i] && c.e2y[i] == -c.e1y[i] && c.dx[i] == c.e1x[i] && c.dy[i] == c.e1y[i];
}

void BlockAssembly::rebuildJoints()
{
	const int     count = joints.count(), batches = (count + Joints::batch - 1) / Joints::batch;
	JointColumns& c = joints.columns;
	for (auto* column : { &c.e1x, &c.e1y, &c.e2x, &c.e2y, &c.dx, &c.dy, &c.area })
		column->resize(count);
	for (int k : { 0, 1 })
		for (auto* column : { &c.s1[k], &c.s2[k], &c.bondOpening[k], &c.bondSlip[k] })
			column->resize(count);
	assert(std::is_sorted(joints.segments.begin(), joints.segments.end(), [](const Segment& g, const Segment& h) { return g.block[0] < h.block[0]; }));
	joints.node.resize(count);
	joints.effective.resize(count);
	joints.kindOfBatch.resize(batches);
	c.matched.assign(batches, true);
	joints.anyCap = std::any_of(joints.softening.begin(), joints.softening.end(), [](const SofteningParams& s) { return s.cap.strength > 0; });
	forces.broke.assign(batches, false);
	for (int i = 0; i < count; ++i) {
		const Segment& g  = joints.segments[i];
		const Vec2     e1 = mesh.reference[g.node[1]] - mesh.reference[g.node[0]], e2 = mesh.reference[g.node[3]] - mesh.reference[g.node[2]];
		const Vec2     d = mesh.reference[g.node[2]] - mesh.reference[g.node[0]];
		joints.node[i]   = g.node;
		c.e1x[i] = e1.x(), c.e1y[i] = e1.y(), c.e2x[i] = e2.x(), c.e2y[i] = e2.y(), c.dx[i] = d.x(), c.dy[i] = d.y();
		const JointFrame f = jointFrame(e1.x(), e1.y(), e2.x(), e2.y());
		for (int k : { 0, 1 }) {
			const Vec2 gap      = d + g.s2[k] * e2 - g.s1[k] * e1;
			c.s1[k][i]          = g.s1[k];
			c.s2[k][i]          = g.s2[k];
			c.bondOpening[k][i] = gap.x() * f.nx + gap.y() * f.ny;
			c.bondSlip[k][i]    = gap.y() * f.nx - gap.x() * f.ny;
			if (joints.inSituOpening.empty()) continue;
			c.bondOpening[k][i] -= joints.inSituOpening[i][k];
			c.bondSlip[k][i] -= joints.inSituSlip[i][k];
		}
		if (!isMatched(c, i)) c.matched[i / Joints::batch] = false;
	}
	if (count > 0) noteKinds(0, count);
	forces.parts = {};
	joints.blocksOfBatch.resize(batches);
	for (int b = 0; b < batches; ++b) {
		BlockRange& blocks = joints.blocksOfBatch[b];
		blocks             = { joints.segments[b * Joints::batch].block[0], 0 };
		for (int i = b * Joints::batch; i < std::min(count, (b + 1) * Joints::batch); ++i)
			blocks.last = std::max(blocks.last, joints.segments[i].block[1]);
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
		require(mesh.mass[dof / 2] > 0,
		        "motion group \"" + group.name + "\" holds a grid point of a rigid block, which moves with its body; grid point",
		        dof / 2);
		for (const MotionGroup& other : state.groups)
			require(!std::binary_search(other.dofs.begin(), other.dofs.end(), dof),
			        "motion group \"" + group.name + "\" overlaps \"" + other.name + "\" at degree of freedom (2 node + axis)",
			        dof);
	}
	state.groups.push_back(std::move(group));
	try {
		requireDashpotsMove();
	} catch (...) {
		state.groups.pop_back();
		throw;
	}
	updateMobility();
	return int(state.groups.size()) - 1;
}

void BlockAssembly::releaseGroup(int group)
{
	const MotionGroup& g        = state.groups[group];
	ReleasedWork&      released = state.accounts.released;
	released.work += g.work + g.pendingWork; // the half step since the last time of forces is past, too
	released.turnover += g.workTurnover + std::abs(g.pendingWork);
	state.groups.erase(state.groups.begin() + group);
	updateMobility();
}

void BlockAssembly::requireDashpotsMove() const
{
	if (supports.dashpots.empty()) return;
	std::vector<int>  axes(nodeCount(), 0);
	std::vector<char> pushed(nodeCount(), false);
	for (const MotionGroup& g : state.groups)
		for (int dof : g.dofs) {
			++axes[dof / 2];
			if (g.drive == MotionGroup::Drive::force) pushed[dof / 2] = true;
		}
	for (const Dashpot& d : supports.dashpots) {
		const std::string what = "viscous boundary \"" + supports.viscous[d.boundary].name + "\": ";
		require(!pushed[d.node], what + "no group may push its grid points; grid point", d.node);
		require(axes[d.node] < 2, what + "its grid points must be free along one axis at least; grid point", d.node);
	}
}

void BlockAssembly::updateMobility()
{
	for (int n = 0; n < nodeCount(); ++n)
		supports.mobility[n] = Vec2::Constant(state.inertia[n] > 0 ? 1 / state.inertia[n] : 0);
	for (const MotionGroup& g : state.groups)
		for (int dof : g.dofs)
			supports.mobility[dof / 2][dof % 2] = 0;
}

int BlockAssembly::firstBadNode() const
{
	for (int n = 0; n < nodeCount(); ++n)
		if (!state.displacement[n].allFinite() || !state.velocity[n].allFinite()) return n;
	return -1;
}

bool edgesTurned(const BlockAssembly& a, int joint)
{
	const auto& node = a.joints.segments[joint].node;
	return a.between(node[0], node[1]).dot(a.between(node[2], node[3])) > 0;
}

bool edgesPassed(const BlockAssembly& a, int joint)
{
	const auto& node = a.joints.segments[joint].node;
	const Real  slip = std::min(std::abs(a.state.slip[2 * joint]), std::abs(a.state.slip[2 * joint + 1]));
	return edgesTurned(a, joint) || slip > a.between(node[0], node[1]).norm() + a.between(node[2], node[3]).norm();
}

} // namespace blocks
