// Wrong input: refused with exit status 2, where it is and what is allowed, before anything is written.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "program.hpp"

using namespace cobasis::test;
using Catch::Matchers::Contains;

namespace {

const std::string right = R"(schema = 1
mesh = "MESHES/box.geo"
mesh_parameters = { n = 8 }
end_time = 1e-5
[phase.copper]
material = "copper"
[phase.air]
material = "air"
[[region]]
shape = "everywhere"
fill = "air"
pressure = 1e5
[[region]]
shape = "half_space"
point = [0.5, 0.0]
normal = [-1.0, 0.0]
fill = "copper"
pressure = 1e5
[boundary]
left = "transmissive"
"*" = "wall"
)";

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

std::string complete(std::string text) {
  const auto at = text.find("MESHES");
  return at == std::string::npos ? text : text.replace(at, 6, SOURCE_DIR "/meshes");
}

int line_of(const std::string& text, const std::string& fragment) {
  const auto at = text.find(fragment);
  REQUIRE(at != std::string::npos);
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(at), '\n'));
}

/// Both run and check refuse the case, say all this, and leave the folder as it was.
void check_refused(const std::string& text, const std::vector<std::string>& says, const std::string& mesh = "") {
  const Folder folder;
  folder.write("wrong.toml", complete(text));
  if (!mesh.empty()) folder.write("mesh.msh", mesh);
  const auto before = folder.contents();
  for (const std::string command : {"run", "check"}) {
    const Outcome outcome = shell(program_with(command + " wrong.toml"), folder);
    INFO(text << "\ncobasis " << command << ": " << outcome.out << outcome.err);
    CHECK(outcome.status == 2);
    CHECK(outcome.out.empty());
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    for (const std::string& piece : says) CHECK_THAT(outcome.err, Contains(piece));
    CHECK(folder.contents() == before);
  }
}

/// `replacement` in place of `found` is refused at its line.
void check_replaced(const std::string& found, const std::string& replacement, std::vector<std::string> says) {
  const std::string text = with(right, found, replacement);
  says.push_back(fmt::format("wrong.toml:{}: ", line_of(text, replacement.substr(0, replacement.find('\n')))));
  check_refused(text, says);
}

/// The case on a mesh of its own.
std::string on_mesh(const std::string& boundary) {
  return with(with(with(right, "MESHES/box.geo", "mesh.msh"), "mesh_parameters = { n = 8 }\n", ""),
              "left = \"transmissive\"\n\"*\" = \"wall\"\n", boundary);
}

}  // namespace

TEST_CASE("the right case, from which the wrong ones are made, runs") {
  const Folder folder;
  folder.write("right.toml", complete(right));
  const Outcome outcome = shell(program_with("run right.toml"), folder);
  INFO(outcome.err);
  CHECK(outcome.status == 0);
  CHECK(outcome.err.empty());
  CHECK(folder.contents() == std::vector<std::string>{"right", "right.toml"});

  const Folder meshed;
  meshed.write("right.toml", on_mesh("side = \"wall\"\n"));
  meshed.write("mesh.msh", square);
  CHECK(shell(program_with("check right.toml"), meshed).status == 0);
}

TEST_CASE("an unknown key is refused with the nearest name") {
  check_replaced("end_time = 1e-5", "temperature = 3\nend_time = 1e-5",
                 {"unknown key \"temperature\"", "allowed: schema"});
  check_replaced("pressure = 1e5", "presure = 1e5\npressure = 1e5",
                 {"unknown key \"presure\"", "did you mean \"pressure\"?"});
}

TEST_CASE("a value of the wrong type, out of range or not a number is refused with what is allowed") {
  check_replaced("end_time = 1e-5", "end_time = \"soon\"", {"\"soon\"", "allowed: a number [s], 0 < end_time"});
  check_replaced("end_time = 1e-5", "end_time = -1.0", {"end_time = -1", "allowed: a number [s], 0 < end_time"});
  check_replaced("end_time = 1e-5", "cfl = 2.5\nend_time = 1e-5", {"cfl = 2.5", "cfl <= 2"});
  check_replaced("pressure = 1e5", "pressure = nan",
                 {"pressure = nan", "allowed: a number, or a formula in x, y, z [Pa]"});
}

TEST_CASE("what is not TOML, or not a formula, is refused at its line") {
  check_replaced("end_time = 1e-5", "end_time = = 1", {});
  check_replaced("pressure = 1e5", "velocity = [\"3*\", 0]\npressure = 1e5", {"\"3*\"", "formulas in x, y, z"});
  check_replaced("pressure = 1e5", "velocity = [\"3*w\", 0]\npressure = 1e5", {"\"3*w\""});
}

TEST_CASE("an unknown material or phase is refused with the known ones") {
  check_replaced("material = \"copper\"", "material = \"coper\"", {"aluminium, copper", "did you mean \"copper\"?"});
  check_replaced("fill = \"copper\"", "fill = \"coppr\"", {"unknown phase \"coppr\"", "allowed: copper, air"});
}

TEST_CASE("volume fractions that do not sum to 1 are refused") {
  check_replaced("fill = \"copper\"", "alpha = { copper = 0.3, air = 0.6 }", {"sum", "1"});
}

TEST_CASE("a cell that no region covers is refused with its place") {
  const std::string text = with(right, "shape = \"everywhere\"", "shape = \"box\"\nlow = [0, 0]\nhigh = [0.7, 1]");
  check_refused(text,
                {"wrong.toml:15: ", "the cell at (0.6875, ", "is only to 60 % covered", "shape = \"everywhere\""});
}

TEST_CASE("a formula that gives what a phase cannot hold is refused with the place") {
  const std::string text = with(right, "pressure = 1e5", "pressure = \"1e5*(0.9 - y)\"");
  check_refused(text, {"wrong.toml:9: ", "of phase \"air\" at (", "allowed: 0 < pressure [Pa]"});
  check_refused(with(right, "pressure = 1e5", "density = \"0.5 - y\"\npressure = 1e5"),
                {"wrong.toml:9: density = -0.0625 of phase \"air\" at (", "allowed: 0 < density"});
  check_refused(with(right, "left = \"transmissive\"",
                     "left = { type = \"inflow\", fill = \"air\", pressure = \"1e5*(0.5 - y)\" }"),
                {"boundary 'left'", "of phase \"air\" at (0, ", "allowed: 0 < pressure [Pa]"});
  check_refused(with(right, "left = \"transmissive\"",
                     "left = { type = \"inflow\", fill = \"air\", pressure = 1e5, velocity = [\"sqrt(0.5 - y)\", 0] }"),
                {"boundary 'left'", "velocity = ", "of phase \"air\" at (0, ", "allowed: finite numbers [m/s]"});
}

TEST_CASE("what samples nothing is refused by check as by run, before anything is made on disk") {
  const Folder folder;
  for (const std::string sampler : {"[[probe]]\nname = \"far\"\nat = [12.0, 0.5]\n",
                                    "[[line]]\nname = \"far\"\nfrom = [0.5, 0.5]\nto = [12.0, 0.5]\npoints = 5\n",
                                    "[[slice]]\nname = \"far\"\npoint = [12.0, 0.0]\nnormal = [1.0, 0.0]\n"}) {
    folder.write("wrong.toml", complete(right + sampler));
    for (const std::string command : {"check", "run"}) {
      const Outcome outcome = shell(program_with(command + " wrong.toml"), folder);
      INFO(command << '\n' << sampler << outcome.err);
      CHECK(outcome.status == 2);
      CHECK_THAT(outcome.err, Contains("'far'"));
      CHECK(folder.contents() == std::vector<std::string>{"wrong.toml"});
    }
  }
}

TEST_CASE("what only one of several ranks finds wrong is told like what all find") {
  const Folder folder;
  for (const std::string corner :
       {"x + y < 0.2", "x - y > 0.8", "y - x > 0.8", "x + y > 1.8"}) {  // not all are rank 0's
    const std::string formula = "pressure = \"" + corner + " ? -4e10 : 1e5\"";
    folder.write("wrong.toml", complete(with(with(right, "pressure = 1e5", formula), "pressure = 1e5", formula)));
    const Outcome one = shell(program_with("check wrong.toml"), folder),
                  two = shell("mpirun --quiet -n 2 " + program_with("check wrong.toml"), folder);
    CHECK(one.status == 2);
    CHECK(two.status == 2);
    CHECK_THAT(one.err, Contains("pressure = -4e+10 of phase ") && Contains("allowed: "));
    CHECK_THAT(two.err, Contains(one.err));
  }
}

TEST_CASE("groups of the mesh are suggested where a region or a periodic pair misspells them") {
  check_refused(with(right, "shape = \"everywhere\"", "shape = \"physical_group\"\nname = \"domin\""),
                {"wrong.toml:9: ", "'domin'", "allowed: domain", "did you mean \"domain\"?"});
  check_refused(with(right, "left = \"transmissive\"", "left = { type = \"periodic\", with = \"rigt\" }"),
                {"'rigt'", "allowed: ", "did you mean \"right\"?"});
  check_refused(with(right, "n = 8", "nn = 8"), {"'nn'", "did you mean \"n\"?"});
}

TEST_CASE("boundaries and the mesh's groups must match, both ways") {
  check_replaced("left = ", "lefft = ", {"'lefft' is not a physical group of the mesh", "bottom, right, top, left"});
  check_refused(with(right, "\"*\"", "bottom = \"wall\"\ntop"),
                {"wrong.toml", "group 'right' has no boundary condition", "add \"*\""});
  const std::string pair = "left = { type = \"periodic\", with = \"bottom\" }";
  check_refused(with(right, "left = \"transmissive\"", pair), {"left", "bottom"});
}

TEST_CASE("a mesh that is missing, no mesh, cut short, of another dimension, or without groups is refused") {
  check_replaced("MESHES/box.geo", "meshes/bax.geo", {"there is no file", "bax.geo"});
  const std::string text = on_mesh("side = \"wall\"\n");
  check_refused(text, {"mesh.msh"}, "this is a letter, not a mesh\n");
  check_refused(text, {"mesh.msh"}, square.substr(0, square.size() / 2));
  check_refused(text, {"mesh.msh"}, square.substr(0, square.find("5 3 2 2")));
  check_refused(with(text, "end_time", "scene = \"space\"\nend_time"), {"mesh.msh", "dimension 3"}, square);
  check_refused(text, {"mesh.msh", "group"}, with(with(square, "\n4 1 2 1 1 4 1", ""), "$Elements\n5", "$Elements\n4"));
}

TEST_CASE("what does not exist yet is refused like what never will, not ignored") {
  for (const char* key : {"stop_when = \"steady\"", "restart = true"})
    check_replaced("end_time = 1e-5", std::string(key) + "\nend_time = 1e-5", {"unknown key"});
  check_replaced("end_time = 1e-5", "scene = \"spherical\"\nend_time = 1e-5", {"allowed: plane, axisymmetric, space"});
  check_refused(with(right, "[boundary]", "[contact]\ndefault = \"glue\"\n[boundary]"),
                {"wrong.toml:20: ", "\"glue\"", "allowed: sliding, adherence, friction"});
  check_refused(with(right, "[boundary]", "[scheme]\nlimiter = \"minmod\"\n[boundary]"),
                {"wrong.toml:20: ", "limiter = \"minmod\"", "allowed: monotone, none"});
  check_refused(with(right, "[boundary]", "[scheme]\norder = 3\n[boundary]"), {"wrong.toml:20: ", "order = 3"});
}

TEST_CASE("traces of every phase are refused with sharp") {
  const std::string sharp = with(right, "[boundary]", "[scheme]\ninterface = \"sharp\"\n[boundary]");
  check_refused(with(sharp, "end_time", "alpha_min = 1e-5\nend_time"),
                {"wrong.toml:4: ", "alpha_min = 1e-05 with sharp or compressed interfaces", "interface = \"diffuse\""});
}

TEST_CASE("an axisymmetric scene has its axis where its mesh touches y = 0, and nowhere else") {
  const std::string round = with(right, "end_time", "scene = \"axisymmetric\"\nend_time");
  const auto with_boundary = [&](const std::string& text) {
    return with(round, "left = \"transmissive\"\n\"*\" = \"wall\"\n", text);
  };
  const Folder folder;
  folder.write("right.toml", complete(with_boundary("bottom = \"axis\"\n\"*\" = \"wall\"\n")));
  const Outcome outcome = shell(program_with("check right.toml"), folder);
  INFO(outcome.err);
  CHECK(outcome.status == 0);
  CHECK_THAT(outcome.out, Contains("axisymmetric scene, 64 cells"));

  check_refused(round, {"wrong.toml:22: ", "boundary 'bottom' has faces on the axis y = 0", "condition \"axis\""});
  check_refused(with_boundary("top = \"axis\"\nbottom = \"axis\"\n\"*\" = \"wall\"\n"),
                {"wrong.toml:21: ", "boundary 'top' = \"axis\", but it has faces off the axis y = 0"});
  check_refused(with_boundary("top = { type = \"periodic\", with = \"bottom\" }\n\"*\" = \"wall\"\n"),
                {"box.geo", "'top' and 'bottom'", "a translation along x"});
  check_refused(with(on_mesh("side = \"wall\"\n"), "end_time", "scene = \"axisymmetric\"\nend_time"),
                {"mesh.msh", "lies at y >= 0", "a node is at (1, -0.5)"}, with(square, "2 1 0 0", "2 1 -0.5 0"));
}

TEST_CASE("a change on the command line is refused by its own name") {
  const Folder folder;
  const Outcome outcome =
      shell(program_with("run " + quoted(case_file("impact")) + " --set phase.copper.elastic.a=0.7"), folder);
  INFO(outcome.err);
  CHECK(outcome.status == 2);
  CHECK_THAT(outcome.err, Contains("--set phase.copper.elastic.a: ") && Contains("a <= 0.5"));
  CHECK(folder.contents().empty());
}

TEST_CASE("an output directory that cannot be is refused before the first step") {
  const Folder folder;
  folder.write("right.toml", complete(right));
  folder.write("taken", "a file");
  for (const std::string directory : {"taken", "taken/below", "/proc/none"}) {
    const Outcome outcome = shell(program_with("run right.toml --output " + directory), folder);
    INFO(outcome.out << outcome.err);
    CHECK(outcome.status == 2);
    CHECK(outcome.out.empty());
    CHECK_THAT(outcome.err, Contains("--output: ") && Contains(directory) && Contains("allowed"));
  }
  const std::string wrong = right + "[output]\ndirectory = \"taken\"\n";
  folder.write("wrong.toml", complete(wrong));
  const Outcome outcome = shell(program_with("run wrong.toml"), folder);
  CHECK(outcome.status == 2);
  CHECK_THAT(outcome.err,
             Contains("wrong.toml:" + std::to_string(line_of(wrong, "directory")) + ": ") && Contains("taken"));
  CHECK(folder.contents() == std::vector<std::string>{"right.toml", "taken", "wrong.toml"});
  CHECK(contents_of(folder.path("taken")) == "a file");
}

TEST_CASE("wrong words on the command line are refused with the right ones") {
  const Folder folder;
  for (const std::string arguments : {"", "rn case.toml", "run", "run missing.toml", "run a.toml b.toml", "help me"}) {
    const Outcome outcome = shell(program_with(arguments), folder);
    INFO("cobasis " << arguments << ": " << outcome.err);
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err, Contains("allowed: "));
  }
}
