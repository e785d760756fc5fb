// Two phases that are mixed in a cell: drag brings their velocities together, and they take volume from each other
// until their pressures are the same. Mass of each, momentum and energy of both together stay.
#pragma once

#include "solver/field.hpp"
#include "solver/setup.hpp"

namespace cobasis {

struct RelaxedPair {
  int l, m;
  Relaxation rates;
};

/// What the pair does to a cell in the time dt, first with its velocities, then with its pressures. Without effect
/// where one of both is absent; pressures stay as they are where a phase would have to expand tenfold, or one of them
/// is not admissible.
///
/// Velocities: alpha_l rho_l du_l/dt = K alpha_l alpha_m (u_m - u_l), for m the opposite; solved exactly. The force
/// works with the common velocity that both approach, (momentum of both) / (mass of both): each phase keeps as heat
/// what kinetic energy it loses in the frame of that velocity, which is never negative, and per kilogram at most half
/// the slip squared, however little there is of the phase.
///
/// Pressures: d alpha_l/dt = R alpha_l alpha_m (p_l - p_m), for m the opposite, p hydrodynamic: a solid changes its
/// volume, not its shape. The work is that of the pressure p_I at which both come to rest, sum of the volumes kept:
/// e^h + p_I / rho stays for each. On that path p_I does not change, so that the equilibrium is the same at any rate
/// and for any sequence of steps.
void relax(Fields& fields, const RelaxedPair& pair, std::int32_t cell, double dt);

}  // namespace cobasis
