// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/Fields.hpp>
#include <blocks/kernel/model/Fingerprint.hpp>
#include <boost/archive/archive_exception.hpp>
#include <boost/serialization/array.hpp>
#include <boost/serialization/nvp.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

/// What O.save keeps of an assembly: its fields, the format's number in front, a fingerprint behind.
namespace blocks {

/// Grows whenever the fields change. Files of another format are refused.
constexpr int archiveFormat = 7;

/// Of files that have columns of a joint law of one's own, behind the other fields. All others are as if there were no such columns.
constexpr int formatWithLawColumns = 8;

} // namespace blocks

namespace boost {
namespace serialization {

	template <class Archive> struct FieldArchive {
		Archive&                    ar;
		template <class Field> void operator()(const char* name, Field& field) const { ar& make_nvp(name, field); }
		void                        operator()(const char*, blocks::LawColumns&) const { } // at the end, where there are any
	};

#define BLOCKS_ARCHIVE(type)                                                                                                                                   \
	template <class Archive> void serialize(Archive& ar, blocks::type& x, unsigned) { blocks::forEachField(x, FieldArchive<Archive> { ar }); }
	BLOCKS_ARCHIVE(Material)
	BLOCKS_ARCHIVE(Mesh)
	BLOCKS_ARCHIVE(Segment)
	BLOCKS_ARCHIVE(Pair)
	BLOCKS_ARCHIVE(JointParams)
	BLOCKS_ARCHIVE(CapParams)
	BLOCKS_ARCHIVE(SofteningParams)
	BLOCKS_ARCHIVE(Joints)
	BLOCKS_ARCHIVE(MotionGroup)
	BLOCKS_ARCHIVE(RigidBlock)
	BLOCKS_ARCHIVE(EdgePair)
	BLOCKS_ARCHIVE(FreeContact)
	BLOCKS_ARCHIVE(ContactMemory)
	BLOCKS_ARCHIVE(ReleasedWork)
	BLOCKS_ARCHIVE(Accounts)
	BLOCKS_ARCHIVE(Softened)
	BLOCKS_ARCHIVE(FurtherAccounts)
	BLOCKS_ARCHIVE(LawColumns)
	BLOCKS_ARCHIVE(Dashpot)
	BLOCKS_ARCHIVE(ViscousBoundary)
	BLOCKS_ARCHIVE(State)
#undef BLOCKS_ARCHIVE

	template <class Archive> void serialize(Archive& ar, blocks::BlockAssembly& x, unsigned)
	{
		int format = x.state.lawColumns.empty() ? blocks::archiveFormat : blocks::formatWithLawColumns;
		try {
			ar& make_nvp("format", format);
		} catch (const boost::archive::archive_exception&) {
			format = 1; // there was no such number
		}
		if (format != blocks::archiveFormat && format != blocks::formatWithLawColumns)
			throw std::runtime_error(
				"this file was saved by another version of yade-blocks (format " + std::to_string(format) + ", this one reads "
				+ std::to_string(blocks::archiveFormat) + " and " + std::to_string(blocks::formatWithLawColumns)
				+ "): build the model anew with its script");
		blocks::forEachField(x, FieldArchive<Archive> { ar });
		if (format == blocks::formatWithLawColumns) ar& make_nvp("lawColumns", x.state.lawColumns);
		std::uint64_t sum = Archive::is_loading::value ? 0 : blocks::fingerprint(x);
		ar&           make_nvp("fingerprint", sum);
		if (!Archive::is_loading::value) return;
		if (sum != blocks::fingerprint(x)) throw std::runtime_error("the saved blocks are damaged: their fingerprint does not fit");
		x.rebuild();
		x.forces.before.take(x.state); // so that the next step's dissipation is known, too
	}

} // namespace serialization
} // namespace boost
