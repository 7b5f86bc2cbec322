#pragma once

/// The one object of a class; which objects there are is settled in YADE's libraries.
template <class T> class Singleton {
public:
	static T& instance();
};
