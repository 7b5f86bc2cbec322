// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/analysis/SparseFactor.hpp>
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
	work.resize(2 * count);
	if (!definite && c->factor->xtype != CHOLMOD_REAL) { // stopped at a pivot: nothing to solve with
		least    = 0;
		leastRow = perm[std::min(size_t(count) - 1, c->factor->minor)];
		return;
	}
	if (!cholmod_change_factor(CHOLMOD_REAL, 0, 0, 0, 1, c->factor, &m)) throw std::runtime_error("memory ran out for the factors of a stiffness");

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

void SparseFactor::add(Real scale, const Entries& v)
{
	std::vector<std::pair<int, Real>> rows;
	const Real                        root = std::sqrt(std::abs(scale));
	for (const auto& [row, value] : v)
		if (value != 0) rows.emplace_back(place[row], root * value);
	if (rows.empty() || scale == 0) return;
	std::sort(rows.begin(), rows.end());
	std::vector<int>  index;
	std::vector<Real> values;
	for (const auto& [row, value] : rows)
		index.push_back(row), values.push_back(value);
	int            ends[2] = { 0, int(rows.size()) };
	cholmod_sparse a {};
	a.nrow   = count;
	a.ncol   = 1;
	a.nzmax  = rows.size();
	a.p      = ends;
	a.i      = index.data();
	a.x      = values.data();
	a.itype  = CHOLMOD_INT;
	a.xtype  = CHOLMOD_REAL;
	a.dtype  = CHOLMOD_DOUBLE;
	a.sorted = a.packed = 1;
	if (!cholmod_updown(scale > 0, &a, c->factor, &c->common)) throw std::runtime_error("memory ran out for the factors of a stiffness");
}

void SparseFactor::solveTwo(std::vector<Real>& b) const
{
	if (count == 0) return;
	const int*  p  = static_cast<const int*>(c->factor->p);
	const int*  nz = static_cast<const int*>(c->factor->nz);
	const int*  is = static_cast<const int*>(c->factor->i);
	const Real* xs = static_cast<const Real*>(c->factor->x);
	Real*       y  = work.data();
	for (int i = 0; i < count; ++i)
		y[2 * place[i]] = b[2 * i], y[2 * place[i] + 1] = b[2 * i + 1];
	for (int j = 0; j < count; ++j) {
		const Real y0 = y[2 * j], y1 = y[2 * j + 1];
		if (y0 == 0 && y1 == 0) continue; // a spring's own right-hand side reaches few rows
		for (int k = p[j] + 1, end = p[j] + nz[j]; k < end; ++k) {
			y[2 * is[k]] -= xs[k] * y0;
			y[2 * is[k] + 1] -= xs[k] * y1;
		}
	}
	for (int j = count - 1; j >= 0; --j) {
		const Real pivot = xs[p[j]];
		Real       y0 = y[2 * j] / pivot, y1 = y[2 * j + 1] / pivot;
		for (int k = p[j] + 1, end = p[j] + nz[j]; k < end; ++k) {
			y0 -= xs[k] * y[2 * is[k]];
			y1 -= xs[k] * y[2 * is[k] + 1];
		}
		y[2 * j] = y0, y[2 * j + 1] = y1;
	}
	for (int i = 0; i < count; ++i)
		b[2 * i] = y[2 * place[i]], b[2 * i + 1] = y[2 * place[i] + 1];
}

} // namespace blocks
