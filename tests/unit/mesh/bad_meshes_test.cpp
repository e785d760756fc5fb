#include <regex>

#include "mesh/msh_check.hpp"
#include "mesh_files.hpp"
#include "mixed_mesh.hpp"

using namespace cobasis;
using Catch::Contains;

namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

MshText two_squares() {
  MshText mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  mesh.cells = {{CellType::quadrilateral, {0, 1, 4, 3}}, {CellType::quadrilateral, {1, 2, 5, 4}}};
  return mesh;
}

std::string error_of_mesh(const MshText& mesh) { return error_of_text("a.msh", mesh.text()); }

}  // namespace

TEST_CASE("files that are no mesh are refused by name") {
  const Folder folder;
  CHECK_THAT(error_of(folder.path("none.msh")), Contains("none.msh: no such mesh file"));
  CHECK_THAT(error_of(folder.path("none.geo")), Contains("none.geo: no such mesh file"));
  std::filesystem::create_directory(folder.path("dir.msh"));
  CHECK_THAT(error_of(folder.path("dir.msh")), Contains("is a directory"));
  CHECK_THAT(error_of(folder.write("empty.msh", "")), Contains("empty"));
  CHECK_THAT(error_of(folder.write("a.stl", "solid")), Contains(".msh or a .geo"));
  CHECK_THAT(error_of(folder.write("bad.geo", "Point(1) = {0, 0;\n")), Contains("bad.geo") && Contains("line 1"));
}

TEST_CASE("a script called .msh is not run") {
  const Folder folder;
  const std::string trace = folder.path("trace");
  CHECK_THAT(error_of(folder.write("evil.msh", "SystemCall \"touch " + trace + "\";\n")), Contains("$MeshFormat"));
  CHECK_FALSE(std::filesystem::exists(trace));
}

TEST_CASE("a mesh file cut anywhere is refused") {
  const std::string text = mixed_mesh(0).text();
  for (std::size_t length = 1; length + 2 < text.size(); length += 23) {
    INFO("cut to " << length << " of " << text.size());
    CHECK_FALSE(error_of_text("cut.msh", text.substr(0, length)).empty());
  }
  CHECK_FALSE(error_of_text("cut.msh", text.substr(0, text.size() - 3)).empty());
}

TEST_CASE("absurd counts and foreign versions are refused before Gmsh sees them") {
  const std::string text = mixed_mesh(0).text();
  CHECK_THAT(error_of_text("a.msh", replaced(text, "$Nodes\n17", "$Nodes\n2000000000")),
             Contains("2000000000 entries"));
  CHECK_THAT(error_of_text("a.msh", replaced(text, "$Nodes\n17", "$Nodes\n-1")), Contains("more than a file"));
  CHECK_THAT(
      error_of_text("a.msh", std::regex_replace(text, std::regex("\\$Elements\n[0-9]+"), "$$Elements\n99999999")),
      Contains("99999999 entries"));
  CHECK_THAT(error_of_text("a.msh", replaced(text, "2.2 0 8", "1 0 8")), Contains("2.2 and 4.1"));
  CHECK_THAT(error_of_text("a.msh", replaced(text, "2.2 0 8", "4 0 8")), Contains("2.2 and 4.1"));
  CHECK_THAT(error_of_text("a.msh", replaced(text, "2.2 0 8", "hello")), Contains("hello"));
}

TEST_CASE("damaged contents are refused") {
  const std::string text = mixed_mesh(0).text();
  CHECK_FALSE(error_of_text("a.msh", replaced(text, "\n17 1.5 ", "\n17 nan ")).empty());
  CHECK_FALSE(error_of_text("a.msh", replaced(text, "\n17 1.5 ", "\n18 1.5 ")).empty());
  CHECK_FALSE(error_of_text("a.msh", replaced(text, " 5 2 2 1 1 2 3 4 5 6 7 8", " 5 2 2 1 1 2 3 4 5 6 7 99")).empty());
}

TEST_CASE("inverted and flat elements are named by their number") {
  MshText mesh = mixed_mesh(0);
  mesh.cells[0].second = {3, 2, 1, 0, 7, 6, 5, 4};
  CHECK_THAT(error_of_mesh(mesh), Contains("element ") && Contains("hexahedron") && Contains("negative volume"));
  MshText flat = two_squares();
  flat.nodes[0] = {1, 0.5, 0};
  flat.nodes[3] = {1, 0.7, 0};
  CHECK_THAT(error_of_mesh(flat), Contains("element 7 (quadrilateral)") && Contains("has no area"));
}

TEST_CASE("plane meshes off z = 0 are refused") {
  MshText mesh = two_squares();
  mesh.nodes[2].z = 0.1;
  CHECK_THAT(error_of_mesh(mesh), Contains("z = 0"));
}

TEST_CASE("boundary faces without a group are counted and located") {
  const std::string text = two_squares().text();
  const std::string one_missing = replaced(text, "$Elements\n8\n1 1 2 1 1 1 2\n", "$Elements\n7\n");
  CHECK_THAT(error_of_text("a.msh", one_missing), Contains("1 of 6 boundary faces") && Contains("(0.5, 0, 0)"));
}

TEST_CASE("hanging nodes are recognised") {
  MshText mesh = two_squares();  // the right square becomes two that share a node on its left side
  mesh.nodes.push_back({1, 0.5, 0});
  mesh.nodes.push_back({2, 0.5, 0});
  mesh.cells = {{CellType::quadrilateral, {0, 1, 4, 3}},
                {CellType::quadrilateral, {1, 2, 7, 6}},
                {CellType::quadrilateral, {6, 7, 5, 4}}};
  // text() puts all bare faces into "wall": take those on x = 1 out again
  std::string text = mesh.text();
  int removed = 0;
  for (const std::string nodes : {" 1 2 1 1 2 5\n", " 1 2 1 1 7 2\n", " 1 2 1 1 5 7\n"}) {
    const std::size_t at = text.find(nodes);
    REQUIRE(at != std::string::npos);
    const std::size_t start = text.rfind('\n', at - 1);
    text.erase(start, at + nodes.size() - 1 - start);
    ++removed;
  }
  text = replaced(text, "$Elements\n13", "$Elements\n10");
  CHECK(removed == 3);
  CHECK_THAT(error_of_text("a.msh", text), Contains("hanging face") && Contains("do not share their nodes"));
}

TEST_CASE("duplicate and overlapping elements are refused") {
  MshText twice = two_squares();
  twice.extra_elements = "3 2 2 1 1 2 5 4\n";
  CHECK_THAT(error_of_mesh(twice), Contains("are the same"));
  MshText third = two_squares();
  third.extra_elements = "2 2 2 1 2 5 6\n";
  CHECK_FALSE(error_of_mesh(third).empty());
  MshText tetrahedra;  // three about one face
  tetrahedra.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {0.3, 0.3, 2}};
  tetrahedra.cells = {{CellType::tetrahedron, {0, 1, 2, 3}}, {CellType::tetrahedron, {0, 2, 1, 4}}};
  tetrahedra.extra_elements = "4 2 2 1 1 2 3 6\n";
  CHECK_THAT(error_of_mesh(tetrahedra), Contains("shared by 3 cells"));
  MshText overlap = two_squares();  // both on the right of x = 1
  overlap.nodes.push_back({3, 0, 0});
  overlap.cells[0] = {CellType::triangle, {1, 6, 4}};
  CHECK_THAT(error_of_mesh(overlap), Contains("overlap"));
}

TEST_CASE("a boundary element in two groups is refused") {
  MshText mesh = two_squares();
  mesh.extra_elements = "1 2 9 2 1 2\n";
  CHECK_THAT(error_of_mesh(mesh), Contains("physical groups") && Contains("wall") && Contains("'9'"));
  CHECK_THAT(error_of_text("a.geo", strip_geo(2, 2) + "Physical Curve(\"all\") = {1, 2, 3, 4};"),
             Contains("two physical groups") && Contains("bottom") && Contains("all"));
}

TEST_CASE("only sections that a mesh has are accepted, each once, and only those needed reach Gmsh") {
  const std::string text = mixed_mesh(0).text();
  for (const std::string wrong : {"$View\n$EndView\n", "$PostFormat\n1.4 0 8\n$EndPostFormat\n", "SystemCall \"ls\";\n",
                                  "$NOD\n1\n$ENDNOD\n", "$\n", "$Nodes\n1\n1 0 0 0\n$EndNodes\n"}) {
    INFO(wrong);
    CHECK_THAT(error_of_text("a.msh", text + wrong), Contains("a.msh: "));
    CHECK_THAT(error_of_text("a.msh", replaced(text, "$Nodes", wrong + "$Nodes")), Contains("a.msh: "));
  }
  const std::string more = "$Comments\n$View\nSystemCall \"ls\";\n$EndComments\n$NodeData\n1\n\"x\"\n$EndNodeData\n";
  CHECK(check_msh("a.msh", text + more) == text);
  CHECK(error_of_text("a.msh", text + more).empty());
}

TEST_CASE(
    "a header that announces more nodes than there are particles on earth is refused before memory is asked for") {
  const std::string text = mixed_mesh(0).text();
  for (const std::string count : {"1000000000000000", "18446744073709551615", "99999999999999999999999"})
    CHECK_THAT(error_of_text("a.msh", replaced(text, "$Nodes\n17", "$Nodes\n" + count)), Contains("more than a file"));
}

TEST_CASE("a quadrilateral whose sides cross about the axis has no volume around it") {
  MshText mesh;  // of its two triangles one counts as negative: the centroid lies below the axis
  mesh.nodes = {{3.75, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}};
  mesh.cells = {{CellType::quadrilateral, {0, 1, 2, 3}}};
  const Folder folder;
  MeshRequest request;
  request.file = folder.write("a.msh", mesh.text());
  request.axisymmetric = true;
  CHECK_THAT(error_of(request), Contains("element ") && Contains("has no volume around the axis"));
}
