#pragma once

#include <lib/base/Math.hpp>
#include <omp.h>

namespace yade {

/// Sums with one slice per thread; EnergyTracker keeps its energies here.
template <class T> class OpenMPArrayAccumulator {
	int             CLS;
	size_t          nThreads;
	int             perCL;
	std::vector<T*> chunks; ///< a slice per thread, in memory of whole cache lines
	size_t          sz;
	size_t          nCL;

public:
	size_t size() const { return sz; }

	T get(size_t i) const
	{
		T sum(0);
		for (const T* slice : chunks)
			sum += slice[i];
		return sum;
	}
	void set(size_t i, const T& value)
	{
		for (T* slice : chunks)
			slice[i] = T(0);
		chunks[0][i] = value;
	}
	void add(size_t i, const T& increment) { chunks[omp_get_thread_num()][i] += increment; }
};

} // namespace yade
