// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/step/ContactResults.hpp>
#include <blocks/kernel/step/Contacts.hpp>
#include <blocks/views/JointPhys.hpp>
#include <cmath>

namespace yade {

JointPhys::~JointPhys() = default;

const blocks::JointParams& JointPhys::joint() const
{
	if (!model) throw std::runtime_error("JointPhys.model is empty: joints are made by BlockModel.bond or Ip2_BlockMat_BlockMat_JointPhys");
	const auto& a = model->assembly;
	if (pair >= 0) return a.joints.of(a.joints.pairs[pair].first);
	if (contact < 0 || contact >= int(a.state.contacts.size()))
		throw std::runtime_error("JointPhys: the two blocks have parted, so there is no contact any more");
	return a.state.contacts[contact].joint;
}

void JointPhys::setJoint(const blocks::JointParams& params)
{
	auto& a = model->assembly;
	if (pair >= 0)
		for (int i = a.joints.pairs[pair].first; i < a.joints.pairs[pair].last; ++i)
			a.requireChangeable(i, params, a.joints.softeningOf(i)); // all before any is set
	if (pair >= 0)
		for (int i = a.joints.pairs[pair].first; i < a.joints.pairs[pair].last; ++i)
			a.changeJoint(i, params);
	if (contact >= 0) blocks::setContactJoint(a, contact, params);
	model->stiffnessChanged();
}

namespace {
	/// Reads or sets one property of a pair's joint; a change is checked and reaches masses and time step.
	template <Real blocks::JointParams::*member> Real get(const JointPhys& phys) { return phys.joint().*member; }
	template <Real blocks::JointParams::*member> void set(JointPhys& phys, Real value)
	{
		blocks::JointParams changed = phys.joint();
		changed.*member             = value;
		blocks::validate(changed);
		phys.setJoint(changed);
	}
	template <Real blocks::JointParams::*member> Real getAngle(const JointPhys& phys) { return std::atan(phys.joint().*member); }
	template <Real blocks::JointParams::*member> void setAngle(JointPhys& phys, Real angle)
	{
		blocks::require(angle >= 0 && angle < M_PI / 2, "an angle of JointPhys must lie in [0, pi/2) rad", angle);
		set<member>(phys, std::tan(angle));
	}

	const blocks::BlockAssembly& assemblyOf(const JointPhys& phys)
	{
		if (!phys.model) throw std::runtime_error("JointPhys.model is empty: joints are made by BlockModel.bond or Ip2_BlockMat_BlockMat_JointPhys");
		return phys.model->assembly;
	}

	/// Of a pair that was never bonded: the ends of the edges that touch.
	template <class Value> py::list ofEnds(const JointPhys& phys, const Value& value)
	{
		const auto& contacts = assemblyOf(phys).state.contacts;
		py::list    list;
		if (phys.contact >= 0 && phys.contact < int(contacts.size()))
			for (int active : contacts[phys.contact].active)
				for (int k : { 0, 1 })
					list.append(value(contacts[phys.contact].edges[active], k));
		return list;
	}
	py::list stresses(const JointPhys& phys, std::vector<Real> blocks::PointStresses::*which, std::array<Real, 2> blocks::EdgePair::*ofEnd)
	{
		if (phys.pair < 0) return ofEnds(phys, [&](const blocks::EdgePair& e, int k) { return (e.*ofEnd)[k]; });
		const auto&                 pair = assemblyOf(phys).joints.pairs[phys.pair];
		py::list                    list;
		const blocks::PointStresses all = blocks::pointStresses(assemblyOf(phys), pair.first, pair.last);
		for (Real stress : all.*which)
			list.append(stress);
		return list;
	}
	py::list sigma(const JointPhys& phys) { return stresses(phys, &blocks::PointStresses::sigma, &blocks::EdgePair::sigma); }
	py::list tau(const JointPhys& phys) { return stresses(phys, &blocks::PointStresses::tau, &blocks::EdgePair::tau); }
	py::list status(const JointPhys& phys)
	{
		if (phys.pair < 0) return ofEnds(phys, [](const blocks::EdgePair&, int) { return int(blocks::Joint::unbonded); });
		const auto& a    = assemblyOf(phys);
		const auto& pair = a.joints.pairs[phys.pair];
		py::list    list;
		for (int i = 2 * pair.first; i < 2 * pair.last; ++i)
			list.append(int(a.state.status[i]));
		return list;
	}
} // namespace

void JointPhysPython::visit(py::class_<JointPhys, shared_ptr<JointPhys>, py::bases<IPhys>, boost::noncopyable>& c) const
{
	using P = blocks::JointParams;
	c.add_property("kn", &get<&P::kn>, &set<&P::kn>, "Normal stiffness [Pa/m].")
		.add_property("ks", &get<&P::ks>, &set<&P::ks>, "Shear stiffness [Pa/m].")
		.add_property("cohesion", &get<&P::cohesion>, &set<&P::cohesion>, "Cohesion [Pa].")
		.add_property("tension", &get<&P::tension>, &set<&P::tension>, "Tensile strength [Pa].")
		.add_property("cohesionResidual", &get<&P::cohesionResidual>, &set<&P::cohesionResidual>, "Cohesion after failure [Pa].")
		.add_property("tensionResidual", &get<&P::tensionResidual>, &set<&P::tensionResidual>, "Tensile strength after failure [Pa].")
		.add_property(
			"dilationLimitSlip", &get<&P::dilationLimitSlip>, &set<&P::dilationLimitSlip>, "Slip beyond which the joint dilates no further [m].")
		.add_property("frictionAngle", &getAngle<&P::tanPhi>, &setAngle<&P::tanPhi>, "Friction angle [rad].")
		.add_property("frictionAngleResidual", &getAngle<&P::tanPhiResidual>, &setAngle<&P::tanPhiResidual>, "Friction angle after failure [rad].")
		.add_property("dilationAngle", &getAngle<&P::tanDilation>, &setAngle<&P::tanDilation>, "Dilation angle [rad].")
		.add_property(
			"sigma",
			&sigma,
			"Normal stresses at the pair's contact points, or at the ends of the edges that touch without a bond, tension positive [Pa].")
		.add_property("tau", &tau, "Shear stresses at the pair's contact points [Pa].")
		.add_property(
			"status", &status, "Of the pair's contact points: 0 intact, 1 broken in tension, 2 broken in shear, 3 never bonded, 4 softening.");
}

YADE_PLUGIN((JointPhys));

} // namespace yade
