// What a plane, an axisymmetric or a space scene cannot hold.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/case.hpp"
#include "app/case_parts.hpp"
#include "math/errors.hpp"

namespace cobasis {
namespace {

class GeometryCheck {
 public:
  GeometryCheck(const Setup& setup, Geometry geometry)
      : setup_(setup), geometry_(geometry), plane_(geometry != Geometry::space) {}

  std::vector<std::string> mistakes() {
    for (const RegionSetup& region : setup_.regions) {
      where_ = region.where + ": ";
      std::visit([this](const auto& shape) { check(shape); }, region.shape);
      check(region.filling);
    }
    for (const BoundarySetup& boundary : setup_.boundaries) {
      where_ = boundary.where + ": ";
      if (const auto* inflow = std::get_if<Inflow>(&boundary.boundary)) check(inflow->filling);
      if (const auto* wall = std::get_if<Wall>(&boundary.boundary); wall && wall->velocity)
        check_velocity(*wall->velocity, fmt::format("boundary \"{}\"", boundary.group));
      if (const auto* wall = std::get_if<NoSlip>(&boundary.boundary))
        check_velocity(wall->velocity, fmt::format("boundary \"{}\"", boundary.group));
      if (std::holds_alternative<AxisOfSymmetry>(boundary.boundary) && geometry_ != Geometry::axisymmetric)
        add(
            fmt::format("boundary \"{}\" = \"axis\" in {} scene; allowed: wall, no_slip, symmetry, "
                        "transmissive, outlet, inflow, periodic, or scene = \"axisymmetric\"",
                        boundary.group, scene()));
    }
    where_ = setup_.case_file + ": ";
    check(setup_.gravity, "gravity");
    if (geometry_ == Geometry::axisymmetric && setup_.gravity.y != 0)
      add(fmt::format("gravity = [{}, {}] in an axisymmetric scene; allowed: second number 0, along the axis",
                      setup_.gravity.x, setup_.gravity.y));
    for (const LineSetup& line : setup_.lines) {
      check(line.from, fmt::format("line \"{}\": from", line.name));
      check(line.to, fmt::format("line \"{}\": to", line.name));
    }
    for (const ProbeSetup& probe : setup_.probes) check(probe.at, fmt::format("probe \"{}\": at", probe.name));
    for (const SliceSetup& slice : setup_.slices) {
      where_ = slice.where + ": ";
      check(slice.point, fmt::format("slice \"{}\": point", slice.name));
      check(slice.normal, fmt::format("slice \"{}\": normal", slice.name));
    }
    where_ = setup_.case_file + ": ";
    for (const IntegralSetup& integral : setup_.integrals) {
      if (const auto* mean = std::get_if<Mean>(&integral.what)) {
        where_ = mean->where + ": ";
        std::visit([this](const auto& shape) { check(shape); }, mean->region);
        where_ = setup_.case_file + ": ";
        continue;
      }
      const auto* extent = std::get_if<Extent>(&integral.what);
      const Axis axis = extent ? extent->axis : std::get<Quantile>(integral.what).axis;
      if (plane_ && axis == Axis::z)
        add(fmt::format("integral \"{}\": axis = \"z\" in {} scene; allowed: x, y, radial", integral.name, scene()));
      if (extent && extent->box) {
        where_ = extent->where + ": ";
        check(*extent->box);
        where_ = setup_.case_file + ": ";
      }
    }
    return mistakes_;
  }

 private:
  std::string scene() const {
    return fmt::format("{} {}", geometry_ == Geometry::axisymmetric ? "an" : "a", name_of(geometry_));
  }
  void add(const std::string& text) { mistakes_.push_back(where_ + text); }

  void check(const Point& x, const std::string& what) {
    if (plane_ && x.z != 0)
      add(fmt::format("{} = [{}, {}, {}] in {} scene; allowed: third number 0 or none", what, x.x, x.y, x.z, scene()));
  }

  void check_velocity(const std::array<Expression, 3>& velocity, const std::string& of) {
    const Expression& w = velocity[2];
    if (plane_ && (!w.is_constant() || w.constant() != 0))
      add(fmt::format("velocity of {} has a third component in {} scene; allowed: 2 components, or 0", of, scene()));
  }

  void check(const Everywhere&) {}
  void check(const PhysicalGroup&) {}
  void check(const Inside&) {}
  void check(const HalfSpace& half) {
    check(half.point, "point");
    check(half.normal, "normal");
  }
  void check(const Box& box) {
    if (plane_ && !(box.low.z <= 0 && 0 <= box.high.z))
      add(
          fmt::format("box beside the plane z = 0 in {} scene; allowed: 2 numbers in low and high, or z from below to "
                      "above 0",
                      scene()));
    if (!plane_ && !(box.low.z < box.high.z))
      add("box of no height in z in a space scene; allowed: 3 numbers in low and high, low < high");
  }
  void check(const Sphere& sphere) { check(sphere.center, "center"); }
  void check(const Cylinder&) {
    if (plane_)
      add(
          fmt::format("shape = \"cylinder\" in {} scene; allowed: everywhere, half_space, box, sphere (a disc), "
                      "physical_group, expression",
                      scene()));
  }

  void check(const Filling& filling) {
    for (std::size_t k = 0; plane_ && k < filling.states.size(); ++k) {
      if (filling.alpha[k] == 0) continue;
      const PhaseState& state = filling.states[k];
      check_velocity(state.velocity, fmt::format("phase \"{}\"", setup_.phases[k].name));
      if (!state.cobasis) continue;
      const auto& e = *state.cobasis;
      if (e[2][0] != 0 || e[2][1] != 0 || e[0][2] != 0 || e[1][2] != 0)
        add(
            fmt::format("cobasis of phase \"{}\" shears out of the plane in {} scene; allowed: "
                        "[[a1, a2, 0], [b1, b2, 0], [0, 0, c3]]",
                        setup_.phases[k].name, scene()));
    }
  }

  const Setup& setup_;
  Geometry geometry_;
  bool plane_;  ///< of two dimensions
  std::string where_;
  std::vector<std::string> mistakes_;
};

}  // namespace

std::vector<std::string> mistakes_in_geometry(const Setup& setup, Geometry geometry) {
  return GeometryCheck(setup, geometry).mistakes();
}

void check_for_geometry(const Setup& setup, Geometry geometry) {
  const auto mistakes = mistakes_in_geometry(setup, geometry);
  if (!mistakes.empty()) throw InputError(fmt::format("{}", fmt::join(mistakes, "\n")));
}

}  // namespace cobasis
