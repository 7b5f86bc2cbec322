// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/model/LawColumns.hpp>
#include <cctype>
#include <stdexcept>

namespace blocks {
namespace {

	/// Columns of contact points and their joints in State, in Python and in ParaView files.
	const char* const taken[] = { "opening", "slip",     "sigma",      "tau",         "slipPlastic", "uplift", "status",
		                      "damage",  "released", "firstBlock", "secondBlock", "normal",      "area",   "name" };

	std::string listed(const std::vector<std::string>& names)
	{
		std::string out;
		for (const std::string& name : names)
			out += (out.empty() ? "'" : ", '") + name + "'";
		return out.empty() ? "none" : out;
	}

	bool isWord(const std::string& name)
	{
		const auto fits = [](unsigned char c) { return c == '_' || (c < 128 && std::isalnum(c)); };
		return !name.empty() && !std::isdigit(static_cast<unsigned char>(name[0])) && std::all_of(name.begin(), name.end(), fits);
	}

} // namespace

void requireColumnNames(const std::string& whose, const std::vector<std::string>& names)
{
	for (const std::string& name : names) {
		if (!isWord(name)) throw std::invalid_argument(whose + ": a column's name must be letters, digits and _, no digit first, got '" + name + "'");
		if (std::find(std::begin(taken), std::end(taken), name) != std::end(taken))
			throw std::invalid_argument(
				whose + ": a column's name must not be that of a column that contact points have anyway ("
				+ listed({ std::begin(taken), std::end(taken) }) + "), got '" + name + "'");
		if (std::count(names.begin(), names.end(), name) > 1)
			throw std::invalid_argument(whose + ": no two columns may have one name, got " + listed(names));
	}
}

std::vector<Real>& LawColumns::operator[](const std::string& name)
{
	const auto found = std::find(names.begin(), names.end(), name);
	if (found == names.end()) throw std::invalid_argument("joint laws have no column '" + name + "'; there are: " + listed(names));
	return columns[found - names.begin()];
}

void LawColumns::claim(const std::string& law, const std::vector<std::string>& wanted, int points)
{
	if (wanted == names) return;
	requireColumnNames(law, wanted);
	if (!empty())
		throw std::invalid_argument(
			law + " must name the columns that the model has from an earlier joint law, in their order: " + listed(names) + ", got "
			+ listed(wanted) + " (BlockModel.dropLawColumns() forgets those of the earlier one)");
	names = wanted;
	columns.assign(names.size(), std::vector<Real>(points, 0));
}

} // namespace blocks
