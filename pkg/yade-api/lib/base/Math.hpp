/// Number and vector types of YADE in double precision, and how they are saved.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <boost/preprocessor.hpp>
#include <boost/python.hpp>
#include <boost/serialization/is_bitwise_serializable.hpp>
#include <boost/serialization/nvp.hpp>
#include <boost/shared_ptr.hpp>
#include <cassert>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#define YADE_PTR_CAST ::boost::static_pointer_cast
#define YADE_PTR_DYN_CAST ::boost::dynamic_pointer_cast

namespace yade {

using boost::shared_ptr;
using std::string;
using std::vector;

using Real = double;
const Real NaN(std::numeric_limits<Real>::quiet_NaN());

using Vector2i    = Eigen::Matrix<int, 2, 1>;
using Vector3i    = Eigen::Matrix<int, 3, 1>;
using Vector2r    = Eigen::Matrix<Real, 2, 1>;
using Vector3r    = Eigen::Matrix<Real, 3, 1>;
using Matrix3r    = Eigen::Matrix<Real, 3, 3>;
using Quaternionr = Eigen::Quaternion<Real>;
using AngleAxisr  = Eigen::AngleAxis<Real>;

/// Position and orientation.
template <class Scalar> class Se3 {
public:
	Eigen::Matrix<Scalar, 3, 1> position;
	Eigen::Quaternion<Scalar>   orientation;

	Se3() = default;
	Se3(const Eigen::Matrix<Scalar, 3, 1>& x, const Eigen::Quaternion<Scalar>& q)
		: position(x)
		, orientation(q)
	{
	}
};
using Se3r = Se3<Real>;

using mask_t = int; ///< bits of Body::groupMask

static_assert(
	sizeof(Vector3r) == 24 && sizeof(Quaternionr) == 32 && sizeof(Se3r) == 56 && sizeof(Matrix3r) == 72 && alignof(Quaternionr) == 8,
	"Eigen must be built as in YADE: compile with -DEIGEN_DONT_VECTORIZE -DEIGEN_DONT_ALIGN");

} // namespace yade

// Saved without class version and tracking, as YADE does: it decides what a file looks like.
BOOST_IS_BITWISE_SERIALIZABLE(yade::Vector2i)
BOOST_IS_BITWISE_SERIALIZABLE(yade::Vector3i)
BOOST_IS_BITWISE_SERIALIZABLE(yade::Vector2r)
BOOST_IS_BITWISE_SERIALIZABLE(yade::Vector3r)
BOOST_IS_BITWISE_SERIALIZABLE(yade::Matrix3r)
BOOST_IS_BITWISE_SERIALIZABLE(yade::Quaternionr)
BOOST_IS_BITWISE_SERIALIZABLE(yade::Se3r)

namespace boost {
namespace serialization {

	template <class Archive, class Scalar> void serialize(Archive& archive, Eigen::Matrix<Scalar, 2, 1>& v, const unsigned int)
	{
		archive& make_nvp("x", v[0]) & make_nvp("y", v[1]);
	}

	template <class Archive, class Scalar> void serialize(Archive& archive, Eigen::Matrix<Scalar, 3, 1>& v, const unsigned int)
	{
		archive& make_nvp("x", v[0]) & make_nvp("y", v[1]) & make_nvp("z", v[2]);
	}

	template <class Archive> void serialize(Archive& archive, yade::Matrix3r& m, const unsigned int)
	{
		static const char* const names[3][3] = { { "m00", "m01", "m02" }, { "m10", "m11", "m12" }, { "m20", "m21", "m22" } };
		for (int i = 0; i < 3; i++)
			for (int j = 0; j < 3; j++)
				archive& make_nvp(names[i][j], m(i, j));
	}

	template <class Archive> void serialize(Archive& archive, yade::Quaternionr& q, const unsigned int)
	{
		archive& make_nvp("w", q.w()) & make_nvp("x", q.x()) & make_nvp("y", q.y()) & make_nvp("z", q.z());
	}

	template <class Archive> void serialize(Archive& archive, yade::Se3r& se3, const unsigned int)
	{
		archive& make_nvp("position", se3.position) & make_nvp("orientation", se3.orientation);
	}

}
}
