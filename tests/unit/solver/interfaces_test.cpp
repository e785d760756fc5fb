#include "solver/interfaces.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace cobasis;

namespace {

/// n faces, face i between the cells 2 i and 2 i + 1.
struct Faced {
  Faces faces;
  Fields fields;

  Faced(int n_phases, int n_faces) {
    faces.n = n_faces;
    for (int f = 0; f < n_faces + 2 * pack_width; ++f) {
      faces.left.push_back(f < n_faces ? 2 * f : 0);
      faces.right.push_back(f < n_faces ? 2 * f + 1 : 0);
    }
    faces.fastest.assign(faces.left.size(), 0);
    fields.n_owned = fields.n_all = 2 * n_faces;
    fields.pure.assign(fields.n_all, -1);
    fields.phases.resize(n_phases);
    for (Phase& phase : fields.phases) {
      phase.alpha.assign(fields.n_all, 0);
      phase.lists.pure = CompactList<std::int32_t>(n_faces + n_parts * pack_width);
      phase.lists.mixed = CompactList<std::int32_t>(n_faces + n_parts * pack_width);
      phase.lists.mixed_share = CompactList<double>(n_faces + n_parts * pack_width);
      phase.lists.slot_of_face.assign(n_faces + 1, 0);
    }
  }
  void set(std::int32_t cell, const std::vector<double>& alpha) {
    for (int k = 0; k < fields.n_phases(); ++k) fields.phases[k].alpha[cell] = alpha[k];
    fields.complete(cell);
  }
  /// S[l][m] of each face.
  std::vector<std::vector<std::vector<double>>> shares() {
    const int n = fields.n_phases();
    Interfaces interfaces(faces, fields, {{0, faces.n}}, {}, {});
    interfaces.clear(fields);
    interfaces.sort(faces, fields, Part::inside);
    interfaces.find_contacts(faces, fields, Part::inside);
    std::vector S(faces.n, std::vector(n, std::vector<double>(n, 0)));
    for (int k = 0; k < n; ++k) {
      const Segment mixed = interfaces.mixed(k, Part::inside), pure = interfaces.pure(k, Part::inside);
      const SlotLists& lists = fields.phases[k].lists;
      for (std::int32_t i = mixed.first; i < mixed.last; ++i) S[lists.mixed[i]][k][k] = lists.mixed_share[i];
      for (std::int32_t i = pure.first; i < pure.last; ++i) S[lists.pure[i]][k][k] = 1;
      for (int m = 0; m < n; ++m) {
        if (m == k) continue;
        const Segment pairs = interfaces.pair_segment(k, m, Part::inside);
        for (std::int32_t i = pairs.first; i < pairs.last; ++i)
          S[interfaces.pair(k, m).face[i]][k][m] = interfaces.pair(k, m).share[i];
      }
    }
    return S;
  }
};

/// Fractions that sum to one, some of them zero.
std::vector<double> fractions(std::mt19937& random, int n) {
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> alpha(n);
  double sum = 0;
  for (double& a : alpha) sum += a = uniform(random) < 0.3 ? 0 : std::pow(uniform(random), 4);
  if (sum == 0) sum = alpha[0] = 1;
  for (double& a : alpha) a /= sum;
  return alpha;
}

}  // namespace

TEST_CASE("contact surfaces of N phases add up to the volume fractions of both sides") {
  std::mt19937 random(1);
  for (int n = 2; n <= 5; ++n) {
    Faced scene(n, 203);
    for (std::int32_t cell = 0; cell < scene.fields.n_all; ++cell) scene.set(cell, fractions(random, n));
    const auto S = scene.shares();
    for (int f = 0; f < scene.faces.n; ++f) {
      for (int k = 0; k < n; ++k) {
        double row = 0, column = 0;
        for (int m = 0; m < n; ++m) {
          row += S[f][k][m];
          column += S[f][m][k];
          CHECK(S[f][k][m] >= 0);
        }
        CAPTURE(n, f, k);
        const auto& alpha = scene.fields.phases[k].alpha;
        CHECK(std::fabs(row - alpha[2 * f]) < 1e-15);
        CHECK(std::fabs(column - alpha[2 * f + 1]) < 1e-15);
        CHECK(S[f][k][k] == std::min(alpha[2 * f], alpha[2 * f + 1]));
      }
    }
  }
}

TEST_CASE("contact surfaces of two phases are those of Table 1") {
  Faced scene(2, 3);
  scene.set(0, {0.75, 0.25}), scene.set(1, {0.5, 0.5});
  scene.set(2, {0.25, 0.75}), scene.set(3, {0.5, 0.5});
  scene.set(4, {1, 0}), scene.set(5, {0, 1});
  const auto S = scene.shares();
  CHECK(S[0] == std::vector<std::vector<double>>{{0.5, 0.25}, {0, 0.25}});
  CHECK(S[1] == std::vector<std::vector<double>>{{0.25, 0}, {0.25, 0.5}});
  CHECK(S[2] == std::vector<std::vector<double>>{{0, 1}, {0, 0}});
}

TEST_CASE("a face between cells that hold the same single phase is pure, whatever its neighbours are") {
  Faced scene(3, 2);
  scene.set(0, {0, 1, 0}), scene.set(1, {0, 1, 0});
  scene.set(2, {0, 1, 0}), scene.set(3, {0, 0.5, 0.5});
  const auto S = scene.shares();
  CHECK(S[0][1][1] == 1);
  CHECK(scene.fields.phases[1].lists.pure.data()[0] == 0);
  CHECK(S[1] == std::vector<std::vector<double>>{{0, 0, 0}, {0, 0.5, 0.5}, {0, 0, 0}});
  CHECK(scene.fields.phases[0].lists.slot_of_face == AlignedVector<std::int32_t>{0, 0, 0});
}

TEST_CASE("the contact surface of a trace keeps nine digits beside a phase of almost one") {
  for (const double alpha_min : {1e-5, 1e-6, 1e-8}) {
    Faced scene(3, 4);
    const double a = alpha_min, b = 1.3 * alpha_min, d = b - a;
    scene.set(0, {1 - 2 * a, a, a}), scene.set(1, {1 - a - b, b, a});  // gains of one trace
    scene.set(2, {1 - a - b, b, a}), scene.set(3, {1 - 2 * a, a, a});
    scene.set(4, {b, a, 1 - a - b}), scene.set(5, {a, b, 1 - a - b});  // two traces, the dominant phase stays
    scene.set(6, {a, a, 1 - 2 * a}), scene.set(7, {1 - 2 * a, a, a});  // an interface
    const auto S = scene.shares();
    CAPTURE(alpha_min);
    CHECK(S[0][0][1] == Approx(d).epsilon(1e-9));
    CHECK(S[1][1][0] == Approx(d).epsilon(1e-9));
    CHECK(S[2][0][1] == Approx(d).epsilon(1e-9));
    CHECK(S[2][2][1] < 1e-9 * d);
    CHECK(S[2][0][2] < 1e-9 * d);
    CHECK(S[3][2][0] == Approx(1 - 3 * a).epsilon(1e-9));
    CHECK(S[3][1][1] == a);
  }
}
