/// Classes with attributes that Python sees and files keep, and the macros that declare them.
///
/// A plugin class lists its attributes once; the list becomes data members and a function visitAttributes(visitor),
/// and everything else (Python properties, keyword arguments, dict(), pickling, archives) is a visitor.
#pragma once

#include <boost/python/raw_function.hpp>
#include <lib/base/AliasNamespaces.hpp>
#include <lib/base/Math.hpp>
#include <lib/factory/Factorable.hpp>

namespace yade {

// Called around saving and loading unless the class has a member of that name, as in `void postLoad(Klass&)`.
template <class T> void preLoad(T&) { }
template <class T> void postLoad(T&) { }
template <class T> void preSave(T&) { }
template <class T> void postSave(T&) { }

namespace Attr {
	enum flags { noSave = 1, readonly = 2, triggerPostLoad = 4, hidden = 8, noResize = 16 };
}

class Serializable : public Factorable {
public:
	Serializable() = default;
	virtual ~Serializable();

	void pyUpdateAttrs(const py::dict& values);

	string           getBaseClassName(unsigned int i = 0) const override;
	int              getBaseClassNumber() const override;
	string           getClassName() const override;
	virtual void     pySetAttr(const string& name, const py::object& value);
	virtual py::dict pyDict() const;
	virtual py::dict pyDictCustom() const;
	virtual void     callPostLoad();
	virtual void     checkPyClassRegistersItself(const string& name) const;
	virtual void     pyRegisterClass(py::object scope);
	virtual void     pyHandleCustomCtorArgs(py::tuple& positional, py::dict& keywords);

	template <class Archive> void serialize(Archive&, unsigned int) { } // it has no attributes of its own
};

namespace api {

	template <int flagBits, class Owner, class Value> struct Attribute {
		static constexpr int flags = flagBits;

		const char* name;
		Value Owner::*member;
		const char*   doc;
	};

	template <int flags, class Owner, class Value> Attribute<flags, Owner, Value> attribute(const char* name, Value Owner::*member, const char* doc)
	{
		return { name, member, doc };
	}

	/// First value of an attribute; no argument means Value().
	template <class Value, class... Arguments> Value initial(Arguments&&... arguments) { return Value(std::forward<Arguments>(arguments)...); }

	/// Python gets a reference to these, so that `state.vel[0] = 1` works; other attributes are copied.
	template <class Value> constexpr bool seenByReference
		= std::is_same_v<
			  Value,
			  Vector2i> || std::is_same_v<Value, Vector3i> || std::is_same_v<Value, Vector2r> || std::is_same_v<Value, Vector3r> || std::is_same_v<Value, Matrix3r> || std::is_same_v<Value, Quaternionr>;

	/// Makes an attribute a property of a Python class.
	struct ExposeAttribute {
		py::object pythonClass;
		py::object property = py::import("builtins").attr("property");

		template <int flags, class Owner, class Value> void operator()(const Attribute<flags, Owner, Value>& a) const
		{
			if constexpr (!(flags & Attr::hidden)) {
				const string doc = a.doc + (" :yattrflags:`" + std::to_string(flags) + "` ");
				py::setattr(pythonClass, a.name, property(getter(a), setter(a), py::object(), doc));
			}
		}

	private:
		template <int flags, class Owner, class Value> static py::object getter(const Attribute<flags, Owner, Value>& a)
		{
			if constexpr (seenByReference<Value>)
				return py::make_getter(a.member);
			else
				return py::make_getter(a.member, py::return_value_policy<py::return_by_value>());
		}

		template <int flags, class Owner, class Value> static py::object setter(const Attribute<flags, Owner, Value>& a)
		{
			if constexpr (flags & Attr::readonly)
				return py::object();
			else if constexpr (flags & Attr::triggerPostLoad) {
				auto set = [member = a.member](Owner& owner, const Value& value) {
					owner.*member = value;
					owner.callPostLoad();
				};
				return py::make_function(set, py::default_call_policies(), boost::mpl::vector3<void, Owner&, const Value&>());
			} else
				return py::make_setter(a.member);
		}
	};

	/// Sets the attribute of that name, if there is one.
	template <class Object> struct SetAttribute {
		Object&           object;
		const string&     name;
		const py::object& value;
		bool              found = false;

		template <int flags, class Owner, class Value> void operator()(const Attribute<flags, Owner, Value>& a)
		{
			if (found || name != a.name) return;
			object.*a.member = py::extract<Value>(value)();
			found            = true;
		}
	};

	/// Collects what Python may see.
	template <class Object> struct CollectAttributes {
		const Object& object;
		py::dict      values;

		template <int flags, class Owner, class Value> void operator()(const Attribute<flags, Owner, Value>& a)
		{
			if constexpr (!(flags & Attr::hidden)) values[a.name] = py::object(object.*a.member);
		}
	};

	/// Saves or loads.
	template <class Object, class Archive> struct ArchiveAttribute {
		Object&  object;
		Archive& archive;

		template <int flags, class Owner, class Value> void operator()(const Attribute<flags, Owner, Value>& a) const
		{
			if (!(flags & Attr::noSave)) archive& boost::serialization::make_nvp(a.name, object.*a.member);
		}
	};

	/// Python's `Class(name=value, ...)`.
	template <class Class> py::object construct(py::tuple arguments, py::dict keywords)
	{
		const py::object self       = arguments[0];
		py::tuple        positional = py::extract<py::tuple>(arguments.slice(1, py::_));

		shared_ptr<Class> object(new Class);
		object->pyHandleCustomCtorArgs(positional, keywords);
		if (py::len(positional) > 0)
			throw std::runtime_error(
				object->getClassName() + " takes keyword arguments only, got " + std::to_string(py::len(positional)) + " without a keyword");
		if (py::len(keywords) > 0) {
			object->pyUpdateAttrs(keywords);
			object->callPostLoad();
		}

		using Holder = py::objects::pointer_holder<shared_ptr<Class>, Class>;
		void* memory = Holder::allocate(self.ptr(), offsetof(py::objects::instance<Holder>, storage), sizeof(Holder));
		try {
			(new (memory) Holder(object))->install(self.ptr());
		} catch (...) {
			Holder::deallocate(self.ptr(), memory);
			throw;
		}
		return py::object();
	}

}

} // namespace yade

// ---- plugin classes: attributes is a sequence of ((type, name, initial value, flags, doc)), all but type and name may be empty

#define YADE_API_TYPE(tuple) BOOST_PP_TUPLE_ELEM(5, 0, tuple)
#define YADE_API_NAME(tuple) BOOST_PP_TUPLE_ELEM(5, 1, tuple)
#define YADE_API_INITIAL(tuple) BOOST_PP_TUPLE_ELEM(5, 2, tuple)
#define YADE_API_FLAGS(tuple) (BOOST_PP_TUPLE_ELEM(5, 3, tuple) + 0)
// YADE's user interface and manual read default and type from the docstring.
#define YADE_API_DOC(tuple)                                                                                                                                    \
	BOOST_PP_TUPLE_ELEM(5, 4, tuple)                                                                                                                       \
	" :ydefault:`" BOOST_PP_STRINGIZE(YADE_API_INITIAL(tuple)) "` :yattrtype:`" BOOST_PP_STRINGIZE(YADE_API_TYPE(tuple)) "`"

#define YADE_API_DECLARE(r, Class, tuple) YADE_API_TYPE(tuple) YADE_API_NAME(tuple) = ::yade::api::initial<YADE_API_TYPE(tuple)>(YADE_API_INITIAL(tuple));
#define YADE_API_VISIT(r, Class, tuple)                                                                                                                        \
	visit(::yade::api::attribute<YADE_API_FLAGS(tuple)>(BOOST_PP_STRINGIZE(YADE_API_NAME(tuple)), &Class::YADE_API_NAME(tuple), YADE_API_DOC(tuple)));
#define YADE_API_INITIALISER(r, data, i, pair)                                                                                                                 \
	BOOST_PP_IF(i, BOOST_PP_COMMA, : BOOST_PP_EMPTY)() BOOST_PP_TUPLE_ELEM(2, 0, pair)(BOOST_PP_TUPLE_ELEM(2, 1, pair))

#define YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(Class, Base, classDoc, attributes, initialisers, constructor, members)                                          \
public:                                                                                                                                                        \
	BOOST_PP_SEQ_FOR_EACH(YADE_API_DECLARE, Class, attributes)                                                                                             \
	Class() BOOST_PP_SEQ_FOR_EACH_I(YADE_API_INITIALISER, ~, initialisers) { constructor; }                                                                \
                                                                                                                                                               \
	template <class Visitor> static void visitAttributes([[maybe_unused]] Visitor&& visit) { BOOST_PP_SEQ_FOR_EACH(YADE_API_VISIT, Class, attributes) }    \
                                                                                                                                                               \
	void pySetAttr(const std::string& attributeName, const boost::python::object& value) override                                                          \
	{                                                                                                                                                      \
		::yade::api::SetAttribute<Class> set { *this, attributeName, value };                                                                          \
		visitAttributes(set);                                                                                                                          \
		if (!set.found) Base::pySetAttr(attributeName, value);                                                                                         \
	}                                                                                                                                                      \
	boost::python::dict pyDict() const override                                                                                                            \
	{                                                                                                                                                      \
		::yade::api::CollectAttributes<Class> collect { *this, {} };                                                                                   \
		visitAttributes(collect);                                                                                                                      \
		collect.values.update(this->pyDictCustom());                                                                                                   \
		collect.values.update(Base::pyDict());                                                                                                         \
		return collect.values;                                                                                                                         \
	}                                                                                                                                                      \
	void callPostLoad() override                                                                                                                           \
	{                                                                                                                                                      \
		Base::callPostLoad();                                                                                                                          \
		postLoad(*this);                                                                                                                               \
	}                                                                                                                                                      \
	void pyRegisterClass(boost::python::object scopeOfClass) override                                                                                      \
	{                                                                                                                                                      \
		checkPyClassRegistersItself(#Class);                                                                                                           \
		boost::python::scope                                                                                   scope(scopeOfClass);                    \
		boost::python::docstring_options                                                                       docstrings(true, true, false);          \
		boost::python::class_<Class, boost::shared_ptr<Class>, boost::python::bases<Base>, boost::noncopyable> pythonClass(#Class, classDoc);          \
		pythonClass.def("__init__", boost::python::raw_function(::yade::api::construct<Class>, 1));                                                    \
		visitAttributes(::yade::api::ExposeAttribute { pythonClass });                                                                                 \
		(void)pythonClass members;                                                                                                                     \
	}                                                                                                                                                      \
                                                                                                                                                               \
private:                                                                                                                                                       \
	friend class boost::serialization::access;                                                                                                             \
	template <class Archive> void serialize(Archive& archive, unsigned int)                                                                                \
	{                                                                                                                                                      \
		archive& boost::serialization::make_nvp(#Base, boost::serialization::base_object<Base>(*this));                                                \
		if (Archive::is_loading::value)                                                                                                                \
			preLoad(*this);                                                                                                                        \
		else                                                                                                                                           \
			preSave(*this);                                                                                                                        \
		visitAttributes(::yade::api::ArchiveAttribute<Class, Archive> { *this, archive });                                                             \
		if (Archive::is_loading::value)                                                                                                                \
			postLoad(*this);                                                                                                                       \
		else                                                                                                                                           \
			postSave(*this);                                                                                                                       \
	}                                                                                                                                                      \
	REGISTER_CLASS_AND_BASE(Class, Base)

#define YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(Class, Base, doc, attributes, constructor, members)                                                                  \
	YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(Class, Base, doc, attributes, , constructor, members)
#define YADE_CLASS_BASE_DOC_ATTRS_CTOR(Class, Base, doc, attributes, constructor)                                                                              \
	YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(Class, Base, doc, attributes, , constructor, )
#define YADE_CLASS_BASE_DOC_ATTRS(Class, Base, doc, attributes) YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(Class, Base, doc, attributes, , , )
#define YADE_CLASS_BASE_DOC(Class, Base, doc) YADE_CLASS_BASE_DOC_ATTRS_INIT_CTOR_PY(Class, Base, doc, , , , )

/// After a plugin class, inside namespace yade.
#define REGISTER_SERIALIZABLE(Class)                                                                                                                           \
	}                                                                                                                                                      \
	BOOST_CLASS_EXPORT_KEY(yade::Class)                                                                                                                    \
	namespace yade {

// ---- classes whose code is in YADE's libraries

/// In the class: the functions that registration gave it there.
#define YADE_API_IN_LIBRARY                                                                                                                                    \
public:                                                                                                                                                        \
	std::string         getBaseClassName(unsigned int i = 0) const override;                                                                               \
	int                 getBaseClassNumber() const override;                                                                                               \
	std::string         getClassName() const override;                                                                                                     \
	void                pySetAttr(const std::string& name, const boost::python::object& value) override;                                                   \
	boost::python::dict pyDict() const override;                                                                                                           \
	void                callPostLoad() override;                                                                                                           \
	void                pyRegisterClass(boost::python::object scope) override;                                                                             \
                                                                                                                                                               \
private:                                                                                                                                                       \
	friend class boost::serialization::access;                                                                                                             \
	template <class Archive> void serialize(Archive&, unsigned int);                                                                                       \
                                                                                                                                                               \
public:

/// After the class, inside namespace yade: the code that saves and loads it is there, too.
#define YADE_API_SAVED_IN_LIBRARY(Class)                                                                                                                       \
	}                                                                                                                                                      \
	BOOST_CLASS_EXPORT_KEY(yade::Class)                                                                                                                    \
	namespace boost {                                                                                                                                      \
		namespace archive {                                                                                                                            \
			namespace detail {                                                                                                                     \
				extern template void oserializer<xml_oarchive, yade::Class>::save_object_data(basic_oarchive&, const void*) const;             \
				extern template void oserializer<binary_oarchive, yade::Class>::save_object_data(basic_oarchive&, const void*) const;          \
				extern template void                                                                                                           \
				iserializer<xml_iarchive, yade::Class>::load_object_data(basic_iarchive&, void*, const unsigned int) const;                    \
				extern template void                                                                                                           \
				iserializer<binary_iarchive, yade::Class>::load_object_data(basic_iarchive&, void*, const unsigned int) const;                 \
			}                                                                                                                                      \
		}                                                                                                                                              \
	}                                                                                                                                                      \
	namespace yade {
