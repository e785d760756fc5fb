#include "physics/smooth_flow.hpp"

#include <catch2/catch.hpp>

#include "physics/eos.hpp"
#include "random_states.hpp"

using namespace cobasis;

namespace {

template <class G, Kind K>
struct Flow {
  using P = Primitives<G, K>;
  using State = typename P::template State<double>;
  static constexpr int D = G::dimension;
  static constexpr int n_laws = D + 2;  // mass, momentum, energy

  HyperelasticMaterial material{92e9, 8900, 0.2};
  StiffenedGas eos{4.22, 34.2e9};
  State w;
  typename P::template Gradients<double> gradient;

  explicit Flow(Random& random) {
    w[P::rho] = material.rho0 * random.between(0.8, 1.3);
    for (int d = 0; d < D; ++d) w[P::u + d] = random.between(-800, 800);
    w[P::p] = random.between(-2e9, 8e9);
    double size[P::size];
    size[P::rho] = w[P::rho], size[P::p] = 1e10;
    for (int d = 0; d < D; ++d) size[P::u + d] = 1000;
    if constexpr (K == Kind::solid) {
      const auto [in_plane, in_space] = plane_strain(random);
      const Rows<double> e = rows<double>(D == 2 ? in_space : random.cobasis(0.3));
      for (int c = 0; c < P::n_cobasis; ++c) {
        w[P::e + c] = D == 3 ? e[c / 3][c % 3] : c == 4 ? e[2][2] : e[c / 2][c % 2];
        size[P::e + c] = 1;
      }
    }
    for (int v = 0; v < P::size; ++v)
      for (double& slope : gradient[v]) slope = random.between(-0.3, 0.3) * size[v];
  }

  /// The state at a distance along an axis.
  State at(int d, double x) const {
    State s = w;
    for (int v = 0; v < P::size; ++v) s[v] += gradient[v][d] * x;
    return s;
  }
  State after(double time) const {
    const State rate = rates();
    State s = w;
    for (int v = 0; v < P::size; ++v) s[v] += rate[v] * time;
    return s;
  }
  State rates() const {
    return rates_of_change<G, K, double>(material, w, gradient, eos.sound_speed_squared(w[P::rho], w[P::p]));
  }

  static Cobasis<G, double> cobasis(const State& s) {
    return make_cobasis<G>([&](int c) { return s[P::e + c]; });
  }
  std::array<std::array<double, 3>, 3> stress(const State& s) const {
    std::array<std::array<double, 3>, 3> sigma{};
    if constexpr (K == Kind::solid) {
      const auto S = deviatoric_stress<G, double>(material, s[P::rho], normalised_metric(cobasis(s)));
      sigma[0][0] = S.xx, sigma[1][1] = S.yy, sigma[2][2] = S.zz, sigma[0][1] = sigma[1][0] = S.xy;
      if constexpr (D == 3) sigma[0][2] = sigma[2][0] = S.xz, sigma[1][2] = sigma[2][1] = S.yz;
    }
    for (int i = 0; i < 3; ++i) sigma[i][i] -= s[P::p];
    return sigma;
  }
  std::array<double, n_laws> densities(const State& s) const {
    std::array<double, n_laws> U;
    double E = eos.energy(s[P::rho], s[P::p]);
    if constexpr (K == Kind::solid) E += elastic_energy(material, normalised_metric(cobasis(s)));
    U[0] = s[P::rho];
    for (int i = 0; i < D; ++i) {
      E += 0.5 * s[P::u + i] * s[P::u + i];
      U[1 + i] = s[P::rho] * s[P::u + i];
    }
    U[1 + D] = s[P::rho] * E;
    return U;
  }
  std::array<double, n_laws> fluxes(const State& s, int d) const {
    std::array<double, n_laws> F = densities(s);
    for (double& f : F) f *= s[P::u + d];
    const auto sigma = stress(s);
    for (int i = 0; i < D; ++i) {
      F[1 + i] -= sigma[i][d];
      F[1 + D] -= sigma[i][d] * s[P::u + i];
    }
    return F;
  }
};

constexpr double dx = 1e-4, dt = 2e-8;  // a sound wave passes about dx in dt

/// Largest residual of mass, momentum and energy, over the largest term of each.
template <class G, Kind K>
double residual_of_balances(const Flow<G, K>& flow) {
  const auto later = flow.densities(flow.after(dt)), earlier = flow.densities(flow.after(-dt));
  double worst = 0;
  for (int law = 0; law < flow.n_laws; ++law) {
    double sum = (later[law] - earlier[law]) / (2 * dt), largest = std::fabs(sum);
    for (int d = 0; d < G::dimension; ++d) {
      const double term = (flow.fluxes(flow.at(d, dx), d)[law] - flow.fluxes(flow.at(d, -dx), d)[law]) / (2 * dx);
      sum += term;
      largest = std::max(largest, std::fabs(term));
    }
    worst = std::max(worst, std::fabs(sum) / largest);
  }
  return worst;
}

template <class G, Kind K>
void check_balances() {
  Random random(3);
  double worst = 0;
  for (int i = 0; i < 200; ++i) worst = std::max(worst, residual_of_balances(Flow<G, K>(random)));
  INFO("largest relative residual " << worst);
  CHECK(worst < 1e-7);
}

/// The same around an axis, at the distance r: densities and fluxes times r, and the stress of the hoop.
template <Kind K>
void check_balances_around_axis() {
  using P = Primitives<Plane, K>;
  Random random(13);
  double worst = 0, worst_volume = 0;
  for (int i = 0; i < 200; ++i) {
    const Flow<Plane, K> flow(random);
    const double r = random.between(0.1, 0.3), ch2 = flow.eos.sound_speed_squared(flow.w[P::rho], flow.w[P::p]);
    auto rate = flow.rates();
    add_hoop_rates<K, double>(flow.material, flow.w, ch2, 1 / r, rate);
    const auto after = [&](double time) {
      auto s = flow.w;
      for (int v = 0; v < P::size; ++v) s[v] += rate[v] * time;
      return s;
    };
    CHECK(hoop_pressure<K>(flow.material, flow.w) == Approx(-flow.stress(flow.w)[2][2]));
    const auto terms = [&](const auto& flux) {
      return std::array{r * (flux(flow.at(0, dx), 0) - flux(flow.at(0, -dx), 0)) / (2 * dx),
                        ((r + dx) * flux(flow.at(1, dx), 1) - (r - dx) * flux(flow.at(1, -dx), 1)) / (2 * dx)};
    };
    const auto later = flow.densities(after(dt)), earlier = flow.densities(after(-dt));
    for (int law = 0; law < flow.n_laws; ++law) {
      const double change = r * (later[law] - earlier[law]) / (2 * dt);
      const auto flux = terms([&](const auto& s, int d) { return flow.fluxes(s, d)[law]; });
      const double hoop = law == 2 ? flow.stress(flow.w)[2][2] : 0;
      const double largest = std::max({std::fabs(change), std::fabs(flux[0]), std::fabs(flux[1]), std::fabs(hoop)});
      worst = std::max(worst, std::fabs(change + flux[0] + flux[1] + hoop) / largest);
    }
    if constexpr (K == Kind::solid) {
      const auto det = [&](const auto& s) { return determinant(flow.cobasis(s)); };
      const auto flux = terms([&](const auto& s, int d) { return s[P::u + d] * det(s); });
      worst_volume =
          std::max(worst_volume, std::fabs(r * (det(after(dt)) - det(after(-dt))) / (2 * dt) + flux[0] + flux[1]));
    }
  }
  INFO("largest relative residual " << worst << ", of det e " << worst_volume << " m/s");
  CHECK(worst < 1e-5);  // differences over dt: (u dt / r)^2 of terms that may nearly cancel
  CHECK(worst_volume < 1e-4);
}

template <class G>
void check_stress_divergence() {
  Random random(5);
  double worst = 0;
  for (int i = 0; i < 200; ++i) {
    const Flow<G, Kind::solid> flow(random);
    using P = Primitives<G, Kind::solid>;
    const auto force = stress_divergence<G, double>(flow.material, flow.w, flow.gradient);
    for (int k = 0; k < G::dimension; ++k) {
      double sum = 0;
      for (int d = 0; d < G::dimension; ++d) {
        const auto ahead = flow.at(d, dx), behind = flow.at(d, -dx);
        const auto S = [&](const auto& s) { return flow.stress(s)[k][d] + (k == d ? s[P::p] : 0); };
        sum += (S(ahead) - S(behind)) / (2 * dx);
      }
      worst = std::max(worst, std::fabs(force[k] - sum) / flow.material.mu);
    }
  }
  INFO("largest error of a force, over mu / m: " << worst);
  CHECK(worst < 1e-7);
}

/// d/dt e_i + d_i (u_j e_j) + u_j (d_j e_i - d_i e_j) = 0, and d/dt det e + div (u det e) = 0.
template <class G>
void check_cobasis() {
  Random random(7);
  double worst = 0, worst_volume = 0;
  for (int n = 0; n < 200; ++n) {
    const Flow<G, Kind::solid> flow(random);
    using P = Primitives<G, Kind::solid>;
    constexpr int D = G::dimension;
    const auto rate = flow.rates();
    const auto along = [&](const auto& s, int beta) {
      double sum = 0;
      for (int j = 0; j < D; ++j) sum += s[P::u + j] * s[P::e + beta * D + j];
      return sum;
    };
    for (int beta = 0; beta < D; ++beta) {
      for (int i = 0; i < D; ++i) {
        double sum =
            rate[P::e + beta * D + i] + (along(flow.at(i, dx), beta) - along(flow.at(i, -dx), beta)) / (2 * dx);
        for (int j = 0; j < D; ++j)
          sum += flow.w[P::u + j] * (flow.gradient[P::e + beta * D + i][j] - flow.gradient[P::e + beta * D + j][i]);
        worst = std::max(worst, std::fabs(sum));
      }
    }
    const auto det = [&](const auto& s) { return determinant(flow.cobasis(s)); };
    double sum = (det(flow.after(dt)) - det(flow.after(-dt))) / (2 * dt);
    for (int d = 0; d < D; ++d) {
      const auto flux = [&](const auto& s) { return s[P::u + d] * det(s); };
      sum += (flux(flow.at(d, dx)) - flux(flow.at(d, -dx))) / (2 * dx);
    }
    worst_volume = std::max(worst_volume, std::fabs(sum));
  }
  INFO("largest residuals, over 1 / s: " << worst << " of e, " << worst_volume << " of det e");
  CHECK(worst < 1e-6);
  CHECK(worst_volume < 1e-4);  // of some thousands
}

}  // namespace

TEST_CASE("rates of change of a smooth flow are those of mass, momentum and energy") {
  SECTION("plane fluid") { check_balances<Plane, Kind::fluid>(); }
  SECTION("plane solid") { check_balances<Plane, Kind::solid>(); }
  SECTION("fluid in space") { check_balances<Space, Kind::fluid>(); }
  SECTION("solid in space") { check_balances<Space, Kind::solid>(); }
}

TEST_CASE("rates of change around an axis are those of mass, momentum, energy and volume") {
  SECTION("fluid") { check_balances_around_axis<Kind::fluid>(); }
  SECTION("solid") { check_balances_around_axis<Kind::solid>(); }
}

TEST_CASE("the divergence of the stress is that of central differences") {
  SECTION("plane") { check_stress_divergence<Plane>(); }
  SECTION("space") { check_stress_divergence<Space>(); }
}

TEST_CASE("rates of change of the cobasis are those of gradients of convected labels, and of the volume") {
  SECTION("plane") { check_cobasis<Plane>(); }
  SECTION("space") { check_cobasis<Space>(); }
}

TEST_CASE("rates of change on packs are those on single numbers") {
  using P = Primitives<Space, Kind::solid>;
  Random random(11);
  std::vector<Flow<Space, Kind::solid>> flows;
  for (int k = 0; k < pack_width; ++k) flows.emplace_back(random);
  const auto packed = [&](const auto& value) {
    alignas(64) double values[pack_width];
    for (int k = 0; k < pack_width; ++k) values[k] = value(flows[k]);
    return load<Pack>(values);
  };
  P::State<Pack> w;
  P::Gradients<Pack> gradient;
  for (int v = 0; v < P::size; ++v) {
    w[v] = packed([&](const auto& flow) { return flow.w[v]; });
    for (int d = 0; d < 3; ++d) gradient[v][d] = packed([&](const auto& flow) { return flow.gradient[v][d]; });
  }
  const Pack ch2 = packed([&](const auto& f) { return f.eos.sound_speed_squared(f.w[P::rho], f.w[P::p]); });
  const auto rate = rates_of_change<Space, Kind::solid, Pack>(flows[0].material, w, gradient, ch2);
  for (int k = 0; k < pack_width; ++k) {
    const auto single = flows[k].rates();
    for (int v = 0; v < P::size; ++v) CHECK(lane(rate[v], k) == Approx(single[v]).epsilon(1e-13));
  }
}
