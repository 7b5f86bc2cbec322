// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

/// Who may touch whom. Whatever the speed, a contact is known before its edges meet: the grid points are compared in every step with where
/// they were when neighbours were last looked for, and margins cover what they may have moved since.
namespace blocks {

/// Whether the scene has general contact. Without it broken joints keep their places.
void setGeneralContact(BlockAssembly&, bool);

/// Before forces: releases broken joints to free contacts and looks for neighbours, where something moved far or broke. Serial. Refuses blocks that come so
/// fast that they might be past each other before their contact acts; dt: of the step that led here, and of the next one [s]. With `account`, a.state.accounts
/// gets what joints held and the free contacts that took their places do not.
void prepareContacts(BlockAssembly&, Real dt = 0, bool account = false);

} // namespace blocks
