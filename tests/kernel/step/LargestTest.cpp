// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/step/Largest.hpp>

#include <gtest/gtest.h>
#include <limits>
#include <random>

using namespace blocks;

TEST(Largest, IsTheLargestInSizeWhereverItStands)
{
	std::mt19937                         random(3);
	std::uniform_real_distribution<Real> anywhere(-1, 1);
	for (int count = 0; count < 70; ++count) {
		std::vector<Real> now(count), then(count);
		Real              most = 0, apart = 0;
		for (int i = 0; i < count; ++i) {
			now[i] = anywhere(random), then[i] = anywhere(random);
			most = std::max(most, std::abs(now[i])), apart = std::max(apart, std::abs(now[i] - then[i]));
		}
		EXPECT_EQ(largest(now.data(), count), most);
		EXPECT_EQ(farthest(now.data(), then.data(), count), apart);
		for (int i = 0; i < count; ++i) {
			std::vector<Real> other = now;
			other[i]                = -3;
			EXPECT_EQ(largest(other.data(), count), 3);
		}
	}
}

TEST(Largest, NeverLosesWhatIsNoNumber)
{
	for (int i = 0; i < 40; ++i)
		for (Real lost : { std::numeric_limits<Real>::quiet_NaN(), -std::numeric_limits<Real>::quiet_NaN() }) {
			std::vector<Real> values(40, std::numeric_limits<Real>::infinity()), nothing(40, 0);
			values[i] = lost;
			EXPECT_TRUE(std::isnan(largest(values.data(), 40))) << i;
			EXPECT_TRUE(std::isnan(farthest(values.data(), nothing.data(), 40))) << i;
		}
}
