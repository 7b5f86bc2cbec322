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
	void add(Real scale, const Entries& v) { add(scale, v, 0, {}); }
	/// matrix += scale1 v1 v1^T + scale2 v2 v2^T, both scales of one sign, in one pass.
	void add(Real scale1, const Entries& v1, Real scale2, const Entries& v2);

	/// x = matrix^-1 b for two right-hand sides side by side: b[2 i + k], in place. Twice the work costs little more time: L passes the memory once.
	void solveTwo(std::vector<Real>& b) const;

	/// Entries of L, which the time of a solution goes with.
	long entries() const;

private:
	void findRuns();

	struct Cholmod;
	std::unique_ptr<Cholmod> c;
	int                      count    = 0;
	Real                     least    = 1;
	int                      leastRow = -1;
	std::vector<int>         place;    ///< row of the matrix -> row of L
	std::vector<int>         runs;     ///< first columns of runs of columns with the same rows, and the end
	long                     used = 0; ///< entries of L that are in use
	mutable std::vector<Eigen::Array<Real, 2, 1>, Eigen::aligned_allocator<Eigen::Array<Real, 2, 1>>> work;
};

} // namespace blocks
