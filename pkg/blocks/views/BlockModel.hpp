// yade-blocks, GPL-2.0-or-later
#pragma once
#include <atomic>
#include <blocks/views/AssemblyArchive.hpp>
#include <blocks/views/JointMat.hpp>
#include <core/Scene.hpp>
#include <core/Shape.hpp>
#include <lib/serialization/Serializable.hpp>
#include <mutex>
#include <pkg/common/ElastMat.hpp>

namespace yade {

class BlockModel;

/// The model's methods and arrays as Python sees them; the definitions stand in `python/`, a part a file.
struct BlockModelPython : py::def_visitor<BlockModelPython> {
	void visit(py::class_<BlockModel, shared_ptr<BlockModel>, py::bases<Serializable>, boost::noncopyable>&) const;
};

/// Owner of the scene's one assembly: builds it, shows it to Python, is saved with it.
class BlockModel : public Serializable {
public:
	/// A number that no model had before, whenever something changed on which masses or the time step depend.
	long stiffnessVersion() const { return version; }
	void stiffnessChanged() { version = ++lastVersion; }

	/// The stiffness of zones has changed.
	void zonesChanged() { zoneStiffness.clear(), stiffnessChanged(); }

	virtual ~BlockModel();
	void postLoad(BlockModel&);

	/// Stiffness that each grid point feels, as it is now [N/m]; see nodalStiffness.
	const vector<Real>& stiffness();

	/// The step at which the forces were computed.
	long forcesAt = -1;

	/// Version of the contacts that O.interactions shows.
	long shownContacts = 0;
	/// Blocks of the contacts that it shows, by the contacts' places in the state; { -1, -1 }: none.
	vector<std::array<int, 2>> shownBlocks;

	/// Damping of the NewtonIntegrator that moves rigid blocks, as the engines know it [-].
	Real newtonDamping = 0;

	/// The scene's model, or an error that says how one gets there.
	static const shared_ptr<BlockModel>& of(const Scene*);

	/// InteractionLoop cannot let an exception out of its threads: functors complain here and the next engine throws it.
	void complain(const std::string& sentence);
	void throwComplaint();

	/// A material of O.materials, by its label; its index in the assembly.
	int materialIndex(const std::string& label);
	/// The label of a block's material.
	const std::string& labelOf(int block) const { return materialLabels[assembly.mesh.blockMaterial[block]]; }

	/// Whether this is the scene's model; no search.
	bool isIn(const Scene*) const;

	/// Finds the joints and gives them their properties, unless the list is empty; the number of pairs.
	int bond(const vector<shared_ptr<JointMat>>&, Real tolerance);

	/// Properties of a pair's joints, and whether they are whole; several threads may do this for different pairs, with joints that do not soften.
	void setJoint(int pair, const JointMat&, const vector<shared_ptr<JointMat>>& all = {}); // all: those that other pairs will be given

	/// What is missing where two blocks touch without a bond and no JointMat says how; empty if nothing is.
	string withoutJoint(int contact) const;

	/// Refuses joints without properties.
	void requireProperties();

	/// Refuses a scene from which blocks have been erased.
	void requireBodies(const Scene*, int threads) const;

	/// Centroids of deformable blocks -> state.pos of their bodies, for engines of YADE that look there; Python asks BlockState.
	void writeCentroids(Scene*, int threads);

	/// One Body per block and one Interaction per pair, into the present scene.
	void insert(bool interactions);

	/// Refuses a region that overlaps one that was added before.
	void requireFree(const blocks::Polygon&) const;
	/// Takes note of a region that was added.
	void claim(const blocks::Polygon& region) { regions.push_back(region); }

	/// Refuses changes of what was already handed over to the scene.
	void requireOpen(const char* what) const;

	blocks::MotionGroup& group(const std::string& name);

	/// Body of a block, or an error if the model is not in a scene yet or has no such block.
	int bodyOf(int block) const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(BlockModel, Serializable,
		"All blocks of a scene in flat arrays: grid points, zones, boundary edges, joints. Build it once (materials, "
		":yref:`addVoronoi<BlockModel.addVoronoi>`, "
		":yref:`addRegion<BlockModel.addRegion>`, :yref:`addRigid<BlockModel.addRigid>`, :yref:`bond<BlockModel.bond>`, boundary conditions, "
		":yref:`insert<BlockModel.insert>`), then let the engines work on it. "
		"SI units, tension positive. Once inserted, arrays are numpy views of the model's own memory: reading costs no copy; displacement and velocity "
		"may be written.",
		((Real, thickness, 1, Attr::triggerPostLoad, "Out-of-plane thickness [m]; to be set before the first block."))
		((bool, planeStress, false, Attr::triggerPostLoad, "Plane stress instead of plane strain."))
		((bool, smallStrain, false, Attr::triggerPostLoad, "Small-strain zones: cheaper, only for scenes in which no block turns by more than about "
			"1e-3."))
		((vector<string>, materialLabels, , Attr::readonly, "Labels of the materials, in the order of "
			":yref:`blockMaterial<BlockModel.blockMaterial>`."))
		((int, firstBody, -1, Attr::readonly, "Body id of block 0; block i is body firstBody + i."))
		((bool, showsInteractions, true, Attr::readonly, "Whether pairs and contacts are shown in ``O.interactions``; see "
			":yref:`insert<BlockModel.insert>`."))
		((vector<shared_ptr<JointMat>>, jointMats, , Attr::hidden, "What bond() was given: properties of the joints between two materials."))
		((blocks::BlockAssembly, assembly, , Attr::hidden, "The arrays."))
		,
		/*ctor*/,
		/*py*/
		.def(BlockModelPython())
	);
	// clang-format on

private:
	/// Of joints [first, last).
	void setJoints(int first, int last, const JointMat&);

	std::vector<blocks::Polygon> regions;

	vector<Real> knownStiffness, zoneStiffness;
	long         knownVersion = 0;

	static std::atomic<long> lastVersion;
	std::atomic<long>        version { ++lastVersion };

	long propertiesKnown = 0; ///< version at which all joints had properties

	std::mutex  complaintMutex;
	std::string complaint;
};
REGISTER_SERIALIZABLE(BlockModel);

} // namespace yade
