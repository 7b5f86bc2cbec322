// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>
#include <blocks/kernel/analysis/ElasticJump.hpp>
#include <blocks/kernel/model/Fingerprint.hpp>

using namespace specimens;

/// Joints that soften within the step: columns against the law, accounts, the way to a free contact. The law itself: laws/SofteningLawTest.cpp.

namespace {

const Vec2 along = Vec2(0.3, 0.8).normalized(), normal(along.y(), -along.x()); // of the joint of twoBlocks

JointParams softJoint()
{
	JointParams p = elasticJoint(4e9, 2e9);
	p.tension = 3.5e5, p.cohesion = 8.7e5, p.tanPhi = 1, p.tanPhiResidual = 0.7;
	return p;
}

SofteningParams energies(Real lasting = 0)
{
	SofteningParams s;
	s.energyI = 120, s.energyII = 1200, s.lastingShare = lasting;
	return s;
}

CapParams cap() { return { 2e6, 1e6, 5e5, 1e-3, 1e4, 4, 0 }; }

SofteningParams capped()
{
	SofteningParams s = energies();
	s.cap             = cap();
	return s;
}

SofteningParams rising()
{
	SofteningParams s  = energies(0.3);
	s.energyIIPressure = 1e-3; // at some MPa as much as without pressure
	return s;
}

/// A softening joint, a brittle one and one with a cap.
const std::array<SofteningParams, 3> softenings { rising(), SofteningParams(), capped() };

/// Blocks of which joints soften, or do not, displaced at random; twice, so that some have a history.
BlockAssembly randomState(Real amount, int kinds, unsigned seed)
{
	BlockAssembly                        a = voronoi(1, 1, 8, 8, stone(), softJoint(), 0.4);
	std::mt19937                         random(seed);
	std::uniform_real_distribution<Real> u(-1, 1);
	for (int i = 0; i < a.joints.count(); ++i)
		a.setJoints(i, i + 1, softJoint(), random() % 9 ? Joint::intact : Joint::unbonded, softenings[i < Joints::batch ? 0 : random() % kinds]);
	const auto shake = [&] {
		for (Vec2& d : a.state.displacement) {
			const Real dx = u(random), dy = u(random);
			d += amount * Vec2(dx, dy);
		}
	};
	shake();
	sweepForces(a, Softening {});
	shake();
	return a;
}

void moveSecond(BlockAssembly& a, const Vec2& u)
{
	for (int n = a.mesh.firstNode[1]; n < a.nodeCount(); ++n)
		a.state.displacement[n] += u;
}

BlockAssembly softPair(const SofteningParams& s, const JointParams& p = softJoint())
{
	BlockAssembly a = twoBlocks(p);
	a.setJoints(0, a.joints.count(), p, Joint::intact, s);
	return a;
}

Real surface(const BlockAssembly& a) { return 2 * a.joints.segments[0].area; }

} // namespace

TEST(SofteningStep, BatchesHaveTheLawsBits)
{
	// Small displacements, where batches are elastic as a whole, to large ones; brittle joints among them, and some with a cap.
	int softened = 0, crushed = 0;
	for (Real amount : { 1e-6, 4e-5, 2e-4, 1e-3 })
		for (int kinds : { 1, 2, 3 })
			for (unsigned seed : { 1, 2, 3 }) {
				SCOPED_TRACE(std::to_string(amount) + " m, " + std::to_string(kinds) + " kinds, seed " + std::to_string(seed));
				const BlockAssembly start    = randomState(amount, kinds, seed);
				BlockAssembly       expected = start;
				updateKinematics(expected, allJoints(expected));
				State& s = expected.state;
				for (int p = 0; p < expected.pointCount(); ++p) {
					const JointParams&    params    = expected.joints.ofPoint(p);
					const SofteningParams softening = expected.joints.softeningOf(p / 2);
					if (softening.softens()) {
						const SofteningStep now = soften(params, softening, s.joint(p), s.softened.of(p), s.opening[p], s.slip[p]);
						s.setJoint(p, now.joint), s.softened.set(p, now.soft), s.sigma[p] = now.sigma, s.tau[p] = now.tau;
						s.softened.snapped += now.snappedBack;
						softened += now.joint.status == Joint::softening, crushed += now.soft.crushing > 0;
					} else {
						const JointStep now = advance(params, s.joint(p), s.opening[p], s.slip[p]);
						s.setJoint(p, now.state), s.sigma[p] = now.sigma, s.tau[p] = now.tau;
					}
				}
				for (int threads : { 1, 2 }) {
					BlockAssembly a = start;
					sweepForces(a, Softening {}, false, threads);
					EXPECT_EQ(fingerprint(a.state), fingerprint(expected.state));
				}
				BlockAssembly byPair = start; // as a loop by pairs does it
				updateKinematics(byPair, allJoints(byPair));
				for (int pair = 0; pair < int(byPair.joints.pairs.size()); ++pair)
					advanceStresses(byPair, jointsOf(byPair, pair), Softening {});
				EXPECT_EQ(fingerprint(byPair.state), fingerprint(expected.state));
			}
	EXPECT_GT(softened, 1000);
	EXPECT_GT(crushed, 100);
}

TEST(SofteningStep, WhatIsDissipatedIsWorkLessWhatIsStored)
{
	// All causes together, against a sum over the points. 700 terms of a few roundings each.
	for (Real amount : { 4e-5, 2e-4, 1e-3 })
		for (int kinds : { 1, 3 }) {
			const BlockAssembly start = randomState(amount, kinds, 5);
			BlockAssembly       a     = start;
			sweepForces(a, Softening {}, true);
			const State &before = start.state, &after = a.state;
			const auto   held = [&](const State& s, int p) {
                                const SofteningParams softening = a.joints.softeningOf(p / 2);
                                return softening.softens() ? storedEnergy(a.joints.ofPoint(p), softening, s.softened.of(p), s.sigma[p], s.tau[p])
							     : storedEnergy(a.joints.ofPoint(p), s.sigma[p], s.tau[p]);
			};
			Real sum = 0, turnover = 0;
			for (int p = 0; p < a.pointCount(); ++p) {
				if (before.status[p] == Joint::intact && after.status[p] == Joint::intact) continue;
				const Real area = a.joints.segments[p / 2].area;
				const Real work = (before.sigma[p] + after.sigma[p]) / 2 * (after.opening[p] - before.opening[p])
					+ (before.tau[p] + after.tau[p]) / 2 * (after.slip[p] - before.slip[p]);
				sum += area * (work + held(before, p) - held(after, p));
				turnover += area * (std::abs(work) + held(before, p) + held(after, p));
			}
			const Real booked
				= after.accounts.friction + after.accounts.fracture + after.softened.modeI + after.softened.modeII + after.softened.cap;
			EXPECT_NEAR(booked, sum, 700 * eps * turnover);
			EXPECT_NE(after.softened.modeI, 0); // steps as large as these err by more than they dissipate, so no sign is known
			EXPECT_EQ(after.softened.modeII != 0, amount > 5e-5);
			EXPECT_EQ(after.softened.cap != 0, kinds == 3 && amount > 5e-5);
			EXPECT_EQ(after.accounts.fracture != 0, kinds == 3);
			// jointEnergy holds the same
			Real stored = 0;
			for (int p = 0; p < a.pointCount(); ++p)
				stored += a.joints.segments[p / 2].area * held(after, p);
			EXPECT_NEAR(jointEnergy(a), stored, 700 * eps * stored);
		}
}

TEST(SofteningStep, PulledApartItTakesItsFractureEnergy)
{
	// Rigid motion along the normal: sigma = ft f(ft w / GfI) at opening w + sigma / kn, and GfI by the surface in the end. 2000 steps of
	// 2 um up to 4 mm = 12 GfI / ft: the trapezoidal rule leaves (ft h / GfI)^2 / 12 = 3e-6, the end of the exponential 1.2e-4.
	BlockAssembly a = softPair(energies());
	const Real    h = 2e-6, ft = 3.5e5;
	for (int i = 0; i < 2000; ++i) {
		moveSecond(a, h * normal);
		sweepForces(a, Softening {}, true);
		const Real un = a.state.opening[0], sigma = a.state.sigma[0], w = un - sigma / 4e9;
		if (un > ft / 4e9) {
			EXPECT_NEAR(sigma, ft * leftStrength(ft * w / 120), 1e-9 * ft) << i;
		}
	}
	EXPECT_EQ(a.state.sigma[0], 0);
	EXPECT_NEAR(a.state.softened.modeI, 120 * surface(a), 2e-4 * 120 * surface(a));
	EXPECT_NEAR(a.state.softened.modeII, 0, 1e-9 * 120 * surface(a)); // the direction of the motion rounds
	EXPECT_EQ(damageOf(a, 0), 1);
	EXPECT_EQ(a.state.status[0], Joint::brokenInTension);
}

TEST(SofteningStep, BrittleScenesHaveNoColumns)
{
	BlockAssembly a = twoBlocks(softJoint());
	EXPECT_TRUE(a.state.softened.empty());
	EXPECT_TRUE(a.joints.softening.empty());
	const auto plain = fingerprint(a.state);
	a.setJoints(0, 1, softJoint(), Joint::intact, energies());
	EXPECT_EQ(int(a.state.softened.k.size()), a.pointCount());
	EXPECT_NE(fingerprint(a.state), plain);
	a.bond(detectSegments(a)); // anew: nothing is left of it
	EXPECT_TRUE(a.state.softened.empty());
	EXPECT_TRUE(a.joints.softening.empty());
	EXPECT_EQ(fingerprint(a.state), plain);
}

TEST(SofteningStep, PropertiesMayChangeButNothingHeals)
{
	BlockAssembly a = softPair(energies());
	moveSecond(a, 1.2e-4 * normal);
	sweepForces(a, Softening {});
	ASSERT_EQ(a.state.status[0], Joint::softening);
	JointParams stiffer = softJoint();
	stiffer.kn *= 2;
	a.changeJoint(0, stiffer);
	EXPECT_TRUE(a.joints.softeningOf(0) == energies()); // stays
	expectRefusal([&] { a.changeJoint(0, stiffer, SofteningParams()); }, { "begun to soften", "brittle" });
	SofteningParams little = energies();
	little.energyI         = 1;
	expectRefusal([&] { a.changeJoint(0, stiffer, little); }, { "snaps back", "GfI 1", "350000" });
	EXPECT_TRUE(a.joints.softeningOf(0) == energies());

	BlockAssembly b   = twoBlocks(softJoint()); // broken, then told to soften: nothing is left to soften
	b.state.status[0] = b.state.status[1] = Joint::brokenInTension;
	b.changeJoint(0, softJoint(), energies());
	moveSecond(b, 5e-5 * normal);
	sweepForces(b, Softening {});
	EXPECT_EQ(b.state.sigma[0], 0);
	EXPECT_EQ(damageOf(b, 0), 1);
}

// ---- from a joint to a free contact

namespace {

/// Slides the joint under pressure until no bond is left. No general contact yet, so it stays a joint.
void slideUntilBroken(BlockAssembly& a)
{
	moveSecond(a, -1e-4 * normal);
	for (int i = 0; i < 400 && a.state.softened.k[1] < softeningEnd; ++i) {
		moveSecond(a, 1e-4 * along);
		sweepForces(a, Softening {});
	}
	ASSERT_EQ(a.state.softened.k[0], softeningEnd);
}

/// Nodal forces in the step before and in the one in which free contacts are allowed; everything rests.
struct Handover {
	std::vector<Vec2> before;
	Real              energy;

	explicit Handover(BlockAssembly& a)
	{
		for (Vec2& v : a.state.velocity)
			v.setZero();
		blocks::computeForces(a, Softening {}, 1);
		before = a.forces.nodal;
		energy = jointEnergy(a);
		setGeneralContact(a, true);
		blocks::computeForces(a, Softening {}, 1);
	}
	Real largestJump(const BlockAssembly& a) const
	{
		Real jump = 0, scale = 0;
		for (int n = 0; n < a.nodeCount(); ++n)
			jump = std::max(jump, (a.forces.nodal[n] - before[n]).norm()), scale = std::max(scale, before[n].norm());
		return jump / scale;
	}
};

} // namespace

TEST(SofteningStep, BrokenJointsBecomeFreeContactsWithoutAJump)
{
	// Residual cohesion, and plastic opening before the slip: what a free contact must take over. The frame has slid by some permille of its
	// length, and contacts differ from joints by that much where ends of edges do not face each other.
	JointParams joint      = softJoint();
	joint.cohesionResidual = 2e5;
	BlockAssembly a        = softPair(energies(1), joint);
	a.joints.ofMaterials   = { a.addKind(neverBonded(joint)) };
	moveSecond(a, 2e-4 * normal);
	sweepForces(a, Softening {});
	const Real raised = a.state.uplift[0];
	ASSERT_GT(raised, 1e-5);
	slideUntilBroken(a);
	const Real     slid = std::abs(a.state.slip[0]) / Vec2(0.3, 0.8).norm();
	const Handover handover(a);
	ASSERT_TRUE(a.state.released[0]);
	EXPECT_LT(handover.largestJump(a), 3 * slid);
	EXPECT_NEAR(jointEnergy(a), handover.energy, 3 * slid * handover.energy);
	EXPECT_EQ(a.state.contacts[0].joint.cohesionResidual, 2e5);
}

TEST(SofteningStep, JointsWithAnythingLeftStayJoints)
{
	const auto released = [](BlockAssembly& a) {
		setGeneralContact(a, true);
		blocks::computeForces(a, Softening {}, 1);
		return bool(a.state.released[0]);
	};
	BlockAssembly nearly = softPair(energies()); // cracked, with a tenth of its strength
	moveSecond(nearly, 9e-4 * normal);
	sweepForces(nearly, Softening {});
	ASSERT_EQ(nearly.state.status[0], Joint::brokenInTension);
	ASSERT_GT(nearly.state.sigma[0], 0);
	moveSecond(nearly, -9e-4 * normal); // closed again: no tension that would keep it
	EXPECT_FALSE(released(nearly));
	EXPECT_EQ(nearly.contacts.waiting.size(), 1u); // it is asked again

	SofteningParams capped = energies();
	capped.cap             = cap();
	BlockAssembly crushing = softPair(capped);
	slideUntilBroken(crushing);
	EXPECT_FALSE(released(crushing)); // free contacts have no cap

	// a hinge: one end has opened farther than the other, and some of it lasts
	BlockAssembly hinge = softPair(energies(1));
	slideUntilBroken(hinge);
	hinge.state.uplift[1] += 1e-5;
	const Handover stays(hinge);
	EXPECT_FALSE(hinge.state.released[0]);
	EXPECT_EQ(stays.largestJump(hinge), 0);
	moveSecond(hinge, 1e-3 * normal); // open: nothing to jump
	EXPECT_FALSE(released(hinge));    // the step in which it opens
	EXPECT_TRUE(released(hinge));
}

TEST(SofteningStep, AnEndThatStillHoldsLetsGoWhereTheEdgesHaveTurnedAway)
{
	// Two squares on each other; one end of their joint has broken, and the upper one has turned about the other end.
	for (bool crushes : { false, true })
		for (Real turn : { 1.5, 1.6 }) {
			BlockAssembly a;
			a.addMaterial(stone());
			addGrid(a, { 0, 0 }, 0.4, 0.4, 1, 1);
			addGrid(a, { 0, 0.4 }, 0.4, 0.4, 1, 1);
			bondAll(a, softJoint());
			a.setJoints(0, 1, softJoint(), Joint::intact, crushes ? capped() : energies());
			for (int n = a.mesh.firstNode[1]; n < a.mesh.firstNode[2]; ++n) {
				const Vec2 arm = a.mesh.reference[n] - Vec2(0, 0.4);
				a.place(n, Vec2(0, 0.4) + std::cos(turn) * arm + std::sin(turn) * Vec2(-arm.y(), arm.x()));
			}
			const int torn           = a.joints.segments[0].s1[0] < 0.5 ? 0 : 1; // the first edge runs towards the end about which it turns
			a.state.status[1 - torn] = Joint::softening;
			a.state.status[torn]     = Joint::brokenInTension;
			a.state.softened.k[torn] = softeningEnd;
			a.contacts.wanted        = true;
			prepareContacts(a);
			EXPECT_EQ(bool(a.state.released[0]), turn > M_PI / 2 && !crushes); // free contacts have no cap
		}
}

TEST(SofteningStep, ElasticJumpsEndBeforeItSoftens)
{
	// A column of two, pulled: 0.9 of the strength, and whole. With a cap, whose yielding is no event, there is no jump; nor a path beyond the first
	// failure.
	JointParams joint = elasticJoint(1e9, 1e9);
	joint.tension = 1e5, joint.cohesion = 1e6, joint.tanPhi = joint.tanPhiResidual = 0.1;
	for (bool capped : { false, true }) {
		BlockAssembly   a = column(2, 1, 1, 1, 1, { 20e9, 0, 2000 }, joint);
		SofteningParams s = energies();
		s.energyI = s.energyII = 1e4;
		if (capped) s.cap = cap();
		a.setJoints(0, a.joints.count(), joint, Joint::intact, s);
		a.addGroup(driven("bottom", dofs(a, 1, [](const Vec2& x) { return x.y() == 0; }), 0));
		a.addGroup(driven("sides", dofs(a, 0, [](const Vec2&) { return true; }), 0));
		a.addGroup(driven("top", dofs(a, 1, [](const Vec2& x) { return x.y() == 2; }), 1e-3));
		if (capped) {
			EXPECT_THROW(elasticJump(a, 0.9, 0), std::runtime_error);
			continue;
		}
		elasticJump(a, 0.9, 0);
		EXPECT_NEAR(a.state.sigma[0], 0.9e5, 1e-3 * 1e5); // the answer is linear but for strains of 1e-5
		EXPECT_EQ(a.state.status[0], Joint::intact);
	}
}
