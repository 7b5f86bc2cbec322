// yade-blocks, GPL-2.0-or-later
#include <Eigen/Dense>
#include <Specimens.hpp>
#include <blocks/kernel/analysis/EventPath.hpp>

/// The path from event to event against a search over all states of the broken points, with dense matrices and the law itself.
using namespace specimens;

namespace {

JointParams brittle(Real tanPhiResidual)
{
	JointParams p;
	p.kn = 400e9, p.ks = 200e9;
	p.tension = 0.6e6, p.cohesion = 1.5e6, p.tanPhi = 0.9, p.tanPhiResidual = tanPhiResidual;
	return p;
}

BlockAssembly wall(const JointParams& joint, bool shear, unsigned seed)
{
	BlockAssembly a    = voronoi(0.3, 0.2, 3, 2, stone(), joint, 0.5, nullptr, seed);
	auto          low  = [](const Vec2& x) { return x.y() < 1e-9; };
	auto          high = [](const Vec2& x) { return x.y() > 0.2 - 1e-9; };
	auto          held = dofs(a, 0, low);
	for (int dof : dofs(a, 1, low))
		held.push_back(dof);
	a.addGroup(driven("low", held, 0));
	a.addGroup(driven("load", dofs(a, shear ? 0 : 1, high), 1e-3));
	if (shear) a.addGroup(pushed("press", dofs(a, 1, high), -0.5e6 * 0.15));
	return a;
}

struct Search {
	const LinearModel& m;
	Eigen::MatrixXd    zones = Eigen::MatrixXd(Eigen::MatrixXd(m.zones).selfadjointView<Eigen::Upper>());

	Eigen::VectorXd row(const LinearPoint& p, bool normal) const
	{
		Eigen::VectorXd b = Eigen::VectorXd::Zero(m.unknowns);
		for (int k = 0; k < p.count; ++k)
			b[p.unknown[k]] = normal ? p.n[k] : p.t[k];
		return b;
	}

	/// All displacements at this load for which every point has, by the law and what it remembered at `before`, the stress that its state says, and
	/// no intact one breaks.
	std::vector<Eigen::VectorXd> solutions(const std::vector<ModePoint>& before, Real lambda) const
	{
		std::vector<int> broken;
		for (int i = 0; i < int(before.size()); ++i)
			if (before[i].mode != Mode::intact) broken.push_back(i);
		std::vector<Eigen::VectorXd> found;
		int                          cases = 1;
		for (size_t i = 0; i < broken.size(); ++i)
			cases *= 4;
		for (int c = 0; c < cases; ++c) {
			Eigen::MatrixXd        k     = zones;
			Eigen::VectorXd        f     = m.load + lambda * (m.loadGrowth - m.zonesDriven) - m.zoneForce;
			std::vector<ModePoint> modes = before;
			int                    digit = c;
			for (int i : broken) {
				modes[i].mode = digit % 4 == 0 ? Mode::stick : digit % 4 == 3 ? Mode::open : Mode::slide;
				modes[i].sign = digit % 4 == 1 ? 1 : -1;
				digit /= 4;
			}
			for (size_t i = 0; i < modes.size(); ++i) { // sigma, tau are linear in opening and slip: by three evaluations
				const LinearPoint&    p = m.points[i];
				const Stress          s = stressOf(p.joint, modes[i], p.opening + p.nDriven * lambda, p.slip + p.tDriven * lambda);
				const Stress          n = stressRate(p.joint, modes[i], 1, 0), t = stressRate(p.joint, modes[i], 0, 1);
				const Eigen::VectorXd bn = row(p, true), bt = row(p, false);
				k += p.area * (bn * (n.sigma * bn + t.sigma * bt).transpose() + bt * (n.tau * bn + t.tau * bt).transpose());
				f -= p.area * (s.sigma * bn + s.tau * bt);
			}
			const Eigen::VectorXd u    = k.partialPivLu().solve(f);
			bool                  good = u.allFinite() && (k * u - f).norm() < 1e-8 * f.norm();
			for (size_t i = 0; good && i < modes.size(); ++i) {
				const LinearPoint& p = m.points[i];
				const Real   un = p.opening + p.nDriven * lambda + row(p, true).dot(u), us = p.slip + p.tDriven * lambda + row(p, false).dot(u);
				const Stress s       = stressOf(p.joint, modes[i], un, us);
				const JointStep law  = advance(p.joint, before[i].state, un, us);
				const Real      near = 1e-6 * p.joint.tension;
				good                 = std::abs(s.sigma - law.sigma) < near && std::abs(s.tau - law.tau) < near;
				good                 = good && (before[i].mode != Mode::intact || law.state.status == Joint::intact);
			}
			const bool known = std::any_of(found.begin(), found.end(), [&](const auto& v) { return (v - u).norm() < 1e-6 * u.norm(); });
			if (good && !known) found.push_back(u);
		}
		return found;
	}
};

} // namespace

TEST(EventPathSearch, EveryStateIsTheOnlyAdmissibleOne)
{
	int checked = 0, fallen = 0, compared = 0;
	for (Real mu : { 0., 0.6 })
		for (unsigned seed = 1; seed <= 12; ++seed) {
			const bool        shear = seed % 2 == 0;
			BlockAssembly     a     = wall(brittle(mu), shear, seed);
			const LinearModel m     = linearise(a, [&] {
                                Growth g;
                                g.group.assign(a.state.groups.size(), 0);
                                g.group[1] = 1;
                                return g;
                        }());
			const Search      search { m };
			EventPath         path(m);
			ASSERT_TRUE(path.settle()) << path.ended();
			std::vector<ModePoint> before = path.state().modes;
			Real                   at     = path.state().lambda;
			while (path.advance() && path.cracks().size() <= 4) {
				// what was intact and has broken since keeps what it remembered at breaking
				const PathState& s = path.state();
				for (size_t i = 0; i < before.size(); ++i)
					if (before[i].mode == Mode::intact && s.modes[i].mode != Mode::intact) before[i] = s.modes[i];
				const auto found = search.solutions(before, s.lambda * (1 - 1e-12)); // the pending one just holds
				bool       there = false;
				for (const auto& u : found)
					there = there || (u - s.u).norm() < 1e-6 * s.u.norm();
				EXPECT_TRUE(there) << "seed " << seed << " mu " << mu << " crack " << path.cracks().size() << " of " << found.size();
				if (mu == 0) {
					EXPECT_EQ(found.size(), 1u) << "seed " << seed << " crack " << path.cracks().size();
				}
				if (s.lambda < at * (1 - 1e-9) && mu == 0) { // the load fell no more than it had to
					EXPECT_TRUE(search.solutions(before, s.lambda * (1 + 1e-6)).empty()) << "seed " << seed;
					++fallen;
				}
				++(mu == 0 ? checked : compared);
				before = s.modes;
				at     = s.lambda;
			}
		}
	EXPECT_GT(checked, 50);
	EXPECT_GT(compared, 50);
	EXPECT_GT(fallen, 3);
}
