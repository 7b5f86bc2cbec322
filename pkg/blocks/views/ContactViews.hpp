// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/views/BlockModel.hpp>

namespace yade {

/// Shows free contacts that have come or gone in O.interactions. Serial; does something only where contacts have changed.
void showContacts(Scene*, BlockModel&);

/// Shows all free contacts anew, for one who cannot know what has become of those that were shown.
void showAllContacts(Scene*, BlockModel&);

} // namespace yade
