// yade-blocks, GPL-2.0-or-later
#include <Eigen/LU>
#include <algorithm>
#include <blocks/kernel/analysis/EventPath.hpp>

/// The tangent stiffness of the present modes: factors of its symmetric part, and friction as a low-rank addition.
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

	Real times(const LinearPoint& p, const std::array<Real, 8>& b, const Real* x, int stride)
	{
		Real sum = 0;
		for (int k = 0; k < p.count; ++k)
			sum += b[k] * x[stride * p.unknown[k]];
		return sum;
	}

	/// psi of a sliding point: zero unless it dilates.
	Real psiOf(const JointParams& p, const ModePoint& m) { return m.dilating ? p.tanDilation : 0; }

	/// The factor of t c^T, the unsymmetric part of a sliding point [N/m].
	Real frictionOf(const LinearPoint& p, const ModePoint& m)
	{
		return -p.area * m.sign * slidingStiffness(p.joint, m) * (p.joint.tanPhiResidual - psiOf(p.joint, m));
	}

} // namespace

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

void EventPath::addTo(Vector& f, int i, Real byN, Real byT) const
{
	const LinearPoint& p = m.points[i];
	for (int k = 0; k < p.count; ++k)
		f[p.unknown[k]] += byN * p.n[k] + byT * p.t[k];
}

void EventPath::spread(Direction& d) const
{
	d.n.resize(m.points.size());
	d.t.resize(m.points.size());
	for (size_t i = 0; i < m.points.size(); ++i) {
		const LinearPoint& p = m.points[i];
		Real               n = p.nDriven * d.lambda, t = p.tDriven * d.lambda;
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
		Eigen::SparseMatrix<Real> held = all; // with soft springs everywhere, what nothing else holds moves most
		for (int i = 0; i < m.unknowns; ++i)
			held.coeffRef(i, i) += 1e-9 * std::max(diagonal[i], Real(1e-9) * diagonal.maxCoeff());
		const SparseFactor soft(held);
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

void EventPath::collectFriction()
{
	slides.clear();
	frictionD.clear();
	for (int i = 0; i < int(m.points.size()); ++i)
		if (is.modes[i].mode == Mode::slide && m.points[i].area > 0 && frictionOf(m.points[i], is.modes[i]) != 0) {
			slides.push_back(i);
			frictionD.push_back(frictionOf(m.points[i], is.modes[i]));
		}
	g.resize(slides.size(), slides.size());
	std::vector<Real> x(2 * m.unknowns);
	for (size_t j = 0; j < slides.size(); ++j) {
		std::fill(x.begin(), x.end(), 0);
		const LinearPoint& of = m.points[slides[j]];
		for (int k = 0; k < of.count; ++k)
			x[2 * of.unknown[k]] = of.t[k];
		factor->solveTwo(x);
		for (size_t i = 0; i < slides.size(); ++i) {
			const LinearPoint& p = m.points[slides[i]];
			const ModePoint&   q = is.modes[slides[i]];
			g(i, j)              = times(p, p.n, x.data(), 2) - q.sign * psiOf(p.joint, q) * times(p, p.t, x.data(), 2);
		}
	}
}

/// S += B^T delta B of point i, and G with it.
void EventPath::changeSprings(int i, const Two& delta)
{
	constexpr Real singular = 1e-9; // of what is left of the stiffness where a spring goes
	if (delta.isZero(0)) return;
	const LinearPoint& p = m.points[i];
	std::vector<Real>& z = pair;
	Two                left;
	auto               answer = [&] { // S^-1 of the point's own n and t, and what stays of it
                z.assign(2 * m.unknowns, 0);
                for (int k = 0; k < p.count; ++k)
                        z[2 * p.unknown[k]] = p.n[k], z[2 * p.unknown[k] + 1] = p.t[k];
                factor->solveTwo(z);
                Two own;
                own << times(p, p.n, &z[0], 2), times(p, p.n, &z[1], 2), times(p, p.t, &z[0], 2), times(p, p.t, &z[1], 2);
                left = Two::Identity() + delta * own;
	};
	const bool goes = delta.trace() < 0;
	if (goes || !slides.empty()) answer();
	if (goes) {
		const Real half = left.trace() / 2, det = left.determinant(), root = std::sqrt(std::max(Real(0), half * half - det)), least = half - root;
		if (!(least > singular)) {
			Vec2 v(left(0, 1), least - left(0, 0)); // left v = least v
			if (v.norm() <= std::abs(least - left(1, 1))) v = Vec2(least - left(1, 1), left(1, 0));
			if (v.isZero(0)) v = Vec2(1, 0);
			// delta own f = -f for f = v: the motion is S^-1 B^T f
			Vector motion(m.unknowns);
			for (int k = 0; k < m.unknowns; ++k)
				motion[k] = v[0] * z[2 * k] + v[1] * z[2 * k + 1];
			if (anchor(motion)) answer();
		}
	}
	if (!slides.empty()) {
		const int                              s = int(slides.size());
		Eigen::Matrix<Real, Eigen::Dynamic, 2> vz(s, 2), uz(s, 2);
		for (int j = 0; j < s; ++j) {
			const LinearPoint& q    = m.points[slides[j]];
			const ModePoint&   mode = is.modes[slides[j]];
			for (int k : { 0, 1 }) {
				uz(j, k) = times(q, q.t, &z[k], 2);
				vz(j, k) = times(q, q.n, &z[k], 2) - mode.sign * psiOf(q.joint, mode) * uz(j, k);
			}
		}
		g -= vz * (left.inverse() * delta) * uz.transpose();
	}
	// a symmetric 2x2 as two changes of rank one, what comes before what goes
	if (delta(0, 1) == 0) {
		for (bool up : { true, false }) {
			if ((delta(0, 0) > 0) == up) factor->add(delta(0, 0), entriesOf(p, 1, 0));
			if ((delta(1, 1) > 0) == up) factor->add(delta(1, 1), entriesOf(p, 0, 1));
		}
	} else {
		const Real half = delta.trace() / 2, off = delta(0, 1), diff = (delta(0, 0) - delta(1, 1)) / 2, root = std::hypot(diff, off);
		for (Real value : { half + root, half - root }) {
			Vec2 v(off, value - delta(0, 0));
			v.normalize();
			factor->add(value, entriesOf(p, v[0], v[1]));
		}
	}
}

/// Takes a point out of U and V, or puts it in; its springs are changed already.
void EventPath::changeFriction(int i, const ModePoint& next)
{
	const auto known = std::find(slides.begin(), slides.end(), i);
	if (known != slides.end()) {
		const int at = int(known - slides.begin()), last = int(slides.size()) - 1; // the last takes its place
		g.row(at).swap(g.row(last));
		g.col(at).swap(g.col(last));
		std::swap(slides[at], slides[last]);
		std::swap(frictionD[at], frictionD[last]);
		slides.pop_back();
		frictionD.pop_back();
		g.conservativeResize(last, last);
	}
	const LinearPoint& p = m.points[i];
	const Real         d = next.mode == Mode::slide ? frictionOf(p, next) : 0;
	if (d == 0) return;
	const int          s   = int(slides.size());
	const Real         psi = next.sign * psiOf(p.joint, next);
	std::vector<Real>& z   = pair;
	z.assign(2 * m.unknowns, 0);
	for (int k = 0; k < p.count; ++k)
		z[2 * p.unknown[k]] = p.t[k], z[2 * p.unknown[k] + 1] = p.n[k] - psi * p.t[k];
	factor->solveTwo(z);
	g.conservativeResize(s + 1, s + 1);
	for (int j = 0; j < s; ++j) {
		const LinearPoint& q    = m.points[slides[j]];
		const ModePoint&   mode = is.modes[slides[j]];
		g(s, j)                 = times(q, q.t, &z[1], 2);
		g(j, s)                 = times(q, q.n, &z[0], 2) - mode.sign * psiOf(q.joint, mode) * times(q, q.t, &z[0], 2);
	}
	g(s, s) = times(p, p.n, &z[0], 2) - psi * times(p, p.t, &z[0], 2);
	slides.push_back(i);
	frictionD.push_back(d);
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
	if (any) collectFriction();
	return any;
}

/// a = K^-1 a and b = K^-1 b.
void EventPath::solvePair(Vector& a, Vector& b)
{
	std::vector<Real>& x    = pair;
	auto               fill = [&](const Vector& p, const Vector& q) {
                x.resize(2 * m.unknowns);
                for (int i = 0; i < m.unknowns; ++i)
                        x[2 * i] = p[i], x[2 * i + 1] = q[i];
                factor->solveTwo(x);
	};
	fill(a, b);
	for (int i = 0; i < m.unknowns; ++i)
		a[i] = x[2 * i], b[i] = x[2 * i + 1];
	const int s = int(slides.size());
	if (s == 0) return;

	Eigen::Matrix<Real, Eigen::Dynamic, 2> t(s, 2);
	for (int j = 0; j < s; ++j) {
		const LinearPoint& q    = m.points[slides[j]];
		const ModePoint&   mode = is.modes[slides[j]];
		for (int k : { 0, 1 })
			t(j, k) = times(q, q.n, &x[k], 2) - mode.sign * psiOf(q.joint, mode) * times(q, q.t, &x[k], 2);
	}
	Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> small = g;
	for (int j = 0; j < s; ++j)
		small.col(j) *= frictionD[j];
	small.diagonal().array() += 1;
	t         = Eigen::PartialPivLU<Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>>(small).solve(t).eval();
	Vector fa = Vector::Zero(m.unknowns), fb = fa;
	for (int j = 0; j < s; ++j) {
		addTo(fa, slides[j], 0, frictionD[j] * t(j, 0));
		addTo(fb, slides[j], 0, frictionD[j] * t(j, 1));
	}
	fill(fa, fb);
	for (int i = 0; i < m.unknowns; ++i)
		a[i] -= x[2 * i], b[i] -= x[2 * i + 1];
}

Vector EventPath::solve(const Vector& f)
{
	Vector x = f, none = Vector::Zero(m.unknowns);
	solvePair(x, none);
	return x;
}

} // namespace blocks
