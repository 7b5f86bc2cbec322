// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/model/EdgeShapes.hpp>
#include <blocks/kernel/model/Outline.hpp>
#include <limits>

namespace blocks {

void computeShapes(BlockAssembly& a)
{
	FreeContacts& f     = a.contacts;
	const int     edges = int(a.mesh.edgeNodes.size());
	f.sharpness.assign(a.nodeCount(), 0);
	f.rounding.assign(a.nodeCount(), 0);
	f.edgeFrom.assign(a.nodeCount(), -1);
	for (int e = 0; e < edges; ++e)
		f.edgeFrom[a.mesh.edgeNodes[e][0]] = e;
	for (const auto& [from, to] : a.mesh.edgeNodes) {
		const int  next = a.mesh.edgeNodes[f.edgeFrom[to]][1];
		const Vec2 in = a.mesh.reference[to] - a.mesh.reference[from], out = a.mesh.reference[next] - a.mesh.reference[to];
		const Real lengths = in.norm() * out.norm(), sine = cross(in, out) / lengths, cosine = in.dot(out) / lengths;
		// the outline turns left by the angle of (cosine, sine) = pi - beta, so 1/tan(beta/2) = tan(turn/2)
		const Real tangent  = sine / std::max(1 + cosine, std::numeric_limits<Real>::epsilon()); // negative where it bends inward
		const Real straight = 1e-9; // an outline that turns by less than this [rad] goes straight on
		f.sharpness[to]     = tangent > straight ? tangent * tangent : 0;
		f.rounding[to]      = roundingFraction * std::min(in.norm(), out.norm());
	}
	f.leastDepth = std::numeric_limits<Real>::infinity();
	f.depthLimit.resize(a.blockCount());
	f.meanEdge.resize(a.blockCount());
	for (int b = 0; b < a.blockCount(); ++b) {
		const AreaSum sum = referenceMoments(a, b);
		f.depthLimit[b]   = sum.area() / sum.perimeter(); // between half the inradius (compact blocks) and all of it (thin ones)
		f.meanEdge[b]     = meanEdge(a, b);
		f.leastDepth      = std::min(f.leastDepth, f.depthLimit[b]);
	}
}

void nameEdges(const BlockAssembly& a, EdgePair& e)
{
	const FreeContacts& f = a.contacts;
	const auto &        A = a.mesh.edgeNodes[e.edge[0]], &B = a.mesh.edgeNodes[e.edge[1]];
	e.node = { A[0], A[1], B[0], B[1] };
	for (int i = 0; i < 4; ++i)
		e.shape.sharpness[i] = f.sharpness[e.node[i]];
	auto rho            = [&](int i, int j) { return std::min(f.rounding[i], f.rounding[j]); };
	e.shape.rounding    = { rho(A[0], B[1]), rho(A[1], B[0]) };
	e.shape.farRounding = { rho(A[1], B[1]), rho(A[0], B[0]) };
	e.shape.depthLimit  = std::min(f.depthLimit[a.blockOfNode(A[0])], f.depthLimit[a.blockOfNode(B[0])]);
}

} // namespace blocks
