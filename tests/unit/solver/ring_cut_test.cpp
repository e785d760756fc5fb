// Planes in the cells of an axisymmetric mesh, against volumes and areas that are found in another way.
#include <catch2/catch.hpp>

#include "small_scene.hpp"
#include "solver/cut_cell.hpp"
#include "solver/plane_cut.hpp"

using namespace cobasis;

TEST_CASE("the part of a ring behind a plane is that of its volume, and the plane is found again from it") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> between(-1, 1);
  for (const CellType type : {CellType::triangle, CellType::quadrilateral}) {
    CAPTURE(shape_of(type).name);
    const Mesh mesh = small_mesh(type, 5, 0.3, true);
    double worst = 0, worst_place = 0;
    int cut = 0;
    for (std::int32_t cell = 0; cell < mesh.n_owned; ++cell) {
      const CellCorners corners = corners_of(mesh, cell);
      for (int i = 0; i < 20; ++i) {
        const double angle = 4 * between(random);
        const CutPlane plane{{std::cos(angle), std::sin(angle), 0}, 0.1 * between(random)};
        const double below = volume_below(corners, plane);
        const double exact =
            inside_fraction(HalfSpace{mesh.centroid[cell] + plane.d * plane.n, -1.0 * plane.n}, mesh, cell);
        worst = std::max(worst, std::fabs(below - exact));
        if (below < 0.01 || below > 0.99) continue;
        ++cut;
        worst_place = std::max(worst_place, std::fabs(place_plane(corners, plane.n, below) - plane.d));
      }
    }
    CHECK(cut > 200);
    CHECK(worst < 1e-12);
    CHECK(worst_place < 1e-12);
  }
}

TEST_CASE("the part of a ring's face behind a plane that moves goes with the distance from the axis") {
  const Mesh mesh = small_mesh(CellType::quadrilateral, 4, 0, true);
  const FaceOutlines outlines(mesh);
  for (std::int32_t f = 0; f < mesh.n_faces(); ++f) {
    if (std::fabs(mesh.nx[f]) < 0.9) continue;  // faces across the axis: an annulus of height 1/4
    const double low = mesh.face_centroid[f].y < 0.25 ? 0 : std::floor(4 * mesh.face_centroid[f].y) / 4;
    const double high = low + 0.25;
    const auto part = [&](double r) { return (r * r - low * low) / (high * high - low * low); };
    const Point center = outlines.center(f, 0);
    const double to_face = mesh.face_centroid[f].y - center.y;  // of the cell's centroid
    const auto wetted = [&](double r, double shift) {
      return wetted_fraction(outlines[f], center, {{0, 1, 0}, r - to_face}, shift);
    };
    CHECK(wetted(low + 0.1, 0) == Approx(part(low + 0.1)).epsilon(1e-12));
    const double from = low + 0.05, to = low + 0.15;  // the mean of the part over the way
    const double mean =
        ((to * to * to - from * from * from) / (3 * (to - from)) - low * low) / (high * high - low * low);
    CHECK(wetted(from, to - from) == Approx(mean).epsilon(1e-12));
  }
}
