// yade-blocks, GPL-2.0-or-later
#pragma once
#include <lib/base/Math.hpp>

/// Saving a scene from within an engine.
namespace yade {

/// Saves the present scene; what went wrong, empty if nothing did. YADE's own way would say nothing where a file cannot be opened, and on a full disk
/// its compressors never end: so O.save does it if yadeblocks is there (see saving.py), and else only where the file can be opened.
string saveScene(const string& file);

} // namespace yade
