// The exact Riemann problem between two stiffened gases.
#pragma once

namespace cobasis::test {

struct Gas {
  double gamma, p_inf;
  double rho, u, p;

  double sound_speed() const;
};

struct GasRiemann {
  Gas l, r;
  double p_star, u_star;

  GasRiemann(const Gas& l, const Gas& r);
  struct State {
    double rho, u, p;
  };
  /// At x / t = xi [m/s].
  State at(double xi) const;
  /// The slowest and the fastest x / t with the pressure p_star: between them lie both star states.
  struct Interval {
    double low, high;
  };
  Interval star_region() const;
};

}  // namespace cobasis::test
