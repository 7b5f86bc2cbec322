/// Execution times, kept while O.timingEnabled.
#pragma once

#include <lib/base/Math.hpp>
#include <time.h>

namespace yade {

struct TimingInfo {
	using delta = unsigned long long; ///< [ns]

	long  nExec = 0;
	delta nsec  = 0;

	static bool enabled;

	static delta getNow(bool evenIfDisabled = false)
	{
		if (!enabled && !evenIfDisabled) return 0;
		timespec now;
		clock_gettime(CLOCK_MONOTONIC, &now);
		return now.tv_sec * 1000000000ULL + now.tv_nsec;
	}
};

/// Times of parts of one engine: start(), then checkpoint("name of the part that ends here") after each.
class TimingDeltas {
	TimingInfo::delta last;
	size_t            i = 0;

public:
	vector<TimingInfo> data;
	vector<string>     labels;

	void start()
	{
		i    = 0;
		last = TimingInfo::getNow();
	}
	void checkpoint(const string& label)
	{
		if (!TimingInfo::enabled) return;
		const TimingInfo::delta now = TimingInfo::getNow();
		if (i == data.size()) {
			data.emplace_back();
			labels.push_back(label);
		}
		data[i].nExec++;
		data[i].nsec += now - last;
		last = now;
		i++;
	}
};

} // namespace yade
