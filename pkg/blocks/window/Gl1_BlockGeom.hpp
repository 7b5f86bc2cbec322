// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/views/JointPhys.hpp>
#include <pkg/common/GLDrawFunctors.hpp>

namespace yade {

/// Joints in YADE's window.
class Gl1_BlockGeom : public GlIGeomFunctor {
public:
	virtual ~Gl1_BlockGeom();
	void go(const shared_ptr<IGeom>&, const shared_ptr<Interaction>&, const shared_ptr<Body>&, const shared_ptr<Body>&, bool wire) override;

	// clang-format off
	YADE_CLASS_BASE_DOC(Gl1_BlockGeom, GlIGeomFunctor,
		"Draws joints in YADE's window (``yade.qt.Renderer().intrGeom = True``), midway between their two faces: whole ones green, those that soften "
		"orange, broken ones red.");
	// clang-format on
	RENDERS(BlockGeom)
};
REGISTER_SERIALIZABLE(Gl1_BlockGeom);

/// Stresses of joints in YADE's window.
class Gl1_JointPhys : public GlIPhysFunctor {
public:
	virtual ~Gl1_JointPhys();
	void go(const shared_ptr<IPhys>&, const shared_ptr<Interaction>&, const shared_ptr<Body>&, const shared_ptr<Body>&, bool wire) override;

	static Real scale; ///< length of a bar by the stress [m/Pa]; 0: the largest is as long as a mean joint

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(Gl1_JointPhys, GlIPhysFunctor,
		"Draws normal stresses at contact points in YADE's window (``yade.qt.Renderer().intrPhys = True``) as bars across the joint: compression blue, "
		"tension red. ``Gl1_JointPhys.scale``, of the class: length of a bar by the stress [m/Pa]; 0: the largest stress of the model as it is gets a "
		"bar "
		"twice as long as the mean joint.",
		/*attrs*/,
		/*ctor*/,
		.def_readwrite("scale", &Gl1_JointPhys::scale)
	);
	// clang-format on
	RENDERS(JointPhys)
};
REGISTER_SERIALIZABLE(Gl1_JointPhys);

} // namespace yade
