// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/Parallel.hpp>

#include <atomic>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <vector>

using blocks::forEachInParallel;

TEST(Parallel, EveryoneIsWorkedOnOnce)
{
	for (int threads : { 1, 2, 3 })
		for (int count : { 0, 1, 2, 7, 1000 }) {
			std::vector<std::atomic<int>> times(count);
			forEachInParallel(count, threads, [&](int i) { ++times[i]; });
			for (int i = 0; i < count; ++i)
				EXPECT_EQ(times[i], 1) << threads << " threads, " << i << " of " << count;
		}
}

// Whoever complains, and however many threads there are, the user is told the same.
TEST(Parallel, TheFirstComplaintIsTold)
{
	for (int threads : { 1, 2, 3 })
		for (int repeat = 0; repeat < 50; ++repeat) {
			std::atomic<int> done { 0 };
			try {
				forEachInParallel(300, threads, [&](int i) {
					++done;
					if (i == 40 || i == 120 || i >= 250) throw std::runtime_error(std::to_string(i));
				});
				FAIL() << "nothing was thrown";
			} catch (const std::runtime_error& e) {
				EXPECT_STREQ(e.what(), "40") << threads << " threads";
			}
			EXPECT_EQ(done, 300) << threads << " threads";
		}
}
