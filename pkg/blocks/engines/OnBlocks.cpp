// yade-blocks, GPL-2.0-or-later
#include <blocks/engines/OnBlocks.hpp>
#include <chrono>
#include <thread>

namespace yade {

void holdBack() { std::this_thread::sleep_for(std::chrono::milliseconds(100)); }

} // namespace yade
