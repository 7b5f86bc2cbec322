// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/views/BlockModel.hpp>

namespace yade {

/// BlockModel.follow and BlockModel.elasticJump in Python; see their docstrings.
py::dict
	 follow(BlockModel&,
                const py::object& group,
                bool              peak,
                Real              drop,
                Real              displacement,
                long              cracks,
                const string&     release,
                const py::object& gauges,
                const py::object& progress);
py::dict elasticJump(BlockModel&, Real fraction);

extern const char* const followDoc;

} // namespace yade
