// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/model/Fields.hpp>
#include <blocks/kernel/model/Fingerprint.hpp>
#include <cstring>

namespace blocks {
namespace {

	struct Hash {
		std::uint64_t sum = 14695981039346656037ull;

		void word(std::uint64_t w) { sum = (sum ^ w) * 1099511628211ull, sum ^= sum >> 29; }

		void operator()(const char*, Real x)
		{
			std::uint64_t bits;
			std::memcpy(&bits, &x, sizeof bits);
			word(bits);
		}
		void operator()(const char*, const Vec2& v) { (*this)("", v.x()), (*this)("", v.y()); }
		void operator()(const char*, const Vec3& v) { (*this)("", v[0]), (*this)("", v[1]), (*this)("", v[2]); }
		void operator()(const char*, const std::string& s)
		{
			word(s.size());
			for (char c : s)
				word(static_cast<unsigned char>(c));
		}
		template <class T> std::enable_if_t<std::is_integral_v<T> || std::is_enum_v<T>> operator()(const char*, const T& x) { word(std::uint64_t(x)); }
		template <class T, size_t n> void                                               operator()(const char*, const std::array<T, n>& list)
		{
			for (const T& x : list)
				(*this)("", x);
		}
		template <class T> void operator()(const char*, const std::vector<T>& list)
		{
			word(list.size());
			for (const T& x : list)
				(*this)("", x);
		}
		void operator()(const char*, const Softened& s) // brittle scenes keep the numbers that they had before joints could soften
		{
			if (!s.empty()) forEachField(s, *this);
		}
		void operator()(const char*, const ContactMemory& x) // scenes without general contact keep theirs
		{
			(*this)("", x.detectedAt), (*this)("", x.lookedAt), (*this)("", x.mayGo);
			if (!x.loosened.empty()) (*this)("", x.loosened);
		}
		void operator()(const char*, const FurtherAccounts& x)
		{
			if (x.any()) forEachField(x, *this);
		}
		void operator()(const char*, const LawColumns& x) // scenes without a law that has columns keep theirs
		{
			if (!x.empty()) forEachField(x, *this);
		}
		template <class T> auto operator()(const char*, const T& x) -> decltype(forEachField(x, std::declval<Hash&>())) { forEachField(x, *this); }
	};

} // namespace

std::uint64_t fingerprint(const State& s)
{
	Hash hash;
	forEachField(s, hash);
	return hash.sum;
}

std::uint64_t fingerprint(const BlockAssembly& a)
{
	Hash hash;
	forEachField(a, hash);
	return hash.sum;
}

} // namespace blocks
