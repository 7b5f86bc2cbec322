// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/geometry/Diagram.hpp>
#include <blocks/kernel/geometry/Tessellation.hpp>
#include <map>
#include <queue>
#include <tuple>

namespace blocks {

/// Merges short edges, shortest first, and flattens thin cells. An operation is carried out only if every cell it
/// touches stays a valid cell; otherwise nothing changes.
class CellMerger {
public:
	CellMerger(Diagram&, const Walls&, Real shortestEdge, Real coincidence);

	Cells run();

private:
	// ---- Merging.cpp: edges
	void  mergeEdges();
	void  merge(int a, int b);
	bool  collapse(int a, int b, const Vec2& target);
	Cells result() const;

	// ---- CellChanges.cpp: an operation, tried and carried out
	Real        length(int a, int b) const { return (d.position[a] - d.position[b]).norm(); }
	void        queueEdges(int cell);
	static bool adjacent(const IntRing& ring, int a, int b);
	/// Drops a node of the changed rings if it no longer separates anything. (All its cells are among them if so.)
	void dissolve(int node);
	/// Carries the operation out if every new ring is valid. `harmless`: only coincident nodes were joined, which makes no
	/// ring worse; rings that coincidences of region and diagram have left invalid become valid in this way.
	bool acceptChanges(bool harmless = false);
	/// Convex but for the region's reflex corners, dented by no more than the tolerance, and not degenerate.
	bool valid(const IntRing& ring) const;
	/// Twice the area by the perimeter [m]: less than the width.
	Real meanWidth(const IntRing& ring) const;
	bool simple(const IntRing& ring) const;
	int  cellsAlong(int a, int b) const;
	void moveToWall(int node, const Vec2& position, int wall);
	/// No more area than rounding gives.
	bool empty(const IntRing& ring) const { return meanWidth(ring) <= tolerance; }

	// ---- Necks.cpp: cells that reach around corners of the region
	void divideNecks();
	/// A cell may reach around a corner of the region, its far side running (almost) along the wall. Gives the thin arm's
	/// tip, a triangle from that corner on, to the neighbour on the far side.
	bool trim(int cell);
	/// Shortens an arm where the far side's next node comes before that corner: the node goes onto the wall, and the arm ends there.
	bool shorten(int cell);
	/// A cell may pass a reflex corner of the region by a neck narrower than a short edge. Moves the node on the other
	/// side of the neck to the corner, so that the cell becomes two.
	bool divide(int cell);
	/// Divides a cell at a neck whose other side is an edge: the corner becomes a vertex of the neighbour beyond it.
	bool       divideAtEdge(int cell);
	static int nextTo(const IntRing& ring, int node, bool after);
	/// Moves a node from behind the line between two others onto it, along its edge with a fourth, if that meets the line.
	void giveWay(int node, int from, int to, int along);

	// ---- Flattening.cpp: thin cells
	bool thin(int cell) const { return meanWidth(cells[cell]) < shortest && base(cells[cell]).second < shortest; } // the cheap test first
	/// Where the cell's base begins: that edge from which the others are least far, the longest of several; and how far that is [m].
	std::pair<size_t, Real> base(const IntRing& ring) const;
	/// Moves the cell's other nodes onto its base; the cell vanishes and its neighbour beyond the base (if any) takes the nodes over. Nodes of the
	/// region's outline cannot move; the neighbour takes them over where they are.
	void flatten(int cell);

	Diagram&                      d;
	const Walls&                  walls;
	const Real                    shortest, tolerance; ///< [m]
	std::vector<IntRing>          cells;               ///< empty where a cell has vanished
	std::vector<std::vector<int>> around;              ///< by node: its cells
	std::vector<char>             reflex;              ///< by corner

	using Edge = std::tuple<Real, int, int>; // length, lower node, higher node: a total order
	std::priority_queue<Edge, std::vector<Edge>, std::greater<>> queue;
	std::map<int, IntRing>                                       changed; ///< the operation under test: new rings by cell
};

} // namespace blocks
