// yade-blocks, GPL-2.0-or-later
#include <Eigen/LU>
#include <algorithm>
#include <blocks/kernel/analysis/EventPath.hpp>

/// What friction adds to the tangent stiffness: a column of U and V for every point that slides with mu != psi.
namespace blocks {
namespace {

	/// The factor of t c^T, the unsymmetric part of a sliding point [N/m].
	Real frictionOf(const LinearPoint& p, const ModePoint& m)
	{
		return -p.area * m.sign * slidingStiffness(p.joint, m) * (p.joint.tanPhiResidual - psiOf(p.joint, m));
	}

} // namespace

/// G and W where S^-1 loses S^-1 B^T c B S^-1. False if W is not exact enough.
bool EventPath::followFriction(const Two& c)
{
	if (slides.empty()) return true;
	g.noalias() -= (vY * c) * uY.transpose();
	const Columns                                wv   = w * vY;
	const Eigen::Matrix<Real, 2, Eigen::Dynamic> uw   = uY.transpose() * w;
	const Two                                    core = Two::Identity() - c * (uY.transpose() * wv);
	if (!wellConditioned(core)) return false;
	w.noalias() += (wv * (core.inverse() * c)) * uw;
	return true;
}

/// Takes a point out of U and V, if it is there. False if W is not exact enough.
bool EventPath::dropFriction(int i)
{
	const auto known = std::find(slides.begin(), slides.end(), i);
	if (known == slides.end()) return true;
	const int at = int(known - slides.begin()), last = int(slides.size()) - 1; // the last takes its place
	for (Dense* of : { &g, &w }) {
		of->row(at).swap(of->row(last));
		of->col(at).swap(of->col(last));
	}
	for (Columns* of : { &vY, &uY })
		of->row(at).swap(of->row(last)), of->conservativeResize(last, 2);
	std::swap(slides[at], slides[last]);
	std::swap(frictionD[at], frictionD[last]);
	const Real corner = w(last, last), d = frictionD.back();
	slides.pop_back();
	frictionD.pop_back();
	w.topLeftCorner(last, last) -= (w.col(last).head(last) / corner * w.row(last).head(last)).eval();
	g.conservativeResize(last, last);
	w.conservativeResize(last, last);
	return std::abs(corner) > 1e-5 * std::abs(d);
}

/// Puts a point into U and V if it slides now; `own` is B S^-1 B^T. False if W is not exact enough.
bool EventPath::addFriction(int i, const Two& own)
{
	const LinearPoint& p    = m.points[i];
	const ModePoint&   mode = is.modes[i];
	const Real         d    = mode.mode == Mode::slide ? frictionOf(p, mode) : 0;
	if (d == 0) return true;
	const int    s      = int(slides.size());
	const Real   psi    = mode.sign * psiOf(p.joint, mode);
	const Vector column = vY.col(1), row = uY.col(0) - psi * uY.col(1);
	const Real   corner = own(0, 1) - psi * own(1, 1);
	g.conservativeResize(s + 1, s + 1);
	g.col(s).head(s) = column;
	g.row(s).head(s) = row.transpose();
	g(s, s)          = corner;
	slides.push_back(i);
	frictionD.push_back(d);

	const Vector wc = w.topLeftCorner(s, s) * column, rw = w.topLeftCorner(s, s).transpose() * row;
	const Real   left = 1 / d + corner - row.dot(wc);
	w.conservativeResize(s + 1, s + 1);
	w.topLeftCorner(s, s) += wc * rw.transpose() / left;
	w.col(s).head(s) = -wc / left;
	w.row(s).head(s) = -rw.transpose() / left;
	w(s, s)          = 1 / left;
	return std::abs(left) > 1e-5 * std::abs(1 / d);
}

/// W from G.
void EventPath::invertFriction()
{
	sinceInverted = 0;
	if (slides.empty()) return;
	Dense h = g;
	for (size_t j = 0; j < slides.size(); ++j)
		h(j, j) += 1 / frictionD[j];
	w = Eigen::PartialPivLU<Dense>(h).inverse();
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
	const size_t s = slides.size();
	g.resize(s, s);
	std::vector<Real> x(2 * m.unknowns);
	for (size_t j = 0; j < s; j += 2) { // two columns at a time
		std::fill(x.begin(), x.end(), 0);
		const size_t two = std::min<size_t>(2, s - j);
		for (size_t column = 0; column < two; ++column) {
			const LinearPoint& of = m.points[slides[j + column]];
			for (int k = 0; k < of.count; ++k)
				x[2 * of.unknown[k] + column] = of.t[k];
		}
		factor->solveTwo(x);
		for (size_t column = 0; column < two; ++column)
			for (size_t i = 0; i < s; ++i) {
				const LinearPoint& p = m.points[slides[i]];
				const ModePoint&   q = is.modes[slides[i]];
				g(i, j + column)     = p.times(p.n, &x[column], 2) - q.sign * psiOf(p.joint, q) * p.times(p.t, &x[column], 2);
			}
	}
	invertFriction();
}

/// x -= S^-1 U W t.
void EventPath::withFriction(std::vector<Real>& x, const Columns& t)
{
	const int s = int(slides.size());
	if (s == 0) return;
	const Columns y = w * t;
	third.assign(2 * m.unknowns, 0);
	for (int j = 0; j < s; ++j) {
		const LinearPoint& q = m.points[slides[j]];
		for (int k = 0; k < q.count; ++k)
			third[2 * q.unknown[k]] += q.t[k] * y(j, 0), third[2 * q.unknown[k] + 1] += q.t[k] * y(j, 1);
	}
	factor->solveTwo(third);
	for (size_t k = 0; k < x.size(); ++k)
		x[k] -= third[k];
}

} // namespace blocks
