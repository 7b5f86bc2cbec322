// yade-blocks, GPL-2.0-or-later
#include <ContactScenes.hpp>

using namespace contacts;

namespace {

struct Stress {
	int  poses = 0, touched = 0;
	Real gain      = 0; ///< worst, of what there was
	Real lost      = 0; ///< worst imbalance of energy and friction, of what there was
	long edgePairs = 0, active = 0;
};

/// Two random polygons each time: slivers, tiny edges, reentrant corners, shared vertices and edges, started in touch or overlapping.
Stress stress(int count, int steps, unsigned seed)
{
	Stress                               result;
	std::mt19937                         random(seed);
	std::uniform_real_distribution<Real> u(-1, 1);
	for (int pose = 0; pose < count; ++pose) {
		auto polygon = [&] {
			const int kind = int(random() % 5);
			Ring      ring = randomPolygon(random, 0.5, 3 + int(random() % 6), kind == 0 ? 0.04 : 1);
			if (kind == 1) { // a corner cut by a tiny edge
				const size_t i = random() % ring.size(), n = ring.size();
				const Vec2   p = ring[i], next = ring[(i + 1) % n], last = ring[(i + n - 1) % n];
				ring[i] = p + 1e-3 * (next - p);
				ring.insert(ring.begin() + long(i), p + 1e-3 * (last - p));
			}
			if (kind == 2) { // a grid point in the middle of an edge
				const size_t i = random() % ring.size();
				ring.insert(ring.begin() + long(i) + 1, Vec2((ring[i] + ring[(i + 1) % ring.size()]) / 2));
			}
			if (kind == 3) { // a corner that bends inward a little
				const size_t i = random() % ring.size();
				const Vec2   p = ring[i], q = ring[(i + 1) % ring.size()], e = q - p;
				ring.insert(ring.begin() + long(i) + 1, Vec2((p + q) / 2 + 0.05 * Vec2(-e.y(), e.x())));
			}
			return ring;
		};
		auto usable = [](const Ring& ring) { // addFan's zones must not overlap
			const Vec2 inner = 0.9 * mean(ring) + 0.1 * ring[0];
			for (size_t i = 0; i < ring.size(); ++i)
				if (cross(ring[i] - inner, ring[(i + 1) % ring.size()] - inner) <= 0) return false;
			return true;
		};
		Ring first = polygon(), second = polygon();
		while (!usable(first))
			first = polygon();
		while (!usable(second))
			second = polygon();
		const Vec2 apart(std::cos(6 * u(random)), std::sin(6 * u(random)));
		switch (random() % 4) {
		case 0:
			second = shifted(second, 0.9 * apart);
			break;
		case 1:
			second = shifted(second, first[0] * 1.0 - second[second.size() / 2]);
			break; // vertex upon vertex
		case 2: {      // its mirror image across an edge
			const Vec2 p = first[0], e = (first[1] - first[0]).normalized();
			second.clear();
			for (auto it = first.rbegin(); it != first.rend(); ++it) {
				const Vec2 d = *it - p;
				second.push_back(p + 2 * d.dot(e) * e - d);
			}
			if (!usable(second)) second = shifted(box(0, 0, 0.3, 0.4), first[0]); // another inner point
			break;
		}
		default:
			second = shifted(second, 1.05 * apart);
		}
		BlockAssembly a = scene(5e7);
		if (random() % 3)
			addFan(a, first);
		else
			addRigid(a, first);
		addFan(a, second);
		Simulation run(a, frictional(1e6, 5e5, (pose % 3) * 15 * degree), 0.5);
		for (int b : { 0, 1 })
			if (a.mesh.firstZone[b] < a.mesh.firstZone[b + 1])
				setVelocity(a, b, 0.5 * Vec2(u(random), u(random)) + (b ? -0.3 : 0.3) * apart, u(random));
		Real start = 0, most = 0, imbalance = 0;
		bool touched = false;
		run.steps(steps, [&](Real energy) {
			if (run.step == 0) start = energy;
			most      = std::max(most, energy);
			imbalance = std::max(imbalance, std::abs(energy + contactFriction(a) - start));
			for (int c : a.contacts.order)
				for (const EdgePair& e : a.state.contacts[c].edges)
					touched |= e.touching, ++result.edgePairs, result.active += e.touching;
		});
		EXPECT_EQ(a.firstBadNode(), -1) << "pose " << pose;
		const Real gain = most / start - 1;
		if (gain > 0.01) std::printf("pose %d gains %.3f\n", pose, gain);
		result.gain = std::max(result.gain, gain);
		result.lost = std::max(result.lost, imbalance / start);
		result.touched += touched;
		++result.poses;
	}
	return result;
}

} // namespace

TEST(FreeContacts, CornerHitsKeepTheEnergy)
{
	// Polygons thrown at each other, without friction, both deformable or one of them rigid: energy after the hit against
	// energy before. Second-order scheme, C1 potential: < 1e-3 at 0.3 of the stable step, and 4 x less at a quarter (in fact 16 x).
	Real worst[2] = { 0, 0 }, sum[2] = { 0, 0 };
	int  hits = 0;
	for (int pose = 0; pose < 200; ++pose)
		for (int fine : { 0, 1 }) {
			std::mt19937                         random(pose);
			std::uniform_real_distribution<Real> u(-1, 1);
			BlockAssembly                        a      = scene(3e7);
			const Ring                           target = randomPolygon(random, 0.8, 3 + pose % 5),
				   shot                             = shifted(randomPolygon(random, 0.5, 3 + pose % 4), { 1.31, 0.5 * u(random) });
			if (pose % 2)
				addFan(a, target);
			else
				addRigid(a, target);
			addFan(a, shot);
			Simulation run(a, frictional(1e6, 1e6, 0), fine ? 0.075 : 0.3);
			const Vec2 v(-0.4, 0.15 * u(random));
			setVelocity(a, 1, v, u(random));
			Real       start = 0, last = 0, deepest = 0;
			const long steps = long(2 / run.dt);
			run.steps(steps, [&](Real energy) {
				if (run.step == 1) start = energy;
				last    = energy;
				deepest = std::max(deepest, contactForce(a, 1).norm());
			});
			const Real error = std::abs(last - start) / start;
			worst[fine]      = std::max(worst[fine], error);
			sum[fine] += error;
			hits += deepest > 0;
		}
	std::printf("corner hits: %d of 400, worst %.2e, fine %.2e, mean %.2e, fine %.2e\n", hits, worst[0], worst[1], sum[0] / 200, sum[1] / 200);
	EXPECT_GT(hits, 200);
	EXPECT_LT(worst[0], 1e-3);
	EXPECT_LT(worst[1], worst[0] / 4);
	EXPECT_LT(sum[1], sum[0] / 4);
}

TEST(FreeContacts, ABoxThatFallsBouncesBack)
{
	// Free fall from h, then an elastic impact: within 1 % of the energy back (zones keep some of it as vibration, which counts).
	BlockAssembly a = scene(2e8);
	addRigid(a, box(-2, -1, 4, 1));
	addGrid(a, { -0.5, 0.1 }, 1, 0.6, 3, 2);
	const Vec2 g(0, -9.81);
	addGravity(a, g);
	const Vec2 start = a.centroid(1);
	Simulation run(a, frictional(5e7, 5e7, 0));
	Real       first = 0, worst = 0, touched = 0, top = 0;
	long       contact = 0;
	run.steps(long(0.4 / run.dt), [&](Real energy) {
		if (run.step == 1) first = energy;
		worst = std::max(worst, std::abs(energy - first));
		if (!contact && contactForce(a, 1).y() > 0) contact = run.step, touched = run.step * run.dt;
		if (contact) top = std::max(top, a.centroid(1).y() + (energy - energy));
	});
	const Real fallen = 2000 * 0.6 * 9.81 * 0.1; // N x m: the energy of the fall
	EXPECT_NEAR(touched, std::sqrt(2 * 0.1 / 9.81), 2 * run.dt + 1e-4);
	EXPECT_LT(worst, 0.01 * fallen);
	std::printf("bounce: energy error %.1e of the fall, height regained %.3f\n", worst / fallen, 1 - (start.y() - top) / 0.1);
}

TEST(FreeContacts, FlatFloorFriction)
{
	// A box pulled over a floor at constant velocity and depth d: T = mu N, on its side or on one corner. Where one floor block
	// ends and the next begins, a stretch of order d has other forces: at most 2 d / L of the side's, and those of a corner, which
	// leaves one block's edge and must first get hold of the next one's, only in the mean.
	struct Case {
		Real tilt;
		bool joints;
		Real worst, mean;
	};
	for (const Case& c : { Case { 0, true, 1e-3, 1e-3 }, Case { 20 * degree, false, 1e-3, 1e-3 }, Case { 20 * degree, true, 10, 1e-3 } }) {
		BlockAssembly a = scene();
		if (c.joints)
			addRigid(a, box(-3, -1, 2.5, 1)), addRigid(a, box(-0.5, -1, 1.2, 1)), addRigid(a, box(0.7, -1, 3, 1));
		else
			addRigid(a, box(-3, -1, 6.7, 1));
		const int mover = addRigid(a, box(-2, 0, 0.6, 0.8));
		moveBlock(a, mover, { 0, 0 }, c.tilt);
		Real low = 1;
		for (int n = a.mesh.firstNode[mover]; n < a.mesh.firstNode[mover + 1]; ++n)
			low = std::min(low, a.position(n).y());
		const Real d = 5e-5, dt = 1e-3;
		moveBlock(a, mover, { 0, -low - d });
		const JointParams joint = frictional(1e6, 5e5, 35 * degree);
		Real              worst = 0;
		Vec2              sum   = Vec2::Zero();
		for (int n = a.mesh.firstNode[mover]; n < a.mesh.firstNode[mover + 1]; ++n)
			a.state.velocity[n] = { 0.02, 0 };
		for (int i = 0; i < 175000; ++i) {
			computeAllForces(a, joint, dt);
			for (int n = a.mesh.firstNode[mover]; n < a.mesh.firstNode[mover + 1]; ++n)
				a.state.displacement[n] += dt * a.state.velocity[n];
			if (i < 50) continue; // until friction is built up: mu kn d/ks = 7e-5 m
			const Vec2 f = contactForce(a, mover);
			worst        = std::max(worst, std::abs(-f.x() / (joint.tanPhi * f.y()) - 1));
			sum += f;
		}
		const Real mean = std::abs(-sum.x() / (joint.tanPhi * sum.y()) - 1);
		std::printf(
			"friction on a flat floor, tilt %.2f, %s: T/(mu N) off by %.1e at most, %.1e in the mean\n",
			c.tilt,
			c.joints ? "three blocks" : "one block",
			worst,
			mean);
		EXPECT_LT(worst, c.worst);
		EXPECT_LT(mean, c.mean);
	}
}

TEST(FreeContacts, InclineHoldsAndLetsGo)
{
	// A box on a slope one degree below its friction angle stays; one degree above it slides with g (sin - mu cos). Both start from
	// rest on the lower slope. Staying: nothing but rounding and the last of the damped motion, < 1e-4 of what friction's springs
	// give (4e-5 m). Sliding: the mean acceleration between two times; the box's bouncing on kn, which the sudden turn of gravity
	// starts, adds a fraction of (period/duration) x (relative change of the normal force), 1e-3.
	const Real g = 9.81, phi = 30 * degree;
	for (bool many : { false, true }) {
		BlockAssembly a = scene(2e8);
		if (many)
			for (Real x = -4; x < 3; x += 0.9)
				addRigid(a, box(x, -1, 0.9, 1));
		else
			addRigid(a, box(-4, -1, 8, 1));
		const int  mover = addGrid(a, { 0.05, 0 }, 1, 0.4, 3, 1);
		Simulation run(a, frictional(1e8, 1e8, phi), 0.4, 0.3);
		auto       tilt = [&](Real slope) {
                        std::fill(a.supports.load.begin(), a.supports.load.end(), Vec2::Zero());
                        addGravity(a, { -g * std::sin(slope), -g * std::cos(slope) });
		};
		tilt(0);
		run.steps(10000);
		tilt(phi - degree);
		run.steps(20000);
		const Vec2 start = a.centroid(mover);
		run.damping.kind = Damping::Kind::none;
		run.steps(10000);
		const Real crept = (a.centroid(mover) - start).norm();
		tilt(phi + degree);
		run.steps(long(0.1 / run.dt));
		const Real v = meanVelocity(a, mover).x();
		const long n = long(0.8 / run.dt);
		run.steps(n);
		const Real acceleration = (v - meanVelocity(a, mover).x()) / (n * run.dt);
		const Real expected     = g * (std::sin(phi + degree) - std::tan(phi) * std::cos(phi + degree));
		std::printf("incline, %s: crept %.1e m; acceleration %.5f, expected %.5f\n", many ? "many blocks" : "one block", crept, acceleration, expected);
		EXPECT_LT(crept, 4e-9);
		EXPECT_NEAR(acceleration, expected, 0.01 * expected);
	}
}

TEST(FreeContacts, BoxTopplesOverItsCorner)
{
	// A tall box (1 : 3), rough, on a floor that is tilted (gravity is): below atan(1/3) = 18.43 degrees it stands, above it topples.
	for (Real above : { -1.0, 1.0 }) {
		BlockAssembly a = scene(2e8);
		addRigid(a, box(-3, -1, 6, 1));
		addGrid(a, { 0, 0 }, 0.4, 1.2, 2, 4);
		const Real slope = std::atan(1. / 3) + above * degree, g = 9.81;
		Simulation run(a, frictional(2e8, 2e8, 60 * degree), 0.4, 0.5);
		addGravity(a, { 0, -g });
		run.steps(4000);
		std::fill(a.supports.load.begin(), a.supports.load.end(), Vec2::Zero());
		for (int i = 1; i <= 20; ++i) { // tilt it gradually
			std::fill(a.supports.load.begin(), a.supports.load.end(), Vec2::Zero());
			addGravity(a, { -g * std::sin(slope * i / 20), -g * std::cos(slope * i / 20) });
			run.steps(500);
		}
		run.damping.kind = Damping::Kind::none;
		const Vec2 start = a.centroid(1);
		run.steps(long(1.2 / run.dt));
		const Real moved = (a.centroid(1) - start).norm();
		std::printf("toppling %+.0f degree: centre moved by %.2e\n", above, moved);
		if (above < 0)
			EXPECT_LT(moved, 0.005);
		else
			EXPECT_GT(moved, 0.05);
	}
}

TEST(FreeContacts, SlidesAcrossUnevenBlocksAtConstantForce)
{
	// A plate is pulled over many blocks whose tops rise and fall by 2 mm in 0.3 m, with mu = 0.4. In the mean T = mu N up to the
	// slopes' squares; and no step changes the force by more than what the motion of one step can.
	std::mt19937                         random(5);
	std::uniform_real_distribution<Real> u(-0.002, 0.002);
	BlockAssembly                        a      = scene(5e8);
	Real                                 y      = 0;
	int                                  floors = 0;
	for (Real x = 0; x < 4; x += 0.3, ++floors) {
		const Real next = u(random);
		addRigid(a, { { x, -0.5 }, { x + 0.3, -0.5 }, { x + 0.3, next }, { x, y } });
		y = next;
	}
	addGrid(a, { 0.3, 0.003 }, 1, 0.3, 6, 2);
	addGravity(a, { 0, -9.81 });
	Simulation run(a, frictional(2e7, 1e7, std::atan(0.4)), 0.4, 0.2);
	run.steps(4000);
	std::vector<int> right;
	for (int n = a.mesh.firstNode[floors]; n < a.mesh.firstNode[floors + 1]; ++n)
		if (a.mesh.reference[n].x() > 1.29 && a.mesh.reference[n].y() < 0.2) right.push_back(2 * n);
	a.addGroup(driven("pull", right, 0.3, 0.2));
	Vec2 sum  = Vec2::Zero();
	long from = run.step + long(0.5 / run.dt), count = 0;
	run.steps(long(6.5 / run.dt), [&](Real) {
		if (run.step < from) return;
		sum += contactForce(a, floors);
		++count;
	});
	const Real weight = 2000 * 0.3 * 9.81;
	sum /= Real(count);
	std::printf("uneven floor: N/W = %.4f, T/N = %.4f\n", sum.y() / weight, -sum.x() / sum.y());
	EXPECT_NEAR(sum.y() / weight, 1, 0.02);
	EXPECT_NEAR(-sum.x() / sum.y(), 0.4, 0.02);
}

TEST(FreeContacts, DryStackRests)
{
	// Five blocks on a floor under their weight, damped to rest, then 1e6 steps without damping: nothing creeps.
	BlockAssembly a = scene(1e9);
	addRigid(a, box(-1, -0.5, 3, 0.5));
	for (int i = 0; i < 5; ++i)
		addGrid(a, { 0.03 * (i % 2), 0.2 * i }, 0.5, 0.2, 1, 1);
	addGravity(a, { 0, -9.81 });
	Simulation run(a, frictional(1e9, 5e8, 30 * degree), 0.4, 0.7);
	run.steps(30000);
	const auto start = a.state.displacement;
	run.damping.kind = Damping::Kind::none;
	run.steps(1000000);
	Real moved = 0;
	for (int n = 0; n < a.nodeCount(); ++n)
		moved = std::max(moved, (a.state.displacement[n] - start[n]).norm());
	const Real settled = 2000 * 9.81 / 1e9; // weight of the stack / kn: 2e-5 m
	std::printf("stack: moved %.1e m in 1e6 steps, contacts are compressed by %.1e m\n", moved, settled);
	EXPECT_LT(moved, 1e-3 * settled);
}

TEST(FreeContacts, RandomPolygonsGainNoEnergy)
{
	const int    count = std::getenv("BLOCKS_STRESS") ? std::atoi(std::getenv("BLOCKS_STRESS")) : 2100; // half of them touch
	const Stress s     = stress(count, 1000, 21);
	std::printf(
		"stress: %d poses, %d touched, worst gain of energy %.1e, worst imbalance %.1e; %.1f edge pairs, %.1f active\n",
		s.poses,
		s.touched,
		s.gain,
		s.lost,
		Real(s.edgePairs) / s.poses / 1000,
		Real(s.active) / s.poses / 1000);
	EXPECT_GT(s.touched, count / 3);
	EXPECT_LT(s.gain, 0.01);
	EXPECT_LT(s.lost, 0.01);
}

TEST(FreeContacts, TriplePointsStayQuiet)
{
	// Bonded cells, squeezed. Cells that share only a corner or have
	// intact joints must not disturb each other: forces as without contacts, to the depth by size.
	JointParams joint    = elasticJoint(1e9, 5e8);
	joint.tanPhiResidual = 0.5;
	BlockAssembly a      = voronoi(1, 1, 4, 4, { 1e9, 0.2, 2000 }, joint, 1);
	for (int n = 0; n < a.nodeCount(); ++n)
		a.state.displacement[n].y() = -1e-5 * a.mesh.reference[n].y();
	BlockAssembly b = a;
	computeForces(a);
	computeAllForces(b, joint, 0);
	EXPECT_FALSE(b.contacts.order.empty());
	const Real scale = largestForce(a);
	for (int n = 0; n < a.nodeCount(); ++n)
		EXPECT_LT((a.forces.nodal[n] - b.forces.nodal[n]).norm(), 1e-4 * scale) << n;
}

TEST(FreeContacts, NonConvexBlocksInterlock)
{
	// A block in the notch of another one: pushed to either side it is stopped by the notch's walls, with the area of the wall.
	BlockAssembly a = scene();
	addRigid(a, { { 0, 0 }, { 3, 0 }, { 3, 1 }, { 2, 1 }, { 2, 0.4 }, { 1.5, 0.4 }, { 1, 0.4 }, { 1, 1 }, { 0, 1 } });
	addRigid(a, box(1, 0.4, 1, 1));
	wantContacts(a, frictional(1e6, 1e6, 0));
	prepareContacts(a);
	const Real sharp[] = { 1, 1, 1, 1, 0, 0, 0, 1, 1 }; // right angles are, inward corners and points of straight edges are not
	for (int n = 0; n < 9; ++n)
		EXPECT_NEAR(a.contacts.sharpness[n], sharp[n], 10 * eps) << n;
	const Real d = 1e-4;
	for (const Vec2& push : { Vec2(d, 0), Vec2(-d, 0), Vec2(0, -d) }) {
		BlockAssembly b = a;
		moveBlock(b, 1, push);
		computeAllForces(b, frictional(1e6, 1e6, 0), 0);
		const Vec2 expected = -push * 1e6 * (push.x() != 0 ? 0.6 : 1); // kn d x the wall's height, or the notch's floor
		// the other wall is parted by d; corners share within a few d; 100 d/L
		EXPECT_LT((contactForce(b, 1) - expected).norm(), 0.01 * expected.norm()) << push.transpose();
	}
}
