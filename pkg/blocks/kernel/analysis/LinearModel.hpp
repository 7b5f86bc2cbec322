// yade-blocks, GPL-2.0-or-later
#pragma once
#include <Eigen/SparseCore>
#include <blocks/kernel/model/BlockAssembly.hpp>

/// An assembly linearised about its present state: small displacements u of few unknowns, forces and stresses linear in them.
///
/// Unknowns are the free degrees of freedom of grid points, one displacement for each pushed group, and the free motions of rigid blocks
/// (x, y, turn). The other degrees of freedom are held or move in proportion to the load factor.
///   opening = opening0 + n.u + nDriven lambda,   slip = slip0 + t.u + tDriven lambda     of every contact point
///   force of the zones on the unknowns = -(zoneForce + zones u + zonesDriven lambda)
/// Frames of the joints stay those of the present state, and zones have the stiffness of their reference state: both leave out terms of
/// the order of strains and rotations times the stress.
namespace blocks {

using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

/// What grows with the load factor lambda, per unit of it.
struct Growth {
	std::vector<Real> group; ///< of every motion group: displacement of a driven one [m], force of a pushed one [N]
	std::vector<Vec3> rigid; ///< of every rigid block, along its prescribed directions [m, m, rad]
};

struct LinearPoint {
	JointParams         joint;
	JointState          state;            ///< at the start
	Real                area;             ///< [m2]
	Real                opening, slip;    ///< at the start [m]
	Real                edge;             ///< the shorter of the two edges it sits on [m]
	std::array<int, 2>  block;            ///< on its two sides
	int                 count;            ///< unknowns that it feels
	std::array<int, 8>  unknown;          ///< these
	std::array<Real, 8> n, t;             ///< opening and slip by each
	Real                nDriven, tDriven; ///< opening and slip by the load factor

	/// What a motion of the unknowns, x[0], x[stride], ..., does to it; b: n or t.
	Real times(const std::array<Real, 8>& b, const Real* x, int stride) const
	{
		Real sum = 0;
		for (int k = 0; k < count; ++k)
			sum += b[k] * x[stride * unknown[k]];
		return sum;
	}
};

struct LinearModel {
	static constexpr int driven = -1;

	/// What a degree of freedom of a grid point does: motion = sum of factor x unknown, + byLoad x lambda.
	struct Motion {
		std::array<int, 2>  unknown { driven, driven };
		std::array<Real, 2> factor { 0, 0 };
		Real                byLoad = 0;
	};

	int                       unknowns = 0;
	std::vector<Motion>       motion;         ///< of every degree of freedom, 2 node + axis
	std::vector<int>          groupUnknown;   ///< of every pushed group, or driven
	std::vector<int>          rigidUnknown;   ///< 3 rigid block + direction, or driven
	std::vector<int>          blockOfUnknown; ///< a block that moves with it
	std::vector<LinearPoint>  points;         ///< in the order of contact points
	Eigen::SparseMatrix<Real> zones;          ///< stiffness, upper triangle [N/m]
	Vector                    zonesDriven;    ///< force per load factor
	Real                      drivenDriven = 0;
	Vector                    zoneForce;           ///< at the start [N]
	Real                      zoneForceDriven = 0; ///< work-conjugate to the load factor
	Vector                    load;                ///< dead loads and forces of pushed groups [N]
	Real                      loadDriven = 0;
	Vector                    loadGrowth; ///< force per load factor
	Growth                    growth;
};

/// Linearises; pushed groups act with their whole target, or `growing` (an index; -1: none) with the force it has now.
/// Errors: joints without properties or softening, blocks that touch without a joint.
LinearModel linearise(const BlockAssembly&, const Growth&, int growing = -1);

/// Moves grid points, pushed groups' blocks and rigid blocks by u and lambda. Rigid blocks turn as such.
void displace(BlockAssembly&, const LinearModel&, const Vector& u, Real lambda);

/// Unbalanced forces of the assembly as they are in forces.nodal, gathered on the unknowns; pushed groups act with `groupForce`.
Vector unbalanced(const BlockAssembly&, const LinearModel&, const std::vector<Real>& groupForce);

} // namespace blocks
