// yade-blocks, GPL-2.0-or-later
#include <CellChecks.hpp>

using namespace cellchecks;

TEST(Tessellation, mergesShortEdges)
{
	// A grid sheared so that each vertex of four cells is two vertices of three, an edge of about 0.017 apart.
	auto o = sized(1, 0);
	for (const Vec2& p : grid(6, 5, 1))
		o.seeds.push_back(p + Vec2(0.012 * (int(p.y()) % 2 ? 1 : -1), 0.007 * (int(p.x()) % 2)));
	const Polygon region = solid(rectangle(0, 0, 6, 5));

	o.mergeFraction    = 0;
	const Cells before = tessellate(region, o);
	expectTiling(region, before, 1, "short edges kept");
	EXPECT_LT(shortestInteriorEdge(before), 0.05);
	EXPECT_GT(before.vertices.size(), 42u);

	o.mergeFraction   = 0.1;
	const Cells after = tessellate(region, o);
	expectTiling(region, after, 1, "short edges merged");
	EXPECT_GT(shortestInteriorEdge(after), 0.1);
	EXPECT_EQ(after.cells.size(), 30u);
	EXPECT_EQ(after.vertices.size(), 42u); // 7 x 6: every pair has become one
}

TEST(Tessellation, fewShortEdgesRemainInRandomCells)
{
	for (std::uint64_t seed : { 1, 2, 3 }) {
		const Real  s     = 0.003;
		const Cells cells = tessellate(solid(brick), sized(s, 0, seed)); // 1538 cells
		int         edges = 0, shorter = 0;
		for (size_t i = 0; i < cells.cells.size(); ++i) {
			const Ring ring = ringOf(cells, i);
			for (size_t k = 0; k < ring.size(); ++k) {
				++edges;
				shorter += (ring[(k + 1) % ring.size()] - ring[k]).norm() < 0.05 * s;
			}
		}
		// Without merging about 8 % are (checked below); a merge is refused only where it would dent a cell.
		EXPECT_LE(shorter, edges / 1000);
		auto o          = sized(s, 0, seed);
		o.mergeFraction = 0;
		EXPECT_LT(shortestInteriorEdge(tessellate(solid(brick), o)), 0.005 * s);
	}
}

// Pieces clipped to slivers along the outline have no short edge, but they must go all the same.
TEST(Tessellation, flattensThinCells)
{
	int thin = 0;
	for (int trial = 0; trial < 50; ++trial) { // some 10,000 cells
		const Cells cells = tessellate(solid(comb), sized(0.25, 0, 100 + trial));
		for (size_t i = 0; i < cells.cells.size(); ++i) {
			const Ring ring = ringOf(cells, i);
			bool       free = true; // corners may pin a thin cell
			for (const Vec2& p : ring)
				free = free && !isCornerOf(solid(comb), p);
			Real width = std::numeric_limits<Real>::infinity();
			for (size_t k = 0; k < ring.size(); ++k) {
				const Vec2 t        = (ring[(k + 1) % ring.size()] - ring[k]).normalized();
				Real       farthest = 0;
				for (const Vec2& p : ring)
					farthest = std::max(farthest, cross(t, p - ring[k]));
				width = std::min(width, farthest);
			}
			thin += free && width < 0.05 * 0.25;
		}
	}
	EXPECT_LE(thin, 2); // where flattening would dent a neighbour
}

// The bisector of two seeds mirrored on the line from (0.02, 0) to (1, 1) meets the outline 0.02 beside the region's corner.
TEST(Tessellation, mergesIntoCorners)
{
	const Vec2 p(0.02, 0), t = Vec2(0.98, 1).normalized(), across(-t.y(), t.x());
	auto       o         = sized(0.7, 0);
	o.seeds              = { p + 0.7 * t + 0.2 * across, p + 0.7 * t - 0.2 * across };
	const Polygon square = solid(rectangle(0, 0, 1.1, 1));
	EXPECT_EQ(tessellate(square, o).vertices.size(), 5u); // the four corners and (1, 1)
	expectTiling(square, tessellate(square, o), 0.7, "merged into the corner");
	o.mergeFraction = 0.01;
	EXPECT_EQ(tessellate(square, o).vertices.size(), 6u);
}

// Near the tip of a wedge every edge across is short, and has to stay: its ends lie on different walls.
TEST(Tessellation, edgesAcrossAThinRegionStay)
{
	auto o              = sized(0.7, 0);
	o.seeds             = { { 0.3, 0.01 }, { 0.6, 0.01 }, { 1.1, 0.01 }, { 2, 0.05 }, { 3, 0.1 } };
	const Polygon wedge = solid({ { 0, 0 }, { 4, 0 }, { 4, 0.3 } });
	o.mergeFraction     = 0.1; // of 0.7; the first edge across is 0.034 long
	const Cells cells   = tessellate(wedge, o);
	expectTiling(wedge, cells, 0.7, "wedge");
	EXPECT_EQ(cells.cells.size(), 5u);
}

// A turned T of squares with seeds on their lattice (case 128833 of seed 4711 of the fuzz): the wall between two seeds runs along the outline, and a
// cell of no width lay between them.
TEST(Tessellation, cellsOfNoWidthVanish)
{
	const Vec2 x(0.99691058499036012, 0.078544799536175533), y(-x.y(), x.x());
	const auto at     = [&](Real a, Real b) -> Vec2 { return a * x + b * y; };
	const auto region = solid({ { 1.0754553845265356, -0.91836578545418457 },
	                            at(1, 0),
	                            { 1.9938211699807202, 0.15708959907235107 },
	                            { 1.9152763704445448, 1.1540001840627112 },
	                            { 1.8367315709083691, 2.1509107690530711 },
	                            { 2.8336421558987297, 2.229455568589247 },
	                            { 2.7550973563625538, 3.2263661535796073 },
	                            { 1.7581867713721937, 3.1478213540434314 },
	                            { 0.76127618638183359, 3.069276554507256 },
	                            { 0.83982098591800902, 2.0723659695168957 },
	                            { 0.91836578545418457, 1.0754553845265356 },
	                            at(0, 1),
	                            { 0, 0 },
	                            { 0.078544799536175533, -0.99691058499036012 } });
	auto       o      = sized(1, 0);
	o.mergeFraction   = 0.1;
	o.seeds = { { 0.53772769226326778, -0.45918289272709228 }, { 1.2990038786451015, 2.6100936617801636 }, { 2.2959144636354614, 2.688638461316339 } };
	const Cells cells = tessellate(region, o);
	expectTiling(region, cells, 1, "turned T");
	EXPECT_EQ(cells.cells.size(), 3u);
}

// A sliver 1e5 from the origin (case 119974 of seed 4711 of the fuzz): its coordinates are rounded to more than a billionth of a cell.
TEST(Tessellation, farFromTheOriginWhatIsRoundedAlikeIsOne)
{
	const Polygon region
		= solid({ { 128436.08760368229, 205574.11375129572 }, { 128437.08760368229, 205574.1162184345 }, { 128436.8154463184, 205574.1554862945 } });
	for (Real mergeFraction : { 0.0, 0.1 }) {
		auto o          = sized(0.028100713397721831, 0);
		o.mergeFraction = mergeFraction;
		o.seeds = { { 128436.90010368229, 205574.11635973313 }, { 128436.65010368229, 205574.1424441074 },  { 128436.27510368229, 205574.11635973313 },
			    { 128436.65010368229, 205574.1320103577 },  { 128436.65010368229, 205574.12157660798 }, { 128436.65010368229, 205574.12679348284 },
			    { 128437.02510368229, 205574.12157660798 }, { 128436.77510368229, 205574.11635973313 }, { 128436.77510368229, 205574.13722723254 },
			    { 128436.40010368229, 205574.12679348284 }, { 128436.27510368229, 205574.12157660798 }, { 128436.15010368229, 205574.11635973313 },
			    { 128436.52510368229, 205574.12679348284 }, { 128436.40010368229, 205574.11635973313 }, { 128436.52510368229, 205574.13722723254 },
			    { 128436.52510368229, 205574.1320103577 } };
		const Cells cells = tessellate(region, o);
		Real        sum   = 0;
		for (size_t i = 0; i < cells.cells.size(); ++i) {
			const Ring ring = ringOf(cells, i);
			EXPECT_GT(signedArea(ring), 0);
			EXPECT_NO_THROW(requireSimple(solid(ring), "cell"));
			sum += signedArea(ring);
		}
		EXPECT_NEAR(sum, signedArea(region.outer), 1e-10); // a few roundings of a coordinate, 3e-11, by the perimeter of 2
	}
}

// Two holes with edges on one line (case 4599 of seed 402 of the fuzz): flattening left a cell whose arm of no width lay along that line, and blocks
// that overlap by rounding. No vertex of a cell lies on another of its edges.
TEST(Tessellation, flatteningLeavesNoArms)
{
	Polygon region { { { -11.746167013432753, 4.8068172746213902 },
		           { -12.871862836774095, 5.4384476387366787 },
		           { -14.27139640417289, 2.9441896344472043 },
		           { -13.145700580831548, 2.3125592703319162 } },
		         {} };
	region.holes      = { { { -13.897775289932088, 3.0101349983637102 },
		                { -13.905752444588458, 3.0146109971155326 },
		                { -13.901276445836636, 3.0225881517719024 },
		                { -13.893299291180266, 3.0181121530200805 } },
		              { { -13.904122507396524, 3.0189407594518749 },
		                { -13.911491599868919, 3.0230755731955394 },
		                { -13.909253600493006, 3.0270641505237252 },
		                { -13.901884508020613, 3.0229293367800603 } },
		              { { -13.740509353834359, 3.3210071427920465 },
		                { -13.738527263836456, 3.3212550494655186 },
		                { -13.736570854967653, 3.3181674833479144 },
		                { -13.738229418033439, 3.3160893649411167 },
		                { -13.741810304716363, 3.3163552898571913 },
		                { -13.743150190685968, 3.3178745256171362 } } };
	auto o            = sized(0.21002905215131454, 3, 695587);
	o.mergeFraction   = 0.45;
	const Cells cells = tessellate(region, o);
	for (size_t i = 0; i < cells.cells.size(); ++i) {
		const Ring   ring = ringOf(cells, i);
		const size_t n    = ring.size();
		for (size_t k = 0; k < n; ++k)
			for (size_t m = 1; m + 1 < n; ++m) { // edges that do not begin or end at k
				const Vec2 a = ring[(k + m) % n], b = ring[(k + m + 1) % n];
				const Real along = std::clamp((ring[k] - a).dot(b - a) / (b - a).squaredNorm(), Real(0), Real(1));
				EXPECT_GT((ring[k] - a - along * (b - a)).norm(), 1e-9 * o.size) << "cell " << i;
			}
	}
}
