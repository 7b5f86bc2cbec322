// yade-blocks, GPL-2.0-or-later
#pragma once
#include <Eigen/SparseCore>
#include <blocks/kernel/Types.hpp>
#include <memory>

/// A sparse symmetric matrix as P^T L D L^T P, whose factors follow a change of rank one without being computed anew (CHOLMOD of SuiteSparse, simplicial).
namespace blocks {

class SparseFactor {
public:
	using Matrix  = Eigen::SparseMatrix<Real>;
	using Entries = std::vector<std::pair<int, Real>>; ///< of a sparse vector; no index twice

	/// Orders and factorises; only the upper triangle is read. Errors: std::runtime_error where memory runs out. A matrix that is
	/// not positive definite shows in leastPivot().
	explicit SparseFactor(const Matrix& upper);
	~SparseFactor();
	SparseFactor(const SparseFactor&)            = delete;
	SparseFactor& operator=(const SparseFactor&) = delete;

	int size() const { return count; }

	/// The smallest entry of D by the diagonal entry of the matrix in the same row, as first factorised: zero to rounding if it is singular.
	Real leastPivot() const { return least; }
	/// The row of that entry.
	int rowOfLeastPivot() const { return leastRow; }

	/// matrix += scale v v^T.
	void add(Real scale, const Entries& v);

	/// x = matrix^-1 b for two right-hand sides side by side: b[2 i + k], in place. Twice the work costs little more time: L passes the memory once.
	void solveTwo(std::vector<Real>& b) const;

	/// Entries of L, which the time of a solution goes with.
	long entries() const;

private:
	struct Cholmod;
	std::unique_ptr<Cholmod>  c;
	int                       count    = 0;
	Real                      least    = 1;
	int                       leastRow = -1;
	std::vector<int>          place; ///< row of the matrix -> row of L
	mutable std::vector<Real> work;
};

} // namespace blocks
