// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/analysis/JointModes.hpp>
#include <blocks/kernel/analysis/LinearModel.hpp>
#include <blocks/kernel/analysis/SparseFactor.hpp>

/// The quasi-static path of the brittle model, exactly, from event to event.
///
/// **State.** Displacements u, load factor lambda, a mode and a history (slipPlastic, uplift) of every contact point (JointModes.hpp). With the stress
/// s_i = (sigma, tau) of point i in its mode, A_i its area and B_i = (n_i; t_i), equilibrium reads
///   load + lambda loadGrowth - zoneForce - zones u - zonesDriven lambda - sum A_i B_i^T (s_i + r e_i) - r q = 0.
/// e_i is the stress that a point still has to give away, q the unbalanced force at the start, both times r, which falls from 1 to 0.
///
/// **Admissible** is a state with r = 0 in which every intact point has sigma <= T and |tau| <= c - sigma tan phi, every closed broken one sigma <= T_res and
/// |tau| <= c_res - sigma tan phi_res, every open one un >= uplift, and every sliding one slips the way its friction resists.
///
/// **Between events** everything is linear: K du = f with the tangent K of the present modes, f = loadGrowth - zonesDriven - ... for d lambda = 1, or
/// f = sum A B^T e + q for dr = -1. A point that sticks or slides is symmetric or nearly so:
///   stick  A (kn n n^T + ks t t^T),     slide  A ke (c c^T - s (mu - psi) t c^T),  c = n - s psi t,
/// so K = S + U D V^T with a symmetric S, whose factors follow every event by changes of rank one or two, and as many columns t in U, c in V as points
/// slide with mu != psi. K^-1 f = S^-1 f - S^-1 U W V^T S^-1 f,  W = (1/D + G)^-1,  G = V^T S^-1 U. G and W follow every event by S^-1 B^T of its point.
///
/// The directions follow as well. With Z = K^-1 B^T and the change M of the point's springs, K' = K + B^T M B,
///   K'^-1 f = K^-1 f - Z (1 + M B Z)^-1 M B K^-1 f,
/// so an event costs one solution (two where something slides). Every `refreshAfter` events, and where little is left of a stiffness, directions are solved
/// anew, and what rounding has left unbalanced is put right.
///
/// **The next event** is the first along the direction over all points, ties by index; it may lie at once, so that the modes of points at a
/// limit suit the direction (a sliding point whose slip would reverse sticks; one that sticks at its limit slides). If a point changes too often in
/// one place, no direction is admissible, and the path ends. So it does where equilibrium or a strength is missed by more than `wrong`.
///
/// **Breaking.** What an intact point loses is e; it is given away by r: 1 -> 0 at constant lambda. If on the way another intact point reaches its strength,
/// lambda falls just enough to hold it there (the stiff machine's path, which includes snap-back; `Release::path`); it breaks in its turn once r = 0.
/// Where lambda cannot help, or if asked for (`Release::cascade`: what a machine that holds its displacement sees), it breaks there and then
/// and gives its stress away along with the others. In either case what springs lose at breaking, and the work of r e and r q, is energy
/// that dynamics would carry away ("excess").
///
/// **Loose blocks.** Where a point's springs go and something could then move without resistance, the blocks that could do so are tied to where they are by
/// soft springs, `anchorShare` of the stiffness they had, and reported.
namespace blocks {

enum class Release { path, cascade };

/// One point of the path, in equilibrium: where something broke, and where all of its stress had been given away.
struct PathPoint {
	Real       lambda       = 0;
	Real       force        = 0;  ///< of a driven group or the driven ones together; of a pushed one its force [N]
	Real       displacement = 0;  ///< in the direction of `force` [m]
	int        point        = -1; ///< the contact point that breaks here, or -1
	PointEvent how          = PointEvent::none;
	int        broken       = 0; ///< points that have broken so far
};

/// A contact point that broke, in the order of breaking.
struct PathCrack {
	int        point;
	PointEvent how;
	Real       lambda;
};

/// Energies since the start [J]: work = zones + joints + friction + excess + anchors.
struct PathEnergy {
	Real work = 0, zones = 0, joints = 0, friction = 0, excess = 0, anchors = 0;
	Real error() const { return work - zones - joints - friction - excess - anchors; }
};

struct EventLimits {
	Real share  = 0.1;  ///< of the shorter edge: slip and opening of a broken point, and closing of any, up to which small displacement holds
	int  pieces = 5000; ///< straight pieces from one point of the path to the next
	int  turns  = 8;    ///< how often a point may change its mode in one place
};

/// What a state is, without what can be computed from it.
struct PathState {
	Vector                 u;
	Real                   lambda = 0;
	std::vector<ModePoint> modes;
};

class EventPath {
public:
	static constexpr Real anchorShare  = 1e-7;
	static constexpr Real wrong        = 1e-8; ///< of the largest force at a contact point, or of a strength: far above rounding, far below what matters
	static constexpr int  refreshAfter = 32;

	/// Errors: std::runtime_error where blocks can move without resistance, with their names.
	EventPath(const LinearModel&, Release = Release::path, EventLimits = {});

	/// On to the next point of the path: where a point stands at its strength, about to break, and where what it lost is given away; or to lambda = `until`
	/// if that comes first. False, and `ended` says why, where the path ends.
	bool advance(Real until = std::numeric_limits<Real>::infinity());

	/// Gives the unbalanced force at the start away; part of advance(), for those who want to stop there.
	bool settle();

	const PathPoint&              now() const { return here; }
	const PathState&              state() const { return is; }
	PathEnergy                    energy() const;
	const std::vector<PathCrack>& cracks() const { return broken; }
	const std::string&            ended() const { return reason; }

	Real residual() const { return worstResidual; }         ///< largest unbalanced force by the largest force at a contact point, over all events
	Real inadmissible() const { return worstInadmissible; } ///< see inadmissibility(), over all equilibrium points of the path
	Real leastFriction() const { return lowestFriction; }   ///< the smallest increment of friction, by the turnover of work so far
	Real leastExcess() const { return lowestExcess; }       ///< the smallest sum of excess of one breaking, by the turnover of work so far
	long steps() const { return stepCount; }                ///< straight pieces so far, events without a distance included
	const std::vector<int>& looseBlocks() const { return loose; }
	Real                    anchorForce() const { return largestAnchor; } ///< largest force of an anchor of loose blocks so far [N]

	/// Displacement per load factor of the present state.
	const Vector& rate();

	/// Back (or on) to an admissible state of the same model.
	void restore(const PathState&);

	/// Work of what grows with the load factor, without that of constant loads [J].
	Real loadingWork() const { return grown; }

	/// K^-1 f of the present modes.
	Vector solve(const Vector& f);

private:
	struct Held {
		int        point;
		PointEvent what;
	};
	/// A motion of everything, and what it does to the contact points.
	struct Direction {
		Vector            u;
		std::vector<Real> n, t;
		bool              known = false;
	};
	enum class Phase { release, load };
	using Two     = Eigen::Matrix<Real, 2, 2>;
	using Columns = Eigen::Matrix<Real, Eigen::Dynamic, 2>;
	using Dense   = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

	// ---- EventPathStiffness.cpp: the tangent K
	void        factorise();
	void        change(int i, const ModePoint& next, const Stress& jump);
	void        followDirections(int i, const Two& by, const Stress& jump);
	void        followFactors(const LinearPoint&, const Two& delta);
	void        solvePoint(const LinearPoint&);
	static bool wellConditioned(const Two&);
	bool        anchor(const Vector& motion);
	void        solvePair(Vector& a, Vector& b);
	void        addTo(Vector& f, int i, Real byN, Real byT) const;
	void        spread(Direction&, Real lambda) const;

	// ---- EventPathFriction.cpp: G and W, by which sliding points are not symmetric
	void collectFriction();
	bool followFriction(const Two&);
	bool dropFriction(int i);
	bool addFriction(int i, const Two& own);
	void invertFriction();
	void withFriction(std::vector<Real>& x, const Columns&);

	// ---- EventPathEquilibrium.cpp: forces, and what the unknowns make of the contact points
	void   setUp();
	void   measure();
	Vector loadForce() const;
	Vector releaseForce() const;
	Vector residualForce();
	void   refresh();
	Real   imbalance();
	Real   reaction() const;

	// ---- EventPathAccounts.cpp: energies
	Real jointEnergy() const;
	void book(Real h, Real rBefore);

	// ---- EventPath.cpp: the path
	void chooseDirection(Phase);
	void holdBack();
	bool step(Phase, Real until);
	bool giveAway();
	void transition(int i, PointEvent);
	bool countTurn(int i);
	void breakPending();
	bool end(const std::string&);
	bool note(int point, PointEvent);
	bool small();

	const LinearModel& m;
	const Release      release;
	const EventLimits  limits;

	// ---- the state and what follows from it
	PathState           is;
	std::vector<Real>   un, us;
	std::vector<Stress> excess;    ///< e
	std::vector<int>    giving;    ///< points that have an e
	Vector              unbalance; ///< q
	bool                unbalanced = false;
	Real                r          = 0;
	bool                settling   = false;
	std::vector<int>    drivenPoints; ///< that feel the load factor directly
	Real                forceScale = 0;

	// ---- the direction: onLoad per load factor, onRelease per share given away; along is a sum of both
	Direction         onLoad, onRelease;
	Real              byLoad = 0, byRelease = 0;
	std::vector<Real> alongN, alongT;
	int               changes = 0; ///< since the directions were solved
	Real              still   = 0; ///< rates of opening and slip up to which there is no motion [m]
	std::vector<Held> held;
	int               breaksNow = -1;                   ///< a held point that cannot be held
	Held              pending { -1, PointEvent::none }; ///< a point that stands at its strength and breaks next

	// ---- the tangent
	std::unique_ptr<SparseFactor> factor;
	Vector                        diagonal; ///< of S at the start
	Vector                        anchorStiffness, anchorOrigin;
	std::vector<int>              slides; ///< points in U and V
	std::vector<Real>             frictionD;
	Dense                         g, w; ///< G and W
	int                           sinceInverted = 0;
	std::vector<Real>             pair, second, third;
	Columns                       vY, uY; ///< V^T and U^T times S^-1 B^T of the point that changes

	// ---- accounts
	std::vector<int>       turns, turned;
	PathPoint              here;
	PathEnergy             sum;
	std::string            reason;
	std::vector<int>       loose;
	std::vector<PathCrack> broken;
	Real                   worstResidual = 0, worstInadmissible = 0, lowestFriction = 0, lowestExcess = 0, largestAnchor = 0, excessAtStart = 0;
	Real                   grown = 0, turnover = 0, jointsAtStart = 0;
	long                   stepCount = 0, notedAt = 0;
};

} // namespace blocks
