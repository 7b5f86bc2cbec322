// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/Two.hpp>
#include <blocks/kernel/Wide.hpp>
#include <blocks/kernel/step/CloseRests.hpp>
#include <cmath>

namespace blocks {
namespace {

	/// Where corners a1, b0, b1 have gone, as seen from a0 [m].
	struct Moves {
		alignas(64) RestColumns::Lane x[3], y[3];
	};

	void gather(const BlockAssembly& a, const RestColumns& c, Moves& m)
	{
		const Vec2* u = a.state.displacement.data();
		for (int i = 0; i < c.count; i += 2) { // an odd last one is taken twice; the columns have room for it
			const auto &node = c.node[i], &next = c.node[std::min(i + 1, c.count - 1)];
			const Two   a0 = loadTwo(u[node[0]]), nextA0 = loadTwo(u[next[0]]);
			for (int k : { 0, 1, 2 }) {
				const Two one = loadTwo(u[node[k + 1]]) - a0, other = loadTwo(u[next[k + 1]]) - nextA0;
				store(m.x[k] + i, firsts(one, other)), store(m.y[k] + i, seconds(one, other));
			}
		}
	}

	/// See leftOf() in Rests.hpp.
	WIDE void leftOfAll(const RestColumns& c, const Moves& m, Real* left)
	{
#pragma GCC ivdep
		for (int i = 0, whole = (c.count + 3) / 4 * 4; i < whole; ++i) { // a few lanes of old numbers cost less than a loop of their own
			Real square[3];
			for (int k = 0; k < 3; ++k) {
				const Real x = m.x[k][i] - c.fromX[k][i], y = m.y[k][i] - c.fromY[k][i];
				square[k] = x * x + y * y;
			}
			left[i] = c.free[i] - std::sqrt(square[0]) - std::sqrt(square[1] > square[2] ? square[1] : square[2]);
		}
	}

} // namespace

std::uint32_t stirring(const BlockAssembly& a, const RestColumns& c)
{
	Moves                         moves;
	alignas(64) RestColumns::Lane left;
	gather(a, c, moves);
	leftOfAll(c, moves, left);
	std::uint32_t stirring = 0;
	for (int i = 0; i < c.count; ++i)
		stirring |= std::uint32_t(!(left[i] > 0)) << i;
	return stirring;
}

} // namespace blocks
