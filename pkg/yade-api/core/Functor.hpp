#pragma once

#include <core/Timing.hpp>
#include <lib/multimethods/FunctorWrapper.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

class Scene;

class Functor : public Serializable {
public:
	shared_ptr<TimingDeltas> timingDeltas;
	Scene*                   scene = nullptr; ///< set by the dispatcher before each run
	string                   label;

	Functor() = default;
	virtual ~Functor();
	YADE_API_IN_LIBRARY
	virtual vector<string> getFunctorTypes() const;
};
YADE_API_SAVED_IN_LIBRARY(Functor)

template <class Type, class Result, class Arguments> class Functor1D : public Functor, public FunctorWrapper<Result, Arguments> {
public:
	string         getClassName() const override;
	string         getBaseClassName(unsigned int i = 0) const override;
	int            getBaseClassNumber() const override;
	vector<string> getFunctorTypes() const override;
	virtual string get1DFunctorType1() const;
};

template <class Type1, class Type2, class Result, class Arguments> class Functor2D : public Functor, public FunctorWrapper<Result, Arguments> {
public:
	string         getClassName() const override;
	string         getBaseClassName(unsigned int i = 0) const override;
	int            getBaseClassNumber() const override;
	vector<string> getFunctorTypes() const override;
	virtual string get2DFunctorType1() const;
	virtual string get2DFunctorType2() const;
};

} // namespace yade

// The classes a functor accepts.
#define FUNCTOR1D(Type)                                                                                                                                        \
public:                                                                                                                                                        \
	std::string get1DFunctorType1() const override { return #Type; }
#define FUNCTOR2D(Type1, Type2)                                                                                                                                \
public:                                                                                                                                                        \
	std::string get2DFunctorType1() const override { return #Type1; }                                                                                      \
	std::string get2DFunctorType2() const override { return #Type2; }
