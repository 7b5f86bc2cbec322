// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/analysis/SparseFactor.hpp>
#include <numeric>
#include <suitesparse/cholmod.h>

namespace blocks {

struct SparseFactor::Cholmod {
	cholmod_common  common;
	cholmod_factor* factor = nullptr;

	Cholmod() { cholmod_start(&common); }
	~Cholmod()
	{
		cholmod_free_factor(&factor, &common);
		cholmod_finish(&common);
	}
};

SparseFactor::SparseFactor(const Matrix& upper)
	: c(new Cholmod)
	, count(int(upper.rows()))
{
	constexpr int large = 20000; // beyond it dense parts pay
	auto&         m     = c->common;
	m.print             = 0;
	m.supernodal        = count > large ? CHOLMOD_SUPERNODAL : CHOLMOD_SIMPLICIAL;
	m.final_asis        = 0;
	m.final_super       = 0;
	m.final_ll          = 0;
	m.final_monotonic   = 1;

	cholmod_sparse a {};
	a.nrow = a.ncol = count;
	a.nzmax         = upper.nonZeros();
	a.p             = const_cast<int*>(upper.outerIndexPtr());
	a.i             = const_cast<int*>(upper.innerIndexPtr());
	a.x             = const_cast<Real*>(upper.valuePtr());
	a.stype         = 1;
	a.itype         = CHOLMOD_INT;
	a.xtype         = CHOLMOD_REAL;
	a.dtype         = CHOLMOD_DOUBLE;
	a.sorted = a.packed = 1;
	if (count == 0) return;
	c->factor = cholmod_analyze(&a, &m);
	if (c->factor) cholmod_factorize(&a, c->factor, &m);
	if (!c->factor || m.status < CHOLMOD_OK)
		throw std::runtime_error(
			"a stiffness of " + std::to_string(count) + " unknowns could not be factorised: CHOLMOD's status " + std::to_string(m.status));
	const bool definite = m.status == CHOLMOD_OK;
	const int* perm     = static_cast<const int*>(c->factor->Perm);
	place.resize(count);
	for (int i = 0; i < count; ++i)
		place[perm[i]] = i;
	work.resize(count);
	if (!definite && c->factor->xtype != CHOLMOD_REAL) { // stopped at a pivot: nothing to solve with
		least    = 0;
		leastRow = perm[std::min(size_t(count) - 1, c->factor->minor)];
		return;
	}
	if (!cholmod_change_factor(CHOLMOD_REAL, 0, 0, 0, 1, c->factor, &m)) throw std::runtime_error("memory ran out for the factors of a stiffness");

	findRuns();

	const int*  p = static_cast<const int*>(c->factor->p);
	const Real* x = static_cast<const Real*>(c->factor->x);
	least         = definite ? 1 : 0;
	if (!definite) leastRow = perm[std::min(size_t(count) - 1, c->factor->minor)];
	for (int j = 0; definite && j < count; ++j) {
		const Real share = x[p[j]] / upper.coeff(perm[j], perm[j]);
		if (!(share >= least)) least = share, leastRow = perm[j];
	}
}

SparseFactor::~SparseFactor() = default;

long SparseFactor::entries() const { return c->factor ? long(c->factor->nzmax) : 0; }

void SparseFactor::add(Real scale1, const Entries& v1, Real scale2, const Entries& v2)
{
	std::vector<int>  index;
	std::vector<Real> values;
	int               ends[3] = { 0, 0, 0 }, columns = 0;
	for (const auto& [scale, v] : { std::pair<Real, const Entries&>(scale1, v1), std::pair<Real, const Entries&>(scale2, v2) }) {
		std::vector<std::pair<int, Real>> rows;
		const Real                        root = std::sqrt(std::abs(scale));
		for (const auto& [row, value] : v)
			if (value != 0) rows.emplace_back(place[row], root * value);
		if (rows.empty() || scale == 0) continue;
		std::sort(rows.begin(), rows.end());
		for (const auto& [row, value] : rows)
			index.push_back(row), values.push_back(value);
		ends[++columns] = int(index.size());
	}
	if (columns == 0) return;
	cholmod_sparse a {};
	a.nrow   = count;
	a.ncol   = columns;
	a.nzmax  = index.size();
	a.p      = ends;
	a.i      = index.data();
	a.x      = values.data();
	a.itype  = CHOLMOD_INT;
	a.xtype  = CHOLMOD_REAL;
	a.dtype  = CHOLMOD_DOUBLE;
	a.sorted = a.packed = 1;
	if (!cholmod_updown(scale1 + scale2 > 0, &a, c->factor, &c->common)) throw std::runtime_error("memory ran out for the factors of a stiffness");
	const int* nz = static_cast<const int*>(c->factor->nz);
	if (std::accumulate(nz, nz + count, 0L) != used) findRuns();
}

namespace {

	using Pair = Eigen::Array<Real, 2, 1>; ///< of both right-hand sides

	/// y of `rows` loses what `W` columns take from it.
	template <int W> void takeBelow(const int* rows, int count, const Real* const* column, const Pair* top, Pair* y)
	{
		Pair x[W];
		for (int w = 0; w < W; ++w)
			x[w] = top[w];
		for (int k = 0; k < count; ++k) {
			Pair v = y[rows[k]];
			for (int w = 0; w < W; ++w)
				v -= column[w][k] * x[w];
			y[rows[k]] = v;
		}
	}

	/// What `W` columns make of y of `rows`, taken from `top`.
	template <int W> void takeAbove(const int* rows, int count, const Real* const* column, Pair* top, const Pair* y)
	{
		Pair x[W];
		for (int w = 0; w < W; ++w)
			x[w] = top[w];
		for (int k = 0; k < count; ++k) {
			const Pair v = y[rows[k]];
			for (int w = 0; w < W; ++w)
				x[w] -= column[w][k] * v;
		}
		for (int w = 0; w < W; ++w)
			top[w] = x[w];
	}

	constexpr int                     most    = 4; ///< columns side by side
	constexpr decltype(&takeBelow<1>) below[] = { nullptr, takeBelow<1>, takeBelow<2>, takeBelow<3>, takeBelow<4> };
	constexpr decltype(&takeAbove<1>) above[] = { nullptr, takeAbove<1>, takeAbove<2>, takeAbove<3>, takeAbove<4> };

} // namespace

/// Finds the runs of up to `most` columns whose rows are the same, but for those within the run. Both displacements of a grid point are in one.
void SparseFactor::findRuns()
{
	const int* p  = static_cast<const int*>(c->factor->p);
	const int* nz = static_cast<const int*>(c->factor->nz);
	const int* is = static_cast<const int*>(c->factor->i);
	runs.assign(1, 0);
	for (int j = 1; j < count; ++j) {
		const int *before = is + p[j - 1] + 1, *rows = is + p[j];
		if (j - runs.back() == most || nz[j - 1] != nz[j] + 1 || !std::equal(rows, rows + nz[j], before)) runs.push_back(j);
	}
	runs.push_back(count);
	used = std::accumulate(nz, nz + count, 0L);
}

void SparseFactor::solveTwo(std::vector<Real>& b) const
{
	if (count == 0) return;
	const int*  p  = static_cast<const int*>(c->factor->p);
	const int*  nz = static_cast<const int*>(c->factor->nz);
	const int*  is = static_cast<const int*>(c->factor->i);
	const Real* xs = static_cast<const Real*>(c->factor->x);
	Pair*       y  = work.data();
	for (int i = 0; i < count; ++i)
		y[place[i]] = { b[2 * i], b[2 * i + 1] };

	const Real* column[most];
	for (size_t run = 0; run + 1 < runs.size(); ++run) {
		const int from = runs[run], to = runs[run + 1], last = p[to - 1];
		bool      any = false; // a spring's own right-hand side reaches few rows
		for (int j = from; j < to; ++j) {
			for (int i = j + 1; i < to; ++i)
				y[i] -= xs[p[j] + i - j] * y[j];
			any              = any || y[j][0] != 0 || y[j][1] != 0;
			column[j - from] = xs + p[j] + to - j;
		}
		if (any) below[to - from](is + last + 1, nz[to - 1] - 1, column, y + from, y);
	}
	for (int run = int(runs.size()) - 2; run >= 0; --run) {
		const int from = runs[run], to = runs[run + 1], last = p[to - 1];
		for (int j = from; j < to; ++j)
			y[j] /= xs[p[j]], column[j - from] = xs + p[j] + to - j;
		above[to - from](is + last + 1, nz[to - 1] - 1, column, y + from, y);
		for (int j = to - 1; j >= from; --j)
			for (int i = j + 1; i < to; ++i)
				y[j] -= xs[p[j] + i - j] * y[i];
	}
	for (int i = 0; i < count; ++i)
		b[2 * i] = y[place[i]][0], b[2 * i + 1] = y[place[i]][1];
}

} // namespace blocks
