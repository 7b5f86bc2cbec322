// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/step/RigidBlocks.hpp>
#include <blocks/views/BlockModel.hpp>

/// Rigid blocks as bodies that YADE's own engines move: what the block engines read from their State and write to it; and what other
/// engines must not do to blocks of any kind.
namespace yade {

/// Refuses a step in which blocks would not move as they should: two engines that move them; with rigid blocks ForceResetter, NewtonIntegrator
/// missing or out of order. Returns NewtonIntegrator, if there is one.
const Engine* requireMovers(const Scene*, const BlockModel&);

/// NewtonIntegrator.damping; refuses gravity there. Asks Python, so not to be done in every step.
Real newtonDamping(const Engine& newton);

/// blockedDOFs -> which motions are free; a change is a change of the stable step.
void noteFreedom(const Scene*, BlockModel&);

/// Prescribed velocities of bodies -> the model's rigid blocks, and which motions are free.
void readRigidMotion(const Scene*, BlockModel&);

/// Masses of the model -> state.mass and state.inertia, with what follows for the velocity.
void writeMasses(const Scene*, BlockModel&);

/// Forces of neighbours and loads -> O.forces.
void addRigidForces(Scene*, BlockModel&);

/// After NewtonIntegrator: grid points get the velocity that takes them where their body has gone.
blocks::StepWork followRigidBodies(Scene*, BlockModel&);

/// Puts bodies where the model's rigid blocks are, for a run that goes back to its last good state.
void restoreRigidBodies(const Scene*, const BlockModel&);

} // namespace yade
