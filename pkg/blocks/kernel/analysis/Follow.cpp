// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/analysis/Follow.hpp>
#include <blocks/kernel/step/Step.hpp>

namespace blocks {
namespace {

	/// Forces at the present places; what is whole stays whole, however little is missing to its strength.
	void forcesWithoutBreaking(BlockAssembly& a)
	{
		sweepForces(a, [](const JointParams& p, const JointState& s, Real opening, Real slip) {
			if (s.status != Joint::intact) return advance(p, s, opening, slip);
			return JointStep { p.kn * (opening - s.uplift), p.ks * (slip - s.slipPlastic), s };
		});
	}

	Real largestJointForce(const BlockAssembly& a)
	{
		Real largest = 0;
		for (int i = 0; i < a.pointCount(); ++i)
			largest = std::max(largest, a.joints.segments[i / 2].area * std::max(std::abs(a.state.sigma[i]), std::abs(a.state.tau[i])));
		return largest;
	}

	/// Everything that following changes, to be put back.
	struct Untouched {
		State             state;
		std::vector<Vec2> force;

		explicit Untouched(const BlockAssembly& a)
			: state(a.state)
			, force(a.forces.nodal)
		{
		}
		void restore(BlockAssembly& a) const
		{
			a.restore(state);
			a.forces.nodal = force;
		}
	};

	Real displacementOf(const LinearModel& m, const Vector& u, Real lambda, int dof)
	{
		const LinearModel::Motion& d   = m.motion[dof];
		Real                       sum = d.byLoad * lambda;
		for (int k : { 0, 1 })
			if (d.unknown[k] >= 0) sum += d.factor[k] * u[d.unknown[k]];
		return sum;
	}

	/// A metre (of a block that only turns: a radian), or a newton, in the direction in which the driver goes.
	Growth unitOf(const BlockAssembly& a, const Driver& driver)
	{
		Growth growth;
		growth.group.assign(a.state.groups.size(), 0);
		growth.rigid.assign(a.state.rigid.size(), Vec3::Zero());
		if (driver.group >= 0) {
			const MotionGroup& g = a.state.groups.at(driver.group);
			if (g.target == 0) throw std::runtime_error("motion group \"" + g.name + "\" has no target, whose sign says which way to follow it");
			growth.group[driver.group] = g.target > 0 ? 1 : -1;
			return growth;
		}
		const RigidBlock& r = a.state.rigid.at(driver.rigid);
		Vec3              v = r.velocity;
		for (int k : { 0, 1, 2 })
			if (r.free[k]) v[k] = 0;
		if (v.isZero(0))
			throw std::runtime_error("rigid block " + std::to_string(r.block) + " has no prescribed velocity, which says which way to follow it");
		growth.rigid[driver.rigid] = v / (v.head<2>().isZero(0) ? std::abs(v[2]) : v.head<2>().norm());
		return growth;
	}

} // namespace

Real handOver(BlockAssembly& a, const LinearModel& m, EventPath& path, Real time)
{
	const PathState&  s       = path.state();
	auto              placeOf = [&](const MotionGroup& g) { return a.state.displacement[g.dofs.front() / 2][g.dofs.front() % 2]; };
	std::vector<Real> before, pushes, places;
	for (size_t i = 0; i < a.state.groups.size(); ++i) {
		MotionGroup& g = a.state.groups[i];
		before.push_back(g.force);
		places.push_back(placeOf(g));
		if (g.drive == MotionGroup::Drive::force && m.loadGrowth[m.groupUnknown[i]] != 0) g.target = g.force + m.growth.group[i] * s.lambda;
		pushes.push_back(g.target);
	}
	displace(a, m, s.u, s.lambda);
	for (int i = 0; i < a.pointCount(); ++i) {
		if (s.modes[i].state.status != a.state.status[i]) a.forces.broke[i / 2 / Joints::batch] = true;
		a.state.setJoint(i, s.modes[i].state);
	}
	forcesWithoutBreaking(a);

	Real size = 0;
	for (const Vec2& x : a.mesh.reference)
		size = std::max(size, (x - a.mesh.reference[0]).norm());
	const Real stiffest = m.unknowns > 0 ? Vector(m.zones.diagonal()).maxCoeff() : 0;
	const Real rounding = 1e3 * std::numeric_limits<Real>::epsilon() * stiffest * size; // what places of 16 digits leave of forces, where nothing is loaded
	constexpr int  rounds = 12;
	constexpr Real enough = 1e-9; // of the largest force at a contact point; a round leaves a share of strains and rotations
	constexpr Real most   = 0.02; // where blocks have slid far, what small displacement left out is this much; time steps take it from there
	Real           left = std::numeric_limits<Real>::infinity(), leastWorst = 0;
	Untouched      best(a);
	for (int round = 0; m.unknowns > 0 && round <= rounds; ++round) {
		const Vector lack  = unbalanced(a, m, pushes);
		const Real   scale = largestJointForce(a), worst = lack.cwiseAbs().maxCoeff(), now = scale > 0 ? worst / scale : 0;
		if (now < left) left = now, leastWorst = worst, best = Untouched(a);
		if (!(now > enough) || !(now < 10 * left)) break;
		displace(a, m, path.solve(lack), 0);
		forcesWithoutBreaking(a);
	}
	if (m.unknowns == 0) left = 0;
	if (leastWorst <= rounding && !(left < most)) left = 0;
	if (!(left < most))
		throw std::runtime_error(
			"the answer is not linear: in large displacement " + shown(left) + " of the largest force at a contact point is left unbalanced");
	if (m.unknowns > 0) best.restore(a);

	Real speed = 0; // of the load factor; a force that grows has none
	for (size_t i = 0; i < a.state.groups.size(); ++i)
		if (a.state.groups[i].drive == MotionGroup::Drive::velocity && m.growth.group[i] != 0)
			speed = a.state.groups[i].target * a.state.groups[i].throttle / m.growth.group[i];
	for (size_t i = 0; i < a.state.rigid.size(); ++i)
		for (int k : { 0, 1, 2 })
			if (m.growth.rigid[i][k] != 0) speed = a.state.rigid[i].velocity[k] / m.growth.rigid[i][k];
	const Vector rate = path.rate();
	for (int dof = 0; dof < 2 * a.nodeCount(); ++dof)
		a.state.velocity[dof / 2][dof % 2] = speed * displacementOf(m, rate, 1, dof);
	for (size_t i = 0; i < a.state.rigid.size(); ++i)
		for (int k : { 0, 1, 2 })
			if (m.rigidUnknown[3 * i + k] >= 0) a.state.rigid[i].velocity[k] = speed * rate[m.rigidUnknown[3 * i + k]];
	for (size_t i = 0; i < a.state.groups.size(); ++i) {
		MotionGroup& g      = a.state.groups[i];
		const bool   driven = g.drive == MotionGroup::Drive::velocity;
		const Real   moved  = placeOf(g) - places[i]; // with what large displacement adds
		Real         work   = 0;
		if (driven) {
			g.force = 0;
			for (int dof : g.dofs)
				g.force -= a.forces.nodal[dof / 2][dof % 2];
			if (m.growth.group[i] != 0) work = path.loadingWork(); // the one that grows, or all together: see follow and elasticJump
		} else {
			g.force = g.target;
			work    = (before[i] + g.force) / 2 * moved;
		}
		g.travelled += moved;
		g.work += work;
		g.workTurnover += std::abs(work);
		g.pendingWork = 0;
		g.velocity    = a.state.velocity[g.dofs.front() / 2][g.dofs.front() % 2];
		g.startTime   = time;
		g.rampTime    = 0;
	}
	return left;
}

FollowReport
follow(BlockAssembly&                               a,
       const Driver&                                driver,
       const FollowUntil&                           until,
       Release                                      release,
       Real                                         time,
       const std::vector<Gauge>&                    gauges,
       const std::function<bool(const PathPoint&)>& look)
{
	require(until.drop >= 0 && until.drop < 1, "follow: drop must lie in [0, 1)", until.drop);
	require(until.displacement > 0, "follow: displacement must be positive [m]", until.displacement);
	require(until.cracks >= 1, "follow: cracks must be at least 1", until.cracks);
	if (a.joints.anySoftens()) throw std::runtime_error("follow: joints soften; events are known of brittle joints only");
	const Growth      growth = unitOf(a, driver);
	const bool        driven = driver.group < 0 || a.state.groups[driver.group].drive == MotionGroup::Drive::velocity;
	const LinearModel m      = linearise(a, growth, driven ? -1 : driver.group);
	const Real        offset = driven ? 0 : growth.group[driver.group] * a.state.groups[driver.group].force;
	EventPath         path(m, release);

	FollowReport report;
	report.gauges.resize(gauges.size());
	Real      peak = -std::numeric_limits<Real>::infinity();
	PathState best;
	PathPoint bestPoint;
	PathState last;
	auto      note = [&] {
                PathPoint p = path.now();
                p.force += offset;
                report.path.push_back(p);
                last = path.state();
                for (size_t k = 0; k < gauges.size(); ++k) {
                        Real sum = 0;
                        for (const auto& [dof, weight] : gauges[k])
                                sum += weight * displacementOf(m, last.u, last.lambda, dof);
                        report.gauges[k].push_back(sum);
                }
                if (p.force > peak) {
                        peak      = p.force;
                        bestPoint = p;
                        if (until.peak) best = last;
                }
                const bool enough = look && !look(p);
                if (enough) report.ended = "stopped";
                if (path.cracks().size() >= size_t(until.cracks)) report.ended = "cracks";
                if (until.drop > 0 && !path.cracks().empty() && p.force < until.drop * peak) report.ended = "drop";
                if (p.displacement >= until.displacement) report.ended = "displacement";
	};
	const Real most = driven ? until.displacement : std::numeric_limits<Real>::infinity();
	if (path.settle()) note();
	while (report.ended.empty() && path.advance(most))
		note();
	if (report.ended.empty()) report.ended = path.ended();

	report.cracks        = path.cracks();
	report.energy        = path.energy();
	report.looseBlocks   = path.looseBlocks();
	report.anchorForce   = path.anchorForce();
	report.residual      = path.residual();
	report.inadmissible  = path.inadmissible();
	report.leastFriction = path.leastFriction();
	report.leastExcess   = path.leastExcess();
	report.steps         = path.steps();
	if (report.path.empty()) throw std::runtime_error("nothing to follow: " + report.ended);
	report.reached = until.peak ? bestPoint : report.path.back();
	if (until.peak || !path.ended().empty()) path.restore(until.peak ? best : last);

	const Untouched before(a);
	try {
		report.handOver = handOver(a, m, path, time);
	} catch (...) {
		before.restore(a);
		throw;
	}
	return report;
}

} // namespace blocks
