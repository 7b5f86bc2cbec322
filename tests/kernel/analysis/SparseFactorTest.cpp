// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>
#include <blocks/kernel/analysis/SparseFactor.hpp>

using namespace specimens;

namespace {

/// A grid of springs to the right and upward neighbour, and weak ones to the ground.
Eigen::MatrixXd grid(int n)
{
	Eigen::MatrixXd k    = 0.01 * Eigen::MatrixXd::Identity(n * n, n * n);
	auto            join = [&](int a, int b, Real s) { k(a, a) += s, k(b, b) += s, k(a, b) -= s, k(b, a) -= s; };
	for (int i = 0; i < n * n; ++i) {
		if (i % n + 1 < n) join(i, i + 1, 1 + 0.3 * (i % 5));
		if (i + n < n * n) join(i, i + n, 2 + 0.7 * (i % 3));
	}
	return k;
}

SparseFactor::Matrix upper(const Eigen::MatrixXd& k)
{
	SparseFactor::Matrix s = k.sparseView();
	return s.triangularView<Eigen::Upper>();
}

Real error(const SparseFactor& f, const Eigen::MatrixXd& k)
{
	const int         n  = int(k.rows());
	Eigen::VectorXd   x0 = Eigen::VectorXd::LinSpaced(n, -1, 2), x1 = x0.cwiseProduct(x0), b0 = k * x0, b1 = k * x1;
	std::vector<Real> b(2 * n);
	for (int i = 0; i < n; ++i)
		b[2 * i] = b0[i], b[2 * i + 1] = b1[i];
	f.solveTwo(b);
	Real worst = 0;
	for (int i = 0; i < n; ++i)
		worst = std::max({ worst, std::abs(b[2 * i] - x0[i]), std::abs(b[2 * i + 1] - x1[i]) });
	return worst;
}

} // namespace

TEST(SparseFactor, FollowsChangesOfRankOne)
{
	Eigen::MatrixXd k = grid(12);
	SparseFactor    f(upper(k));
	EXPECT_LT(error(f, k), 1e-11); // condition 1e3
	std::mt19937 random(3);
	for (int change = 0; change < 60; ++change) { // springs between neighbours go, others between strangers come and go
		const int       a = int(random() % 143), b = change % 2 ? int(random() % 143) : a + 1;
		const Real      s = change % 3 ? 0.4 : -0.2;
		Eigen::VectorXd v = Eigen::VectorXd::Zero(144);
		if (a == b) continue;
		v[a] = 1, v[b] = -0.5;
		if ((k + s * v * v.transpose()).ldlt().vectorD().minCoeff() < 1e-3) continue;
		k += s * v * v.transpose();
		f.add(s, { { a, 1 }, { b, -0.5 } });
		ASSERT_LT(error(f, k), 1e-9) << change; // rounding of up to 60 changes
	}
}

TEST(SparseFactor, LargeMatricesTakeTheDenseWay)
{
	SparseFactor::Matrix              k(160 * 160, 160 * 160);
	std::vector<Eigen::Triplet<Real>> entries;
	const int                         n = 160;
	for (int i = 0; i < n * n; ++i) {
		entries.emplace_back(i, i, 4.01);
		if (i % n + 1 < n) entries.emplace_back(i, i + 1, -1);
		if (i + n < n * n) entries.emplace_back(i, i + n, -1);
	}
	k.setFromTriplets(entries.begin(), entries.end());
	SparseFactor f(k);
	f.add(3, { { 7, 1 }, { 8, -1 } });
	k.coeffRef(7, 7) += 3, k.coeffRef(8, 8) += 3, k.coeffRef(7, 8) -= 3;
	Eigen::VectorXd   x = Eigen::VectorXd::LinSpaced(n * n, -1, 2), b = k.selfadjointView<Eigen::Upper>() * x;
	std::vector<Real> two(2 * n * n);
	for (int i = 0; i < n * n; ++i)
		two[2 * i] = two[2 * i + 1] = b[i];
	f.solveTwo(two);
	for (int i = 0; i < n * n; ++i)
		ASSERT_NEAR(two[2 * i + 1], x[i], 1e-9);
}

TEST(SparseFactor, ShowsWhatIsSingular)
{
	Eigen::MatrixXd k = grid(5);
	EXPECT_GT(SparseFactor(upper(k)).leastPivot(), 1e-4);
	k -= 0.01 * Eigen::MatrixXd::Identity(25, 25); // nothing holds it
	EXPECT_LT(SparseFactor(upper(k)).leastPivot(), 1e-13);
}
