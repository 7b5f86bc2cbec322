// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/analysis/EventPath.hpp>

namespace blocks {

Real EventPath::jointEnergy() const
{
	Real e = 0;
	for (size_t i = 0; i < m.points.size(); ++i)
		if (m.points[i].area > 0) {
			const Stress s = stressOf(m.points[i].joint, is.modes[i], un[i], us[i]);
			e += m.points[i].area * storedEnergy(m.points[i].joint, s.sigma, s.tau);
		}
	return e;
}

PathEnergy EventPath::energy() const
{
	PathEnergy   e     = sum;
	const Vector zones = m.zones.selfadjointView<Eigen::Upper>() * is.u;
	e.zones            = m.zoneForce.dot(is.u) + m.zoneForceDriven * is.lambda + zones.dot(is.u) / 2 + is.lambda * m.zonesDriven.dot(is.u)
		+ m.drivenDriven * is.lambda * is.lambda / 2;
	e.joints = jointEnergy() - jointsAtStart;
	if (!loose.empty()) e.anchors = (is.u - anchorOrigin).cwiseAbs2().dot(anchorStiffness) / 2;
	return e;
}

/// Moves by h along the direction and keeps the accounts. All forces are linear on the way, so means of both ends are exact.
void EventPath::book(Real h, Real rBefore)
{
	const Real                                                 rMean = (rBefore + r) / 2, dLambda = h * byLoad, lambda0 = is.lambda;
	std::vector<std::pair<int, std::pair<Stress, JointState>>> sliding;
	for (size_t i = 0; i < m.points.size(); ++i)
		if (is.modes[i].mode == Mode::slide && m.points[i].area > 0)
			sliding.push_back({ int(i), { stressOf(m.points[i].joint, is.modes[i], un[i], us[i]), is.modes[i].state } });

	Vector du = byLoad * h * onLoad.u;
	if (byRelease != 0) du += byRelease * h * onRelease.u;
	Real force = reaction() / 2;
	is.u += du;
	is.lambda += dLambda;
	for (size_t i = 0; i < m.points.size(); ++i) {
		un[i] += h * alongN[i], us[i] += h * alongT[i];
		rememberSlip(m.points[i].joint, is.modes[i], un[i], us[i]);
	}
	force += reaction() / 2;

	Real excessWork = unbalanced ? rMean * unbalance.dot(du) : 0, friction = 0;
	for (int i : giving)
		excessWork += rMean * h * m.points[i].area * (excess[i].sigma * alongN[i] + excess[i].tau * alongT[i]);
	for (const auto& [i, before] : sliding) {
		const Stress      now = stressOf(m.points[i].joint, is.modes[i], un[i], us[i]);
		const JointState &was = before.second, &has = is.modes[i].state;
		friction += m.points[i].area
			* ((before.first.tau + now.tau) / 2 * (has.slipPlastic - was.slipPlastic)
		           + (before.first.sigma + now.sigma) / 2 * (has.uplift - was.uplift));
	}
	const Real pushing = (lambda0 + is.lambda) / 2 * m.loadGrowth.dot(du) + force * dLambda, work = pushing + m.load.dot(du) + m.loadDriven * dLambda;
	sum.work += work;
	turnover += std::abs(work);
	grown += pushing;
	sum.friction += friction;
	sum.excess += excessWork;
	if (turnover > 0) lowestFriction = std::min(lowestFriction, friction / turnover);
	if (r == 0) {
		for (int i : giving)
			excess[i] = {};
		if (rBefore > 0 && !settling && turnover > 0) lowestExcess = std::min(lowestExcess, (sum.excess - excessAtStart) / turnover);
		giving.clear();
		if (unbalanced) unbalance.setZero();
		held.clear();
		settling = unbalanced = false;
	}
}

} // namespace blocks
