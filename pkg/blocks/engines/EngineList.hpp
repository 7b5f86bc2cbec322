// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/views/BlockModel.hpp>

/// What scripts may have done to a scene that blocks would not notice: refused in a sentence. Asks Python and looks at every body, so not in every step.
namespace yade {

/// Refuses lists of engines in which blocks would be stepped twice, or YADE would abort. flat: whether BlockLoop computes the joints.
void requireEngines(const Scene*, const BlockModel&, bool flat);

/// Refuses bodies, materials, joints and forces that were changed behind the model's back.
void requireUntouched(const Scene*, const BlockModel&, int threads);

/// What is no error, but not what one would expect; empty if there is nothing.
string remarks(const Scene*, const BlockModel&);

} // namespace yade
