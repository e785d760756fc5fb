// `cobasis study`: a case on a sequence of meshes.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>

#include "program.hpp"

using namespace cobasis::test;
using Catch::Matchers::Contains;

namespace {

using Row = std::map<std::string, std::string>;

std::vector<Row> rows_of(const std::filesystem::path& table) {
  const auto lines = lines_of(contents_of(table));
  const auto header = fields_of(lines.at(0));
  std::vector<Row> rows;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto fields = fields_of(lines[i]);
    REQUIRE(fields.size() == header.size());
    rows.emplace_back();
    for (std::size_t c = 0; c < header.size(); ++c) rows.back()[header[c]] = fields[c];
  }
  return rows;
}

/// A mean over a box of the whole tube's height, as a line of --set's array.
std::string mean(const std::string& name, const std::string& field, const std::string& low, const std::string& high) {
  return "{ name = \"" + name + "\", mean = { field = \"" + field + "\", box = { low = [" + low + ", 0], high = [" +
         high + ", 1] } } }";
}

std::string study(const std::string& name, const std::string& integrals, int n, const std::string& options = "") {
  return program_with("study " + quoted(case_file(name)) + " --output out " + options + " --set 'line=[]' " +
                      quoted("integral=[" + integrals + "]") + " mesh_parameters.n=" + std::to_string(n));
}

Outcome succeed(const std::string& line, const Folder& folder) {
  const Outcome outcome = shell(line, folder);
  INFO(line << '\n' << outcome.out << outcome.err);
  REQUIRE(outcome.status == 0);
  return outcome;
}

/// Every exact value lies within its bar.
void check_bars(const Folder& folder, const std::map<std::string, double>& exact) {
  const auto rows = rows_of(folder.path("out/study.csv"));
  REQUIRE(rows.size() == exact.size());
  for (Row row : rows) {
    CAPTURE(row["quantity"], row["value"], row["error"], row["trend"], exact.at(row["quantity"]));
    CHECK(std::fabs(std::stod(row["value"]) - exact.at(row["quantity"])) <= std::stod(row["error"]));
    CHECK(std::stod(row["error"]) < 0.35 * std::fabs(std::stod(row["value"])));  // a bar that says something
  }
}

const std::string impact_plateaus =
    mean("sigma", "stress.xx", "0.6", "0.75") + ", " + mean("u", "velocity.x", "0.3", "0.45") + ", " +
    mean("rho_copper", "density.copper", "0.3", "0.45") + ", " + mean("p_copper", "pressure.copper", "0.3", "0.45") +
    ", " + mean("rho_aluminium", "density.aluminium", "0.6", "0.75") + ", " +
    mean("p_aluminium", "pressure.aluminium", "0.6", "0.75");

/// One square with a group on its sides.
const std::string square = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
1 1 "side"
2 2 "domain"
$EndPhysicalNames
$Nodes
4
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
$EndNodes
$Elements
5
1 1 2 1 1 1 2
2 1 2 1 1 2 3
3 1 2 1 1 3 4
4 1 2 1 1 4 1
5 3 2 2 1 1 2 3 4
$EndElements
)";

const std::string gas = R"(schema = 1
mesh = "mesh.msh"
end_time = 1e-3
[phase.air]
material = "air"
[[region]]
shape = "everywhere"
fill = "air"
pressure = 1e5
[boundary]
side = "wall"
)";

}  // namespace

TEST_CASE("the bars of a study hold the exact plateaus of the impact of section 5.2") {
  const Folder folder;
  succeed(study("impact", impact_plateaus, 400), folder);
  // exact by Rankine-Hugoniot relations, nine digits
  check_bars(folder, {{"sigma", -8.09200895e9},
                      {"u", 239.554899},
                      {"rho_copper", 9159.33178},
                      {"p_copper", 4.39399172e9},
                      {"rho_aluminium", 2886.05605},
                      {"p_aluminium", 5.50283504e9}});
}

TEST_CASE("the bars of a study hold the exact plateaus of the shear test of section 5.3") {
  const Folder folder;
  succeed(study("shear",
                mean("u_outside", "velocity.x", "0.22", "0.3") + ", " +
                    mean("sigma_outside", "stress.xx", "0.22", "0.3") + ", " +
                    mean("rho_middle", "density", "0.4", "0.6") + ", " + mean("tau_middle", "stress.xy", "0.4", "0.6"),
                800),
          folder);
  check_bars(folder, {{"u_outside", -21.3228854},
                      {"sigma_outside", -0.365169409e9},
                      {"rho_middle", 2690.62376},
                      {"tau_middle", -4.20390152e9}});
}

TEST_CASE("a study tells values, orders, costs before and after, and the run that an accuracy takes") {
  const Folder folder;
  const Outcome outcome =
      succeed(study("impact", impact_plateaus, 200, "--accuracy 1e-2,1e-5 --set scheme.order=1"), folder);
  INFO(outcome.out);
  CHECK(outcome.err.empty());
  for (const std::string said : {"mesh 3 of 3: n = 200, 200 cells, predicted ", " ± ", "order",
                                 "core-seconds on 1 rank", "results: out: study.csv"})
    CHECK_THAT(outcome.out, Contains(said));
  CHECK_THAT(lines_of(outcome.out).back(),
             Contains("cobasis: meshes=3 quantities=6 ") && Contains("finest_predicted="));

  const auto meshes = rows_of(folder.path("out/meshes.csv"));
  REQUIRE(meshes.size() == 3);
  CHECK(meshes[0].at("mesh_parameters.n") == "50");
  CHECK(meshes[2].at("cells") == "200");
  CHECK(std::stod(meshes[2].at("h")) == 1);
  CHECK(std::stod(meshes[2].at("core_seconds")) > 0);
  CHECK(std::stod(meshes[2].at("predicted_core_seconds")) > 0);

  // the value of a mesh is that of the run's last row
  const auto history = rows_of(folder.path("out/mesh_2/history.csv"));
  CHECK(rows_of(folder.path("out/study.csv")).at(1).at("mesh_2") == history.back().at("u"));

  int together = 0;
  for (const Row& row : rows_of(folder.path("out/forecast.csv"))) {
    CHECK(std::stod(row.at("core_seconds")) > 0);
    if (row.at("quantity") == "*") ++together;
  }
  CHECK(together == 2);
}

TEST_CASE("a study leaves a picture") {
  const Folder folder;
  succeed(study("impact", mean("u", "velocity.x", "0.3", "0.45"), 100), folder);
  CHECK_THAT(contents_of(folder.path("out/study.png")).substr(0, 8), Catch::Equals("\x89PNG\r\n\x1a\n"));
}

TEST_CASE("a quiet study says one line, and on two ranks finds the same numbers to the last byte") {
  const Folder one, two;
  const Outcome outcome = succeed(study("impact", impact_plateaus, 120, "--quiet"), one);
  CHECK(lines_of(outcome.out).size() == 1);
  succeed("mpirun --quiet -n 2 " + study("impact", impact_plateaus, 120, "--quiet"), two);
  CHECK((contents_of(one.path("out/study.csv")) == contents_of(two.path("out/study.csv"))));
  CHECK(rows_of(two.path("out/meshes.csv")).at(0).at("ranks") == "2");
}

TEST_CASE("a probe's fields are studied like integrals") {
  const Folder folder;
  succeed(study("impact", "", 100, "--quiet") + " 'probe=[{ name = \"gauge\", at = [0.4, 0.0] }]'", folder);
  const auto rows = rows_of(folder.path("out/study.csv"));
  CHECK(std::ranges::any_of(rows, [](const Row& row) { return row.at("quantity") == "gauge.stress.copper.xx"; }));
}

TEST_CASE("a mesh without parameters is refined by splitting its cells") {
  const Folder folder;
  folder.write("mesh.msh", square);
  folder.write("gas.toml", gas + "[[integral]]\nname = \"mass\"\nmean = { field = \"density\" }\n");
  succeed(program_with("study gas.toml --refine split"), folder);
  const auto meshes = rows_of(folder.path("gas-study/meshes.csv"));
  REQUIRE(meshes.size() == 3);
  CHECK(meshes[0].at("cells") == "1");
  CHECK(meshes[2].at("cells") == "16");
  CHECK(rows_of(folder.path("gas-study/study.csv")).at(0).at("trend") == "same");
}

TEST_CASE("a study that cannot be is refused before anything is written, with what to do") {
  const Folder folder;
  folder.write("mesh.msh", square);
  folder.write("none.toml", gas);
  const std::string some = gas + "[[integral]]\nname = \"p\"\nmean = { field = \"pressure\" }\n";
  folder.write("some.toml", some);
  folder.write("steps.toml", "max_steps = 3\n" + some);
  const auto before = folder.contents();
  const auto refused = [&](const std::string& arguments, const std::vector<std::string>& says) {
    const Outcome outcome = shell(program_with("study " + arguments), folder);
    INFO(arguments << '\n' << outcome.out << outcome.err);
    CHECK(outcome.status == 2);
    CHECK(outcome.out.empty());
    for (const std::string& piece : says) CHECK_THAT(outcome.err, Contains(piece));
    CHECK(folder.contents() == before);
  };
  refused("none.toml --refine split", {"none.toml", "no [[integral]] and no [[probe]]", "pressure.air"});
  refused("some.toml", {"some.toml", "--refine split"});
  refused("some.toml --refine n", {"--refine n", "allowed: split"});
  refused("some.toml --refine split --ratio 3", {"--ratio 3", "allowed: 2"});
  refused("some.toml --meshes 2", {"--meshes", "3 to 8"});
  refused("steps.toml --refine split", {"max_steps"});
  refused("", {"cobasis study CASE"});
}
