// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/Types.hpp>
#include <string>
#include <vector>

namespace blocks {

/// What a joint law of one's own remembers of contact points besides JointState: columns with names, each one number a contact point. Empty where no law
/// asks for any.
struct LawColumns {
	std::vector<std::string>       names;
	std::vector<std::vector<Real>> columns; ///< of each name; the law knows their units

	bool empty() const { return names.empty(); }

	/// A column by its name, which is there.
	std::vector<Real>& operator[](const std::string& name);

	/// Makes a law's columns, of zeros, where there are none yet. Where there are, they must have these names in this order. `law`: what it is called.
	void claim(const std::string& law, const std::vector<std::string>& wanted, int points);
};

/// Refuses names that no column of a law can have: no words, one twice, those of the columns that contact points have anyway. `whose`: what is to be said.
void requireColumnNames(const std::string& whose, const std::vector<std::string>& names);

} // namespace blocks
