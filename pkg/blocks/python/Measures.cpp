// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/analysis/Energy.hpp>
#include <blocks/kernel/analysis/StabilityWatch.hpp>
#include <blocks/kernel/geometry/Zoning.hpp>
#include <blocks/kernel/model/Fingerprint.hpp>
#include <blocks/python/ModelPython.hpp>
#include <core/Omega.hpp>

/// What is measured on a model as a whole.
namespace yade {

namespace {

	py::dict zoneQuality(const BlockModel& m)
	{
		if (m.assembly.zoneCount() == 0) throw std::runtime_error("BlockModel.zoneQuality: the model has no zones yet");
		const auto q = blocks::quality({ m.assembly.mesh.reference, {}, m.assembly.mesh.zoneNodes });
		py::dict   out;
		out["minAngle"] = q.minAngle, out["maxAngle"] = q.maxAngle;
		out["minArea"] = q.minArea, out["maxArea"] = q.maxArea;
		out["worstAspect"] = q.worstAspect;
		return out;
	}

	string fingerprint(const BlockModel& m)
	{
		char text[17];
		std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(blocks::fingerprint(m.assembly.state)));
		return text;
	}

	Real unbalancedRatio(const BlockModel& m, Real floor) { return blocks::unbalancedRatio(m.assembly, floor); }
	Real unrest(const BlockModel& m, Real floor) { return blocks::unrest(m.assembly, Omega::instance().getScene()->time, floor); }

	void requireSound(const BlockModel& m)
	{
		const auto verdict = blocks::StabilityWatch::lookAtEnd(m.assembly);
		if (!verdict.stable) throw std::runtime_error("unstable, block " + std::to_string(verdict.block) + ": " + verdict.reason);
	}
	Real kineticEnergy(const BlockModel& m) { return blocks::kineticEnergy(m.assembly); }

} // namespace

void defineMeasures(PythonModel& c)
{
	using py::arg;
	c.def("requireSound",
	      &requireSound,
	      "Raises RuntimeError where the motion of a grid point is not a number or a zone is inside out. Runs are looked at "
	      "by themselves, see BlockMotion.watchPeriod.")
		.def("unrest",
	             &unrest,
	             (arg("floor") = 0.),
	             "How far the scene is from rest [-]: unbalanced forces by the largest sum of loads, of forces of groups and twice those of contacts, or "
	             "kinetic energy by that of zones "
	             "and joints, if this is more. Infinite while a group is within its ramp. floor: least sum of forces that counts [N].")
		.def("unbalancedRatio",
	             &unbalancedRatio,
	             (arg("floor") = 0.),
	             "Sum of unbalanced |force| over free degrees of freedom (of rigid blocks: of their bodies, without moments) by twice the sum of contact "
	             "|forces|, the latter at least floor [N]. YADE's utils.unbalancedForce() knows nothing of grid points.")
		.def("kineticEnergy", &kineticEnergy, "Kinetic energy, with the scaled masses if masses are scaled [J].")
		.def("zoneQuality",
	             &zoneQuality,
	             "Quality of the mesh, a dictionary: minAngle, maxAngle [rad], minArea, maxArea [m2], worstAspect (longest edge by least height, 1 for an "
	             "equilateral triangle).")
		.def("fingerprint",
	             &fingerprint,
	             "16 hexadecimal digits that are the same only for the same bits of the state: motion, joints, contacts, "
	             "groups, accounts.");
}

} // namespace yade
