// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/laws/Zone.hpp>

namespace blocks {

struct Material {
	Real young   = 0; ///< [Pa]
	Real poisson = 0; ///< [-]
	Real density = 0; ///< [kg/m3]
};

/// Gradients of the shape functions of all zones, as columns [1/m].
struct ZoneColumns {
	std::vector<Real> g1x, g1y, g2x, g2y;

	ZoneGradients operator[](int zone) const { return { g1x[zone], g1y[zone], g2x[zone], g2y[zone] }; }
	void          resize(size_t count) { g1x.resize(count), g1y.resize(count), g2x.resize(count), g2y.resize(count); }
	void          set(int zone, const ZoneGradients& g) { g1x[zone] = g.g1x, g1y[zone] = g.g1y, g2x[zone] = g.g2x, g2y[zone] = g.g2y; }
};

/// Strains of all zones, as columns.
struct StrainColumns {
	std::vector<Real> xx, yy, xy;

	bool empty() const { return xx.empty(); }
	void clear() { xx.clear(), yy.clear(), xy.clear(); }
	void assign(size_t count, Real value) { xx.assign(count, value), yy.assign(count, value), xy.assign(count, value); }
};

/// Grid points, zones and blocks without stress: nothing here changes once the blocks are in the scene.
struct Mesh {
	std::vector<Material> materials;

	// ---- grid points, block by block
	std::vector<Vec2> reference; ///< positions without stress [m]
	std::vector<Real> mass;      ///< true mass; 0 for grid points of rigid blocks [kg]

	// ---- zones, block by block
	std::vector<std::array<int, 3>> zoneNodes;
	ZoneColumns                     zoneGradient; ///< [1/m]
	std::vector<Real>               zoneVolume;   ///< [m3]
	StrainColumns                   inSitu;       ///< elastic strain without displacement, from stresses in situ; empty if there are none

	// ---- boundary edges, block by block: material on the left
	std::vector<std::array<int, 2>> edgeNodes;

	// ---- blocks, as ranges
	std::vector<int>  firstNode { 0 }, firstZone { 0 }, firstEdge { 0 }; ///< one more entry than there are blocks
	std::vector<int>  blockMaterial;
	std::vector<char> removed; ///< whether a block has been taken out; empty if none has
	std::vector<char> isFan;   ///< whether zone k of the block is (corner k, corner k + 1, last grid point), all corners round
};

} // namespace blocks
