// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/views/BlockModel.hpp>

/// Colours of what YADE's window shows.
namespace yade {

/// What zones may be coloured by.
const vector<string>& colourings();

/// A value for each zone, and for each rigid block, and the range that the colours span.
struct Coloured {
	vector<Real> zone, block; ///< block: of rigid ones; no number where they have no such value or have been removed
	Real         low = 0, high = 1;
};

/// Of the model as it is. `what` is one of colourings() other than 'material'.
Coloured colouredBy(const string& what, const blocks::BlockAssembly&, const Vector2r& range);

/// Blue, white, red along [low, high]; grey for what is no number.
Vector3r colourOf(Real value, Real low, Real high);

/// By number: materials that lie next to each other look different.
Vector3r colourOfMaterial(int material);

} // namespace yade
