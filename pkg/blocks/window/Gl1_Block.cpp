// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/model/Outline.hpp>
#include <blocks/window/Colours.hpp>
#include <blocks/window/Gl1_Block.hpp>
#include <lib/opengl/gl.hpp>

namespace yade {

Gl1_Block::~Gl1_Block() = default;

string   Gl1_Block::colour = "material";
bool     Gl1_Block::zones = false, Gl1_Block::cracks = true;
Vector2r Gl1_Block::range = Vector2r::Zero();

namespace {

	/// What the window shows, worked out once for all blocks of a picture.
	struct Picture {
		const BlockModel*                         model     = nullptr;
		long                                      iteration = -1;
		string                                    colour;
		Vector2r                                  range = Vector2r::Zero();
		Coloured                                  coloured;
		std::map<int, vector<std::array<int, 3>>> rigidTriangles; ///< grid points, by block
	} picture;

	void update(const BlockModel& model, long iteration)
	{
		if (picture.model != &model) picture.rigidTriangles.clear();
		if (picture.model == &model && picture.iteration == iteration && picture.colour == Gl1_Block::colour && picture.range == Gl1_Block::range)
			return;
		picture.model = &model, picture.iteration = iteration, picture.colour = Gl1_Block::colour, picture.range = Gl1_Block::range;
		picture.coloured = picture.colour == "material" ? Coloured() : colouredBy(picture.colour, model.assembly, picture.range);
	}

	/// A rigid block has no zones: triangles between its corners.
	const vector<std::array<int, 3>>& trianglesOf(const blocks::BlockAssembly& a, int block)
	{
		auto& known = picture.rigidTriangles[block];
		if (known.empty()) known = blocks::cornerTriangles(a, block);
		return known;
	}

	/// Draws points of the model with respect to a body, as the renderer has moved there already.
	class Pen {
	public:
		Pen(const blocks::BlockAssembly& assembly, const State& state)
			: a(assembly)
			, centre(state.se3.position)
			, back(state.se3.orientation.conjugate())
		{
		}
		void to(const blocks::Vec2& x) const
		{
			const Vector3r local = back * (Vector3r(x.x(), x.y(), 0) - centre);
			glVertex3d(local.x(), local.y(), local.z());
		}
		void to(int node) const { to(a.position(node)); }
		void line(int from, int there) const { to(from), to(there); }

	private:
		const blocks::BlockAssembly& a;
		const Vector3r               centre;
		const Quaternionr            back;
	};

	void fill(const BlockModel& model, int block, const Vector3r& plain, const Pen& pen)
	{
		const blocks::BlockAssembly& a       = model.assembly;
		const Coloured&              c       = picture.coloured;
		const bool                   byValue = picture.colour != "material";
		const auto                   draw    = [&](const std::array<int, 3>& triangle, Real value) {
                        const Vector3r rgb = byValue ? colourOf(value, c.low, c.high) : plain;
                        glColor3d(rgb[0], rgb[1], rgb[2]);
                        for (int n : triangle)
                                pen.to(n);
		};
		glEnable(GL_POLYGON_OFFSET_FILL); // lines lie on top
		glPolygonOffset(1, 1);
		glBegin(GL_TRIANGLES);
		if (a.isRigid(block))
			for (const auto& triangle : trianglesOf(a, block))
				draw(triangle, byValue ? c.block[block] : 0);
		for (int z = a.mesh.firstZone[block]; z < a.mesh.firstZone[block + 1]; ++z)
			draw(a.mesh.zoneNodes[z], byValue ? c.zone[z] : 0);
		glEnd();
		glDisable(GL_POLYGON_OFFSET_FILL);
	}

	void drawZones(const blocks::BlockAssembly& a, int block, const Pen& pen)
	{
		glLineWidth(1);
		glColor3d(0.45, 0.45, 0.45);
		glBegin(GL_LINES);
		for (int z = a.mesh.firstZone[block]; z < a.mesh.firstZone[block + 1]; ++z)
			for (int k = 0; k < 3; ++k)
				pen.line(a.mesh.zoneNodes[z][k], a.mesh.zoneNodes[z][(k + 1) % 3]);
		glEnd();
	}

	void drawOutline(const blocks::BlockAssembly& a, int block, const Pen& pen)
	{
		glLineWidth(1.5);
		glColor3d(0.15, 0.15, 0.15);
		glBegin(GL_LINES);
		for (int e = a.mesh.firstEdge[block]; e < a.mesh.firstEdge[block + 1]; ++e)
			pen.line(a.mesh.edgeNodes[e][0], a.mesh.edgeNodes[e][1]);
		glEnd();
	}

	/// Both faces of the joints that are broken and whose first block this is.
	void drawCracks(const blocks::BlockAssembly& a, int block, const Pen& pen)
	{
		const auto& pairs = a.joints.pairs;
		auto        pair  = std::lower_bound(pairs.begin(), pairs.end(), block, [](const blocks::Pair& p, int b) { return p.block[0] < b; });
		glLineWidth(3);
		glColor3d(0.85, 0.1, 0.1);
		glBegin(GL_LINES);
		for (; pair != pairs.end() && pair->block[0] == block; ++pair) {
			if (a.isRemoved(pair->block[1])) continue;
			for (int i = pair->first; i < pair->last; ++i) {
				const auto broken = [](blocks::Joint s) { return s == blocks::Joint::brokenInTension || s == blocks::Joint::brokenInShear; };
				if (!broken(a.state.status[2 * i]) && !broken(a.state.status[2 * i + 1])) continue;
				const blocks::Segment& g    = a.joints.segments[i];
				const auto             face = [&](int from, int to, Real s) -> blocks::Vec2 {
                                        return a.position(g.node[from]) + s * (a.position(g.node[to]) - a.position(g.node[from]));
				};
				for (int k : { 0, 1 })
					pen.to(face(0, 1, g.s1[k]));
				for (int k : { 0, 1 })
					pen.to(face(2, 3, g.s2[k]));
			}
		}
		glEnd();
	}

} // namespace

string Gl1_Block::getColour() { return colour; }

void Gl1_Block::setColour(const string& wanted)
{
	const auto& names = colourings();
	if (std::find(names.begin(), names.end(), wanted) == names.end()) {
		string list;
		for (const string& name : names)
			list += (list.empty() ? "'" : ", '") + name + "'";
		throw std::invalid_argument("Gl1_Block.colour must be one of " + list + ", got '" + wanted + "'");
	}
	colour = wanted;
}

py::tuple Gl1_Block::getShownRange() { return py::make_tuple(picture.coloured.low, picture.coloured.high); }

void Gl1_Block::go(const shared_ptr<Shape>& shape, const shared_ptr<State>& state, bool wire, const GLViewInfo&)
{
	const Block& block = static_cast<const Block&>(*shape);
	if (!block.model || block.index < 0 || block.index >= block.model->assembly.blockCount()) return; // made by hand
	const blocks::BlockAssembly& a = block.model->assembly;
	update(*block.model, scene ? scene->iter : -1);
	const Pen pen(a, *state);
	glPushAttrib(GL_CURRENT_BIT | GL_LINE_BIT | GL_POLYGON_BIT | GL_LIGHTING_BIT | GL_ENABLE_BIT);
	glDisable(GL_LIGHTING);
	const bool own = shape->color != Vector3r::Ones(); // somebody has given it a colour
	if (!wire) fill(*block.model, block.index, own ? shape->color : colourOfMaterial(a.mesh.blockMaterial[block.index]), pen);
	if (zones || wire) drawZones(a, block.index, pen);
	drawOutline(a, block.index, pen);
	if (cracks) drawCracks(a, block.index, pen);
	glPopAttrib();
}

YADE_PLUGIN((Gl1_Block));

} // namespace yade
