// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/step/ViscousBoundaries.hpp>

namespace blocks {
namespace {

	/// What of a dashpot acts on degrees of freedom that forces move.
	Dashpot acting(Dashpot d, const Vec2& mobility)
	{
		if (!(mobility.x() > 0)) d.xx = d.xy = 0;
		if (!(mobility.y() > 0)) d.yy = d.xy = 0;
		return d;
	}

	/// Boundary edges on which there are joints.
	std::vector<char> bondedEdges(const BlockAssembly& a)
	{
		std::vector<int> from(a.nodeCount(), -1); // grid point -> the boundary edge that starts there
		for (size_t e = 0; e < a.mesh.edgeNodes.size(); ++e)
			from[a.mesh.edgeNodes[e][0]] = int(e);
		std::vector<char> bonded(a.mesh.edgeNodes.size(), false);
		for (const Segment& g : a.joints.segments)
			bonded[from[g.node[0]]] = bonded[from[g.node[2]]] = true;
		return bonded;
	}

} // namespace

Impedance impedanceOf(const Material& m, Plane plane)
{
	const Moduli moduli = planeModuli(m.young, m.poisson, plane);
	return { std::sqrt(m.density * (moduli.lambda + 2 * moduli.mu)), std::sqrt(m.density * moduli.mu) };
}

void addViscous(BlockAssembly& a, const std::string& name, std::vector<int> nodes, const Impedance& given)
{
	const std::string what = "viscous boundary \"" + name + "\"";
	for (const ViscousBoundary& other : a.supports.viscous)
		if (other.name == name) throw std::invalid_argument("there is a " + what + " already");
	const bool own = given.normal == 0 && given.tangential == 0;
	for (Real z : { given.normal, given.tangential })
		require(own || (z > 0 && std::isfinite(z)), what + ": impedances must be positive and finite [Pa s/m]", z);
	require(!nodes.empty(), what + " must hold at least one grid point; count", 0);
	std::sort(nodes.begin(), nodes.end());
	nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
	for (int n : nodes) {
		require(n >= 0 && n < a.nodeCount(), what + ": no such grid point", n);
		require(a.mesh.mass[n] > 0, what + " holds a grid point of a rigid block, which moves with its body, or of a removed one; grid point", n);
	}
	std::vector<Dashpot> found(nodes.size());
	for (size_t i = 0; i < nodes.size(); ++i)
		found[i].node = nodes[i], found[i].boundary = int(a.supports.viscous.size());
	const std::vector<char> bonded = bondedEdges(a);
	for (int block = 0; block < a.blockCount(); ++block) {
		const Impedance z = own ? impedanceOf(a.mesh.materials[a.mesh.blockMaterial[block]], a.plane) : given;
		for (int e = a.mesh.firstEdge[block]; e < a.mesh.firstEdge[block + 1]; ++e) {
			Dashpot* ends[2];
			bool     all = !bonded[e];
			for (int k : { 0, 1 }) {
				const auto at = std::lower_bound(nodes.begin(), nodes.end(), a.mesh.edgeNodes[e][k]);
				all           = all && at != nodes.end() && *at == a.mesh.edgeNodes[e][k];
				ends[k]       = all ? &found[at - nodes.begin()] : nullptr;
			}
			if (!all) continue;
			const Vec2 t    = a.between(a.mesh.edgeNodes[e][0], a.mesh.edgeNodes[e][1]);
			const Real half = t.norm() * a.thickness / 2, cc = t.x() * t.x() / t.squaredNorm(), ss = t.y() * t.y() / t.squaredNorm(),
				   cs = t.x() * t.y() / t.squaredNorm();
			for (Dashpot* d : ends) { // normal (sin, -cos), tangent (cos, sin)
				d->xx += half * (z.normal * ss + z.tangential * cc);
				d->yy += half * (z.normal * cc + z.tangential * ss);
				d->xy += half * (z.tangential - z.normal) * cs;
			}
		}
	}
	for (const Dashpot& d : found)
		require(d.xx > 0, what + ": no boundary edge without a joint joins this grid point to another one of them; grid point", d.node);

	std::vector<Dashpot>& all      = a.supports.dashpots;
	const auto            previous = all;
	all.insert(all.end(), found.begin(), found.end());
	std::stable_sort(all.begin(), all.end(), [](const Dashpot& p, const Dashpot& q) { return p.node < q.node; });
	a.supports.viscous.push_back({ name, {}, {} });
	try {
		a.requireDashpotsMove();
	} catch (...) {
		all = previous;
		a.supports.viscous.pop_back();
		throw;
	}
}

int viscousOf(const BlockAssembly& a, const std::string& name)
{
	std::string known;
	for (size_t i = 0; i < a.supports.viscous.size(); ++i) {
		if (a.supports.viscous[i].name == name) return int(i);
		known += (known.empty() ? "" : ", ") + a.supports.viscous[i].name;
	}
	throw std::invalid_argument("no viscous boundary \"" + name + "\"; there are: " + (known.empty() ? "none" : known));
}

void setIncoming(BlockAssembly& a, int boundary, std::vector<Real> times, std::vector<Vec2> velocities)
{
	ViscousBoundary&  b    = a.supports.viscous[boundary];
	const std::string what = "viscous boundary \"" + b.name + "\": ";
	require(times.size() == velocities.size(), what + "an incoming wave needs a velocity for each time; velocities", Real(velocities.size()));
	require(times.size() >= 2, what + "an incoming wave needs two times at least; times", Real(times.size()));
	for (size_t i = 0; i < times.size(); ++i) {
		require(std::isfinite(times[i]) && (i == 0 || times[i] > times[i - 1]), what + "times of an incoming wave must ascend [s]", times[i]);
		require(velocities[i].allFinite(),
		        what + "velocities of an incoming wave must be finite [m/s]",
		        velocities[i].allFinite() ? 0 : velocities[i].sum());
	}
	b.times = std::move(times), b.incoming = std::move(velocities);
}

void releaseViscous(BlockAssembly& a, int boundary)
{
	auto& all = a.supports.dashpots;
	all.erase(std::remove_if(all.begin(), all.end(), [=](const Dashpot& d) { return d.boundary == boundary; }), all.end());
	for (Dashpot& d : all)
		d.boundary -= d.boundary > boundary;
	a.supports.viscous.erase(a.supports.viscous.begin() + boundary);
}

Vec2 viscousForce(const BlockAssembly& a, int boundary, Real time)
{
	const Vec2 twice = 2 * a.supports.viscous[boundary].incomingAt(time);
	Vec2       sum   = Vec2::Zero();
	for (const Dashpot& d : a.supports.dashpots)
		if (d.boundary == boundary) sum += acting(d, a.supports.mobility[d.node]) * (twice - a.state.velocity[d.node]);
	return sum;
}

Real viscousPower(const BlockAssembly& a, Real time)
{
	Real sum = 0;
	for (const Dashpot& d : a.supports.dashpots) {
		const Vec2& v = a.state.velocity[d.node];
		sum += v.dot(acting(d, a.supports.mobility[d.node]) * (2 * a.supports.viscous[d.boundary].incomingAt(time) - v));
	}
	return sum;
}

void ViscousStep::begin(const BlockAssembly& a)
{
	before.clear();
	for (const Dashpot& d : a.supports.dashpots)
		before.push_back(a.state.velocity[d.node]);
}

Real ViscousStep::end(BlockAssembly& a, Real dt, Real time, StepWork& work) const
{
	std::vector<Vec2> wave; // of each boundary
	for (const ViscousBoundary& b : a.supports.viscous)
		wave.push_back(b.incomingAt(time));
	FurtherAccounts& booked   = a.state.further;
	const Real       incoming = booked.pendingIncoming, viscous = booked.pendingViscous;
	booked.pendingIncoming = booked.pendingViscous = 0;
	Real        incomingBefore = 0, viscousBefore = 0, fastest = 0;
	const auto& all = a.supports.dashpots;
	for (size_t first = 0, last; first < all.size(); first = last) { // those of one grid point
		const int  n = all[first].node;
		const Vec2 w = a.supports.mobility[n], v = before[first], without = a.state.velocity[n], force = a.forces.nodal[n];
		Dashpot    sum;
		Vec2       pull = Vec2::Zero();
		for (last = first; last < all.size() && all[last].node == n; ++last) {
			const Dashpot d = acting(all[last], w);
			sum.xx += d.xx, sum.xy += d.xy, sum.yy += d.yy;
			pull += d * (2 * wave[d.boundary]);
		}
		// (1 + dt/2 W C) v_after = v_without + dt W (pull - C v_before / 2)
		const Vec2 right = without + dt * w.cwiseProduct(pull - sum * v / 2), h = dt / 2 * w;
		const Real axx = 1 + h.x() * sum.xx, axy = h.x() * sum.xy, ayx = h.y() * sum.xy, ayy = 1 + h.y() * sum.yy, det = axx * ayy - axy * ayx;
		const Vec2 after((ayy * right.x() - axy * right.y()) / det, (axx * right.y() - ayx * right.x()) / det);
		a.state.velocity[n] = after;
		a.state.displacement[n] += dt * (after - without);
		fastest = std::max(fastest, after.cwiseAbs().maxCoeff());
		for (int axis : { 0, 1 }) // what was turned over as if there were no dashpots
			if (w[axis] > 0) {
				const Real drag = force[axis] - (without[axis] - v[axis]) / (w[axis] * dt);
				work.dampingAfter += drag * (after[axis] - without[axis]) * dt / 2;
				work.kinetic += (after[axis] - without[axis]) * v[axis] / (2 * w[axis]);
			}
		const Vec2 mean = (v + after) / 2;
		for (size_t i = first; i < last; ++i) { // each half by the velocity of its half step
			const Dashpot d    = acting(all[i], w);
			const Vec2&   in   = wave[d.boundary];
			const Vec2    by   = d * (2 * in - mean);
			const Real    half = in.dot(d * in) * dt / 2;
			incomingBefore += half, booked.pendingIncoming += half;
			viscousBefore += half - by.dot(v) * dt / 2;
			booked.pendingViscous += half - by.dot(after) * dt / 2;
		}
	}
	booked.incoming += incoming + incomingBefore;
	booked.viscous += viscous + viscousBefore;
	return fastest;
}

} // namespace blocks
