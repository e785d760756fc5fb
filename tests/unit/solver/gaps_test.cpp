// Slopes of a phase beside cells that do not hold it.
#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "small_scene.hpp"
#include "solver/reconstruct.hpp"

using namespace cobasis;

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// A fluid over part of a mesh, its primitives linear there and not numbers elsewhere. `centred`: its values are those
/// at its own centroids, anywhere in the cells at its surface.
template <class G>
struct HalfFilled {
  using P = Primitives<G, Kind::fluid>;
  static constexpr int D = G::dimension;
  using Vector = Eigen::Matrix<double, D, 1>;
  using Matrix = Eigen::Matrix<double, D, D>;

  Mesh mesh;
  Faces faces;
  Stencil stencil;
  Phase phase;
  std::array<Vector, P::size> gradient;

  HalfFilled(CellType type, int n, double below, bool centred)
      : mesh(small_mesh(type, n)),
        faces(make_faces(mesh)),
        stencil(make_stencil(mesh, faces, std::vector<Boundary>(mesh.boundary_groups.size(), Inflow{}),
                             PhaseCount::several, one_rank())) {
    const std::size_t size = mesh.n_all() + pack_width;
    phase.alpha.assign(size, 0);
    phase.primitive.assign(Layout<G, Kind::fluid>::n_primitive, AlignedVector<double>(size, nothing));
    phase.slopes = CellNumbers(mesh.n_all(), P::size * D);
    std::mt19937 random(7);
    const auto any = [&] { return static_cast<double>(random()) / 0x1p31 - 1; };
    for (Vector& g : gradient)
      for (int d = 0; d < D; ++d) g[d] = any();
    if (centred) phase.centre = CellNumbers(size, D);
    const auto fill = [&](std::int32_t cell, const Point& centroid) {
      const double height = 0.6 * centroid.x + 0.7 * centroid.y - 0.3 * centroid.z;
      phase.alpha[cell] = height < below ? 1 : height < below + 0.1 ? least_for_slopes : 0;
      Point x = centroid;
      if (centred && height < below && height > below - 0.1) {
        phase.alpha[cell] = 0.6 + 0.4 * any();
        const double quarter = 0.25 / n;
        const double off[] = {quarter * any(), quarter * any(), D == 3 ? quarter * any() : 0.0};
        for (int d = 0; d < D; ++d) phase.centre.component(d)[cell] = off[d];
        x = centroid + Point{off[0], off[1], off[2]};
      }
      if (height < below)
        for (int v = 0; v < P::size; ++v) {
          phase.primitive[v][cell] = 3 + v + gradient[v][0] * x.x + gradient[v][1] * x.y;
          if constexpr (D == 3) phase.primitive[v][cell] += gradient[v][2] * x.z;
        }
    };
    for (std::int32_t cell = 0; cell < mesh.n_owned; ++cell) fill(cell, mesh.centroid[cell]);
    for (std::int32_t f = mesh.first_boundary_face(); f < mesh.n_faces(); ++f)
      fill(mesh.ghost_of(f), mesh.centroid[mesh.left[f]] + mesh.face_delta[f]);
    CellList cells(mesh.n_owned);
    for (std::int32_t cell = 0; cell < mesh.n_owned; ++cell)
      if (holds(cell)) cells.push(cell);
    const std::int32_t count = cells.size();
    cells.fill(pack_width);
    find_slopes<G, Kind::fluid, Pack, Around::gaps>(phase, faces, stencil, cells, count);
  }

  bool holds(std::int32_t cell) const { return phase.alpha[cell] > least_for_slopes; }
  Vector slope(int v, std::int32_t cell) const {
    Vector g;
    for (int d = 0; d < D; ++d) g[d] = phase.slopes.component(v * D + d)[cell];
    return g;
  }
  /// sum r r^T over the neighbours that hold the phase, times its volume fraction, and what is added to that.
  std::pair<Matrix, Matrix> moments(std::int32_t cell) const {
    Matrix held = Matrix::Zero(), ridge = Matrix::Zero();
    for (int j = 0; j < mesh.max_cell_faces; ++j) {
      const std::int32_t entry = mesh.cell_faces[static_cast<std::size_t>(j) * mesh.cell_stride + cell];
      if (entry < 0) continue;
      const Point delta = (entry & 1 ? -1.0 : 1.0) * mesh.face_delta[entry >> 1];
      Vector r{};
      r[0] = delta.x, r[1] = delta.y;
      if constexpr (D == 3) r[2] = delta.z;
      ridge += always_known * r * r.transpose();
      const std::int32_t other = entry & 1 ? mesh.left[entry >> 1] : mesh.right[entry >> 1];
      if (!holds(other)) {
        ridge += least_known * r * r.transpose();
        continue;
      }
      for (int d = 0; d < D && phase.centre.stride != 0; ++d)
        r[d] += phase.centre.component(d)[other] - phase.centre.component(d)[cell];
      held += phase.alpha[other] * r * r.transpose();
    }
    return {held, ridge};
  }

  /// With P and S these sums, the slope g of a linear field with gradient G minimises sum w (r·(g - G))^2 over the
  /// neighbours held plus g·S g: (P + S) g = P G. Where all neighbours hold the phase it is G but for always_known;
  /// where nothing is known of a direction, it is 0 there.
  void check() const {
    int beside = 0, inside = 0;
    double predicted = 0, worst_inside = 0;
    for (std::int32_t cell = 0; cell < mesh.n_owned; ++cell) {
      if (!holds(cell)) continue;
      const auto [held, ridge] = moments(cell);
      const bool has_all = ridge.norm() < 0.005 * held.norm();
      ++(has_all ? inside : beside);
      const Eigen::SelfAdjointEigenSolver<Matrix> known(held);
      for (int v = 0; v < P::size; ++v) {
        const Vector g = slope(v, cell), expected = (held + ridge).ldlt().solve(held * gradient[v]);
        predicted = std::max(predicted, (g - expected).norm());
        if (has_all) worst_inside = std::max(worst_inside, (g - gradient[v]).norm() / gradient[v].norm());
        if (phase.centre.stride != 0) continue;
        for (int d = 0; d < D; ++d)
          if (known.eigenvalues()[d] < 1e-12 * known.eigenvalues()[D - 1])
            CHECK(std::fabs(known.eigenvectors().col(d).dot((held + ridge) * g)) < 1e-11 * gradient[v].norm());
      }
    }
    CHECK(beside > 5);
    CHECK(inside > 5);
    CHECK(predicted < 1e-11);
    CHECK(worst_inside < 0.02);
  }
};

}  // namespace

TEST_CASE("gradients beside gaps are those of a linear field, but for the share by which directions may be unknown") {
  for (const bool centred : {false, true}) {
    HalfFilled<Plane>(CellType::quadrilateral, 12, 0.7, centred).check();
    HalfFilled<Plane>(CellType::triangle, 12, 0.7, centred).check();
    HalfFilled<Space>(CellType::hexahedron, 7, 0.5, centred).check();
  }
}
