// Phases in the cells of a mesh, drawn at random by the cells' global numbers: the same for any partition.
#pragma once

#include <functional>
#include <limits>
#include <random>

#include "mesh/mesh.hpp"
#include "solver/field.hpp"

namespace cobasis {

/// A fluid, a solid and the void.
inline constexpr int sample_phases = 3;

/// The owned cells, with `phases` of sample_phases; halo cells hold nothing that may be read.
inline Fields empty_fields(const Mesh& mesh, int phases = sample_phases) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  Fields fields;
  fields.dimension = mesh.dimension;
  fields.n_owned = mesh.n_owned, fields.n_all = mesh.n_all();
  const std::size_t n = mesh.n_all() + pack_width;
  fields.volume.assign(mesh.volume.begin(), mesh.volume.end());
  fields.volume.resize(n, 1);
  fields.pure.assign(n, -1);
  fields.phases.resize(phases);
  for (int k = 0; k < phases; ++k) {
    Phase& phase = fields.phases[k];
    phase.kind = k == 1 ? Kind::solid : Kind::fluid;
    phase.is_void = k == 2;
    phase.alpha.assign(n, unknown);
    const int n_cobasis = k != 1 ? 0 : mesh.dimension == 2 ? Plane::n_cobasis : Space::n_cobasis;
    if (!phase.is_void) phase.conserved.assign(2 + mesh.dimension + n_cobasis, AlignedVector<double>(n, unknown));
  }
  return fields;
}

/// Q of a phase: mass, momentum, energy per volume of the phase, cobasis.
inline double intensive(const Fields& fields, int k, int c, std::int32_t cell) {
  const Phase& phase = fields.phases[k];
  return phase.conserved[c][cell] / (c < fields.first_cobasis() ? phase.alpha[cell] : 1);
}

inline void set_intensive(Fields& fields, int k, int c, std::int32_t cell, double value) {
  Phase& phase = fields.phases[k];
  phase.conserved[c][cell] = value * (c < fields.first_cobasis() ? phase.alpha[cell] : 1);
}

/// Volume fractions of all sizes, among them negative ones where `negative` says so, and any states.
inline Fields random_fields(const Mesh& mesh, bool negative) {
  Fields fields = empty_fields(mesh);
  for (std::int32_t cell = 0; cell < mesh.n_owned; ++cell) {
    std::mt19937_64 random(mesh.global_id[cell]);
    const auto between = [&](double a, double b) {
      return a + (b - a) * static_cast<double>(random() >> 11) * 0x1p-53;
    };
    const double few[] = {0, 1e-14, 1e-9, 1e-5, 1e-3, 0.02, 0.1, 0.3, 0.45, 1, 1, 1};
    double small = few[random() % std::size(few)];
    if (negative && random() % 4 == 0 && small < 0.2) small = -small;
    const int most = static_cast<int>(random() % 3), less = (most + 1 + static_cast<int>(random() % 2)) % 3;
    for (int k = 0; k < sample_phases; ++k) fields.phases[k].alpha[cell] = 0;
    fields.phases[less].alpha[cell] = small;
    fields.phases[most].alpha[cell] = 1 - small;
    if (small == 0.3) fields.phases[most].alpha[cell] -= fields.phases[3 - most - less].alpha[cell] = 0.02;
    fields.complete(cell);
    for (int k = 0; k < sample_phases; ++k)
      for (int c = 0; c < fields.phases[k].n_conserved(); ++c)
        set_intensive(fields, k, c, cell, c == 0 ? between(1000, 3000) : between(-2, 3));
  }
  return fields;
}

/// Content of a component over the owned cells, and the sum of its magnitudes.
inline std::pair<double, double> content(const Fields& fields, int k, int c) {
  const Phase& phase = fields.phases[k];
  double sum = 0, scale = 0;
  for (std::int32_t cell = 0; cell < fields.n_owned; ++cell) {
    const double value =
        fields.volume[cell] * phase.conserved[c][cell] * (c < fields.first_cobasis() ? 1 : phase.alpha[cell]);
    sum += value, scale += std::fabs(value);
  }
  return {sum, scale};
}

}  // namespace cobasis
