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

	/// Names of the columns that it keeps, model.assembly.state.lawColumns[name] in advance(): one number a contact point, 0 when the law first works, part
	/// of the state from then on.
	virtual const vector<string>& columns() const;

	// clang-format off
	YADE_CLASS_BASE_DOC(BlockLaw, Serializable,
		"Base of joint laws of one's own for :yref:`BlockLoop.law`: derive from it in C++ and work on ranges of contact points, one virtual call a "
		"range, or try a law out in Python with :yref:`NumpyLaw`. "
		"A law that remembers more of a contact point than the model does names columns for it. They are 0 when it first works, saved and put back "
		"with the model, and shown as :yref:`BlockModel.lawColumns`.");
	// clang-format on
};
REGISTER_SERIALIZABLE(BlockLaw);

class NumpyLaw : public BlockLaw {
public:
	virtual ~NumpyLaw();
	void                  advance(BlockModel&, blocks::JointRange) const override;
	bool                  serial() const override { return true; }
	const vector<string>& columns() const override { return columnNames; }
	void                  pyHandleCustomCtorArgs(py::tuple&, py::dict&) override;

	py::list getColumns() const;
	void     setColumns(const py::object&);

	py::object function; ///< what is called; None after loading

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(NumpyLaw, BlockLaw,
		"A joint law written in numpy, for trying out: ``BlockLoop(law=NumpyLaw(function))``. In every step ``function(columns)`` is called with a "
		"dictionary of arrays, one entry a contact point, that are views of the model's memory: "
		"'opening', 'slip' [m] (given), 'sigma', 'tau' [Pa] (to be written), 'slipPlastic', 'uplift' [m] and 'status' (0 intact, 1 broken in tension, "
		"2 in shear, 3 never bonded; kept from step to step). "
		"What else the law remembers are columns of its own: with ``NumpyLaw(function, columns=('wear',))`` the dictionary has 'wear' too, to be "
		"written, 0 at first and kept from step to step. "
		"All of it is saved and put back with the model (:yref:`BlockModel.lawColumns`). Joints that have become free contacts or whose block was "
		"removed keep their places; what is written there carries nothing. "
		"The arrays are good for the call only. The function is not saved: after O.load it must be given anew, ``O.engines[i].law.function = "
		"function``.",
		((vector<string>, columnNames, , Attr::hidden, "Columns of its own."))
		,
		/*ctor*/,
		.def_readwrite("function", &NumpyLaw::function, "What is called in every step.")
		.add_property("columns", &NumpyLaw::getColumns, &NumpyLaw::setColumns, "Names of the columns that the law keeps, one number a contact point "
			"each; words, none of those that the dictionary has anyway. A model whose columns are there already takes no others: "
			":yref:`dropLawColumns<BlockModel.dropLawColumns>` forgets them.")
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(NumpyLaw);

} // namespace yade
