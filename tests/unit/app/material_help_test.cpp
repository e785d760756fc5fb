#include "app/material_help.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "physics/material_library.hpp"

using namespace cobasis;
using Catch::Matchers::Contains;

TEST_CASE("the help on materials tells every constant of every material, its unit and its source") {
  const std::string help = describe_materials();
  for (const Material& material : material_library()) {
    CAPTURE(material.name);
    const auto at = help.find(fmt::format("\n{}: a ", material.name));
    REQUIRE(at != std::string::npos);
    const std::string entry = help.substr(at, help.find("\n\n", at) - at);
    const auto tells = [&](const auto& owner) {
      for (const auto& field : owner.fields()) {
        CHECK_THAT(entry, Contains(fmt::format("{} = {:g}", field.key, owner.*field.member)));
        if (field.unit != "-") CHECK_THAT(entry, Contains(fmt::format(" {}", field.unit)));
      }
    };
    std::visit(tells, material.eos);
    std::visit([&](const auto& eos) { CHECK_THAT(entry, Contains(fmt::format("type = \"{}\"", eos.name))); },
               material.eos);
    if (material.elastic) tells(*material.elastic);
    CHECK_THAT(entry, Contains(fmt::format("source: {}", material.source)));
  }
  CHECK_THAT(help, Contains("aluminium: a solid, 2700 kg/m^3 at rest, 6318 m/s, 3103 m/s"));  // see face_state_test
}
