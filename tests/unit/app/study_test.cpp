// The statistics of `cobasis study`: what is known of a number from its values on some meshes, and of a run's cost from
// those of others.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "app/command_line.hpp"
#include "app/study_convergence.hpp"
#include "app/study_cost.hpp"
#include "app/study_meshes.hpp"
#include "app/study_report.hpp"
#include "math/errors.hpp"

using namespace cobasis;
using Catch::Matchers::Contains;

namespace {

template <class Function>
std::vector<double> values(const std::vector<double>& h, const Function& f) {
  std::vector<double> found;
  for (const double x : h) found.push_back(f(x));
  return found;
}

bool holds(const Convergence& found, double exact) { return std::fabs(found.value - exact) <= found.error; }

const std::vector<double> halved = {4, 2, 1};

Setup setup_with(std::map<std::string, double> parameters) {
  Setup setup;
  setup.case_file = "case.toml";
  setup.mesh_parameters = std::move(parameters);
  return setup;
}

std::vector<double> sizes(const std::vector<StudyMesh>& meshes) {
  std::vector<double> h;
  for (const StudyMesh& mesh : meshes) h.push_back(mesh.h);
  return h;
}

}  // namespace

TEST_CASE("of f + C h^p the value f and the order p are found, whatever the ratios of the meshes") {
  const double p = GENERATE(0.55, 0.7, 1.0, 1.6, 2.0, 2.9);
  const double c = GENERATE(0.3, -0.02);
  for (const std::vector<double>& h : {halved, std::vector<double>{2.1, 1.5, 1}, std::vector<double>{7, 3, 2.5, 1}}) {
    const Convergence found = converge(h, values(h, [&](double x) { return 5 + c * std::pow(x, p); }));
    CAPTURE(p, c, h, found.value, found.error);
    CHECK(found.trend == Trend::asymptotic);
    CHECK(found.order.value() == Approx(p).epsilon(1e-6));
    CHECK(found.value == Approx(5).epsilon(1e-9));
    CHECK(found.error >= std::fabs(c));  // the bar reaches the finest mesh's value
  }
}

TEST_CASE("the bar holds the exact value where a second term disturbs the power law") {
  const double p = GENERATE(0.6, 1.0, 2.0);
  const double disturbance = GENERATE(-0.4, -0.2, 0.2, 0.4, 1.0);
  const Convergence found =
      converge(halved, values(halved, [&](double x) { return 1 + std::pow(x / 4, p) * (1 + disturbance * x / 4); }));
  CAPTURE(p, disturbance, found.value, found.error, found.order.value_or(0));
  CHECK(holds(found, 1));
}

TEST_CASE("an order that a fourth mesh confirms makes the bar narrower") {
  const std::vector<double> h = {8, 4, 2, 1};
  const auto law = [](double x) { return 3 + 0.1 * x * x; };
  const Convergence three = converge(halved, values(halved, law)), four = converge(h, values(h, law));
  CHECK(four.value == Approx(3));
  CHECK(four.error == Approx(1.25 * 0.1).epsilon(1e-9));
  CHECK(three.error == Approx(2 * 0.3).epsilon(1e-9));
  const Convergence unlike = converge(h, std::vector<double>{9, 4.6, 3.4, 3.1});  // orders 1.87 and 2
  CHECK(unlike.error == Approx(1.25 * 0.1).epsilon(1e-9));
  const Convergence misled = converge(h, std::vector<double>{5, 4.6, 3.4, 3.1});  // order below 0, then 2
  CHECK(misled.error == Approx(2 * 0.3).epsilon(1e-9));
}

TEST_CASE("values that do not converge with an order of a scheme are not extrapolated, and their bar is larger") {
  const auto check = [](const std::vector<double>& f, Trend trend, double error) {
    const Convergence found = converge(halved, f);
    CAPTURE(f, found.error);
    CHECK(found.trend == trend);
    CHECK(found.value == f.back());
    CHECK(found.error == Approx(error).epsilon(1e-9));
    CHECK_THAT(std::string(describe(found.trend)), Contains("not in the asymptotic range"));
  };
  const double half = std::sqrt(2.0) - 1;
  check({1.0, 1.5, 1.9}, Trend::slow, 3 * 0.4 / half);     // order 0.32
  check({1.0, 1.1, 1.3}, Trend::growing, 3 * 0.2 / half);  // order -1
  check({1.0, 1.9, 1.99}, Trend::fast, 1.25 * 0.99);       // order 3.3, what they span is more than 3 x 0.09
  check({1.0, 1.2, 1.1}, Trend::oscillating, 3 * 0.2);
  check({1.0, 1.1, 0.9}, Trend::oscillating, 3 * 0.2);
}

TEST_CASE("values that differ by round-off are the same, and a component that vanishes is measured by the others") {
  const Convergence same = converge(halved, std::vector<double>{1e5, 1e5 * (1 + 2e-14), 1e5 * (1 - 1e-13)});
  CHECK(same.trend == Trend::same);
  CHECK(holds(same, 1e5));
  CHECK(same.error < 1e-4);
  const std::vector<double> noise = {1e-9, -2e-9, 5e-10};
  CHECK(converge(halved, noise).trend == Trend::oscillating);
  CHECK(converge(halved, noise, 1e5).trend == Trend::same);
  CHECK(converge(halved, std::vector<double>{0, 0, 0}).error == 0);
  CHECK(converge(halved, std::vector<double>{1, 2, 2}).trend == Trend::fast);
  CHECK(holds(converge(halved, std::vector<double>{1, 2, 2}), 2.9));
}

TEST_CASE("a number that some mesh has no value of has none") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Convergence found = converge(halved, std::vector<double>{nan, 1, 2});
  CHECK(found.trend == Trend::none);
  CHECK(std::isnan(found.value));
  CHECK_FALSE(refinement_for(found, 1e-2));
}

TEST_CASE("the mesh for an accuracy has an error bar of that accuracy") {
  const double p = GENERATE(0.55, 1.0, 2.0);
  const auto law = [&](double x) { return 5 + 0.3 * std::pow(x, p); };
  const Convergence found = converge(halved, values(halved, law));
  for (const double accuracy : {0.1, 1e-3}) {
    const double h = 1 / refinement_for(found, accuracy).value();
    const std::vector<double> finer = {4 * h, 2 * h, h};
    const Convergence then = converge(finer, values(finer, law));
    CAPTURE(p, accuracy, h);
    CHECK(then.error == Approx(accuracy * 5).epsilon(1e-6));
  }
  CHECK_FALSE(refinement_for(converge(halved, std::vector<double>{0, 0, 0}), 1e-3));
}

TEST_CASE("a cost that is fixed and per cell is found, and foretold for any number of cells, steps and rows") {
  const std::vector<double> cells = {100, 400, 1600};
  const LinearCost found = fit_cost(cells, values(cells, [](double n) { return 3e-5 + 2e-7 * n; }));
  CHECK(found.fixed == Approx(3e-5));
  CHECK(found.per_cell == Approx(2e-7));

  std::vector<MeasuredRun> runs;
  const auto cost = [](double n, double steps, double rows) {
    return RunSeconds{steps * (3e-5 + 2e-7 * n), rows * (1e-4 + 1e-8 * n), 0.1 + 1e-5 * n};
  };
  for (const double h : {4.0, 2.0, 1.0}) {
    const double n = 1e4 / (h * h), steps = 200 / h;
    runs.push_back({h, {n, steps, steps}, cost(n, steps, steps)});
  }
  const CostModel model(runs, {});
  const RunSize fine = model.size(0.1);
  CHECK(fine.cells == Approx(1e6));
  CHECK(fine.steps == Approx(2000));
  CHECK(fine.rows == 1000);  // a row per 0.1 % of the run
  CHECK(model.seconds(fine) == Approx(cost(1e6, 2000, 1000).total()));
  CHECK(model.size(0.1, 7e5).cells == 7e5);
  CHECK(CostModel(runs, 4).size(0.1).rows == Approx(500));
}

TEST_CASE("times that tell nothing of fixed and per cell are shared, and none is negative") {
  const auto near = [](const LinearCost& found, double fixed, double per_cell) {
    CHECK(found.fixed == Approx(fixed));
    CHECK(found.per_cell == Approx(per_cell));
  };
  near(fit_cost(std::vector<double>{100}, std::vector<double>{2.0}), 1, 0.01);
  near(fit_cost(std::vector<double>{100, 200}, std::vector<double>{2.0, 1.0}), 0.5, 0.0025);
  near(fit_cost(std::vector<double>{100, 200}, std::vector<double>{0.0, 0.0}), 0, 0);
  const LinearCost steep = fit_cost(std::vector<double>{100, 200}, std::vector<double>{1.0, 3.0});
  CHECK(steep.fixed == 0);
  CHECK(steep.per_cell == Approx(0.0115385).epsilon(1e-5));
}

TEST_CASE("the case's mesh is the finest, with counts divided and sizes multiplied by the ratio") {
  const StudyOptions options;
  const auto counted = mesh_sequence(Refinement(setup_with({{"n", 400}, {"element", 3}}), ""), options);
  CHECK(sizes(counted) == std::vector<double>{4, 2, 1});
  CHECK(counted[0].parameters == std::map<std::string, double>{{"n", 100}, {"element", 3}});
  CHECK(counted[2].parameters.at("n") == 400);
  CHECK(counted[1].name == "n = 200");

  const auto sized = mesh_sequence(Refinement(setup_with({{"h", 0.5e-3}}), ""), options);
  CHECK(sizes(sized) == std::vector<double>{4, 2, 1});
  CHECK(sized[0].parameters.at("h") == Approx(2e-3));

  StudyOptions more;
  more.meshes = 4;
  more.ratio = 1.5;
  const auto several = mesh_sequence(Refinement(setup_with({{"nx", 135}, {"d", 0.2}}), "nx,1/d"), more);
  REQUIRE(several.size() == 4);
  CHECK(several[0].parameters.at("nx") == 40);
  CHECK(several[0].parameters.at("d") == Approx(0.2 * 3.375));
}

TEST_CASE("counts are rounded to whole numbers, and h is that of the rounded mesh") {
  const auto meshes = mesh_sequence(Refinement(setup_with({{"n", 101}}), "n"), {});
  CHECK(meshes[1].parameters.at("n") == 51);
  CHECK(meshes[1].h == 101.0 / 51);
  CHECK(meshes[0].h == 101.0 / 25);
}

TEST_CASE("a split mesh is the finer one") {
  const Refinement refinement(setup_with({}), "split");
  const auto meshes = mesh_sequence(refinement, {});
  CHECK(sizes(meshes) == std::vector<double>{1, 0.5, 0.25});
  CHECK(meshes[2].splits == 2);
  CHECK(refinement.mesh(0.3).splits == 2);  // the first that is fine enough
}

TEST_CASE("meshes that cannot be made are refused with what can") {
  const auto said = [](const Setup& setup, const std::string& refine, StudyOptions options = {}) -> std::string {
    try {
      mesh_sequence(Refinement(setup, refine), options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "nothing";
  };
  CHECK_THAT(said(setup_with({}), ""), Contains("case.toml") && Contains("--refine split"));
  CHECK_THAT(said(setup_with({{"element", 3}}), ""), Contains("--refine NAME"));
  CHECK_THAT(said(setup_with({{"cells", 30}}), "cels"), Contains("allowed: cells, split; did you mean \"cells\"?"));
  CHECK_THAT(said(setup_with({{"n", 400}, {"ny", 2}}), "n,ny"), Contains("ny = 2 cannot be divided by 4"));
  CHECK_THAT(said(setup_with({{"n", 0}}), "n"), Contains("allowed: a number above 0"));
  StudyOptions thirds;
  thirds.ratio = 3;
  CHECK_THAT(said(setup_with({}), "split", thirds), Contains("--ratio 3") && Contains("allowed: 2"));
  CHECK_THAT(said(setup_with({{"n", 400}}), ","), Contains("--refine ,"));
}

TEST_CASE("an error is told with two digits, and its value with as many places") {
  CHECK(with_error(-8.09203e9, 1.23e6) == "(-8.0920 ± 0.0012)e9");
  CHECK(with_error(239.554, 0.31) == "239.55 ± 0.31");
  CHECK(with_error(0.0061234, 0.0004) == "(6.12 ± 0.40)e-3");
  CHECK(with_error(2.0, 30.0) == "2 ± 30");
  CHECK(with_error(1e5, 1e-5) == "100000 ± 1e-05");
  CHECK(with_error(0, 0) == "0");
  CHECK(with_error(std::nan(""), std::nan("")) == "no value");
}

TEST_CASE("the study's options are read, and refused out of range") {
  const CommandLine line = read_command_line({"study", "--accuracy", "1e-2,2e-3", "a.toml", "--meshes", "4", "--ratio",
                                              "1.5", "--refine", "n,1/h", "--set", "cfl=0.5", "--quiet"});
  CHECK(line.command == CommandLine::Command::study);
  CHECK(line.file == "a.toml");
  CHECK(line.study.meshes == 4);
  CHECK(line.study.ratio == 1.5);
  CHECK(line.study.refine == "n,1/h");
  CHECK(line.study.accuracies == std::vector<double>{1e-2, 2e-3});
  CHECK(line.overrides.set.size() == 1);
  CHECK(line.quiet);
  CHECK(read_command_line({"study", "a.toml"}).study.accuracies == std::vector<double>{1e-2, 1e-3, 1e-4});
  CHECK_THROWS_WITH(read_command_line({"study", "a.toml", "--meshes", "2"}),
                    Contains("--meshes") && Contains("3 to 8"));
  CHECK_THROWS_WITH(read_command_line({"study", "a.toml", "--ratio", "1"}), Contains("--ratio"));
  CHECK_THROWS_WITH(read_command_line({"study", "a.toml", "--accuracy", "0"}), Contains("--accuracy"));
}
