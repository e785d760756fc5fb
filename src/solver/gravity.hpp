// Gravity: all phases gain the same velocity, half of it before the sweeps of a step and half after them. What is
// between is the step of a frame that falls along, so that free fall is exact with every scheme.
#pragma once

#include "math/vec3.hpp"
#include "solver/field.hpp"

namespace cobasis {

/// Owned cells gain the velocity `gain` [m/s] in their conserved quantities, and the kinetic energy that goes with it:
/// internal energy stays.
void accelerate(Fields& fields, const Point& gain);

}  // namespace cobasis
