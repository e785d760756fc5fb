#include "solver/volume_exchange.hpp"

#include <catch2/catch.hpp>

#include "small_scene.hpp"

using namespace cobasis;

namespace {

constexpr int solid = 0, liquid = 1;

/// A solid and a liquid, flowing along x at 1 m/s, in rectangles of height 1.
struct Strip {
  Mesh mesh;
  Faces faces;
  Fields fields;
  std::unique_ptr<VolumeExchange> exchange;

  explicit Strip(const std::vector<double>& x, const ExchangeThresholds& thresholds = diffuse_exchange)
      : mesh(strip(x)), faces(make_faces(mesh)) {
    fields.dimension = 2;
    fields.n_owned = mesh.n_owned, fields.n_all = mesh.n_all();
    fields.volume.assign(mesh.volume.begin(), mesh.volume.end());
    fields.pure.assign(mesh.n_all(), 0);
    fields.phases.resize(2);
    for (Phase& phase : fields.phases) {
      phase.alpha.assign(mesh.n_all(), 0);
      phase.conserved.assign(4, AlignedVector<double>(mesh.n_all(), 0));
    }
    Phase& s = fields.phases[solid];
    s.kind = Kind::solid;
    for (int c = 0; c < Plane::n_cobasis; ++c)
      s.conserved.push_back(AlignedVector<double>(mesh.n_all(), identity_cobasis(2, c)));
    exchange = std::make_unique<VolumeExchange>(one_rank(), mesh, fields, thresholds);
  }

  std::int32_t cell(double x) const { return cell_at(mesh, x); }

  /// Fills a cell; states differ from cell to cell by `variation`.
  void set(double x, double alpha_solid, double variation = 0) {
    const std::int32_t i = cell(x);
    fields.phases[solid].alpha[i] = alpha_solid, fields.phases[liquid].alpha[i] = 1 - alpha_solid;
    fields.complete(i);
    const double more = 1 + variation * x;
    for (int k = 0; k < 2; ++k) {
      Phase& phase = fields.phases[k];
      const double mass = (k == solid ? 8900 : 1000) * more * phase.alpha[i], u = more, v = variation * x;
      phase.conserved[0][i] = mass, phase.conserved[1][i] = mass * u, phase.conserved[2][i] = mass * v;
      phase.conserved[3][i] = mass * 1e6 * more * more;
    }
    for (int c = 0; c < Plane::n_cobasis; ++c)
      fields.phases[solid].conserved[4 + c][i] = alpha_solid == 0 ? identity_cobasis(2, c) : 0.1 * c + more;
  }
  double alpha(int k, double x) const { return fields.phases[k].alpha[cell(x)]; }
  /// rho, u, v, E, e of a phase in a cell.
  std::vector<double> intensive(int k, double x) const {
    const Phase& phase = fields.phases[k];
    const std::int32_t i = cell(x);
    std::vector<double> values{phase.conserved[0][i] / phase.alpha[i]};
    for (int c = 1; c < 4; ++c) values.push_back(phase.conserved[c][i] / phase.conserved[0][i]);
    for (int c = 4; c < phase.n_conserved(); ++c) values.push_back(phase.conserved[c][i]);
    return values;
  }
  /// Volume, mass, momentum, energy and volume times cobasis of a phase over all cells.
  std::vector<double> totals(int k) const {
    const Phase& phase = fields.phases[k];
    std::vector<double> sums(1 + phase.n_conserved(), 0.0);
    for (std::int32_t i = 0; i < mesh.n_owned; ++i) {
      const double V = mesh.volume[i];
      sums[0] += V * phase.alpha[i];
      for (int c = 0; c < phase.n_conserved(); ++c)
        sums[1 + c] += V * phase.conserved[c][i] * (c < 4 ? 1 : phase.alpha[i]);
    }
    return sums;
  }
  void run(double dt = 1, const std::vector<std::pair<double, int>>& forced = {}) {
    std::vector<std::pair<std::int32_t, int>> fragments;
    for (const auto& [x, k] : forced) fragments.emplace_back(cell(x), k);
    std::sort(fragments.begin(), fragments.end());
    std::vector<std::int32_t> candidates(mesh.n_owned);
    for (std::int32_t i = 0; i < mesh.n_owned; ++i) candidates[i] = i;
    exchange->run(mesh, faces, fields, dt, candidates, fragments);
  }
  void check_counters(int exchanges, int kept, int dust) const {
    CHECK(exchange->counters().exchanges == exchanges);
    CHECK(exchange->counters().kept == kept);
    CHECK(exchange->counters().dust == dust);
  }
  double exchanged_volume() const {
    double sum = 0;
    for (const double v : exchange->volume_of_cell()) sum += v;
    return sum;
  }
};

void check_close(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CAPTURE(i);
    CHECK(a[i] == Approx(b[i]).epsilon(tolerance).margin(1e-300));
  }
}

}  // namespace

TEST_CASE("a small volume changes places with an equal volume of the neighbour that has more of the phase") {
  Strip s({0, 1, 3, 4});  // volumes 1, 2, 1
  s.set(0.5, 4e-4), s.set(2, 0.6), s.set(3.5, 1);
  s.run();
  s.check_counters(1, 0, 0);
  CHECK(s.exchanged_volume() == Approx(4e-4).epsilon(1e-15));
  CHECK(s.alpha(solid, 0.5) == 0);
  CHECK(s.alpha(liquid, 0.5) == 1);
  CHECK(s.alpha(solid, 2) == Approx(0.6 + 2e-4).epsilon(1e-15));
  CHECK(s.alpha(liquid, 2) == Approx(0.4 - 2e-4).epsilon(1e-15));
  CHECK(s.fields.pure[s.cell(0.5)] == liquid);
  CHECK(s.fields.phases[solid].conserved[0][s.cell(0.5)] == 0);
  for (int c = 0; c < Plane::n_cobasis; ++c)
    CHECK(s.fields.phases[solid].conserved[4 + c][s.cell(0.5)] == identity_cobasis(2, c));
}

TEST_CASE("an exchange conserves volume, mass, momentum, energy and volume times cobasis of each phase") {
  Strip s({0, 1, 3, 4, 5.5, 6});
  s.set(0.5, 4e-4, 0.1), s.set(2, 0.6, 0.1), s.set(3.5, 3e-4, 0.1), s.set(4.75, 0.5, 0.1), s.set(5.75, 1 - 2e-4, 0.1);
  // the absent solid left behind counts nothing: volume times cobasis is zero there
  const std::vector<double> solid_before = s.totals(solid), liquid_before = s.totals(liquid);
  s.run();
  CHECK(s.exchange->counters().exchanges == 3);
  CHECK(s.exchanged_volume() == Approx(4e-4 + 3e-4 + 0.5 * 2e-4).epsilon(1e-12));
  check_close(s.totals(solid), solid_before, 1e-15);
  check_close(s.totals(liquid), liquid_before, 1e-15);
}

TEST_CASE("uniform density, velocity, energy and cobasis stay so") {
  Strip s({0, 1, 3, 4});
  s.set(0.5, 4e-4), s.set(2, 0.6), s.set(3.5, 1 - 3e-4);
  const std::vector<double> rigid = s.intensive(solid, 2), wet = s.intensive(liquid, 2);
  s.run();
  s.check_counters(2, 0, 0);
  check_close(s.intensive(solid, 2), rigid, 1e-15);
  check_close(s.intensive(solid, 3.5), rigid, 1e-15);
  check_close(s.intensive(liquid, 0.5), wet, 1e-15);
  check_close(s.intensive(liquid, 2), wet, 1e-15);
}

TEST_CASE("what a donor keeps of the phase it gives is as it was, and what moves is mixed by volume") {
  Strip s({0, 1, 3, 4});
  s.set(0.5, 4e-4, 0.2), s.set(2, 0.6, 0.2), s.set(3.5, 1, 0.2);
  const auto moved = s.intensive(solid, 0.5), met = s.intensive(solid, 2), kept = s.intensive(liquid, 2);
  s.run();
  check_close(s.intensive(liquid, 2), kept, 1e-14);
  const auto mixed = s.intensive(solid, 2);
  const double share = 4e-4 / (1.2 + 4e-4);
  CHECK(mixed[0] == Approx(met[0] + share * (moved[0] - met[0])).epsilon(1e-14));
  for (int c = 4; c < 4 + Plane::n_cobasis; ++c)
    CHECK(mixed[c] == Approx(met[c] + share * (moved[c] - met[c])).epsilon(1e-14));
}

TEST_CASE("a front that has just entered from a cell without the other phase is kept") {
  Strip s({0, 1, 2});
  s.set(0.5, 1), s.set(1.5, 4e-4);
  s.run();
  s.check_counters(0, 1, 0);
  CHECK(s.alpha(solid, 1.5) == 4e-4);
  CHECK(s.exchanged_volume() == 0);
  s.run();
  s.check_counters(0, 2, 0);  // summed over steps
}

TEST_CASE("round-off of a phase beside a cell that is pure in it is swept up without volume, and conserved") {
  Strip s({0, 1, 2});
  s.set(0.5, 1), s.set(1.5, 5e-12);
  const std::vector<double> before = s.totals(solid), wet = s.totals(liquid);
  s.run();
  s.check_counters(0, 0, 1);
  CHECK(s.alpha(solid, 0.5) == 1);
  CHECK(s.alpha(solid, 1.5) == 0);
  CHECK(s.alpha(liquid, 1.5) == 1);
  const std::vector<double> after = s.totals(solid), after_wet = s.totals(liquid);
  for (int c = 1; c <= 4; ++c) CHECK(after[c] == Approx(before[c]).epsilon(1e-15));
  for (int c = 1; c <= 4; ++c) CHECK(after_wet[c] == wet[c]);
  CHECK(after[0] == Approx(before[0]).epsilon(1e-11));
}

TEST_CASE("dust goes to a neighbour that is no dust, be that so full that it must take it without volume") {
  Strip s({0, 1, 2, 3});
  s.set(0.5, 5e-13), s.set(1.5, 5e-14), s.set(2.5, 0.999);
  const std::vector<double> before = s.totals(solid);
  s.run();
  CHECK(s.alpha(solid, 1.5) == 0);
  CHECK(s.alpha(solid, 2.5) == 0.999);
  const std::vector<double> after = s.totals(solid);
  for (int c = 1; c <= 4; ++c) CHECK(after[c] == Approx(before[c]).epsilon(1e-15));
}

TEST_CASE("a negative volume fraction, from round-off, is filled up from the neighbour") {
  Strip s({0, 1, 2});
  s.set(0.5, 0.5), s.set(1.5, -3e-17);
  const std::vector<double> before = s.totals(solid);
  s.run();
  s.check_counters(1, 0, 0);
  CHECK(s.alpha(solid, 1.5) == 0);
  CHECK(s.fields.pure[s.cell(1.5)] == liquid);
  check_close(s.totals(solid), before, 1e-15);
}

TEST_CASE("a negative volume goes to the neighbour with as much of the cell's own other phase") {
  // the neighbour's tiny volume of liquid, of quite another state, has no part in it
  for (const double tiny : {0.0, 1e-14, 1e-9, 1e-3}) {
    CAPTURE(tiny);
    const double exact = tiny == 1e-14 ? 1e-9 : 1e-14;  // so little is swept up at the same time, without volume
    Strip s({0, 1, 3});
    s.set(2, 1 - tiny, 5), s.set(0.5, -2e-3, 0.1);
    const std::vector<double> rigid = s.totals(solid), wet = s.totals(liquid);
    const std::vector<double> own = s.intensive(liquid, 0.5), alien = s.intensive(liquid, 2);
    s.run();
    CHECK(s.exchange->counters().exchanges == 1);
    CHECK(s.alpha(solid, 0.5) == 0);
    CHECK(s.alpha(liquid, 0.5) == 1);
    CHECK(s.fields.pure[s.cell(0.5)] == liquid);
    CHECK(s.alpha(solid, 2) == Approx(1 - tiny - 1e-3).epsilon(exact));
    CHECK(s.alpha(liquid, 2) == Approx(tiny + 1e-3).epsilon(100 * exact));
    check_close(s.totals(solid), rigid, exact);
    check_close(s.totals(liquid), wet, exact);
    check_close(s.intensive(liquid, 0.5), own, exact);
    const double mixed = (2e-3 * own[0] + 2 * tiny * (tiny > 0 ? alien[0] : 0)) / (2e-3 + 2 * tiny);
    CHECK(s.intensive(liquid, 2)[0] == Approx(mixed).epsilon(100 * exact));
  }
}

TEST_CASE("a negative volume needs a neighbour with more of the phase than is missing") {
  Strip s({0, 1, 2});
  s.set(0.5, 1e-2), s.set(1.5, -1.1e-2);
  s.run();
  s.check_counters(0, 1, 0);
  CHECK(s.alpha(solid, 1.5) == -1.1e-2);
  // a larger volume at too small a fraction
  Strip wide({0, 10, 11});
  wide.set(5, 1e-2), wide.set(10.5, -1.1e-2);
  wide.run();
  wide.check_counters(0, 1, 0);
  // a larger fraction of too small a volume
  Strip narrow({0, 1, 1.01});
  narrow.set(0.5, -1e-3), narrow.set(1.005, 0.09);
  narrow.run();
  narrow.check_counters(0, 1, 0);
}

TEST_CASE("several negative volumes leave a neighbour no less than nothing") {
  Strip s({0, 4, 4.15, 8.15});  // 0.15 * 0.6 = 0.09 of solid; 4 * 0.01 and 4 * 0.02 are missing
  s.set(2, -0.01), s.set(4.075, 0.6), s.set(6.15, -0.02);
  const std::vector<double> rigid = s.totals(solid), wet = s.totals(liquid);
  s.run();
  s.check_counters(1, 1, 0);
  CHECK(s.alpha(solid, 6.15) == 0);
  CHECK(s.alpha(solid, 2) == -0.01);
  CHECK(s.alpha(solid, 4.075) == Approx(0.6 - 4 * 0.02 / 0.15).epsilon(1e-13));
  check_close(s.totals(solid), rigid, 1e-14);
  check_close(s.totals(liquid), wet, 1e-14);
}

TEST_CASE("what a cell gives with its negative volume it does not give to others") {
  constexpr int gas = 2;
  Strip s({0, 1, 1.01, 12.11});
  Phase& third = s.fields.phases.emplace_back();
  third.alpha.assign(s.mesh.n_all(), 0);
  third.conserved.assign(4, AlignedVector<double>(s.mesh.n_all(), 0));
  s.exchange = std::make_unique<VolumeExchange>(one_rank(), s.mesh, s.fields);
  const auto fill = [&](double x, double alpha_solid, double alpha_gas) {
    s.set(x, alpha_solid, 0.1);
    const std::int32_t i = s.cell(x);
    const double before = s.fields.phases[liquid].alpha[i], after = before - alpha_gas;
    s.fields.phases[liquid].alpha[i] = after, s.fields.phases[gas].alpha[i] = alpha_gas;
    for (int c = 0; c < 4; ++c) {
      s.fields.phases[liquid].conserved[c][i] *= after / before;
      third.conserved[c][i] = alpha_gas * (c + 1 + x);
    }
  };
  // the cell in the middle holds 0.007 of liquid and gives 0.002 with its solid; its neighbour asks for 0.0055 for gas
  fill(0.5, 0.9, 0), fill(1.005, -0.2, 0.5), fill(6.56, 0.4, 5e-4);
  const std::vector<double> before[] = {s.totals(solid), s.totals(liquid), s.totals(gas)};
  s.run();
  s.check_counters(1, 1, 0);
  CHECK(s.alpha(liquid, 1.005) == Approx(0.5));
  CHECK(s.alpha(gas, 6.56) == 5e-4);
  for (const int k : {solid, liquid, gas}) check_close(s.totals(k), before[k], 1e-14);
}

TEST_CASE("a donor keeps more than round-off of the phase it gives") {
  for (const double left : {0.5e-6, 2e-6}) {
    Strip s({0, 25, 26});  // 25 * 8e-4 = 0.02
    s.set(12.5, 8e-4), s.set(25.5, 0.98 - left);
    s.run();
    CAPTURE(left);
    CHECK(s.exchange->counters().exchanges == (left > 1e-6 ? 1 : 0));
  }
}

TEST_CASE("the threshold follows the distance the material moves in the step") {
  // 0.1 dt sum of A |u_n| / (2 V) = 0.1 dt (1 + 1) 1 m/s / 2 m^2, at most 1e-3, at least 1e-9; beside planes 3e-2, 1e-8
  const auto exchanged = [](double alpha, double dt, const ExchangeThresholds& thresholds = diffuse_exchange) {
    Strip s({0, 1, 2}, thresholds);
    s.set(0.5, 0.5), s.set(1.5, alpha);
    s.run(dt);
    return s.exchange->counters().exchanges == 1;
  };
  CHECK(exchanged(0.99e-3, 1));
  CHECK_FALSE(exchanged(1.01e-3, 1));
  CHECK(exchanged(0.99e-4, 1e-3));
  CHECK_FALSE(exchanged(1.01e-4, 1e-3));
  CHECK(exchanged(0.99e-9, 0));
  CHECK_FALSE(exchanged(1.01e-9, 0));
  CHECK(exchanged(0.0299, 1, sharp_exchange));
  CHECK_FALSE(exchanged(0.0301, 1, sharp_exchange));
  CHECK(exchanged(0.99e-4, 1e-3, sharp_exchange));
  CHECK_FALSE(exchanged(1.01e-4, 1e-3, sharp_exchange));
  CHECK(exchanged(0.99e-8, 0, sharp_exchange));
  CHECK_FALSE(exchanged(1.01e-8, 0, sharp_exchange));
}

TEST_CASE("what may itself leave a donor is not given away, up to the largest threshold") {
  // the middle cell has 0.025 of liquid, which the right one takes; the left one asks for some of it
  Strip s({0, 1, 2, 3}, sharp_exchange);
  s.set(0.5, 1e-3), s.set(1.5, 0.975), s.set(2.5, 0.4);
  const std::vector<double> rigid = s.totals(solid), wet = s.totals(liquid);
  s.run();
  CHECK(s.exchange->counters().exchanges == 1);
  CHECK(s.alpha(solid, 0.5) == 1e-3);
  CHECK(s.alpha(liquid, 1.5) == 0);
  check_close(s.totals(solid), rigid, 1e-15);
  check_close(s.totals(liquid), wet, 1e-15);
}

TEST_CASE("a fragment is exchanged by force whatever the threshold, with a partner that has enough of its phase") {
  Strip s({0, 1, 2});
  s.set(0.5, 0.5), s.set(1.5, 5e-3);
  s.run();
  s.check_counters(0, 0, 0);
  s.run(1, {{1.5, solid}});
  s.check_counters(1, 0, 0);
  CHECK(s.exchanged_volume() == Approx(5e-3));
  CHECK(s.alpha(solid, 1.5) == 0);
  CHECK(s.alpha(solid, 0.5) == Approx(0.505).epsilon(1e-15));

  Strip poor({0, 1, 2});
  poor.set(0.5, 8e-3), poor.set(1.5, 5e-3);
  poor.run(1, {{1.5, solid}});
  poor.check_counters(0, 1, 0);
}

TEST_CASE("a donor is never overdrawn: the smaller volume fraction is served first") {
  // the middle cell can give 0.15 * 0.02 = 3e-3 of liquid; its neighbours ask for 4 * 6e-4 and 4 * 5e-4
  for (const bool mirror : {false, true}) {
    Strip s({0, 4, 4.15, 8.15});
    s.set(2, mirror ? 5e-4 : 6e-4), s.set(4.075, 0.98), s.set(6.15, mirror ? 6e-4 : 5e-4);
    s.run();
    s.check_counters(1, 1, 0);
    const double served = mirror ? 2 : 6.15, refused = mirror ? 6.15 : 2;
    CHECK(s.alpha(solid, served) == 0);
    CHECK(s.alpha(solid, refused) == 6e-4);
    CHECK(s.alpha(liquid, 4.075) == Approx(0.02 - 4 * 5e-4 / 0.15).epsilon(1e-13));
    CHECK(s.exchanged_volume() == Approx(2e-3));
  }
}

TEST_CASE("of equal requests the one from the cell with the smaller global number is served first") {
  Strip s({0, 4, 4.15, 8.15});
  s.set(2, 6e-4), s.set(4.075, 0.98), s.set(6.15, 6e-4);
  s.run();
  s.check_counters(1, 1, 0);
  const bool left_first = s.mesh.global_id[s.cell(2)] < s.mesh.global_id[s.cell(6.15)];
  CHECK(s.alpha(solid, left_first ? 2 : 6.15) == 0);
  CHECK(s.alpha(solid, left_first ? 6.15 : 2) == 6e-4);
}

TEST_CASE("the donor is the neighbour with most of the phase, of equals the one with the smaller global number") {
  Strip s({0, 1, 2, 3});
  s.set(0.5, 0.6), s.set(1.5, 4e-4), s.set(2.5, 0.7);
  s.run();
  s.check_counters(1, 0, 0);
  CHECK(s.alpha(solid, 0.5) == 0.6);
  CHECK(s.alpha(solid, 2.5) == Approx(0.7004).epsilon(1e-15));

  Strip equal({0, 1, 2, 3});
  equal.set(0.5, 0.6), equal.set(1.5, 4e-4), equal.set(2.5, 0.6);
  equal.run();
  const bool left = equal.mesh.global_id[equal.cell(0.5)] < equal.mesh.global_id[equal.cell(2.5)];
  CHECK(equal.alpha(solid, left ? 0.5 : 2.5) == Approx(0.6004).epsilon(1e-15));
  CHECK(equal.alpha(solid, left ? 2.5 : 0.5) == 0.6);
}
