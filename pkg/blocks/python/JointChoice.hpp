// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/views/BlockModel.hpp>

/// Which joints a script means. `method` is named where it is refused.
namespace yade {

/// Joints by their indices or by a name or several; None: all.
vector<long> chosenJoints(const BlockModel&, const py::object& which, const string& method);

/// Those of some joints that are between two materials and within a region; None: wherever they are.
vector<long> narrowed(const BlockModel&, const vector<long>& joints, const py::object& pair, const py::object& region, const string& method);

} // namespace yade
