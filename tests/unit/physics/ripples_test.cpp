#include "physics/ripples.hpp"

#include <catch2/catch.hpp>

#include "physics/smooth_flow.hpp"

using namespace cobasis;

namespace {

const HyperelasticMaterial neo_hookean{.mu = 3, .rho0 = 1, .a = -1};

/// Stretched by `length`, `height`, `width` along x, y, z with det = 1, then turned about z; ch2 is large.
template <class G>
SolidState<G, double> stretched_block(double length, double height, double width, double angle = 0) {
  const double c = std::cos(angle), s = std::sin(angle);
  const double rows[3][3] = {
      {c / length, s / length, 0}, {-s / height, c / height, 0}, {0, 0, 1 / width}};  // e^beta of F = R diag
  SolidState<G, double> state;
  state.rho = 1, state.p = 7, state.ch2 = 1e4, state.E = 0;
  state.g = normalised_metric(make_cobasis<G>([&](int i) {
    if constexpr (G::dimension == 2)
      return i == 4 ? rows[2][2] : rows[i / 2][i % 2];
    else
      return rows[i / 3][i % 3];
  }));
  return state;
}

/// mu (height^2 - most^2) less a hundredth of rho c_s^2 = mu height^2, at most 3 mu: closed form of incompressible
/// neo-Hookean.
double exact(double height, double most) {
  return std::sqrt(neo_hookean.mu * std::clamp(height * height * (1 - 0.01) - most * most, 0.0, 3.0));
}

Frame<Plane, double> surface(double angle) {  // normal y before the body is turned
  const double c = std::cos(angle), s = std::sin(angle);
  return {{-s, c, {}}, {-c, -s, {}}, {{}, {}, 1.0}};
}

}  // namespace

TEST_CASE("ripples run along a compressed surface with the root of the excess of stress over density") {
  for (const double angle : {0.0, 0.3, 2.0})
    for (const double length : {0.3, 0.65, 0.95})
      CHECK(ripple_speed(neo_hookean, stretched_block<Plane>(length, 1 / length, 1, angle), surface(angle)) ==
            Approx(exact(1 / length, length)).epsilon(1e-12));
}

TEST_CASE("there are no ripples where a surface is stretched, nor under pressure alone") {
  CHECK(ripple_speed(neo_hookean, stretched_block<Plane>(1.3, 1 / 1.3, 1), surface(0)) == 0);
  CHECK(ripple_speed(neo_hookean, stretched_block<Plane>(1, 1, 1, 0.7), surface(0.2)) == 0);
}

TEST_CASE("ripples are no faster than sound") {
  SolidState<Plane, double> soft = stretched_block<Plane>(0.3, 1 / 0.3, 1);
  soft.ch2 = 0;
  CHECK(ripple_speed(neo_hookean, soft, surface(0)) <= face_state(neo_hookean, soft, surface(0)).c1);
}

TEST_CASE(
    "in space the tangent along which the surface is compressed most counts, whatever the tangents of its frame") {
  const double along_x = 0.7, along_z = 0.9, height = 1 / (along_x * along_z);
  const SolidState<Space, double> block = stretched_block<Space>(along_x, height, along_z);
  for (const double angle : {0.0, 0.4, 1.2}) {
    const double c = std::cos(angle), s = std::sin(angle);
    const Frame<Space, double> top{{0, 1, 0}, {c, 0, -s}, {-s, 0, -c}};
    CHECK(ripple_speed(neo_hookean, block, top) == Approx(exact(height, along_x)).epsilon(1e-12));
  }
}
