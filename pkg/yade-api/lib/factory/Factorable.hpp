#pragma once

#include <boost/enable_shared_from_this.hpp>
#include <lib/factory/ClassFactory.hpp>

namespace yade {

/// Root of all classes that can be made by name.
class Factorable : public boost::enable_shared_from_this<Factorable> {
public:
	virtual ~Factorable();
	virtual string getBaseClassName(unsigned int i = 0) const;
	virtual int    getBaseClassNumber() const;
	virtual string getClassName() const;
};

} // namespace yade

#define REGISTER_CLASS_AND_BASE(Class, Base)                                                                                                                   \
public:                                                                                                                                                        \
	std::string getClassName() const override { return #Class; }                                                                                           \
	std::string getBaseClassName(unsigned int i = 0) const override { return i == 0 ? #Base : ""; }                                                        \
	int         getBaseClassNumber() const override { return 1; }
