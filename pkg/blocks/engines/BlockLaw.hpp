// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/step/Joints.hpp>
#include <blocks/views/BlockModel.hpp>

namespace yade {

/// A joint law of one's own, for BlockLoop.law.
class BlockLaw : public Serializable {
public:
	virtual ~BlockLaw();

	/// Stresses and states of the joints' contact points from openings and slips, all in model.assembly.state. Called from several
	/// threads for different ranges: it may write only what belongs to its range.
	virtual void advance(BlockModel&, blocks::JointRange) const;

	/// Whether advance() wants all joints at once, from one thread.
	virtual bool serial() const { return false; }

	// clang-format off
	YADE_CLASS_BASE_DOC(BlockLaw, Serializable,
		"Base of joint laws of one's own for :yref:`BlockLoop.law`: derive from it in C++ and work on ranges of contact points, one virtual call a range, or try a law out in Python with :yref:`NumpyLaw`.");
	// clang-format on
};
REGISTER_SERIALIZABLE(BlockLaw);

class NumpyLaw : public BlockLaw {
public:
	virtual ~NumpyLaw();
	void advance(BlockModel&, blocks::JointRange) const override;
	bool serial() const override { return true; }
	void pyHandleCustomCtorArgs(py::tuple&, py::dict&) override;

	py::object function; ///< what is called; None after loading

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(NumpyLaw, BlockLaw,
		"A joint law written in numpy, for trying out: ``BlockLoop(law=NumpyLaw(function))``. In every step ``function(columns)`` is called with a dictionary of arrays, one entry a contact point, that are views of the model's memory: "
		"'opening', 'slip' [m] (given), 'sigma', 'tau' [Pa] (to be written), 'slipPlastic', 'uplift' [m] and 'status' (0 intact, 1 broken in tension, 2 in shear, 3 never bonded; kept from step to step, saved with the model); keep further columns in Python objects of your own. "
		"The function is not saved: after O.load it must be given anew.",
		/*attrs*/,
		/*ctor*/,
		.def_readwrite("function", &NumpyLaw::function, "What is called in every step.")
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(NumpyLaw);

} // namespace yade
