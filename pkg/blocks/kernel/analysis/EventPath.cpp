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
	jointsAtStart = jointEnergy();
}

/// How everything moves per load factor, or per share of the excess given away.
void EventPath::chooseDirection(Phase phase)
{
	if (changes >= refreshAfter || !onLoad.known || (r > 0 && !onRelease.known)) refresh();
	const bool loading = phase == Phase::load;
	byLoad = loading, byRelease = !loading;
	breaksNow = -1;
	if (loading)
		held.clear();
	else if (!held.empty())
		holdBack();

	constexpr Real rounding = 1e-11; // of a sum of eight products of displacements, and of the solution
	Real           largest  = 0;
	for (size_t i = 0; i < m.points.size(); ++i) {
		alongN[i] = alongT[i] = 0;
		if (byLoad != 0) alongN[i] = byLoad * onLoad.n[i], alongT[i] = byLoad * onLoad.t[i];
		if (byRelease != 0) alongN[i] += onRelease.n[i], alongT[i] += onRelease.t[i];
		largest = std::max({ largest, std::abs(alongN[i]), std::abs(alongT[i]) });
	}
	still = rounding * largest;
}

/// Lets the load fall so that the held points keep to their strength; or names one of them that must break.
void EventPath::holdBack()
{
	constexpr Real rounding = 1e-9;
	auto           use      = [&](const Direction& d, const Held& h) { return useOf(m.points[h.point].joint, h.what, d.n[h.point], d.t[h.point]); };
	for (const Held& h : held)
		if (use(onLoad, h) > 0) byLoad = std::min(byLoad, -use(onRelease, h) / use(onLoad, h));
	std::vector<Held> still_;
	for (const Held& h : held) {
		const Real given = use(onRelease, h), taken = byLoad * use(onLoad, h), left = given + taken, scale = std::abs(given) + std::abs(taken);
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
	if (!std::isfinite(byLoad) || !onLoad.u.allFinite() || (byRelease != 0 && !onRelease.u.allFinite())) return end("the stiffness is singular");
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
		const PointLimit limit = nextLimit(p.joint, is.modes[i], un[i], us[i], alongN[i], alongT[i], still, except);
		if (limit.at < next.at) next = limit, point = i;
	}
	bool loadGone = false;
	if (byLoad < 0 && is.lambda + next.at * byLoad < 0) next = { is.lambda / -byLoad, PointEvent::none }, point = -1, loadGone = true;
	if (!std::isfinite(next.at)) return end("nothing more happens, however far the loading goes");

	const Real     h = next.at, rBefore = r;
	constexpr Real place = 1e-12; // of the largest opening or slip: nearer than that is the same place
	Real           moved = 0, reach = 0;
	for (size_t i = 0; i < m.points.size(); ++i) {
		moved = std::max({ moved, std::abs(h * alongN[i]), std::abs(h * alongT[i]) });
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

	constexpr Real rounding = 1e-12;
	Stress         jump { before.sigma - now.sigma, before.tau - now.tau };
	const Real     scale = std::max({ p.joint.tension, p.joint.cohesion, std::abs(before.sigma), std::abs(before.tau) });
	if (std::abs(jump.sigma) + std::abs(jump.tau) > rounding * scale) {
		if (r == 0) {
			excessAtStart = sum.excess;
			onRelease.u.setZero(m.unknowns);
			onRelease.n.assign(m.points.size(), 0), onRelease.t.assign(m.points.size(), 0);
			onRelease.known = true;
		} else if (r < 1) {
			for (int j : giving)
				excess[j].sigma *= r, excess[j].tau *= r;
			unbalance *= r;
			onRelease.u *= r;
			for (size_t j = 0; onRelease.known && j < m.points.size(); ++j)
				onRelease.n[j] *= r, onRelease.t[j] *= r;
		}
		r = 1;
		sum.excess += p.area * (storedEnergy(p.joint, before.sigma, before.tau) - storedEnergy(p.joint, now.sigma, now.tau));
		if (std::find(giving.begin(), giving.end(), i) == giving.end()) giving.push_back(i);
		excess[i].sigma += jump.sigma;
		excess[i].tau += jump.tau;
	} else
		jump = {};
	change(i, next, jump);
}

/// A point of the path. False where it is none: not in equilibrium, or not admissible.
bool EventPath::note(int point, PointEvent how)
{
	const bool pushed = m.unknowns > 0 && !m.loadGrowth.isZero(0);
	notedAt           = stepCount;
	measure();
	constexpr Real enough = 1e-11; // then what rounding has left is put right with the next direction
	Real           left   = imbalance();
	if (!(left < wrong)) {
		refresh();
		left = imbalance();
	}
	if (!(left < enough)) changes = refreshAfter;
	worstResidual = std::max(worstResidual, left);
	if (!(left < wrong)) return end("equilibrium is lost: " + shown(left) + " of the largest force at a contact point is unbalanced");
	here.lambda       = is.lambda;
	here.force        = pushed ? is.lambda : reaction();
	here.displacement = pushed ? m.loadGrowth.dot(is.u) : is.lambda;
	here.point        = point;
	here.how          = how;
	for (size_t i = 0; i < m.points.size(); ++i) {
		if (m.points[i].area == 0) continue;
		const Real beyond = inadmissibility(m.points[i].joint, is.modes[i], un[i], us[i]);
		worstInadmissible = std::max(worstInadmissible, beyond);
		if (!(beyond < wrong)) return end("contact point " + std::to_string(i) + " is beyond its limits by " + shown(beyond) + " of its strength");
	}
	return true;
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
		const std::string by = " by more than " + shown(100 * limits.share) + " % of an edge";
		return end(who + (slip > reach ? " have slid" : opening > 0 ? " have parted" : " overlap") + by + (whole ? ", though bonded" : ""));
	}
	return true;
}

const Vector& EventPath::rate()
{
	chooseDirection(Phase::load);
	return onLoad.u;
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
	r        = 0;
	settling = unbalanced = false;
	onLoad.known = onRelease.known = false;
	pending.point                  = -1;
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

bool EventPath::settle() { return reason.empty() && giveAway() && note(-1, PointEvent::none) && small(); }

bool EventPath::advance(Real until)
{
	if (!reason.empty()) return false;
	if (pending.point >= 0) breakPending();
	if (r > 0) {
		if (!giveAway()) return false;
		return note(-1, PointEvent::none) && small();
	}
	while (is.lambda < until && pending.point < 0) {
		if (!step(Phase::load, until) || !giveAway() || !small()) return false;
	}
	return note(pending.point, pending.what);
}

} // namespace blocks
