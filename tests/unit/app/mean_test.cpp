// The mean of a field over a region.
#include <catch2/catch.hpp>
#include <cmath>

#include "app/integrals.hpp"
#include "app/output.hpp"
#include "case_file.hpp"
#include "output_scene.hpp"

using namespace cobasis;
using namespace cobasis::test;
using Catch::Matchers::Contains;

namespace {

double mean(const Mesh& mesh, const Snapshot& snapshot, const std::string& field, const Shape& region) {
  const Setup setup = three_phases("unused");
  const IntegralSetup integral{"value", Mean{field, region, "case.toml:7"}, "Pa"};
  return Integrals({integral}, Geometry::plane, mesh, world(), setup.phases).evaluate(snapshot).at(0);
}

std::string with_mean(const std::string& what) {
  return rest + "[[integral]]\nname = \"a\"\nmean = { " + what + " }\n";
}

}  // namespace

TEST_CASE("a phase's field is weighted by the phase's volume in the region, which cuts cells") {
  const Mesh mesh = squares(5, 1, 2);
  const Snapshot state = three_phase_state(5, 0);  // alpha of copper 1, 1, 0.5, 0, 0; pressure 120, 120.125, 120.25
  CHECK(mean(mesh, state, "pressure.copper", Everywhere{}) ==
        Approx((120 + 120.125 + 0.5 * 120.25) / 2.5).epsilon(1e-14));
  CHECK(mean(mesh, state, "pressure.copper", Box{{1, -1, 0}, {5, 9, 0}}) ==
        Approx((0.5 * 120 + 120.125 + 0.25 * 120.25) / 1.75).epsilon(1e-14));
  CHECK(mean(mesh, state, "stress.copper.xy", Box{{0.5, 0.5, 0}, {1, 1, 0}}) == Approx(133).epsilon(1e-14));
  CHECK(std::isnan(mean(mesh, state, "pressure.copper", Box{{7, 0, 0}, {9, 2, 0}})));  // no copper there
}

TEST_CASE("a volume fraction and the mixture's fields are weighted by volume") {
  const Mesh mesh = squares(5, 1, 2);
  const Snapshot state = three_phase_state(5, 0);
  CHECK(mean(mesh, state, "alpha.copper", Everywhere{}) == Approx(0.5).epsilon(1e-14));
  // the third cell: copper 0.5 x 120.25, gas 0.25 x 220.25, a void at 10 Pa
  CHECK(mean(mesh, state, "pressure", Box{{4, 0, 0}, {6, 2, 0}}) ==
        Approx(0.5 * 120.25 + 0.25 * 220.25 + 0.25 * 10).epsilon(1e-14));
}

TEST_CASE("a region beside the mesh is refused with its line") {
  CHECK_THROWS_WITH(mean(squares(5, 1, 2), three_phase_state(5, 0), "pressure", Box{{20, 0, 0}, {21, 1, 0}}),
                    Contains("case.toml:7") && Contains("outside the mesh"));
}

TEST_CASE("the history has the mean's column in the field's unit, and the latest values of integrals and probes") {
  const Scratch scratch;
  Setup setup = three_phases(scratch.path);
  setup.output.fields = {"pressure"};
  setup.integrals = {{"front", Extent{0, 0.5, Axis::x}}, {"p", Mean{"pressure.gas", Everywhere{}, ""}, "Pa"}};
  setup.probes = {{"gauge", {1, 1, 0}}};
  const Mesh mesh = squares(5, 1, 2);
  Output output(setup, Geometry::plane, mesh, world());
  CHECK(output.needs_fields_for_history());
  output.history(three_phase_state(5, 0), {});
  output.finish();
  const auto rows = table(read(scratch.path / "history.csv"));
  CHECK(std::stod(cell_of(rows, 1, "p")) == output.integral("p"));
  CHECK_THAT(read(scratch.path / "units.csv"), Contains("history,p,Pa\n") && Contains("history,front,m\n"));
  REQUIRE(output.latest().size() == 5);
  CHECK(output.latest()[1].value == Approx((0.25 * 220.25 + 220.375 + 220.5) / 2.25).epsilon(1e-14));
  CHECK(output.latest()[2].name == "gauge.pressure.copper");
  CHECK(output.latest()[2].value == 120);
  CHECK(std::isnan(output.latest()[3].value));  // no gas there
}

TEST_CASE("a mean is read with its field, unit and box") {
  const Setup setup =
      read_text(with_mean("field = \"stress.copper.xy\", box = { low = [0.1, 0.2], high = [0.3, 0.4] }"));
  REQUIRE(setup.integrals.size() == 1);
  CHECK(setup.integrals[0].unit == "Pa");
  const auto& what = std::get<Mean>(setup.integrals[0].what);
  CHECK(what.field == "stress.copper.xy");
  CHECK(std::get<Box>(what.region).high.y == 0.4);
  CHECK_THAT(what.where, Contains("case.toml:"));
  const Setup everywhere = read_text(with_mean("field = \"velocity.x\""));
  CHECK(everywhere.integrals[0].unit == "m/s");
  CHECK(std::holds_alternative<Everywhere>(std::get<Mean>(everywhere.integrals[0].what).region));
}

TEST_CASE("a mean of an unknown field, of a flat box, or beside another integral is refused") {
  CHECK_THAT(mistakes_in(with_mean("field = \"presure.copper\"")),
             Contains("case.toml:19") && Contains("did you mean \"pressure.copper\"?"));
  CHECK_THAT(mistakes_in(with_mean("field = \"velocity\"")), Contains("velocity.x"));
  CHECK_THAT(mistakes_in(with_mean("field = \"pressure\", box = { low = [0, 0], high = [0, 1] }")),
             Contains("low < high"));
  CHECK_THAT(mistakes_in(with_mean("field = \"pressure\", box = { low = [0, 0] }")), Contains("missing key \"high\""));
  CHECK_THAT(
      mistakes_in(with_mean("field = \"pressure\"") + "quantile = { phase = \"air\", fraction = 0.5, axis = \"x\" }"),
      Contains("mean"));
  CHECK_THAT(mistakes_in("scene = \"plane\"\n" +
                         with_mean("field = \"pressure\", box = { low = [0, 0, 1], high = [1, 1, 2] }")),
             Contains("plane"));
}
