// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/views/BlockModel.hpp>

namespace yade {

/// Shows free contacts that have come or gone in O.interactions. Serial; does something only where contacts have changed.
void showContacts(Scene*, BlockModel&);

/// The same for one who cannot know what has become of those that were shown: all are looked for.
void showAllContacts(Scene*, BlockModel&);

} // namespace yade
