#include "solver/relaxation.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace cobasis;

TEST_CASE("a trace relaxes in a moment, also where its pressure at rest is round-off") {
  // Of traces so small that their volume does not show in the other's, what a substep should be is round-off: such a
  // one asked for 3e14 substeps.
  Fields fields;
  fields.dimension = 2;
  fields.n_owned = fields.n_all = 1;
  fields.volume.assign(1 + pack_width, 1);
  fields.pure.assign(1 + pack_width, -1);
  fields.phases.resize(2);
  const StiffenedGas metal{.gamma = 3.4, .p_inf = 2.15e10}, jelly{.gamma = 2.2, .p_inf = 1e6};
  fields.phases[0].eos = metal, fields.phases[1].eos = jelly;
  for (Phase& phase : fields.phases) {
    phase.alpha.assign(1 + pack_width, 0);
    phase.conserved.assign(4, AlignedVector<double>(1 + pack_width, 0));
  }
  const double of_trace = GENERATE(1e-9, 1e-15, 1e-21, 2.3909909193425222e-27), p = GENERATE(-1e6, 1e6, 6.618e6);
  const double rate = GENERATE(1e-6, 1e-3, 1e3);
  CAPTURE(of_trace, p, rate);
  const auto fill = [&](int k, double alpha, double rho, double energy) {
    fields.phases[k].alpha[0] = alpha;
    fields.phases[k].conserved[0][0] = alpha * rho;
    fields.phases[k].conserved[3][0] = alpha * rho * energy;
  };
  fill(0, of_trace, 2700, metal.energy(2700.0, p));
  fill(1, 1 - of_trace, 1010, jelly.energy(1010.0, 147941.0));
  const double energy = fields.phases[0].conserved[3][0] + fields.phases[1].conserved[3][0];
  for (int step = 0; step < 3; ++step) relax(fields, {0, 1, {.velocity = 0, .pressure = rate}}, 0, 4e-6);
  CHECK(fields.phases[0].conserved[3][0] + fields.phases[1].conserved[3][0] == Approx(energy).epsilon(1e-14));
  CHECK(fields.phases[0].alpha[0] == Approx(of_trace).epsilon(1e-3));  // the metal is stiff
  CHECK(fields.phases[1].alpha[0] == Approx(1 - of_trace).epsilon(1e-9));
}
