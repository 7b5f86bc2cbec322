// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/step/Joints.hpp>
#include <blocks/window/Gl1_BlockGeom.hpp>
#include <lib/opengl/gl.hpp>

namespace yade {

Gl1_BlockGeom::~Gl1_BlockGeom() = default;
Gl1_JointPhys::~Gl1_JointPhys() = default;

Real Gl1_JointPhys::scale = 0;

namespace {

	void vertex(const blocks::Vec2& x) { glVertex3d(x.x(), x.y(), 0); }

	/// Flat colours, and the renderer's own again afterwards.
	class Flat {
	public:
		Flat(float width)
		{
			glPushAttrib(GL_CURRENT_BIT | GL_LINE_BIT | GL_LIGHTING_BIT | GL_ENABLE_BIT);
			glDisable(GL_LIGHTING);
			glDisable(GL_DEPTH_TEST); // in the plane of the blocks, and on top of them
			glLineWidth(width);
			glBegin(GL_LINES);
		}
		~Flat()
		{
			glEnd();
			glPopAttrib();
		}
		Flat(const Flat&)            = delete;
		Flat& operator=(const Flat&) = delete;
	};

	/// Bars by the stresses of the model as it is, worked out once for all joints of a picture.
	Real automaticScale(const BlockModel& model, long iteration)
	{
		static const BlockModel* known = nullptr;
		static long              at    = -1;
		static Real              bars  = 0;
		if (known == &model && at == iteration) return bars;
		known = &model, at = iteration;
		const blocks::BlockAssembly& a       = model.assembly;
		Real                         largest = 0, area = 0;
		for (Real sigma : a.state.sigma)
			largest = std::max(largest, std::abs(sigma));
		for (const blocks::Segment& g : a.joints.segments)
			area += 2 * g.area;
		const Real length = a.joints.count() > 0 ? area / a.thickness / a.joints.count() : 0;
		return bars       = largest > 0 ? 2 * length / largest : 0;
	}

} // namespace

void Gl1_BlockGeom::go(const shared_ptr<IGeom>& geom, const shared_ptr<Interaction>&, const shared_ptr<Body>&, const shared_ptr<Body>&, bool)
{
	const BlockGeom& g = static_cast<const BlockGeom&>(*geom);
	if (!g.model || g.pair < 0) return;
	const blocks::BlockAssembly& a    = g.model->assembly;
	const blocks::Pair&          pair = a.joints.pairs[g.pair];
	const Flat                   flat(2);
	for (int i = pair.first; i < pair.last; ++i) {
		const auto first = a.state.status[2 * i], second = a.state.status[2 * i + 1];
		const auto is = [&](blocks::Joint s) { return first == s || second == s; };
		if (is(blocks::Joint::brokenInTension) || is(blocks::Joint::brokenInShear))
			glColor3d(0.85, 0.1, 0.1);
		else if (is(blocks::Joint::softening))
			glColor3d(0.95, 0.6, 0.1);
		else
			glColor3d(0.1, 0.6, 0.2);
		vertex(blocks::contactPosition(a, 2 * i)), vertex(blocks::contactPosition(a, 2 * i + 1));
	}
}

void Gl1_JointPhys::go(const shared_ptr<IPhys>& phys, const shared_ptr<Interaction>&, const shared_ptr<Body>&, const shared_ptr<Body>&, bool)
{
	const JointPhys& p = static_cast<const JointPhys&>(*phys);
	if (!p.model || p.pair < 0) return;
	const blocks::BlockAssembly& a    = p.model->assembly;
	const blocks::Pair&          pair = a.joints.pairs[p.pair];
	const Real                   bars = scale > 0 ? scale : automaticScale(*p.model, scene ? scene->iter : -1);
	const Flat                   flat(2);
	for (int i = 2 * pair.first; i < 2 * pair.last; ++i) {
		const Real sigma = a.state.sigma[i];
		if (sigma == 0) continue;
		const auto         frame = blocks::frameOf(a, i / 2);
		const blocks::Vec2 x = blocks::contactPosition(a, i), half = blocks::Vec2(frame.nx, frame.ny) * (std::abs(sigma) * bars / 2);
		glColor3d(sigma > 0 ? 0.85 : 0.1, 0.15, sigma > 0 ? 0.1 : 0.85);
		vertex(x - half), vertex(x + half);
	}
}

YADE_PLUGIN((Gl1_BlockGeom)(Gl1_JointPhys));

} // namespace yade
