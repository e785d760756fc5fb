#include "mesh/mesh_info.hpp"

#include "mesh_files.hpp"
#include "mixed_mesh.hpp"

using namespace cobasis;

TEST_CASE("a mesh is described by types, groups, quality and parts") {
  const Folder folder;
  MeshRequest request;
  request.file = folder.write("a.msh", mixed_mesh(0).text());
  const MeshInfo info = mesh_info(request);
  CHECK(info.cells == 11);
  CHECK(info.cells_by_type == std::array<std::int64_t, 6>{0, 0, 4, 1, 2, 4});
  CHECK(info.volume == Approx(3).epsilon(1e-14));
  CHECK(info.high.x == 3);
  CHECK(info.smallest_volume == Approx(1.0 / 12));
  CHECK(info.largest_volume == Approx(1));
  CHECK(info.worst_warp == 0);
  REQUIRE(info.regions.size() == 1);
  CHECK(info.regions[0].count == 11);
  REQUIRE(info.boundaries.size() == 1);
  CHECK(info.boundaries[0].measure == Approx(14));
  REQUIRE(info.parts.size() == 3);
  for (const MeshInfo::Parts& parts : info.parts) {
    CHECK(parts.cut_faces > 0);
    CHECK(parts.most_cells >= 11 / parts.n);
    CHECK(parts.most_cells < 11);
  }
  const std::string text = format(info);
  for (const char* word : {"hexahedron", "prism", "wall", "body", "8 ranks"}) CHECK_THAT(text, Catch::Contains(word));
}

TEST_CASE("squares have aspect 1, warped faces a warp") {
  const Folder folder;
  MeshRequest request;
  request.file = folder.write("a.geo", strip_geo(3, 3));
  CHECK(mesh_info(request).worst_aspect == Approx(1));
  request.file = folder.write("a.msh", mixed_mesh(0.2).text());
  // corners +-0.155 off a plane of slopes -0.03 and -0.09
  CHECK(mesh_info(request).worst_warp == Approx(0.155 * std::pow(1.009, -0.75)));
}

TEST_CASE("the box of mixed cells has all types, and its volume, from four cells along x") {
  MeshRequest request;
  request.file = SOURCE_DIR "/meshes/box_space.geo";
  for (const int n : {4, 5, 6, 7, 8}) {
    CAPTURE(n);
    request.parameters = {{"element", 0}, {"n", n}};
    const MeshInfo info = mesh_info(request);
    CHECK(info.volume == Approx(1));
    CHECK(std::ranges::count(info.cells_by_type, 0) == 2);
  }
}
