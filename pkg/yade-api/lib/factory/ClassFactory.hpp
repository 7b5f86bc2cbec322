/// YADE's register of classes that can be made by name, and YADE_PLUGIN, which enters a plugin's classes.
#pragma once

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/archive/xml_iarchive.hpp>
#include <boost/archive/xml_oarchive.hpp>
#include <boost/serialization/export.hpp> // after the archives: it exports to those it knows
#include <boost/serialization/list.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/nvp.hpp>
#include <boost/serialization/shared_ptr.hpp>
#include <boost/serialization/vector.hpp>
#include <lib/base/Math.hpp>
#include <lib/base/Singleton.hpp>
#include <list>
#include <map>

namespace yade {

class Factorable;

class DynLibManager {
	std::map<const std::string, void*> handles;
	bool                               autoUnload;
	std::string                        lastError_;
};

class ClassFactory : public Singleton<ClassFactory> {
	struct Creators {
		Factorable* (*create)();
		shared_ptr<Factorable> (*createShared)();
		void* (*createPureCustom)();
	};

	virtual ~ClassFactory(); // the first member of the object is its vtable

	DynLibManager                   dlm;
	std::map<std::string, Creators> map;

public:
	bool registerFactorable(std::string name, Factorable* (*create)(), shared_ptr<Factorable> (*createShared)(), void* (*createPureCustom)());
	void registerPluginClasses(const char* fileAndClasses[]);

	std::list<string> pluginClasses; ///< names of all classes of all loaded libraries
};

namespace api {

	template <class Class> bool makeFactorable(const char* name)
	{
		return ClassFactory::instance().registerFactorable(
			name,
			[]() -> Factorable* { return new Class; },
			[]() -> shared_ptr<Factorable> { return shared_ptr<Class>(new Class); },
			[]() -> void* { return new Class; });
	}

}

} // namespace yade

// For use inside namespace yade, as in YADE; boost's macros must stand outside it.
#define YADE_API_PLUGIN_NAME(r, data, Class) BOOST_PP_STRINGIZE(Class),
#define YADE_API_PLUGIN_FACTORY(r, data, Class) ::yade::api::makeFactorable<yade::Class>(BOOST_PP_STRINGIZE(Class));
#define YADE_API_PLUGIN_EXPORT(r, data, Class) BOOST_CLASS_EXPORT_IMPLEMENT(yade::Class)
#define YADE_PLUGIN(classes)                                                                                                                                   \
	}                                                                                                                                                      \
	BOOST_PP_SEQ_FOR_EACH(YADE_API_PLUGIN_EXPORT, ~, classes)                                                                                              \
	namespace {                                                                                                                                            \
		__attribute__((constructor)) void BOOST_PP_CAT(enterPlugin, BOOST_PP_SEQ_HEAD(classes))()                                                      \
		{                                                                                                                                              \
			BOOST_PP_SEQ_FOR_EACH(YADE_API_PLUGIN_FACTORY, ~, classes)                                                                             \
			const char* fileAndClasses[] = { "plugin", BOOST_PP_SEQ_FOR_EACH(YADE_API_PLUGIN_NAME, ~, classes) nullptr };                          \
			::yade::ClassFactory::instance().registerPluginClasses(fileAndClasses);                                                                \
		}                                                                                                                                              \
	}                                                                                                                                                      \
	namespace yade {
