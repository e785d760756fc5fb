#include <catch2/catch.hpp>
#include <limits>

#include "small_scene.hpp"

using namespace cobasis;

namespace {

struct BusyScene {
  const char* name;
  std::vector<std::string> materials;
  Contact contact = Contact::sliding;
};

const std::vector<BusyScene> scenes = {
    {"solid", {"copper"}},
    {"fluid", {"water"}},
    {"solid and fluid", {"copper", "water"}},
    {"fluid and solid", {"water", "aluminium"}},
    {"two fluids, one an ideal gas", {"water", "air"}},
    {"sliding solids", {"copper", "aluminium"}},
    {"adhering solids", {"copper", "aluminium"}, Contact::adherence},
    {"solids that rub", {"copper", "aluminium"}, {Contact::friction, 0.2}},
    {"solid and void", {"copper", "void"}},
    {"void and solid", {"void", "aluminium"}},
    {"fluid and void", {"void", "water"}},
    {"all kinds", {"copper", "water", "aluminium", "void"}, Contact::adherence},
};

constexpr auto diffuse = InterfaceTreatment::diffuse, sharp_planes = InterfaceTreatment::sharp;
const std::vector<Scheme> schemes = {{.order = 1, .interface = diffuse},
                                     {.order = 2, .interface = diffuse},
                                     {.order = 2, .interface = diffuse, .limited = false},
                                     {.order = 1, .interface = sharp_planes},
                                     {.order = 2, .interface = sharp_planes}};

}  // namespace

TEST_CASE("packs of cells and faces give what one at a time gives") {
  const Scheme scheme = GENERATE(from_range(schemes));
  for (const auto& [type, round] : std::initializer_list<std::pair<CellType, bool>>{{CellType::quadrilateral, false},
                                                                                    {CellType::triangle, false},
                                                                                    {CellType::quadrilateral, true},
                                                                                    {CellType::triangle, true},
                                                                                    {CellType::hexahedron, false},
                                                                                    {CellType::tetrahedron, false}}) {
    const bool plane = type == CellType::quadrilateral || type == CellType::triangle;
    for (const BusyScene& scene : scenes) {
      for (const double mixed_in : {0.0, 1e-6}) {
        const bool several = scene.materials.size() > 1, sharp = scheme.interface == InterfaceTreatment::sharp;
        if ((mixed_in > 0 && (!several || sharp)) || (sharp && !several) || (several && !scheme.limited)) continue;
        Setup setup = busy_setup(scene.materials, plane, scene.contact, mixed_in);
        setup.alpha_min = mixed_in;
        setup.scheme = scheme;
        if (round) {
          setup.scene = Geometry::axisymmetric;
          setup.boundaries.push_back({"bottom", AxisOfSymmetry{}, "busy:5"});
        }
        const int n = plane ? 11 : type == CellType::hexahedron ? 5 : 4;
        SolverOptions one_at_a_time;
        one_at_a_time.scalar = true;
        SmallScene packs = small_scene(setup, small_mesh(type, n, 0.2, round));
        SmallScene scalar = small_scene(setup, small_mesh(type, n, 0.2, round), one_at_a_time);
        CAPTURE(shape_of(type).name, round, scene.name, mixed_in, scheme.order, sharp);
        double dt = 0, same = 0;
        const int steps = scheme.limited && !sharp ? 3 : 1;  // the bodies are not at peace
        for (int step = 0; step < steps; ++step) {
          dt = packs.solver->advance(1);
          same = scalar.solver->advance(1);
        }
        CHECK(dt > 0);
        CHECK(same == Approx(dt).epsilon(1e-14));
        CHECK(largest_difference(packs.solver->fields(), scalar.solver->fields()) < 1e-14);
      }
    }
  }
}

TEST_CASE("a step does not depend on which tangents the faces have") {
  std::mt19937 random(1);
  for (const CellType type : {CellType::hexahedron, CellType::tetrahedron}) {
    for (const BusyScene& scene : scenes) {
      const Setup setup = busy_setup(scene.materials, false, scene.contact);
      const int n = type == CellType::hexahedron ? 5 : 4;
      Mesh turned = small_mesh(type, n);
      for (std::int32_t f = 0; f < turned.n_faces(); ++f) {
        const double angle = std::uniform_real_distribution<double>(0, 6.283)(random);
        const Point normal{turned.nx[f], turned.ny[f], turned.nz[f]}, t1{turned.tx[f], turned.ty[f], turned.tz[f]};
        const Point t = std::cos(angle) * t1 + std::sin(angle) * cross(normal, t1);
        turned.tx[f] = t.x, turned.ty[f] = t.y, turned.tz[f] = t.z;
      }
      SmallScene one = small_scene(setup, small_mesh(type, n)), other = small_scene(setup, std::move(turned));
      CAPTURE(shape_of(type).name, scene.name);
      const double dt = one.solver->advance(1);
      CHECK(other.solver->advance(1) == Approx(dt).epsilon(1e-13));
      CHECK(largest_difference(one.solver->fields(), other.solver->fields()) < 1e-12);
    }
  }
}

TEST_CASE("a step does not depend on the orientation of the faces") {
  // so that a material left of a void does what it does right of it
  for (const CellType type : {CellType::quadrilateral, CellType::hexahedron}) {
    const bool plane = type == CellType::quadrilateral;
    for (const BusyScene& scene : scenes) {
      const Setup setup = busy_setup(scene.materials, plane, scene.contact);
      Mesh turned = small_mesh(type, plane ? 11 : 5);
      for (std::int32_t f = 0; f < turned.n_interior_faces; f += 2) {
        std::swap(turned.left[f], turned.right[f]);
        for (auto* component : {&turned.nx, &turned.ny, &turned.nz}) (*component)[f] = -(*component)[f];
        if (plane) turned.tx[f] = -turned.tx[f], turned.ty[f] = -turned.ty[f];
      }
      for (std::int32_t& entry : turned.cell_faces)
        if (entry >= 0 && entry / 2 < turned.n_interior_faces && entry / 2 % 2 == 0) entry ^= 1;
      SmallScene one = small_scene(setup, small_mesh(type, plane ? 11 : 5)),
                 other = small_scene(setup, std::move(turned));
      CAPTURE(shape_of(type).name, scene.name);
      const double dt = one.solver->advance(1);
      CHECK(other.solver->advance(1) == Approx(dt).epsilon(1e-12));
      CHECK(largest_difference(one.solver->fields(), other.solver->fields()) < 1e-12);
    }
  }
}

TEST_CASE("a step conserves the mass of each phase, and with walls the energy of all") {
  for (const CellType type : {CellType::triangle, CellType::tetrahedron}) {
    const bool plane = type == CellType::triangle;
    for (const BusyScene& scene : scenes) {
      Setup setup = busy_setup(scene.materials, plane, scene.contact);
      setup.boundaries = {{"*", Wall{}, "walls:1"}};
      SmallScene walled = small_scene(setup, small_mesh(type, plane ? 11 : 4));
      const auto totals = [&] {
        std::map<std::string, double> sums;
        for (const Column& column : walled.solver->totals()) {
          const std::string kind = column.name.substr(0, column.name.find('.'));
          if (kind == "mass") sums[column.name] = column.value;
          if (kind == "energy") sums["energy"] += column.value;
          if (kind == "volume") sums["volume"] += column.value;
          // the void does the work of its constant pressure
          if (column.name == "volume.void") sums["energy"] -= 1e5 * column.value;
        }
        return sums;
      };
      const auto before = totals();
      for (int step = 0; step < 5; ++step) walled.solver->advance(1);
      CAPTURE(shape_of(type).name, scene.name);
      for (const auto& [name, value] : totals()) {
        CAPTURE(name);
        CHECK(value == Approx(before.at(name)).epsilon(1e-13));
      }
    }
  }
}

TEST_CASE("what the arrays hold of a phase where it is absent is not felt") {
  // the velocity of dust, for example, that lost its mass before it went
  for (const Scheme& scheme : schemes) {
    for (const BusyScene& scene : scenes) {
      if (scene.materials.size() == 1 || !scheme.limited) continue;
      Setup setup = busy_setup(scene.materials, true, scene.contact);
      setup.scheme = scheme;
      SmallScene clean = small_scene(setup, small_mesh(CellType::triangle, 11)),
                 littered = small_scene(setup, small_mesh(CellType::triangle, 11));
      auto& phases = const_cast<Fields&>(littered.solver->fields()).phases;
      for (Phase& phase : phases)
        for (std::int32_t cell = 0; cell < littered.mesh->n_owned; ++cell)
          if (phase.alpha[cell] == 0)
            for (auto& component : phase.primitive) component[cell] = std::numeric_limits<double>::quiet_NaN();
      CAPTURE(scene.name, scheme.order, scheme.interface == sharp_planes);
      CHECK(littered.solver->advance(1) == clean.solver->advance(1));
      CHECK(largest_difference(littered.solver->fields(), clean.solver->fields()) == 0);
    }
  }
}

TEST_CASE("as many phases meet as a case may have") {
  constexpr int most = 31;
  const char* const materials[] = {"copper", "water", "aluminium", "air"};
  std::vector<std::string> phases;
  for (int k = 0; k < most; ++k) phases.push_back(materials[k % 4]);
  for (const InterfaceTreatment interface : {diffuse, InterfaceTreatment::compressed, sharp_planes}) {
    Setup setup = busy_setup(phases, true);
    setup.scheme = {.order = 2, .interface = interface};
    setup.boundaries = {{"*", Wall{}, "walls:1"}};
    SmallScene scene = small_scene(setup, small_mesh(CellType::triangle, 11));
    const auto all = [&](const std::string& kind) {
      double sum = 0;
      for (const Column& column : scene.solver->totals())
        if (column.name.starts_with(kind)) sum += column.value;
      return sum;
    };
    const double mass = all("mass."), energy = all("energy.");
    for (int step = 0; step < 3; ++step) scene.solver->advance(1);
    CAPTURE(static_cast<int>(interface));
    CHECK(all("mass.") == Approx(mass).epsilon(1e-13));
    CHECK(all("energy.") == Approx(energy).epsilon(1e-13));
  }
}
