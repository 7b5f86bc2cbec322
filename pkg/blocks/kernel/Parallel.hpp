// yade-blocks, GPL-2.0-or-later
#pragma once
#include <exception>

namespace blocks {

/// work(0) ... work(count - 1), which must not depend on each other, on so many threads. If some throw, what the first of them threw is thrown again.
template <class Work> void forEachInParallel(int count, [[maybe_unused]] int threads, const Work& work)
{
	int                first = count;
	std::exception_ptr failed; // none may leave a parallel region
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
	for (int i = 0; i < count; ++i) {
		try {
			work(i);
		} catch (...) {
#pragma omp critical(blocksFailedInParallel)
			if (i < first) first = i, failed = std::current_exception();
		}
	}
	if (failed) std::rethrow_exception(failed);
}

} // namespace blocks
