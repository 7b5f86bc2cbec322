// yade-blocks, GPL-2.0-or-later
#include <Eigen/LU>
#include <algorithm>
#include <blocks/kernel/analysis/EventPath.hpp>

/// The tangent stiffness of the present modes: factors of its symmetric part. What friction adds is in EventPathFriction.cpp.
namespace blocks {
namespace {

	std::string blockNames(const std::vector<int>& blocks)
	{
		std::string text;
		for (size_t i = 0; i < blocks.size() && i < 8; ++i)
			text += (i ? ", " : "") + std::to_string(blocks[i]);
		return text + (blocks.size() > 8 ? " and " + std::to_string(blocks.size() - 8) + " more" : "");
	}

	/// The blocks that a motion moves, in order.
	std::vector<int> blocksThatMove(const LinearModel& m, const Vector& motion)
	{
		constexpr Real   noticeable = 1e-3;
		const Real       largest    = motion.cwiseAbs().maxCoeff();
		std::vector<int> blocks;
		for (int i = 0; i < m.unknowns; ++i)
			if (std::abs(motion[i]) > noticeable * largest) blocks.push_back(m.blockOfUnknown[i]);
		std::sort(blocks.begin(), blocks.end());
		blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
		return blocks;
	}

	SparseFactor::Entries entriesOf(const LinearPoint& p, Real byN, Real byT)
	{
		SparseFactor::Entries v;
		for (int k = 0; k < p.count; ++k)
			v.emplace_back(p.unknown[k], byN * p.n[k] + byT * p.t[k]);
		return v;
	}

	/// The symmetric springs of a contact point in a mode, in the plane of opening and slip [Pa/m].
	Eigen::Matrix<Real, 2, 2> springsOf(const JointParams& p, const ModePoint& m)
	{
		Eigen::Matrix<Real, 2, 2> k = Eigen::Matrix<Real, 2, 2>::Zero();
		if (m.mode == Mode::slide) {
			const Vec2 c(1, -m.sign * psiOf(p, m));
			k = slidingStiffness(p, m) * c * c.transpose();
		} else if (m.mode != Mode::open)
			k(0, 0) = p.kn, k(1, 1) = p.ks;
		return k;
	}

	/// All springs: change of the stresses (sigma, tau) with opening and slip [Pa/m].
	Eigen::Matrix<Real, 2, 2> tangentOf(const JointParams& p, const ModePoint& m)
	{
		const Stress              n = stressRate(p, m, 1, 0), t = stressRate(p, m, 0, 1);
		Eigen::Matrix<Real, 2, 2> k;
		k << n.sigma, t.sigma, n.tau, t.tau;
		return k;
	}

	/// Opening and slip of a point by two motions side by side: a matrix of rows opening and slip.
	Eigen::Matrix<Real, 2, 2> ofPoint(const LinearPoint& p, const std::vector<Real>& x)
	{
		if (x.empty()) return Eigen::Matrix<Real, 2, 2>::Zero(); // nothing is free to move
		Eigen::Matrix<Real, 2, 2> own;
		own << p.times(p.n, &x[0], 2), p.times(p.n, &x[1], 2), p.times(p.t, &x[0], 2), p.times(p.t, &x[1], 2);
		return own;
	}

} // namespace

/// Whether a small matrix can be inverted without losing more than 5 of 16 digits.
bool EventPath::wellConditioned(const Two& a) { return std::abs(a.determinant()) > 1e-5 * a.squaredNorm(); }

void EventPath::addTo(Vector& f, int i, Real byN, Real byT) const
{
	const LinearPoint& p = m.points[i];
	for (int k = 0; k < p.count; ++k)
		f[p.unknown[k]] += byN * p.n[k] + byT * p.t[k];
}

void EventPath::spread(Direction& d, Real lambda) const
{
	d.n.resize(m.points.size());
	d.t.resize(m.points.size());
	for (size_t i = 0; i < m.points.size(); ++i) {
		const LinearPoint& p = m.points[i];
		Real               n = p.nDriven * lambda, t = p.tDriven * lambda;
		for (int k = 0; k < p.count; ++k) {
			const Real x = d.u[p.unknown[k]];
			n += p.n[k] * x;
			t += p.t[k] * x;
		}
		d.n[i] = n, d.t[i] = t;
	}
}

void EventPath::factorise()
{
	std::vector<Eigen::Triplet<Real>> entries;
	entries.reserve(36 * m.points.size() + m.unknowns);
	for (size_t i = 0; i < m.points.size(); ++i) {
		const LinearPoint& p = m.points[i];
		const Two          s = p.area * springsOf(p.joint, is.modes[i]);
		if (s.isZero(0)) continue;
		for (int a = 0; a < p.count; ++a)
			for (int b = 0; b < p.count; ++b)
				if (p.unknown[b] >= p.unknown[a])
					entries.emplace_back(p.unknown[a], p.unknown[b], Vec2(p.n[a], p.t[a]).dot(s * Vec2(p.n[b], p.t[b])));
	}
	for (int i = 0; i < m.unknowns; ++i)
		if (anchorStiffness[i] > 0) entries.emplace_back(i, i, anchorStiffness[i]);
	Eigen::SparseMatrix<Real> all(m.unknowns, m.unknowns);
	all.setFromTriplets(entries.begin(), entries.end());
	all += m.zones;
	all.makeCompressed();
	if (diagonal.size() == 0) diagonal = all.diagonal();
	factor.reset(new SparseFactor(all));

	constexpr Real singular = 1e-12; // of a pivot by its diagonal entry: rounding leaves 1e-15 times the length of a row
	if (m.unknowns > 0 && !(factor->leastPivot() > singular)) {
		Eigen::SparseMatrix<Real> softened = all; // with soft springs everywhere, what nothing else holds moves most
		for (int i = 0; i < m.unknowns; ++i)
			softened.coeffRef(i, i) += 1e-9 * std::max(diagonal[i], Real(1e-9) * diagonal.maxCoeff());
		const SparseFactor soft(softened);
		Vector             motion = Vector::Zero(m.unknowns), none = motion;
		motion[factor->rowOfLeastPivot()] = 1;
		std::vector<Real> b(2 * m.unknowns, 0);
		for (int round = 0; round < 3; ++round) {
			for (int i = 0; i < m.unknowns; ++i)
				b[2 * i] = motion[i];
			soft.solveTwo(b);
			for (int i = 0; i < m.unknowns; ++i)
				motion[i] = b[2 * i];
			motion /= motion.cwiseAbs().maxCoeff();
		}
		throw std::runtime_error("blocks can move without resistance; hold them: block " + blockNames(blocksThatMove(m, motion)));
	}
	collectFriction();
}

/// pair = S^-1 B^T of a point, and what it does to the sliding ones.
void EventPath::solvePoint(const LinearPoint& p)
{
	pair.assign(2 * m.unknowns, 0);
	for (int k = 0; k < p.count; ++k)
		pair[2 * p.unknown[k]] = p.n[k], pair[2 * p.unknown[k] + 1] = p.t[k];
	factor->solveTwo(pair);
}

/// A point goes into its next mode and loses `jump` of its stress: factors, W and directions follow.
void EventPath::change(int i, const ModePoint& next, const Stress& jump)
{
	constexpr Real     singular = 1e-9; // of what is left of the stiffness where a spring goes
	const LinearPoint& p        = m.points[i];
	const ModePoint    now      = is.modes[i];
	const Two  delta = p.area * (springsOf(p.joint, next) - springsOf(p.joint, now)), by = p.area * (tangentOf(p.joint, next) - tangentOf(p.joint, now));
	const bool loses = jump.sigma != 0 || jump.tau != 0;
	if (by.isZero(0) && !loses) {
		is.modes[i] = next;
		return;
	}
	++changes;
	solvePoint(p);
	Two own = ofPoint(p, pair), left = Two::Identity() + delta * own;
	if (delta.trace() < 0) {
		const Real half = left.trace() / 2, det = left.determinant(), root = std::sqrt(std::max(Real(0), half * half - det)), least = half - root;
		if (!(least > singular)) {
			Vec2 v(left(0, 1), least - left(0, 0)); // left v = least v
			if (v.norm() <= std::abs(least - left(1, 1))) v = Vec2(least - left(1, 1), left(1, 0));
			if (v.isZero(0)) v = Vec2(1, 0);
			// delta own f = -f for f = v: the motion is S^-1 B^T f
			Vector motion(m.unknowns);
			for (int k = 0; k < m.unknowns; ++k)
				motion[k] = v[0] * pair[2 * k] + v[1] * pair[2 * k + 1];
			if (anchor(motion)) {
				solvePoint(p);
				own  = ofPoint(p, pair);
				left = Two::Identity() + delta * own;
			}
		}
	}
	const int s = int(slides.size());
	vY.resize(s, 2), uY.resize(s, 2);
	for (int j = 0; j < s; ++j) {
		const LinearPoint& q    = m.points[slides[j]];
		const ModePoint&   mode = is.modes[slides[j]];
		for (int k : { 0, 1 }) {
			uY(j, k) = q.times(q.t, &pair[k], 2);
			vY(j, k) = q.times(q.n, &pair[k], 2) - mode.sign * psiOf(q.joint, mode) * uY(j, k);
		}
	}
	followDirections(i, by, { p.area * jump.sigma, p.area * jump.tau });

	const Two after = left.inverse(); // S'^-1 B^T = S^-1 B^T after
	bool      exact = followFriction(after * delta);
	vY = (vY * after).eval(), uY = (uY * after).eval(), own = (own * after).eval();
	followFactors(p, delta);
	exact       = dropFriction(i) && exact;
	is.modes[i] = next;
	exact       = addFriction(i, own) && exact;
	if (!slides.empty() && (!exact || ++sinceInverted > refreshAfter)) invertFriction();
}

/// The directions of the next mode, where they are known; `jump` is a force [N].
void EventPath::followDirections(int i, const Two& by, const Stress& jump)
{
	const LinearPoint& p     = m.points[i];
	const bool         loses = jump.sigma != 0 || jump.tau != 0;
	if (!onLoad.known && !onRelease.known) return;
	second = pair; // K^-1 B^T
	withFriction(second, vY);
	const Two left = Two::Identity() + by * ofPoint(p, second);
	if (!wellConditioned(left)) {
		onLoad.known = onRelease.known = false;
		return;
	}
	const Two after  = left.inverse();
	auto      follow = [&](Direction& d, Real lambda, const Vec2& more) {
                const Vec2 f = after * (more - by * Vec2(d.n[i], d.t[i]));
                for (int k = 0; k < m.unknowns; ++k)
                        d.u[k] += second[2 * k] * f[0] + second[2 * k + 1] * f[1];
                spread(d, lambda);
	};
	if (onLoad.known) follow(onLoad, 1, Vec2::Zero());
	if (onRelease.known && (r > 0 || loses)) follow(onRelease, 0, Vec2(jump.sigma, jump.tau));
}

/// S += B^T delta B, a symmetric 2x2, what comes before what goes.
void EventPath::followFactors(const LinearPoint& p, const Two& delta)
{
	if (delta.isZero(0)) return;
	if (delta(0, 1) == 0) {
		if (delta(0, 0) * delta(1, 1) > 0) {
			factor->add(delta(0, 0), entriesOf(p, 1, 0), delta(1, 1), entriesOf(p, 0, 1));
			return;
		}
		for (bool up : { true, false }) {
			if ((delta(0, 0) > 0) == up) factor->add(delta(0, 0), entriesOf(p, 1, 0));
			if ((delta(1, 1) > 0) == up) factor->add(delta(1, 1), entriesOf(p, 0, 1));
		}
		return;
	}
	const Real half = delta.trace() / 2, off = delta(0, 1), diff = (delta(0, 0) - delta(1, 1)) / 2, root = std::hypot(diff, off);
	for (Real value : { half + root, half - root }) {
		Vec2 v(off, value - delta(0, 0));
		v.normalize();
		factor->add(value, entriesOf(p, v[0], v[1]));
	}
}

/// Soft springs on the blocks of a motion that nothing resists. False if they have them already.
bool EventPath::anchor(const Vector& motion)
{
	bool any = false;
	for (int block : blocksThatMove(m, motion)) {
		if (std::find(loose.begin(), loose.end(), block) != loose.end()) continue;
		loose.push_back(block);
		any = true;
		for (int i = 0; i < m.unknowns; ++i)
			if (m.blockOfUnknown[i] == block) {
				anchorStiffness[i] = anchorShare * diagonal[i];
				anchorOrigin[i]    = is.u[i];
				factor->add(anchorStiffness[i], { { i, 1 } });
			}
	}
	if (any) {
		collectFriction();
		onLoad.known = onRelease.known = false;
	}
	return any;
}

/// a = K^-1 a and b = K^-1 b.
void EventPath::solvePair(Vector& a, Vector& b)
{
	std::vector<Real>& x = pair;
	x.resize(2 * m.unknowns);
	for (int i = 0; i < m.unknowns; ++i)
		x[2 * i] = a[i], x[2 * i + 1] = b[i];
	factor->solveTwo(x);
	const int s = int(slides.size());
	Columns   t(s, 2);
	for (int j = 0; j < s; ++j) {
		const LinearPoint& q    = m.points[slides[j]];
		const ModePoint&   mode = is.modes[slides[j]];
		for (int k : { 0, 1 })
			t(j, k) = q.times(q.n, &x[k], 2) - mode.sign * psiOf(q.joint, mode) * q.times(q.t, &x[k], 2);
	}
	withFriction(x, t);
	for (int i = 0; i < m.unknowns; ++i)
		a[i] = x[2 * i], b[i] = x[2 * i + 1];
}

Vector EventPath::solve(const Vector& f)
{
	Vector x = f, none = Vector::Zero(m.unknowns);
	solvePair(x, none);
	return x;
}

} // namespace blocks
