// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/views/Block.hpp>
#include <pkg/common/GLDrawFunctors.hpp>

namespace yade {

/// Blocks in YADE's window.
class Gl1_Block : public GlShapeFunctor {
public:
	virtual ~Gl1_Block();
	void go(const shared_ptr<Shape>&, const shared_ptr<State>&, bool wire, const GLViewInfo&) override;

	static string   colour;        ///< one of colourings()
	static bool     zones, cracks; ///< whether they are drawn
	static Vector2r range;         ///< of the colours; equal: that of the model as it is

	static string    getColour();
	static void      setColour(const string&);
	static py::tuple getShownRange();

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(Gl1_Block, GlShapeFunctor,
		"Draws :yref:`Block` in YADE's window (``yade.qt.View``): zones, outlines and broken joints, where they are now. yadeblocks.window opens a "
		"window that "
		"looks on the plane of the blocks. Settings belong to the class, ``Gl1_Block.colour = 'sigma1'``, and to all blocks of the scene. "
		"colour: what zones are coloured by, 'material' (or the colour of a body's shape), 'displacement' [m], 'sigma1', 'sigma2', 'sxx', 'syy', 'sxy' "
		"[Pa] or "
		"'damage', the share of a block's joints that is broken [1]; zones: whether the zones' edges are drawn; cracks: whether broken joints are, "
		"red, at both "
		"faces; range: values of the ends of the colour scale, equal ones for those of the model as it is; shownRange: the values that were drawn "
		"last.",
		/*attrs*/,
		/*ctor*/,
		.add_static_property("colour", &Gl1_Block::getColour, &Gl1_Block::setColour)
		.def_readwrite("zones", &Gl1_Block::zones)
		.def_readwrite("cracks", &Gl1_Block::cracks)
		.def_readwrite("range", &Gl1_Block::range)
		.add_static_property("shownRange", &Gl1_Block::getShownRange)
	);
	// clang-format on
	RENDERS(Block)
};
REGISTER_SERIALIZABLE(Gl1_Block);

} // namespace yade
