// Scenes in which steps fail at first: velocities that differ from cell to cell by much more than the speed of sound.
#pragma once

#include "scene.hpp"

namespace cobasis::test {

/// Second order in a periodic square of triangles (`element` = 3) or squares (4), every phase with these velocities.
inline std::string hypersonic(int element, const std::string& speed, const std::string& phases,
                              const std::string& first, const std::string& second = "") {
  const std::string moving =
      "pressure = 1e5\nvelocity = [\"" + speed + "*sin(700*x+500*y)\", \"" + speed + "*cos(400*x-900*y)\"]\nfill = ";
  const std::string disc = "[[region]]\nshape = \"sphere\"\ncenter = [0.45, 0.5]\nradius = 0.3\n";
  return second_order + "mesh = \"@box.geo\"\nmesh_parameters = { n = 20, element = " + std::to_string(element) +
         " }\nend_time = 1\n" + phases + "[[region]]\nshape = \"everywhere\"\n" +
         (first == "surroundings" ? "fill = " : moving) + "\"" + first + "\"\n" +
         (second.empty() ? "" : disc + moving + "\"" + second + "\"\n") +
         "[boundary]\nleft = { type = \"periodic\", with = \"right\" }\n"
         "bottom = { type = \"periodic\", with = \"top\" }\n";
}
inline std::string hypersonic_gas(int element) {
  return hypersonic(element, "1e4", "[phase.air]\nmaterial = \"air\"\n", "air");
}
inline std::string hypersonic_solid(int element) {
  return hypersonic(element, "1e5", "[phase.aluminium]\nmaterial = \"aluminium\"\n", "aluminium");
}
inline std::string hypersonic_solids(int element) {
  return hypersonic(element, "1e5",
                    "[phase.aluminium]\nmaterial = \"aluminium\"\n[phase.copper]\nmaterial = \"copper\"\n", "copper",
                    "aluminium");
}
inline std::string hypersonic_solid_in_void(int element) {
  return hypersonic(element, "1e4",
                    "[phase.aluminium]\nmaterial = \"aluminium\"\n[phase.surroundings]\nvoid = { pressure = 1e5 }\n",
                    "surroundings", "aluminium");
}
inline std::string hypersonic_solid_in_water(int element) {
  return hypersonic(element, "3e4",
                    "[phase.aluminium]\nmaterial = \"aluminium\"\n[phase.water]\nmaterial = \"water\"\n", "water",
                    "aluminium");
}

}  // namespace cobasis::test
