// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/analysis/EventPath.hpp>

namespace blocks {
namespace {

	constexpr Real infinite = std::numeric_limits<Real>::infinity();

	bool breaks(PointEvent e) { return e == PointEvent::tension || e == PointEvent::shearForward || e == PointEvent::shearBackward; }

	/// How fast an intact point uses up its strength of one kind [Pa], by how fast its opening and slip change.
	Real useOf(const JointParams& p, PointEvent what, Real dun, Real dus)
	{
		if (what == PointEvent::tension) return p.kn * dun;
		return (what == PointEvent::shearForward ? 1 : -1) * p.ks * dus + p.tanPhi * p.kn * dun;
	}

} // namespace

EventPath::EventPath(const LinearModel& model, Release how, EventLimits within)
	: m(model)
	, release(how)
	, limits(within)
{
	setUp();
	factorise();
	measure();
}

void EventPath::setUp()
{
	const size_t count = m.points.size();
	is.u               = Vector::Zero(m.unknowns);
	zonesTimesU        = is.u;
	anchorStiffness = anchorOrigin = is.u;
	is.modes.resize(count);
	un.resize(count), us.resize(count), excess.resize(count), turns.assign(count, 0);
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
		r = 1, settling = true;
	else
		unbalance.setZero();
}

/// Opening, slip and memory of all points, and what the zones do, at the present u and lambda.
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
	zonesTimesU.setZero();
	for (int j = 0; j < m.zones.outerSize(); ++j)
		for (Eigen::SparseMatrix<Real>::InnerIterator k(m.zones, j); k; ++k) {
			zonesTimesU[k.row()] += k.value() * is.u[j];
			if (k.row() != j) zonesTimesU[j] += k.value() * is.u[k.row()];
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
	Vector f     = m.load + is.lambda * m.loadGrowth - m.zoneForce - zonesTimesU - is.lambda * m.zonesDriven - r * unbalance;
	Real   scale = forceScale;
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

void EventPath::correct(const Vector& by)
{
	is.u += by;
	measure();
}

/// Displacements per load factor, or per share of the excess given away; with what rounding has left put right on the way.
void EventPath::chooseDirection(Phase phase)
{
	Vector residual = residualForce();
	Vector main     = phase == Phase::load ? loadForce() : releaseForce();
	Vector fix      = residual;
	solvePair(main, fix);
	correct(fix);
	along.u      = std::move(main);
	along.lambda = phase == Phase::load ? 1 : 0;
	spread(along);
	breaksNow = -1;
	if (phase == Phase::load)
		held.clear();
	else if (!held.empty())
		holdBack(along);

	constexpr Real rounding = 1e-11; // of a sum of eight products of displacements, and of the solution
	Real           largest  = 0;
	for (size_t i = 0; i < m.points.size(); ++i)
		largest = std::max({ largest, std::abs(along.n[i]), std::abs(along.t[i]) });
	still = rounding * largest;
}

/// Lets the load fall so that the held points keep to their strength; or names one of them that must break.
void EventPath::holdBack(Direction& d)
{
	constexpr Real rounding = 1e-9;
	Direction      load;
	load.u      = loadForce();
	load.lambda = 1;
	Vector none = Vector::Zero(m.unknowns);
	solvePair(load.u, none);
	spread(load);

	Real fall = 0;
	auto use  = [&](const Direction& of, const Held& h) { return useOf(m.points[h.point].joint, h.what, of.n[h.point], of.t[h.point]); };
	for (const Held& h : held)
		if (use(load, h) > 0) fall = std::min(fall, -use(d, h) / use(load, h));
	d.u += fall * load.u;
	d.lambda = fall;
	for (size_t i = 0; i < m.points.size(); ++i)
		d.n[i] += fall * load.n[i], d.t[i] += fall * load.t[i];
	std::vector<Held> still_;
	for (const Held& h : held) {
		const Real left = use(d, h), scale = std::abs(fall * use(load, h)) + std::abs(left - fall * use(load, h));
		if (left > rounding * scale && (breaksNow < 0 || h.point < breaksNow)) breaksNow = h.point;
		if (left > -rounding * scale) still_.push_back(h);
	}
	held = still_;
}

/// Along the direction to the next event, and what happens there. False where the path ends.
bool EventPath::step(Phase phase, Real until)
{
	if (++stepCount - notedAt > limits.pieces) return end("no equilibrium within " + std::to_string(limits.pieces) + " straight pieces");
	chooseDirection(phase);
	if (!along.u.allFinite()) return end("the stiffness is singular");
	if (breaksNow >= 0) {
		PointEvent how = PointEvent::none;
		for (const Held& h : held)
			if (h.point == breaksNow) how = h.what;
		held.erase(std::remove_if(held.begin(), held.end(), [&](const Held& h) { return h.point == breaksNow; }), held.end());
		transition(breaksNow, how);
		return true;
	}

	int        point = -1;
	PointLimit next;
	next.at = phase == Phase::release ? r : until - is.lambda;
	for (int i = 0; i < int(m.points.size()); ++i) {
		const LinearPoint& p = m.points[i];
		if (p.area == 0) continue;
		PointEvent except = PointEvent::none;
		for (const Held& h : held)
			if (h.point == i) except = h.what;
		const PointLimit limit = nextLimit(p.joint, is.modes[i], un[i], us[i], along.n[i], along.t[i], still, except);
		if (limit.at < next.at) next = limit, point = i;
	}
	bool loadGone = false;
	if (along.lambda < 0 && is.lambda + next.at * along.lambda < 0) next = { is.lambda / -along.lambda, PointEvent::none }, point = -1, loadGone = true;
	if (!std::isfinite(next.at)) return end("nothing more happens, however far the loading goes");

	const Real     h = next.at, rBefore = r;
	constexpr Real place = 1e-12; // of the largest opening or slip: nearer than that is the same place
	Real           moved = 0, reach = 0;
	for (size_t i = 0; i < m.points.size(); ++i) {
		moved = std::max({ moved, std::abs(h * along.n[i]), std::abs(h * along.t[i]) });
		reach = std::max({ reach, std::abs(un[i]), std::abs(us[i]) });
	}
	if (moved > place * reach) {
		for (int i : turned)
			turns[i] = 0;
		turned.clear();
	}
	if (h > 0) {
		if (phase == Phase::release) r = point < 0 && !loadGone ? 0 : std::max(Real(0), r - h);
		book(h, rBefore);
	}
	if (loadGone) { // nothing left to hold them with
		const Held first = *std::min_element(held.begin(), held.end(), [](const Held& a, const Held& b) { return a.point < b.point; });
		held.clear();
		transition(first.point, first.what);
		return true;
	}
	if (point < 0) return true;
	if (!countTurn(point)) return end("no mode of contact point " + std::to_string(point) + " suits any direction");
	if (phase == Phase::release && breaks(next.what) && release == Release::path && !settling)
		held.push_back({ point, next.what });
	else if (phase == Phase::load && breaks(next.what))
		pending = { point, next.what };
	else
		transition(point, next.what);
	return true;
}

void EventPath::breakPending()
{
	const Held one = pending;
	pending.point  = -1;
	transition(one.point, one.what);
}

bool EventPath::countTurn(int i)
{
	if (turns[i] == 0) turned.push_back(i);
	return ++turns[i] <= limits.turns;
}

/// A point changes its mode; what its stress loses thereby is to be given away.
void EventPath::transition(int i, PointEvent what)
{
	const LinearPoint& p      = m.points[i];
	const Stress       before = stressOf(p.joint, is.modes[i], un[i], us[i]);
	const ModePoint    next   = after(p.joint, is.modes[i], what, un[i], us[i]);
	const Stress       now    = stressOf(p.joint, next, un[i], us[i]);
	if (breaks(what)) ++here.broken, broken.push_back({ i, what, is.lambda });

	const Two delta = p.area * (springsOf(p.joint, next) - springsOf(p.joint, is.modes[i]));
	changeSprings(i, delta);
	changeFriction(i, next);
	is.modes[i] = next;

	constexpr Real rounding = 1e-12;
	const Stress   jump { before.sigma - now.sigma, before.tau - now.tau };
	const Real     scale = std::max({ p.joint.tension, p.joint.cohesion, std::abs(before.sigma), std::abs(before.tau) });
	if (!(std::abs(jump.sigma) + std::abs(jump.tau) > rounding * scale)) return;
	const Real lost = p.area * (storedEnergy(p.joint, before.sigma, before.tau) - storedEnergy(p.joint, now.sigma, now.tau));
	if (r == 0) excessAtStart = sum.excess;
	sum.excess += lost;
	sum.joints -= lost;
	if (r < 1) {
		for (int j : giving)
			excess[j].sigma *= r, excess[j].tau *= r;
		unbalance *= r;
		r = 1;
	}
	if (std::find(giving.begin(), giving.end(), i) == giving.end()) giving.push_back(i);
	excess[i].sigma += jump.sigma;
	excess[i].tau += jump.tau;
}

/// Moves by h along the direction and keeps the accounts. All forces are linear on the way, so means of both ends are exact.
void EventPath::book(Real h, Real rBefore)
{
	const Real rMean = (rBefore + r) / 2, dLambda = h * along.lambda;
	auto       jointEnergy = [&] {
                Real e = 0;
                for (size_t i = 0; i < m.points.size(); ++i)
                        if (m.points[i].area > 0) {
                                const Stress s = stressOf(m.points[i].joint, is.modes[i], un[i], us[i]);
                                e += m.points[i].area * storedEnergy(m.points[i].joint, s.sigma, s.tau);
                        }
                return e;
	};
	auto zoneEnergy = [&] {
		return m.zoneForce.dot(is.u) + m.zoneForceDriven * is.lambda + zonesTimesU.dot(is.u) / 2 + is.lambda * m.zonesDriven.dot(is.u)
			+ m.drivenDriven * is.lambda * is.lambda / 2;
	};
	std::vector<std::pair<int, std::pair<Stress, JointState>>> sliding;
	for (size_t i = 0; i < m.points.size(); ++i)
		if (is.modes[i].mode == Mode::slide && m.points[i].area > 0)
			sliding.push_back({ int(i), { stressOf(m.points[i].joint, is.modes[i], un[i], us[i]), is.modes[i].state } });

	auto anchorEnergy = [&] { return loose.empty() ? 0 : (is.u - anchorOrigin).cwiseAbs2().dot(anchorStiffness) / 2; };

	const Real joints0 = jointEnergy(), zones0 = zoneEnergy(), anchors0 = anchorEnergy(), lambda0 = is.lambda;
	Real       force = reaction() / 2;
	is.u += h * along.u;
	is.lambda += dLambda;
	measure();
	force += reaction() / 2;

	Real excessWork = rMean * h * unbalance.dot(along.u), friction = 0;
	for (int i : giving)
		excessWork += rMean * h * m.points[i].area * (excess[i].sigma * along.n[i] + excess[i].tau * along.t[i]);
	for (const auto& [i, before] : sliding) {
		const Stress      now = stressOf(m.points[i].joint, is.modes[i], un[i], us[i]);
		const JointState &was = before.second, &has = is.modes[i].state;
		friction += m.points[i].area
			* ((before.first.tau + now.tau) / 2 * (has.slipPlastic - was.slipPlastic)
		           + (before.first.sigma + now.sigma) / 2 * (has.uplift - was.uplift));
	}
	sum.work += h * (m.load + (lambda0 + is.lambda) / 2 * m.loadGrowth).dot(along.u) + (force + m.loadDriven) * dLambda;
	grown += h * (lambda0 + is.lambda) / 2 * m.loadGrowth.dot(along.u) + force * dLambda;
	sum.zones += zoneEnergy() - zones0;
	sum.joints += jointEnergy() - joints0;
	sum.anchors += anchorEnergy() - anchors0;
	sum.friction += friction;
	sum.excess += excessWork;
	const Real scale = std::abs(sum.zones) + std::abs(sum.joints) + sum.friction + std::abs(sum.excess);
	if (scale > 0) lowestFriction = std::min(lowestFriction, friction / scale);
	if (r == 0) {
		for (int i : giving)
			excess[i] = {};
		if (rBefore > 0 && !settling && scale > 0) lowestExcess = std::min(lowestExcess, (sum.excess - excessAtStart) / scale);
		giving.clear();
		unbalance.setZero();
		held.clear();
		settling = false;
	}
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

void EventPath::note(int point, PointEvent how)
{
	const bool pushed = m.unknowns > 0 && !m.loadGrowth.isZero(0);
	notedAt           = stepCount;
	here.lambda       = is.lambda;
	here.force        = pushed ? is.lambda : reaction();
	here.displacement = pushed ? m.loadGrowth.dot(is.u) : is.lambda;
	here.point        = point;
	here.how          = how;
	const Vector f    = residualForce();
	if (m.unknowns > 0 && forceScale > 0) worstResidual = std::max(worstResidual, f.cwiseAbs().maxCoeff() / forceScale);
	for (size_t i = 0; i < m.points.size(); ++i)
		if (m.points[i].area > 0) worstInadmissible = std::max(worstInadmissible, inadmissibility(m.points[i].joint, is.modes[i], un[i], us[i]));
}

/// Whether the answer is still that of small displacement.
bool EventPath::small()
{
	for (size_t i = 0; i < m.points.size(); ++i) {
		const LinearPoint& p = m.points[i];
		if (p.area == 0) continue;
		const bool whole = is.modes[i].mode == Mode::intact;
		const Real slip = std::abs(us[i] - p.slip), opening = un[i] - p.opening, reach = limits.share * p.edge;
		if (slip <= reach && std::abs(opening) <= reach) continue;
		const std::string who
			= "blocks " + std::to_string(p.block[0]) + " and " + std::to_string(p.block[1]) + " at contact point " + std::to_string(i);
		const std::string by = " by more than " + shown(limits.share) + " of an edge";
		return end(who + (slip > reach ? " have slid" : opening > 0 ? " have parted" : " overlap") + by + (whole ? ", though bonded" : ""));
	}
	return true;
}

const Vector& EventPath::rate()
{
	chooseDirection(Phase::load);
	return along.u;
}

void EventPath::restore(const PathState& state)
{
	const bool asFactored = loose.empty() && std::equal(is.modes.begin(), is.modes.end(), state.modes.begin(), [](const ModePoint& p, const ModePoint& q) {
					return p.mode == q.mode && p.sign == q.sign && p.dilating == q.dilating;
				});
	is                    = state;
	giving.clear();
	held.clear();
	loose.clear();
	std::fill(excess.begin(), excess.end(), Stress {});
	anchorStiffness.setZero();
	unbalance.setZero();
	r             = 0;
	settling      = false;
	pending.point = -1;
	reason.clear();
	if (!asFactored) factorise();
	measure();
}

bool EventPath::end(const std::string& why)
{
	reason = why;
	return false;
}

bool EventPath::giveAway()
{
	while (r > 0)
		if (!step(Phase::release, infinite)) return false;
	return true;
}

bool EventPath::settle() { return reason.empty() && giveAway() && (note(-1, PointEvent::none), small()); }

bool EventPath::advance(Real until)
{
	if (!reason.empty()) return false;
	if (pending.point >= 0) breakPending();
	if (r > 0) {
		if (!giveAway()) return false;
		note(-1, PointEvent::none);
		return small();
	}
	while (is.lambda < until && pending.point < 0) {
		if (!step(Phase::load, until) || !giveAway() || !small()) return false;
	}
	note(pending.point, pending.what);
	return true;
}

} // namespace blocks
