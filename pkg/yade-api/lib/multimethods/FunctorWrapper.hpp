#pragma once

#include <boost/mpl/at.hpp>
#include <boost/mpl/vector.hpp>
#include <string>

namespace yade {

/// The calls a dispatcher may make, with one to seven arguments; each family of functors overrides one of them.
template <class Result, class Arguments> class FunctorWrapper {
	template <int i> using Argument = typename boost::mpl::at_c<Arguments, i>::type;
	using A0                        = Argument<0>;
	using A1                        = Argument<1>;
	using A2                        = Argument<2>;
	using A3                        = Argument<3>;
	using A4                        = Argument<4>;
	using A5                        = Argument<5>;
	using A6                        = Argument<6>;

public:
	FunctorWrapper() = default;
	virtual ~FunctorWrapper();
	virtual std::string checkOrder() const;

	virtual Result go(A0);
	virtual Result go(A0, A1);
	virtual Result go(A0, A1, A2);
	virtual Result go(A0, A1, A2, A3);
	virtual Result go(A0, A1, A2, A3, A4);
	virtual Result go(A0, A1, A2, A3, A4, A5);
	virtual Result go(A0, A1, A2, A3, A4, A5, A6);

	virtual Result goReverse(A0);
	virtual Result goReverse(A0, A1);
	virtual Result goReverse(A0, A1, A2);
	virtual Result goReverse(A0, A1, A2, A3);
	virtual Result goReverse(A0, A1, A2, A3, A4);
	virtual Result goReverse(A0, A1, A2, A3, A4, A5);
	virtual Result goReverse(A0, A1, A2, A3, A4, A5, A6);
};

} // namespace yade

#define DEFINE_FUNCTOR_ORDER_2D(first, second)                                                                                                                 \
public:                                                                                                                                                        \
	std::string checkOrder() const override { return #first " " #second; }
