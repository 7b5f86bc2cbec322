// yade-blocks, GPL-2.0-or-later
#pragma once
#include <atomic>
#include <blocks/kernel/model/FreeContact.hpp>

namespace blocks {

/// The contacts of a State, which know when somebody may have changed them: whoever gets hold of one that can be written, or puts another list in their
/// place, makes a new edition. Columns that were filled from one edition are not used with another one, so nobody has to say that he changed something.
class ContactList {
public:
	ContactList() = default;
	ContactList(const ContactList& other)
		: list(other.list)
	{
	}
	ContactList(ContactList&& other) noexcept
		: list(std::move(other.list))
	{
		other.changed();
	}
	ContactList& operator=(const ContactList& other)
	{
		list = other.list;
		changed();
		return *this;
	}
	ContactList& operator=(ContactList&& other) noexcept
	{
		list = std::move(other.list);
		changed(), other.changed();
		return *this;
	}
	~ContactList() = default;

	const std::vector<FreeContact>& all() const { return list; }
	std::vector<FreeContact>&       all() { return changed(), list; }
	const FreeContact&              operator[](size_t i) const { return list[i]; }
	FreeContact&                    operator[](size_t i) { return changed(), list[i]; }
	auto                            begin() const { return list.begin(); }
	auto                            begin() { return changed(), list.begin(); }
	auto                            end() const { return list.end(); }
	auto                            end() { return list.end(); }
	size_t                          size() const { return list.size(); }
	bool                            empty() const { return list.empty(); }

	/// No two editions have the same number, whichever list they are of.
	long edition() const { return number.load(std::memory_order_relaxed); }
	/// For the step alone, which tells its columns what it tells the contact.
	FreeContact& keepingEdition(size_t i) { return list[i]; }

private:
	static long next()
	{
		static std::atomic<long> last { 0 };
		return ++last;
	}
	void changed() { number.store(next(), std::memory_order_relaxed); } // also by several threads at once, each with a contact of its own

	std::vector<FreeContact> list;
	std::atomic<long>        number { next() };
};

} // namespace blocks
