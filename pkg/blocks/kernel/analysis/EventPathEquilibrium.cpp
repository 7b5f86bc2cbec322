// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/analysis/EventPath.hpp>

namespace blocks {

void EventPath::setUp()
{
	const size_t count = m.points.size();
	is.u               = Vector::Zero(m.unknowns);
	anchorStiffness = anchorOrigin = is.u;
	is.modes.resize(count);
	un.resize(count), us.resize(count), excess.resize(count), turns.assign(count, 0), alongN.resize(count), alongT.resize(count);
	unbalance = m.load - m.zoneForce;
	for (size_t i = 0; i < count; ++i) {
		const LinearPoint& p    = m.points[i];
		ModePoint&         mode = is.modes[i];
		mode.state              = p.state;
		un[i] = p.opening, us[i] = p.slip;
		if (p.area == 0) {
			mode.mode = Mode::open; // its edges are a free contact
			continue;
		}
		if (p.state.status != Joint::intact) {
			const JointStep now = blocks::advance(p.joint, p.state, p.opening, p.slip);
			mode.state          = now.state;
			mode.mode           = p.joint.kn * (p.opening - p.state.uplift) <= p.joint.tensionResidual ? Mode::stick : Mode::open;
		}
		if (p.nDriven != 0 || p.tDriven != 0) drivenPoints.push_back(int(i));
		const Stress s = stressOf(p.joint, mode, un[i], us[i]);
		addTo(unbalance, int(i), -p.area * s.sigma, -p.area * s.tau);
		forceScale = std::max({ forceScale, p.area * std::abs(s.sigma), p.area * std::abs(s.tau) });
	}
	forceScale = std::max(forceScale, m.load.size() ? m.load.cwiseAbs().maxCoeff() : 0);
	// what rounding of positions leaves, 1e3 eps x stiffness x the size of a specimen, is no load; it is cancelled with the first residual
	const Real rounding = 1e-10 * forceScale;
	if (m.unknowns > 0 && unbalance.cwiseAbs().maxCoeff() > rounding)
		r = 1, settling = unbalanced = true;
	else
		unbalance.setZero();
}

/// Opening, slip and memory of all points at the present u and lambda.
void EventPath::measure()
{
	for (size_t i = 0; i < m.points.size(); ++i) {
		const LinearPoint& p = m.points[i];
		Real               n = p.opening + p.nDriven * is.lambda, t = p.slip + p.tDriven * is.lambda;
		for (int k = 0; k < p.count; ++k) {
			const Real x = is.u[p.unknown[k]];
			n += p.n[k] * x;
			t += p.t[k] * x;
		}
		un[i] = n, us[i] = t;
		rememberSlip(p.joint, is.modes[i], n, t);
	}
}

Vector EventPath::loadForce() const
{
	Vector f = m.loadGrowth - m.zonesDriven;
	for (int i : drivenPoints) {
		const LinearPoint& p = m.points[i];
		const Stress       s = stressRate(p.joint, is.modes[i], p.nDriven, p.tDriven);
		addTo(f, i, -p.area * s.sigma, -p.area * s.tau);
	}
	return f;
}

Vector EventPath::releaseForce() const
{
	Vector f = unbalance;
	for (int i : giving)
		addTo(f, i, m.points[i].area * excess[i].sigma, m.points[i].area * excess[i].tau);
	return f;
}

/// What is not in equilibrium: rounding, and what small pivots made of it.
Vector EventPath::residualForce()
{
	Vector f = m.load + is.lambda * m.loadGrowth - m.zoneForce - is.lambda * m.zonesDriven - r * unbalance;
	f.noalias() -= m.zones.selfadjointView<Eigen::Upper>() * is.u;
	Real scale = forceScale;
	for (size_t i = 0; i < m.points.size(); ++i) {
		const LinearPoint& p = m.points[i];
		if (p.area == 0) continue;
		Stress s = stressOf(p.joint, is.modes[i], un[i], us[i]);
		if (r > 0) s.sigma += r * excess[i].sigma, s.tau += r * excess[i].tau;
		if (s.sigma == 0 && s.tau == 0) continue;
		scale = std::max({ scale, p.area * std::abs(s.sigma), p.area * std::abs(s.tau) });
		addTo(f, int(i), -p.area * s.sigma, -p.area * s.tau);
	}
	forceScale = scale;
	for (int i = 0; i < m.unknowns && !loose.empty(); ++i)
		if (anchorStiffness[i] > 0) {
			const Real force = anchorStiffness[i] * (is.u[i] - anchorOrigin[i]);
			largestAnchor    = std::max(largestAnchor, std::abs(force));
			f[i] -= force;
		}
	return f;
}

/// Both directions solved anew, and what rounding has left put right.
void EventPath::refresh()
{
	measure();
	Vector residual = residualForce(), load = loadForce();
	solvePair(load, residual);
	is.u += residual;
	measure();
	onLoad.u = std::move(load);
	spread(onLoad, 1);
	if (r > 0) {
		Vector given = releaseForce(), none = Vector::Zero(m.unknowns);
		solvePair(given, none);
		onRelease.u = std::move(given);
		spread(onRelease, 0);
	}
	onLoad.known = true, onRelease.known = r > 0;
	changes = 0;
}

/// Force work-conjugate to the load factor, that moves the driven degrees of freedom, loads on them taken off.
Real EventPath::reaction() const
{
	Real f = m.zoneForceDriven + m.zonesDriven.dot(is.u) + m.drivenDriven * is.lambda - m.loadDriven;
	for (int i : drivenPoints) {
		const LinearPoint& p = m.points[i];
		const Stress       s = stressOf(p.joint, is.modes[i], un[i], us[i]);
		f += p.area * ((s.sigma + r * excess[i].sigma) * p.nDriven + (s.tau + r * excess[i].tau) * p.tDriven);
	}
	return f;
}

/// The largest unbalanced force by the largest force at a contact point.
Real EventPath::imbalance()
{
	const Vector f = residualForce();
	return m.unknowns > 0 && forceScale > 0 ? f.cwiseAbs().maxCoeff() / forceScale : 0;
}

} // namespace blocks
