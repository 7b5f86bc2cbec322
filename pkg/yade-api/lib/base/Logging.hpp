/// Messages on the standard error stream, filtered by YADE's default level: yade.log.setLevel('Default', yade.log.INFO).
/// Levels by class name need boost::log in every class; here they are not offered.
#pragma once

#include <iostream>
#include <lib/base/Singleton.hpp>
#include <sstream>
#include <string>

/// YADE's table of filter levels; in YADE, too, it is outside its namespace.
class Logging : public Singleton<Logging> {
public:
	short getNamedLogLevel(const std::string& name) const;
};

namespace yade {
namespace api {

	struct Logger {
		const char* name;

		bool shows(int level) const { return level <= Logging::instance().getNamedLogLevel("Default"); }
	};

}
}

// A class that logs says DECLARE_LOGGER in its declaration and CREATE_LOGGER(Name) in its source file.
#define DECLARE_LOGGER                                                                                                                                         \
public:                                                                                                                                                        \
	static ::yade::api::Logger logger
#define CREATE_LOGGER(Class)                                                                                                                                   \
	::yade::api::Logger Class::logger { #Class }
#define CREATE_CPP_LOCAL_LOGGER(name)                                                                                                                          \
	namespace {                                                                                                                                            \
		::yade::api::Logger logger { name };                                                                                                           \
	}

#define YADE_API_LOG(level, levelName, message)                                                                                                                \
	{                                                                                                                                                      \
		if (logger.shows(level)) {                                                                                                                     \
			std::ostringstream yadeApiText;                                                                                                        \
			yadeApiText << "<" levelName "> " << logger.name << ":" << __LINE__ << " " << __func__ << ": " << message << "\n";                     \
			std::cerr << yadeApiText.str();                                                                                                        \
		}                                                                                                                                              \
	}
#define LOG_FATAL(message) YADE_API_LOG(1, "FATAL ERROR", message)
#define LOG_ERROR(message) YADE_API_LOG(2, "ERROR", message)
#define LOG_WARN(message) YADE_API_LOG(3, "WARNING", message)
#define LOG_INFO(message) YADE_API_LOG(4, "INFO", message)
#define LOG_DEBUG(message) YADE_API_LOG(5, "DEBUG", message)
#define LOG_TRACE(message) YADE_API_LOG(6, "TRACE", message)
