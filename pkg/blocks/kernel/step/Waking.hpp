// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

/// Which edge pairs of contacts are worked on and which rest; what is in columns follows.
namespace blocks {

/// Brings the columns of a run of contacts up to date: asks those whose rest is over, those that rest close, and now and then those in work that do not touch.
/// Columns are filled anew where some begin or end their rest. dt: for how soon a rest may be over [s].
void wake(BlockAssembly&, int run, Real dt);

/// Asks all pairs of one contact, whose columns are not to be used.
void wakeContact(BlockAssembly&, int contact);

/// Nothing of a contact is in columns yet.
void beginColumns(BlockAssembly&, int contact);

/// Puts a pair that is in work into a free lane. place: of its contact, in FreeContacts::order.
void putInColumns(BlockAssembly&, int contact, int place, int pair, EdgeColumns&);

} // namespace blocks
