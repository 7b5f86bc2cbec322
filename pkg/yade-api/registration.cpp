/// Part of every plugin: tells YADE of the plugin's classes when the plugin is loaded after YADE has started.
#include <core/Omega.hpp>
#include <dlfcn.h>
#include <lib/factory/ClassFactory.hpp>
#include <lib/serialization/Serializable.hpp>

/// Which YADE the plugin was built for; the Python side looks for this text before it loads the file.
extern "C" __attribute__((used)) const char yadePluginBuiltFor[] = "plugin built for YADE " YADE_VERSION;

/// Registers all classes that YADE does not know yet, in its database and in Python.
extern "C" void yadeRegisterNewClasses()
{
	using namespace yade;
	std::vector<std::string> names;
	for (const std::string& name : ClassFactory::instance().pluginClasses)
		if (!Omega::instance().getDynlibsDescriptor().count(name)) names.push_back(name);

	// Omega::buildDynlibDatabase(names), which YADE exports but declares private
	using BuildDynlibDatabase             = void (*)(Omega*, const std::vector<std::string>&);
	const char* const symbol              = "_ZN4yade5Omega19buildDynlibDatabaseERKSt6vectorINSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEESaIS7_EE";
	const auto        buildDynlibDatabase = reinterpret_cast<BuildDynlibDatabase>(dlsym(RTLD_DEFAULT, symbol));
	if (buildDynlibDatabase && !names.empty()) buildDynlibDatabase(&Omega::instance(), names);
}

/// Tells YADE's window, if it was opened before the plugin was loaded, of the functors that draw. `renderer`: yade.qt.Renderer().
extern "C" void yadeDrawNewClasses(PyObject* renderer)
{
	// OpenGLRenderer::init(), which asks all classes once more; it derives from Serializable alone
	using Init      = void (*)(yade::Serializable*);
	const auto init = reinterpret_cast<Init>(dlsym(RTLD_DEFAULT, "_ZN4yade14OpenGLRenderer4initEv"));
	if (init) init(&boost::python::extract<yade::Serializable&>(renderer)());
}
