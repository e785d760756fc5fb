// What a run tells of fragments that have a volume and no state.
#include <catch2/catch.hpp>

#include "small_scene.hpp"

using namespace cobasis;

namespace {

/// Gives a cell without the phase a fragment of it, spoilt, with what the kernel makes of that.
std::int32_t add_fragment(SmallScene& scene, int k, double mass, double e3) {
  Fields& fields = const_cast<Fields&>(scene.solver->fields());
  Phase& phase = fields.phases[k];
  std::int32_t cell = 0;
  while (phase.alpha[cell] != 0) ++cell;
  phase.alpha[cell] = 1e-6;
  phase.conserved[0][cell] = mass;
  phase.conserved[1][cell] = 1e-3, phase.conserved[2][cell] = 0, phase.conserved[3][cell] = 1;
  if (phase.kind == Kind::solid) {
    for (int c = fields.first_cobasis(); c < phase.n_conserved(); ++c)
      phase.conserved[c][cell] = identity_cobasis(2, c - fields.first_cobasis());
    phase.conserved[fields.first_cobasis() + 4][cell] = e3;
  }
  CellList one(pack_width);
  one.push(cell);
  one.fill(pack_width);
  BadCells bad;
  scene.solver->kernels(k).primitives(phase, one, 1, bad);
  CHECK(bad == BadCells{cell});
  return cell;
}

double value(const std::vector<Column>& columns, const std::string& name) {
  for (const Column& column : columns)
    if (column.name == name) return column.value;
  throw std::runtime_error("no column " + name);
}

}  // namespace

TEST_CASE("a volume without mass has neither velocity nor energy, in totals and in snapshots") {
  for (const double mass : {0.0, -1e-9, std::numeric_limits<double>::quiet_NaN()}) {
    for (const std::string material : {"copper", "water"}) {
      SmallScene scene = small_scene(busy_setup({"air", material}, true), small_mesh(CellType::quadrilateral, 9));
      const std::vector<Column> before = scene.solver->totals();
      const std::int32_t cell = add_fragment(scene, 1, mass, 1);
      const std::vector<Column> after = scene.solver->totals();
      CAPTURE(mass, material);
      CHECK(value(before, "kinetic." + material) > 0);
      CHECK(value(after, "kinetic." + material) == value(before, "kinetic." + material));
      if (material == "copper") CHECK(value(after, "elastic.copper") == value(before, "elastic.copper"));
      const PhaseSnapshot phase = scene.solver->snapshot().phases[1];
      CHECK(phase.alpha[cell] == 1e-6);
      for (const double number : {phase.density[cell], phase.velocity[0][cell], phase.pressure[cell],
                                  phase.stress[0][cell], phase.energy[cell]})
        CHECK(number == 0);
    }
  }
}

TEST_CASE("a fragment whose cobasis is no deformation has kinetic energy, but neither elastic energy nor stress") {
  for (const double e3 : {0.0, -1.0}) {
    SmallScene scene = small_scene(busy_setup({"air", "copper"}, true), small_mesh(CellType::quadrilateral, 9));
    const std::vector<Column> before = scene.solver->totals();
    const std::int32_t cell = add_fragment(scene, 1, 1e-6, e3);
    const std::vector<Column> after = scene.solver->totals();
    CAPTURE(e3);
    CHECK(value(after, "elastic.copper") == value(before, "elastic.copper"));
    const double u = 1e-3 / 1e-6, mass = 1e-6 * scene.mesh->volume[cell];
    CHECK(value(after, "kinetic.copper") == Approx(value(before, "kinetic.copper") + 0.5 * mass * u * u));
    const PhaseSnapshot copper = scene.solver->snapshot().phases[1];
    for (const auto& component : copper.stress) CHECK(component[cell] == 0);
  }
}
