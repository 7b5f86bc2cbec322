// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/step/Joints.hpp>
#include <blocks/kernel/step/ZoneForces.hpp>
#include <blocks/window/Colours.hpp>
#include <limits>

namespace yade {
namespace {

	/// The share of a block's joints, by area, that are broken.
	vector<Real> damageOfBlocks(const blocks::BlockAssembly& a)
	{
		vector<Real> broken(a.blockCount(), 0), all(a.blockCount(), 0);
		for (int i = 0; i < a.joints.count(); ++i) {
			const blocks::Segment& joint = a.joints.segments[i];
			if (a.isRemoved(joint.block[0]) || a.isRemoved(joint.block[1])) continue;
			for (int k : { 0, 1 })
				for (int block : joint.block) {
					all[block] += joint.area;
					broken[block] += joint.area * blocks::damageOf(a, 2 * i + k);
				}
		}
		for (int b = 0; b < a.blockCount(); ++b)
			broken[b] = all[b] > 0 ? broken[b] / all[b] : 0;
		return broken;
	}

	Real stressOf(const string& what, const blocks::ZoneStress& s)
	{
		if (what == "sxx") return s.sxx;
		if (what == "syy") return s.syy;
		if (what == "sxy") return s.sxy;
		const Real mean = (s.sxx + s.syy) / 2, radius = std::hypot((s.sxx - s.syy) / 2, s.sxy);
		return what == "sigma1" ? mean + radius : mean - radius;
	}

} // namespace

const vector<string>& colourings()
{
	static const vector<string> names { "material", "displacement", "sigma1", "sigma2", "sxx", "syy", "sxy", "damage" };
	return names;
}

Coloured colouredBy(const string& what, const blocks::BlockAssembly& a, const Vector2r& range)
{
	Coloured out;
	out.zone.assign(a.zoneCount(), std::numeric_limits<Real>::quiet_NaN());
	out.block.assign(a.blockCount(), std::numeric_limits<Real>::quiet_NaN()); // rigid blocks have no stress
	const vector<Real> damage = what == "damage" ? damageOfBlocks(a) : vector<Real>();
	Real               low = std::numeric_limits<Real>::infinity(), high = -low;
	for (int b = 0; b < a.blockCount(); ++b) {
		if (a.isRemoved(b)) continue;
		if (what == "damage") out.block[b] = damage[b];
		if (what == "displacement") out.block[b] = a.state.displacement[a.mesh.firstNode[b]].norm();
		for (int z = a.mesh.firstZone[b]; z < a.mesh.firstZone[b + 1]; ++z) {
			if (what == "damage")
				out.zone[z] = damage[b];
			else if (what == "displacement") {
				const auto& n = a.mesh.zoneNodes[z];
				const auto& u = a.state.displacement;
				out.zone[z]   = ((u[n[0]] + u[n[1]] + u[n[2]]) / 3).norm();
			} else
				out.zone[z] = stressOf(what, blocks::cauchyStress(a, b, z));
			low = std::min(low, out.zone[z]), high = std::max(high, out.zone[z]);
		}
	}
	if (range[0] != range[1])
		out.low = range[0], out.high = range[1];
	else if (what == "damage")
		out.low = 0, out.high = 1;
	else if (low <= high)
		out.low = low, out.high = high;
	return out;
}

Vector3r colourOf(Real value, Real low, Real high)
{
	if (std::isnan(value)) return { 0.6, 0.6, 0.6 };
	const Real t = high > low ? std::min(Real(1), std::max(Real(0), (value - low) / (high - low))) : 0.5;
	if (t < 0.5) return { 0.2 + 1.6 * t, 0.3 + 1.4 * t, 1 };
	return { 1, 1.7 - 1.4 * t, 1.8 - 1.6 * t };
}

Vector3r colourOfMaterial(int material)
{
	static const vector<Vector3r> palette { { 0.80, 0.52, 0.38 }, { 0.82, 0.81, 0.76 }, { 0.55, 0.65, 0.74 },
		                                { 0.62, 0.71, 0.51 }, { 0.74, 0.62, 0.74 }, { 0.86, 0.76, 0.48 } };
	return palette[size_t(material) % palette.size()];
}

} // namespace yade
