// yade-blocks, GPL-2.0-or-later

// Random regions through all of the geometry: tessellation, zones, contact detection. Run by scripts/fuzz.sh part=geometry.
//   geometry_fuzz COUNT SEED [FIRST]
// Case i of a seed is the same whatever the count. What comes out is compared with sums that are taken here, apart from the code under test:
//   - the cells' areas add up to the region's; every side is shared by two cells or lies on the outline, whose length is the perimeter;
//   - the zones' areas add up to their cell's, none is negative; regionZones likewise, in all four zonings;
//   - the joints' areas add up to the length of the sides that two cells share;
//   - overlapDepth: a region is in itself, its plugs are not in it.
// Refusals count as explained where the words say what cannot be done. Everything else is unexplained, is printed with its case, and makes the program fail.

#include <blocks/kernel/geometry/PolygonRules.hpp>
#include <blocks/kernel/geometry/Tessellation.hpp>
#include <blocks/kernel/geometry/Zoning.hpp>
#include <blocks/kernel/model/JointDetection.hpp>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <random>
#include <set>

using namespace blocks;

namespace {

struct Dice {
	std::mt19937_64 source;
	Real            operator()(Real low, Real high) { return low + (high - low) * Real(source() >> 11) * 0x1p-53; }
	int             below(int n) { return int(source() % std::uint64_t(n)); }
	bool            chance(Real p) { return (*this)(0, 1) < p; }
};

// ---------------------------------------------------------------- regions

Ring rectangle(Real x0, Real y0, Real x1, Real y1) { return { { x0, y0 }, { x1, y0 }, { x1, y1 }, { x0, y1 } }; }
Ring reversed(const Ring& ring) { return { ring.rbegin(), ring.rend() }; }

Ring star(Dice& dice, const Vec2& centre, Real smallest, Real largest, int corners)
{
	Ring ring;
	for (int k = 0; k < corners; ++k) {
		const Real angle = 2 * M_PI * (k + dice(0, 0.8)) / corners, radius = dice(smallest, largest);
		ring.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
	}
	return ring;
}

Ring comb(Dice& dice)
{
	const int  teeth = 2 + dice.below(6);
	const Real back  = dice(0.02, 0.5);
	Ring       ring { { 0, 0 }, { Real(teeth), 0 } };
	for (int k = teeth - 1; k >= 0; --k) {
		const Real low = k + dice(0.02, 0.45), high = k + dice(0.5, 0.98), top = dice(1, 3);
		ring.push_back({ high, top }), ring.push_back({ low, top });
		if (k > 0) ring.push_back({ low - dice(0, 0.01), back }), ring.push_back({ k - 0.01, back });
	}
	ring[2].x() = teeth, ring.back().x() = 0;
	return ring;
}

Ring spiral(Dice& dice)
{
	const int  points = 6 + dice.below(20);
	const Real turns = dice(0.8, 2.5), thick = dice(0.1, 0.7);
	Ring       out, in;
	for (int k = 0; k < points; ++k) {
		const Real angle = 2 * M_PI * turns * k / (points - 1), radius = 1 + angle / (2 * M_PI);
		const Vec2 way(std::cos(angle), std::sin(angle));
		out.push_back(radius * way), in.push_back((radius - thick) * way);
	}
	out.insert(out.end(), in.rbegin(), in.rend());
	return out;
}

/// Random points, joined in an order without crossings: as long as two edges cross, what lies between them is reversed.
Ring tangled(Dice& dice)
{
	Ring      ring;
	const int n = 4 + dice.below(14);
	for (int k = 0; k < n; ++k)
		ring.push_back({ dice(0, 1), dice(0, 1) });
	for (bool again = true; again;) {
		again = false;
		for (int i = 0; i < n; ++i)
			for (int j = i + 2; j < n; ++j) {
				const Vec2 &a = ring[i], &b = ring[i + 1], &c = ring[j], &d = ring[(j + 1) % n];
				if (!(cross(b - a, c - a) * cross(b - a, d - a) < 0 && cross(d - c, a - c) * cross(d - c, b - c) < 0)) continue;
				std::reverse(ring.begin() + i + 1, ring.begin() + j + 1);
				again = true;
			}
	}
	return signedArea(ring) < 0 ? reversed(ring) : ring;
}

/// Unit squares that hang together; their outline, with or without the vertices on straight lines. Empty if it is not one simple line.
Ring polyomino(Dice& dice)
{
	std::set<std::pair<int, int>> squares { { 0, 0 } };
	const size_t                  count     = 2 + dice.below(10);
	const int                     way[4][2] = { { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 } };
	while (squares.size() < count) {
		auto at = squares.begin();
		std::advance(at, dice.below(int(squares.size())));
		const auto& step = way[dice.below(4)];
		squares.insert({ at->first + step[0], at->second + step[1] });
	}
	std::map<std::pair<int, int>, std::pair<int, int>> next;
	for (const auto& [x, y] : squares) {
		const std::pair<int, int> corner[4] = { { x, y }, { x + 1, y }, { x + 1, y + 1 }, { x, y + 1 } };
		const std::pair<int, int> beyond[4] = { { x, y - 1 }, { x + 1, y }, { x, y + 1 }, { x - 1, y } };
		for (int k = 0; k < 4; ++k)
			if (!squares.count(beyond[k]) && !next.insert({ corner[k], corner[(k + 1) % 4] }).second) return {};
	}
	const bool all = dice.chance(0.3);
	Ring       ring;
	const auto start = next.begin()->first;
	auto       at    = start;
	size_t     steps = 0;
	do {
		const auto to = next[at], after = next[to];
		const bool straight = (to.first - at.first) == (after.first - to.first) && (to.second - at.second) == (after.second - to.second);
		if (all || !straight) ring.push_back({ Real(to.first), Real(to.second) });
		at = to, ++steps;
	} while (at != start);
	return steps == next.size() ? ring : Ring {};
}

struct Case {
	std::string         kind;
	Polygon             region;
	TessellationOptions options;
	Zoning              zoning = Zoning::fan;
};

void addHoles(Dice& dice, Polygon& region)
{
	Vec2 low = region.outer[0], high = low;
	for (const Vec2& p : region.outer)
		low = low.cwiseMin(p), high = high.cwiseMax(p);
	const Real scale = (high - low).minCoeff();
	const int  tries = 1 + dice.below(dice.chance(0.3) ? 12 : 4);
	for (int k = 0; k < tries; ++k) {
		Polygon    more = region;
		const Vec2 centre(dice(low.x(), high.x()), dice(low.y(), high.y()));
		const Real radius = scale * std::exp(dice(std::log(1e-3), std::log(0.4)));
		more.holes.push_back(reversed(star(dice, centre, radius / 2, radius, 3 + dice.below(5))));
		if (dice.chance(0.3)) { // a neighbour a little apart
			const Real gap    = radius * std::exp(dice(std::log(1e-6), std::log(0.1)));
			more.holes.back() = reversed(rectangle(centre.x(), centre.y(), centre.x() + radius, centre.y() + radius));
			more.holes.push_back(reversed(rectangle(centre.x() + radius + gap, centre.y(), centre.x() + 2 * radius, centre.y() + radius / 2)));
		}
		try {
			requireSimple(more, "fuzz");
			region = more;
		} catch (const std::invalid_argument&) {
		}
	}
}

Case drawn(Dice& dice)
{
	Case c;
	bool lattice = false;
	switch (dice.below(9)) {
	case 0:
		c.kind = "rectangle", c.region.outer = rectangle(0, 0, dice(0.5, 4), dice(0.5, 4));
		break;
	case 1:
		c.kind = "star", c.region.outer = star(dice, { 0, 0 }, 0.2, 1, 3 + dice.below(12));
		break;
	case 2:
		c.kind = "comb", c.region.outer = comb(dice);
		break;
	case 3:
		c.kind = "spiral", c.region.outer = spiral(dice);
		break;
	case 4: {
		c.kind           = "sliver";
		const Real width = std::exp(dice(std::log(1e-3), std::log(0.1)));
		c.region.outer   = dice.chance(0.5) ? rectangle(0, 0, 1, width) : Ring { { 0, 0 }, { 1, width * dice(0, 1) }, { dice(0, 1), width } };
		if (signedArea(c.region.outer) < 0) c.region.outer = reversed(c.region.outer);
		break;
	}
	case 5:
		c.kind = "tangled", c.region.outer = tangled(dice);
		break;
	case 6:
		c.kind = "convex", c.region.outer = star(dice, { 0, 0 }, 1, 1, 3 + dice.below(8));
		break;
	case 7:
	case 8:
		c.kind = "lattice", lattice = true;
		while (c.region.outer.empty())
			c.region.outer = polyomino(dice);
	}
	if (lattice && dice.chance(0.2)) { // a frame
		c.region = { rectangle(0, 0, 5, 4), { rectangle(2, 1, 3, 3) } };
		std::reverse(c.region.holes[0].begin(), c.region.holes[0].end());
	} else if (dice.chance(lattice ? 0.1 : 0.45))
		addHoles(dice, c.region);
	if (!c.region.holes.empty()) c.kind += " with holes";

	auto&      o           = c.options;
	const Real area        = signedArea(c.region);
	o.size                 = std::sqrt(area / (1 + dice(0, 1) * (dice.chance(0.1) ? 200 : 25)));
	o.lloyd                = dice.below(4);
	o.seed                 = dice.source() % 1000000;
	const Real fractions[] = { 0, 0.05, 0.05, 0.1, 0.2, 0.3, 0.45 };
	o.mergeFraction        = fractions[dice.below(7)];
	c.zoning               = dice.chance(0.3) ? Zoning::corners : Zoning::fan;
	const int how          = dice.below(10);
	Vec2      low = c.region.outer[0], high = low;
	for (const Vec2& p : c.region.outer)
		low = low.cwiseMin(p), high = high.cwiseMax(p);
	if (lattice && how < 7) { // in the middle of squares, or all over the half lattice
		const Real step = how < 4 ? 1 : 0.5;
		for (Real x = low.x() + step / 2; x < high.x(); x += step)
			for (Real y = low.y() + step / 2; y < high.y(); y += step)
				if (dice.chance(how % 2 ? 1 : 0.7) && strictlyInside({ x, y }, c.region)) o.seeds.push_back({ x, y });
		o.size = step, o.lloyd = dice.chance(0.7) ? 0 : o.lloyd;
		c.kind += ", seeds on it";
	} else if (how == 8) {
		const Vec2 along(dice(-1, 1), dice.chance(0.5) ? 0 : dice(-1, 1)), through(dice(low.x(), high.x()), dice(low.y(), high.y()));
		for (int k = -10; k <= 10; ++k)
			if (strictlyInside(through + 0.1 * k * along, c.region)) o.seeds.push_back(through + 0.1 * k * along);
		c.kind += ", collinear seeds";
	} else if (how == 9) { // seeds at the same distance from walls, in pairs
		for (int k = 0; k < 30; ++k) {
			const Vec2 p = low + (high - low).cwiseProduct(Vec2((dice.below(8) + 0.5) / 8, (dice.below(8) + 0.5) / 8));
			if (strictlyInside(p, c.region) && !std::count(o.seeds.begin(), o.seeds.end(), p)) o.seeds.push_back(p);
		}
		c.kind += ", seeds of a grid";
	}
	o.size = std::min(o.size, std::sqrt(area) * (1 - 1e-9));

	const auto map = [&](const std::function<Vec2(const Vec2&)>& f) {
		for (Vec2& p : c.region.outer)
			p = f(p);
		for (Ring& hole : c.region.holes)
			for (Vec2& p : hole)
				p = f(p);
		for (Vec2& p : o.seeds)
			p = f(p);
	};
	if (dice.chance(0.25)) {
		const Real angle = dice.chance(0.3) ? M_PI / 4 : dice(0, 2 * M_PI), x = std::cos(angle), y = std::sin(angle);
		map([&](const Vec2& p) { return Vec2(x * p.x() - y * p.y(), y * p.x() + x * p.y()); });
		c.kind += ", turned";
	}
	if (dice.chance(0.15)) {
		const Real scale = std::pow(10, dice(-6, 3));
		map([&](const Vec2& p) { return Vec2(scale * p); });
		o.size *= scale;
		c.kind += ", scaled";
	} else if (dice.chance(0.2)) {
		const Vec2 shift = std::pow(10, dice(0, 6.5)) * Vec2(dice(-1, 1), dice(-1, 1));
		map([&](const Vec2& p) { return Vec2(p + shift); });
		c.kind += ", far away";
	}
	return c;
}

// ---------------------------------------------------------------- what must hold

struct Failure {
	std::string what;
};

void check(bool holds, const std::string& what)
{
	if (!holds) throw Failure { what };
}

/// Far from the code under test: extended precision, fan from the first vertex.
long double areaOf(const Ring& ring)
{
	long double twice = 0;
	for (size_t k = 1; k + 1 < ring.size(); ++k) {
		const long double px = (long double)(ring[k].x()) - ring[0].x(), py = (long double)(ring[k].y()) - ring[0].y();
		const long double qx = (long double)(ring[k + 1].x()) - ring[0].x(), qy = (long double)(ring[k + 1].y()) - ring[0].y();
		twice += px * qy - py * qx;
	}
	return twice / 2;
}

long double areaOf(const Polygon& polygon)
{
	long double area = areaOf(polygon.outer);
	for (const Ring& hole : polygon.holes)
		area += areaOf(hole);
	return area;
}

/// What the rounding of vertices may change in an area [m2].
Real areaRounding(const Polygon& region)
{
	const Real eps = std::numeric_limits<Real>::epsilon();
	return 64 * eps * (largestCoordinate(region) * perimeter(region) + signedArea(region));
}

Real checkZones(const Zones& zones, const Polygon& outline, const std::string& what)
{
	long double sum = 0;
	for (const auto& t : zones.triangles) {
		const Ring triangle { zones.points[t[0]], zones.points[t[1]], zones.points[t[2]] };
		check(areaOf(triangle) > 0, what + ": a zone without area");
		sum += areaOf(triangle);
	}
	check(std::abs(Real(sum - areaOf(outline))) <= areaRounding(outline),
	      what + ": zones have the area " + shown(Real(sum)) + ", not " + shown(Real(areaOf(outline))));
	return quality(zones).worstAspect;
}

/// What a cell cannot help: its diameter by the smallest of the lengths of the region's walls that it touches, the distances between them, and the widths
/// of their sharp corners. 1 if it touches none.
Real forcedAspect(const Ring& cell, const Polygon& region)
{
	std::vector<std::pair<Vec2, Vec2>> walls;
	const Real                         reach = 1e-9 * std::sqrt(signedArea(cell)) + 64 * std::numeric_limits<Real>::epsilon() * largestCoordinate(region);
	const auto                         distance = [](const Vec2& p, const Vec2& a, const Vec2& b) {
                const Real s = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), Real(0), Real(1));
                return (p - a - s * (b - a)).norm();
	};
	const auto collect = [&](const Ring& ring) {
		for (size_t k = 0, n = ring.size(); k < n; ++k) {
			const Vec2 &a = ring[k], &b = ring[(k + 1) % n];
			for (const Vec2& p : cell)
				if (distance(p, a, b) <= reach) {
					walls.push_back({ a, b });
					break;
				}
		}
	};
	collect(region.outer);
	for (const Ring& hole : region.holes)
		collect(hole);
	Real diameter = 0, feature = std::numeric_limits<Real>::infinity();
	for (const Vec2& p : cell)
		for (const Vec2& q : cell)
			diameter = std::max(diameter, (p - q).norm());
	for (const auto& [a, b] : walls) {
		feature = std::min(feature, (b - a).norm());
		for (const auto& [c, d] : walls) {
			if (a == c) continue;
			if (b == c) {
				if ((a - b).dot(d - b) > 0)
					feature = std::min(feature, diameter * std::abs(cross(a - b, d - b)) / ((a - b).norm() * (d - b).norm()));
			} else if (a != d)
				feature = std::min({ feature, distance(a, c, d), distance(b, c, d), distance(c, a, b), distance(d, a, b) });
		}
	}
	return std::max(Real(1), diameter / feature);
}

struct Tally {
	std::map<std::string, long> refusals, zonings;
	std::map<int, long>         aspects; ///< decade of the worst zone of a cell -> cells
	std::map<int, long>         ours;    ///< the same of slivers that neither the region nor given seeds nor mergeFraction 0 ask for
	long                        cells = 0, tessellations = 0, regions = 0;
};

/// The refusal without its numbers.
std::string kindOf(const std::string& refusal)
{
	std::string text = refusal.substr(0, refusal.find(", got"));
	text.erase(std::remove_if(text.begin(), text.end(), [](char c) { return std::isdigit(c) || c == '.'; }), text.end());
	return text;
}

void checkTessellation(const Case& c, Tally& tally)
{
	const Cells cells = tessellate(c.region, c.options);
	++tally.tessellations;
	tally.cells += long(cells.cells.size());
	long double                   sum = 0;
	std::set<std::pair<int, int>> sides;
	for (size_t i = 0; i < cells.cells.size(); ++i) {
		const Ring cell = ringOf(cells, i);
		requireSimple({ cell, {} }, "cell");
		sum += areaOf(cell);
		for (size_t k = 0, n = cell.size(); k < n; ++k)
			check(sides.insert({ cells.cells[i][k], cells.cells[i][(k + 1) % n] }).second, "a side has two cells");
	}
	check(std::abs(Real(sum - areaOf(c.region))) <= areaRounding(c.region),
	      "cells have the area " + shown(Real(sum)) + ", not " + shown(Real(areaOf(c.region))));
	Real inner = 0, outer = 0;
	for (const auto& [a, b] : sides) {
		const Real length = (cells.vertices[a] - cells.vertices[b]).norm();
		if (!sides.count({ b, a }))
			outer += length;
		else if (a < b)
			inner += length;
	}
	const Real rounding = 64 * std::numeric_limits<Real>::epsilon() * largestCoordinate(c.region) * Real(sides.size());
	check(std::abs(outer - perimeter(c.region)) <= rounding + 1e-12 * outer,
	      "cells have the outline " + shown(outer) + ", not " + shown(perimeter(c.region)));

	BlockAssembly a;
	a.addMaterial({ 1e9, 0.2, 2000 });
	for (size_t i = 0; i < cells.cells.size(); ++i) {
		const CellZones zones  = cellZones(ringOf(cells, i), c.zoning);
		const Real      aspect = checkZones(zones.zones, { ringOf(cells, i), {} }, "cell");
		++tally.aspects[int(std::floor(std::log10(aspect)))];
		if (aspect > sliverAspect && aspect > 10 * forcedAspect(ringOf(cells, i), c.region) && c.options.mergeFraction > 0 && c.options.seeds.empty())
			++tally.ours[int(std::floor(std::log10(aspect)))];
		++tally.zonings[zones.zoning == Zoning::fan ? "fan" : zones.zoning == Zoning::corners ? "corners" : "delaunay"];
		a.addBlock(zones.zones.points, zones.zones.rings, zones.zones.triangles, 0);
	}
	Real joints = 0;
	for (const Segment& g : detectSegments(a))
		joints += 2 * g.area;
	// A segment shorter than the detection's reach, a millionth of its edge, is none; of an edge that ends there so much is missing.
	check(std::abs(joints - inner) <= 1e-5 * inner + rounding, "joints have the area " + shown(joints) + ", not " + shown(inner));
}

void checkRegions(const Case& c, Dice& dice, Tally& tally)
{
	const Real zoneSize = std::sqrt(signedArea(c.region)) * dice(0.1, 1.2);
	for (Zoning zoning : { Zoning::delaunay, Zoning::corners, Zoning::fan, Zoning::regular }) {
		const std::string name = zoning == Zoning::delaunay ? "delaunay"
			: zoning == Zoning::corners                 ? "corners"
			: zoning == Zoning::fan                     ? "fan"
								    : "regular";
		try {
			const Zones zones = regionZones(c.region, zoning, zoneSize);
			checkZones(zones, c.region, "region, " + name);
			++tally.regions;
			for (const auto& ring : zones.rings)
				for (size_t k = 0; k < ring.size(); ++k)
					check((zones.points[ring[k]] - zones.points[ring[(k + 1) % ring.size()]]).norm() <= zoneSize * (1 + 1e-6),
					      name + ": an edge is longer than zoneSize");
		} catch (const std::invalid_argument& error) {
			const std::string text = error.what();
			const bool        fits = (zoning == Zoning::fan
                                           && (text.find("see every edge") != std::string::npos || text.find("no place for holes") != std::string::npos))
				|| (zoning == Zoning::regular
			            && (text.find("must be a rectangle") != std::string::npos || text.find("no place for holes") != std::string::npos));
			check(fits, name + " is refused: " + text);
			++tally.refusals[kindOf(text)];
		}
	}
	const Real touching = 1e-6 * meanWidth(c.region) + 64 * std::numeric_limits<Real>::epsilon() * largestCoordinate(c.region);
	if (dice.chance(0.1)) check(overlapDepth(c.region, c.region) > touching, "a region is not in itself");
	if (!c.region.holes.empty() && dice.chance(0.2)) {
		const Polygon plug { reversed(c.region.holes[0]), {} };
		check(overlapDepth(c.region, plug) <= touching, "a plug overlaps the region round it");
		check(overlapDepth({ c.region.outer, {} }, plug) > 0, "a hole's plug is not in the region without the hole");
	}
}

bool explained(const std::string& refusal)
{
	for (const char* words : { "edges must be farther apart", "must be distinct", "must be farther apart", "must lie inside the region" })
		if (refusal.find(words) != std::string::npos) return true;
	return false;
}

void print(const Case& c)
{
	const auto rings = [](const Ring& ring) {
		std::cout << "[";
		for (const Vec2& p : ring)
			std::cout << "(" << shown(p.x()) << "," << shown(p.y()) << "),";
		std::cout << "]";
	};
	std::cout << "  outline=";
	rings(c.region.outer);
	std::cout << " holes=[";
	for (const Ring& hole : c.region.holes)
		rings(hole), std::cout << ",";
	std::cout << "] size=" << shown(c.options.size) << " lloyd=" << c.options.lloyd << " seed=" << c.options.seed
		  << " mergeFraction=" << shown(c.options.mergeFraction) << " zoning=" << (c.zoning == Zoning::fan ? "fan" : "corners") << " seeds=";
	rings(c.options.seeds);
	std::cout << std::endl;
}

} // namespace

int main(int argc, char** argv)
{
	if (argc < 3) {
		std::cerr << "usage: geometry_fuzz COUNT SEED [FIRST]\n";
		return 2;
	}
	const long count = std::atol(argv[1]), seed = std::atol(argv[2]), first = argc > 3 ? std::atol(argv[3]) : 0;
	Tally      tally;
	long       unexplained = 0, invalid = 0;
	for (long i = first; i < first + count; ++i) {
		Dice dice;
		dice.source.seed(std::uint64_t(seed) * 1000003 + std::uint64_t(i) * 7919);
		const Case c = drawn(dice);
		try {
			requireSimple(c.region, "fuzz");
		} catch (const std::invalid_argument&) {
			++invalid; // not the generator's, but rounding's: turned, scaled, far away
			continue;
		}
		const auto report = [&](const std::string& text) {
			++unexplained;
			std::cout << "UNEXPLAINED case " << i << " (" << c.kind << "): " << text << "\n";
			print(c);
		};
		try {
			checkTessellation(c, tally);
		} catch (const Failure& failure) {
			report(failure.what);
		} catch (const std::invalid_argument& error) {
			if (explained(error.what()))
				++tally.refusals[kindOf(error.what())];
			else
				report(error.what());
		} catch (const std::exception& error) {
			report(error.what());
		}
		try {
			checkRegions(c, dice, tally);
		} catch (const Failure& failure) {
			report(failure.what);
		} catch (const std::exception& error) {
			report(error.what());
		}
	}
	std::cout << "geometry: " << count << " regions of seed " << seed << " (" << invalid << " invalid), " << tally.tessellations << " tessellations, "
		  << tally.cells << " cells, " << tally.regions << " meshed regions\n";
	for (const auto& [name, n] : tally.zonings)
		std::cout << "  cells by zoning: " << name << " " << n << "\n";
	for (const auto& [decade, n] : tally.aspects)
		std::cout << "  worst aspect of a cell in [1e" << decade << ", 1e" << decade + 1 << "): " << n << "\n";
	for (const auto& [decade, n] : tally.ours)
		std::cout << "  of these, asked for neither by the region nor by its options: [1e" << decade << ", 1e" << decade + 1 << "): " << n << "\n";
	for (const auto& [text, n] : tally.refusals)
		std::cout << "  refused " << n << ": " << text << "\n";
	std::cout << "unexplained " << unexplained << "\n";
	return unexplained ? 1 : 0;
}
