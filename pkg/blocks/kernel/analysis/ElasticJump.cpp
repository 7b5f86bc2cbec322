// yade-blocks, GPL-2.0-or-later
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <blocks/kernel/analysis/ElasticJump.hpp>
#include <blocks/kernel/step/Step.hpp>
#include <blocks/kernel/step/ZoneForces.hpp>
#include <limits>

namespace blocks {
namespace {

	using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
	using Sparse = Eigen::SparseMatrix<Real>;

	/// Degrees of freedom (2 node + axis) -> unknowns: one for each that is free, one for each force-driven group.
	struct Unknowns {
		static constexpr int prescribed = -1;

		std::vector<int> of;
		int              count = 0;

		explicit Unknowns(const BlockAssembly& a)
			: of(2 * a.nodeCount(), prescribed)
		{
			std::vector<char> grouped(of.size(), false);
			for (const MotionGroup& g : a.state.groups) {
				const int shared = g.drive == MotionGroup::Drive::force ? count++ : prescribed;
				for (int dof : g.dofs)
					of[dof] = shared, grouped[dof] = true;
			}
			for (size_t dof = 0; dof < of.size(); ++dof)
				if (!grouped[dof]) of[dof] = count++;
		}
	};

	/// The elastic stiffness of zones and joints on the unknowns, and the forces that a motion of the others puts on them.
	struct LinearSystem {
		std::vector<Eigen::Triplet<Real>> entries;
		Vector                            pull;
		const Unknowns&                   unknowns;
		const std::vector<Vec2>&          driven; ///< displacement of the prescribed degrees of freedom [m]

		LinearSystem(const Unknowns& u, const std::vector<Vec2>& motion)
			: pull(Vector::Zero(u.count))
			, unknowns(u)
			, driven(motion)
		{
		}

		void add(int dof1, int dof2, Real k)
		{
			const int row = unknowns.of[dof1], column = unknowns.of[dof2];
			if (row < 0) return;
			if (column >= 0)
				entries.emplace_back(row, column, k);
			else
				pull[row] -= k * driven[dof2 / 2][dof2 % 2];
		}
		void add(int node1, int node2, const Eigen::Matrix<Real, 2, 2>& k)
		{
			for (int i : { 0, 1 })
				for (int j : { 0, 1 })
					add(2 * node1 + i, 2 * node2 + j, k(i, j));
		}
	};

	void addZones(const BlockAssembly& a, LinearSystem& system)
	{
		for (int block = 0; block < a.blockCount(); ++block) {
			const Moduli m = moduliOf(a, block);
			for (int z = a.mesh.firstZone[block]; z < a.mesh.firstZone[block + 1]; ++z) {
				const ZoneGradients s    = a.mesh.zoneGradient[z];
				const Vec2          g[3] = { { -s.g1x - s.g2x, -s.g1y - s.g2y }, { s.g1x, s.g1y }, { s.g2x, s.g2y } };
				for (int i = 0; i < 3; ++i)
					for (int j = 0; j < 3; ++j) {
						Eigen::Matrix<Real, 2, 2> k = m.lambda * g[i] * g[j].transpose() + m.mu * g[j] * g[i].transpose();
						k.diagonal().array() += m.mu * g[i].dot(g[j]);
						system.add(a.mesh.zoneNodes[z][i], a.mesh.zoneNodes[z][j], a.mesh.zoneVolume[z] * k);
					}
			}
		}
	}

	void addJoints(const BlockAssembly& a, LinearSystem& system)
	{
		for (int s = 0; s < a.joints.count(); ++s) {
			const Segment&                  g = a.joints.segments[s];
			const JointFrame                f = frameOf(a, s);
			const Vec2                      n(f.nx, f.ny), t(-f.ny, f.nx);
			const Eigen::Matrix<Real, 2, 2> k = g.area * (a.joints.of(s).kn * n * n.transpose() + a.joints.of(s).ks * t * t.transpose());
			for (int p : { 0, 1 }) {
				const Real weight[4] = { g.s1[p] - 1, -g.s1[p], 1 - g.s2[p], g.s2[p] };
				for (int i = 0; i < 4; ++i)
					for (int j = 0; j < 4; ++j)
						system.add(g.node[i], g.node[j], weight[i] * weight[j] * k);
			}
		}
	}

	/// As if nothing ever broke.
	struct Elastic {
		JointStep operator()(const JointParams& p, const JointState& s, Real opening, Real slip) const
		{
			return { p.kn * (opening - s.uplift), p.ks * (slip - s.slipPlastic), s };
		}
	};

	/// Joint stresses and nodal forces at the present positions, as long as everything holds.
	void elasticForces(BlockAssembly& a)
	{
		advanceJoints(a, Elastic {});
		sumForces(a);
	}

	Vector unbalanced(const BlockAssembly& a, const Unknowns& unknowns)
	{
		Vector sum = Vector::Zero(unknowns.count);
		for (size_t dof = 0; dof < unknowns.of.size(); ++dof)
			if (unknowns.of[dof] >= 0) sum[unknowns.of[dof]] += a.forces.nodal[dof / 2][dof % 2];
		for (const MotionGroup& g : a.state.groups)
			if (g.drive == MotionGroup::Drive::force) sum[unknowns.of[g.dofs.front()]] += g.target;
		return sum;
	}

	std::vector<Vec2> onGridPoints(const Unknowns& unknowns, const Vector& u, const std::vector<Vec2>& driven)
	{
		std::vector<Vec2> out = driven;
		for (size_t dof = 0; dof < unknowns.of.size(); ++dof)
			if (unknowns.of[dof] >= 0) out[dof / 2][dof % 2] = u[unknowns.of[dof]];
		return out;
	}

	Real sizeOf(const BlockAssembly& a)
	{
		Real size = 0;
		for (const Vec2& x : a.mesh.reference)
			size = std::max(size, (x - a.mesh.reference[0]).norm());
		return size;
	}

	/// Equilibrium by rounds with the stiffness of the reference state, which is nearly the present one: each leaves a share of
	/// the strains and rotations.
	void balance(BlockAssembly& a, const Unknowns& unknowns, const Eigen::SimplicialLDLT<Sparse>& factors)
	{
		constexpr int           rounds = 4;
		const std::vector<Vec2> still(a.nodeCount(), Vec2::Zero());
		elasticForces(a);
		Real scale = unbalanced(a, unknowns).norm();
		for (int round = 0; round < rounds; ++round) {
			const auto step = onGridPoints(unknowns, factors.solve(unbalanced(a, unknowns)), still);
			for (int n = 0; n < a.nodeCount(); ++n)
				a.state.displacement[n] += step[n];
			elasticForces(a);
		}
		for (const auto& f : a.forces.side)
			scale = std::max(scale, f[0].norm());
		const Real stiffest = factors.rows() > 0 ? factors.vectorD().maxCoeff() : 0;
		const Real rounding = 1e3 * std::numeric_limits<Real>::epsilon() * stiffest * sizeOf(a);
		if (unbalanced(a, unknowns).norm() > 1e-6 * scale + rounding) // a round less leaves 1e-12 of it at strains of 1e-4
			throw std::runtime_error(
				"no elastic jump: the answer is not linear (unbalanced " + shown(unbalanced(a, unknowns).norm()) + " N beside " + shown(scale)
				+ " N); blocks have turned or strains are large");
	}

	/// Where sigma0 + lambda dsigma, tau0 + lambda dtau meets the strength; infinity if it does not.
	Real timeToFailure(const JointParams& p, Real sigma0, Real tau0, Real sigmaRate, Real tauRate)
	{
		constexpr Real never = std::numeric_limits<Real>::infinity();
		Real           least = sigmaRate > 0 ? (p.tension - sigma0) / sigmaRate : never;
		for (Real sign : { -1., 1. }) {
			const Real rate = sign * tauRate + p.tanPhi * sigmaRate;
			if (rate > 0) least = std::min(least, (p.cohesion - sign * tau0 - p.tanPhi * sigma0) / rate);
		}
		return least;
	}

	void requireIntact(const BlockAssembly& a)
	{
		if (!a.state.rigid.empty())
			throw std::runtime_error(
				"no elastic jump: block " + std::to_string(a.state.rigid.front().block)
				+ " is rigid, and how rigid blocks move is not known beforehand");
		for (int i = 0; i < a.joints.count(); ++i) {
			const auto&       block = a.joints.segments[i].block;
			const std::string who   = "the joint between blocks " + std::to_string(block[0]) + " and " + std::to_string(block[1]);
			if (a.joints.kind[i] == 0)
				throw std::runtime_error("no elastic jump: " + who + " has no properties yet; give them to bond(), or run one step first");
			for (int p : { 2 * i, 2 * i + 1 })
				if (a.state.status[p] != Joint::intact)
					throw std::runtime_error("no elastic jump: " + who + " is not bonded, so the answer is not linear");
		}
		for (const FreeContact& c : a.state.contacts)
			if (!c.active.empty())
				throw std::runtime_error(
					"no elastic jump: blocks " + std::to_string(c.block[0]) + " and " + std::to_string(c.block[1])
					+ " touch without a bond, so the answer is not linear");
	}

	void requireHeld(const Eigen::SimplicialLDLT<Sparse>& factors)
	{
		constexpr Real rounding = 1e-14;
		const bool     solved   = factors.info() == Eigen::Success;
		if (!solved || (factors.rows() > 0 && !(factors.vectorD().minCoeff() > rounding * factors.vectorD().maxCoeff())))
			throw std::runtime_error("no elastic jump: blocks can move without resistance; hold them");
	}

	/// The point that fails first, and when, by the stresses now and those before `time` of loading.
	ElasticJump firstFailure(const BlockAssembly& a, const State& before, Real time)
	{
		ElasticJump  first { std::numeric_limits<Real>::infinity(), -1 };
		const State& now = a.state;
		for (int i = 0; i < a.pointCount(); ++i) {
			const Real sigma = before.sigma[i], tau = before.tau[i];
			const Real when = timeToFailure(a.joints.ofPoint(i), sigma, tau, (now.sigma[i] - sigma) / time, (now.tau[i] - tau) / time);
			if (when < first.time) first = { when, i };
		}
		return first;
	}

	/// Force that velocity-driven groups put on the blocks.
	void takeReactions(BlockAssembly& a)
	{
		for (MotionGroup& g : a.state.groups) {
			if (g.drive == MotionGroup::Drive::force) continue;
			g.force = 0;
			for (int dof : g.dofs)
				g.force -= a.forces.nodal[dof / 2][dof % 2];
		}
	}

	/// The displacement per second of every grid point in a velocity-driven group.
	std::vector<Vec2> drivenVelocities(const BlockAssembly& a)
	{
		std::vector<Vec2> driven(a.nodeCount(), Vec2::Zero());
		for (const MotionGroup& g : a.state.groups)
			if (g.drive == MotionGroup::Drive::velocity)
				for (int dof : g.dofs)
					driven[dof / 2][dof % 2] = g.target * g.throttle;
		return driven;
	}

	/// Dead loads and forces, fully.
	void applyLoads(BlockAssembly& a, const Unknowns& unknowns, const Eigen::SimplicialLDLT<Sparse>& factors)
	{
		const std::vector<Vec2> start = a.state.displacement;
		balance(a, unknowns, factors);
		for (MotionGroup& g : a.state.groups) {
			if (g.drive != MotionGroup::Drive::force) continue;
			const int  node = g.dofs.front() / 2, axis = g.dofs.front() % 2;
			const Real moved = a.state.displacement[node][axis] - start[node][axis], work = (g.force + g.target) / 2 * moved;
			g.travelled += moved;
			g.work += work;
			g.workTurnover += std::abs(work);
			g.force = g.target;
		}
		takeReactions(a);
	}

	/// Loading along `rate` until just before the first failure.
	ElasticJump applyLoading(BlockAssembly& a, const std::vector<Vec2>& rate, Real fraction)
	{
		const State before = a.state;
		auto        moveTo = [&](Real time) {
                        for (int n = 0; n < a.nodeCount(); ++n)
                                a.state.displacement[n] = before.displacement[n] + time * rate[n];
                        elasticForces(a);
		};
		Real fastest = 0;
		for (const Vec2& v : rate)
			fastest = std::max(fastest, v.norm());
		ElasticJump first {};
		Real        look = 1e-7 * sizeOf(a) / fastest; // small, and far from rounding
		for (int round = 0; round < 3; ++round) {      // then by the secant
			moveTo(look);
			first = firstFailure(a, before, look);
			if (!(first.time > 0)) throw std::runtime_error("no elastic jump: the dead loads alone break a joint");
			if (!std::isfinite(first.time)) throw std::runtime_error("no elastic jump: this loading breaks no joint");
			look = first.time;
		}
		first.time *= fraction;
		moveTo(first.time);
		return first;
	}

	/// Groups and grid points go on at full speed, without a start.
	void setInMotion(BlockAssembly& a, const std::vector<Vec2>& rate, Real loadingTime, Real now)
	{
		std::vector<Real> before;
		for (const MotionGroup& g : a.state.groups)
			before.push_back(g.force);
		takeReactions(a);
		a.state.velocity = rate;
		for (size_t i = 0; i < a.state.groups.size(); ++i) {
			MotionGroup& g   = a.state.groups[i];
			g.velocity       = rate[g.dofs.front() / 2][g.dofs.front() % 2];
			const Real moved = g.velocity * loadingTime, work = (before[i] + g.force) / 2 * moved;
			g.travelled += moved;
			g.work += work;
			g.workTurnover += std::abs(work);
			g.pendingWork = 0;
			g.startTime   = now;
			g.rampTime    = 0;
		}
	}

} // namespace

ElasticJump elasticJump(BlockAssembly& a, Real fraction, Real time)
{
	require(fraction > 0 && fraction < 1, "the fraction of an elastic jump must lie in (0, 1)", fraction);
	requireIntact(a);
	const std::vector<Vec2> driven = drivenVelocities(a);
	if (std::all_of(driven.begin(), driven.end(), [](const Vec2& v) { return v.isZero(0); }))
		throw std::runtime_error("no elastic jump: no motion group is driven by a velocity");

	const Unknowns unknowns(a);
	LinearSystem   system(unknowns, driven);
	addZones(a, system);
	addJoints(a, system);
	Sparse stiffness(unknowns.count, unknowns.count);
	stiffness.setFromTriplets(system.entries.begin(), system.entries.end());
	const Eigen::SimplicialLDLT<Sparse> factors(stiffness);
	requireHeld(factors);

	const State             before = a.state; // put back where the jump cannot be done
	const std::vector<Vec2> forces = a.forces.nodal;
	try {
		applyLoads(a, unknowns, factors);
		const std::vector<Vec2> rate = onGridPoints(unknowns, factors.solve(system.pull), driven);
		const ElasticJump       jump = applyLoading(a, rate, fraction);
		balance(a, unknowns, factors);
		setInMotion(a, rate, jump.time, time);
		return jump;
	} catch (...) {
		a.restore(before);
		a.forces.nodal = forces;
		throw;
	}
}

} // namespace blocks
