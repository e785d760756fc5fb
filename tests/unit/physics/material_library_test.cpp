#include "physics/material_library.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

using namespace cobasis;

TEST_CASE("the materials of the paper's Table 3 carry its numbers") {
  struct Row {
    const char* name;
    double gamma, p_inf, mu, rho0, a;
  };
  for (const Row& row : {Row{"aluminium", 3.4, 21.5e9, 26e9, 2700, 0.5}, Row{"copper", 4.2, 34.2e9, 92e9, 8900, 0.5},
                         Row{"carbopol", 2.2, 1e6, 85, 1020, 0}}) {
    INFO(row.name);
    const Material* material = find_material(row.name);
    REQUIRE(material != nullptr);
    const StiffenedGas eos = std::get<StiffenedGas>(material->eos);
    CHECK(eos.gamma == row.gamma);
    CHECK(eos.p_inf == row.p_inf);
    REQUIRE(material->elastic);
    CHECK(material->elastic->mu == row.mu);
    CHECK(material->elastic->rho0 == row.rho0);
    CHECK(material->elastic->a == row.a);
    CHECK(material->rho0 == row.rho0);
  }
  const Material* air = find_material("air");
  REQUIRE(air != nullptr);
  CHECK(std::get<IdealGas>(air->eos).gamma == 1.4);
  CHECK_FALSE(air->elastic);
  CHECK(air->rho0 == 1.19);
}

TEST_CASE("sound travels in the fluids of the library as fast as measured at room conditions") {
  struct Row {
    const char* name;
    double sound_speed;  // [m/s], handbook values at 20 C
    double tolerance;    // stiffened gas of water: fitted to shocks, 8 % above
  };
  for (const Row& row : {Row{"air", 343.2, 0.01}, Row{"nitrogen", 349, 0.01}, Row{"argon", 319, 0.01},
                         Row{"helium", 1007, 0.01}, Row{"water", 1482, 0.10}}) {
    INFO(row.name);
    const Material* material = find_material(row.name);
    REQUIRE(material != nullptr);
    const double c2 =
        std::visit([&](const auto& eos) { return eos.sound_speed_squared(material->rho0, 101325.0); }, material->eos);
    CHECK(std::sqrt(c2) == Approx(row.sound_speed).epsilon(row.tolerance));
  }
}

TEST_CASE("names are unique, sources are given, and elastic and rest densities agree") {
  std::set<std::string_view> names;
  for (const Material& material : material_library()) {
    INFO(material.name);
    CHECK(names.insert(material.name).second);
    CHECK_FALSE(material.source.empty());
    CHECK(material.rho0 > 0);
    if (material.elastic) CHECK(material.elastic->rho0 == material.rho0);
  }
  CHECK(find_material("unobtainium") == nullptr);
}
