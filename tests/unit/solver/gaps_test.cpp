// Slopes of a phase beside cells that do not hold it.
#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "small_scene.hpp"
#include "solver/reconstruct.hpp"

using namespace cobasis;

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// A fluid over part of a mesh, its primitives linear there and not numbers elsewhere.
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

  HalfFilled(CellType type, int n, double below)
      : mesh(small_mesh(type, n)),
        faces(make_faces(mesh)),
        stencil(make_stencil(mesh, faces, std::vector<Boundary>(mesh.boundary_groups.size(), Inflow{}), one_rank())) {
    const std::size_t size = mesh.n_all() + pack_width;
    phase.alpha.assign(size, 0);
    phase.primitive.assign(Layout<G, Kind::fluid>::n_primitive, AlignedVector<double>(size, nothing));
    phase.slopes = CellNumbers(mesh.n_all(), P::size * D);
    std::mt19937 random(7);
    const auto any = [&] { return static_cast<double>(random()) / 0x1p31 - 1; };
    for (Vector& g : gradient)
      for (int d = 0; d < D; ++d) g[d] = any();
    const auto fill = [&](std::int32_t cell, const Point& x) {
      const double height = 0.6 * x.x + 0.7 * x.y - 0.3 * x.z;
      phase.alpha[cell] = height < below ? 1 : height < below + 0.1 ? least_for_slopes : 0;
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
  /// sum r r^T over the neighbours that hold the phase, and over all.
  std::pair<Matrix, Matrix> moments(std::int32_t cell) const {
    Matrix held = Matrix::Zero(), all = Matrix::Zero();
    for (int j = 0; j < mesh.max_cell_faces; ++j) {
      const std::int32_t entry = mesh.cell_faces[static_cast<std::size_t>(j) * mesh.cell_stride + cell];
      if (entry < 0) continue;
      const Point delta = mesh.face_delta[entry >> 1];
      Vector r{};
      r[0] = delta.x, r[1] = delta.y;
      if constexpr (D == 3) r[2] = delta.z;
      all += r * r.transpose();
      if (holds(entry & 1 ? mesh.left[entry >> 1] : mesh.right[entry >> 1])) held += r * r.transpose();
    }
    return {held, all};
  }

  /// With P and M these sums, the slope g of a linear field with gradient G minimises sum (r·(g - G))^2 over the
  /// neighbours held plus s g·M g, s = least_known: (P + s M) g = P G. In the norm of M, where the share of the stencil
  /// known in any direction is at least c, |g - G| <= s / (c + s) |G|; where that is nothing, the slope is 0.
  void check() const {
    int beside = 0;
    double predicted = 0, worst = 0;
    for (std::int32_t cell = 0; cell < mesh.n_owned; ++cell) {
      if (!holds(cell)) continue;
      const auto [held, all] = moments(cell);
      if ((all - held).norm() < 1e-12 * all.norm()) continue;
      ++beside;
      const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> known(held, all);
      const double share = std::max(0.0, known.eigenvalues()[0]);
      const Matrix ridge = held + least_known * all;
      for (int v = 0; v < P::size; ++v) {
        const Vector g = slope(v, cell), error = g - gradient[v], expected = ridge.ldlt().solve(held * gradient[v]);
        const double size = std::sqrt(gradient[v].dot(all * gradient[v]));
        const double off = std::sqrt(error.dot(all * error));
        predicted = std::max(predicted, (g - expected).norm());
        worst = std::max(worst, off / (least_known / (share + least_known) * size));
        for (int d = 0; d < D; ++d) {  // eigenvectors: x·M x = 1
          if (known.eigenvalues()[d] > 1e-12) continue;
          const Vector direction = known.eigenvectors().col(d);
          CHECK(std::fabs(direction.dot(all * g)) < 1e-11 * size);
        }
      }
    }
    CHECK(beside > 5);
    CHECK(predicted < 1e-11);
    CHECK(worst < 1 + 1e-10);
    CHECK(worst > 0.9);  // the bound is sharp
  }
};

}  // namespace

TEST_CASE("gradients beside gaps are those of a linear field, but for the share by which directions may be unknown") {
  HalfFilled<Plane>(CellType::quadrilateral, 12, 0.7).check();
  HalfFilled<Plane>(CellType::triangle, 12, 0.7).check();
  HalfFilled<Space>(CellType::hexahedron, 7, 0.5).check();
}
