// Hydrodynamic equations of state, (7): the part e^h(p, rho) of the internal energy.
#pragma once

#include <array>
#include <string_view>
#include <type_traits>
#include <variant>

#include "math/field_info.hpp"
#include "math/pack.hpp"

namespace cobasis {

/// e^h = (p + gamma p_inf) / (rho (gamma - 1))                                                                    (7)
struct StiffenedGas {
  double gamma = 1.4;  ///< adiabatic exponent [-]
  double p_inf = 0;    ///< reference pressure [Pa]

  static constexpr std::string_view name = "stiffened_gas";
  static constexpr std::array<FieldInfo<StiffenedGas>, 2> fields() {
    return {{{"gamma", "-", &StiffenedGas::gamma, 1, infinity, false, false, "adiabatic exponent"},
             {"p_inf", "Pa", &StiffenedGas::p_inf, 0, infinity, true, false, "reference pressure"}}};
  }

  template <class Real>
  Real pressure(const Real& rho, const Real& e_h) const {
    return (gamma - 1) * rho * e_h - gamma * p_inf;
  }
  template <class Real>
  Real energy(const Real& rho, const Real& p) const {
    return (p + gamma * p_inf) / (rho * (gamma - 1));
  }  // (7)
  /// Square of the sound speed of the hydrodynamic part [m^2/s^2].
  template <class Real>
  Real sound_speed_squared(const Real& rho, const Real& p) const {
    return gamma * (p + p_inf) / rho;
  }
  /// The pressure must stay above this [Pa], the density below that [kg/m^3].
  double lowest_pressure() const { return -p_inf; }
  double densest() const { return infinity; }
};

/// p = (gamma - 1) rho e
struct IdealGas {
  double gamma = 1.4;  ///< adiabatic exponent [-]

  static constexpr std::string_view name = "ideal_gas";
  static constexpr std::array<FieldInfo<IdealGas>, 1> fields() {
    return {{{"gamma", "-", &IdealGas::gamma, 1, infinity, false, false, "adiabatic exponent"}}};
  }

  template <class Real>
  Real pressure(const Real& rho, const Real& e_h) const {
    return (gamma - 1) * rho * e_h;
  }
  template <class Real>
  Real energy(const Real& rho, const Real& p) const {
    return p / (rho * (gamma - 1));
  }
  template <class Real>
  Real sound_speed_squared(const Real& rho, const Real& p) const {
    return gamma * p / rho;
  }
  double lowest_pressure() const { return 0; }
  double densest() const { return infinity; }
};

/// Noble and Abel: molecules take room of their own. e^h = (p + gamma p_inf) (1 - b rho) / (rho (gamma - 1)), as in Le
/// Métayer & Saurel, Phys. Fluids 28 (2016) 046102.
struct NobleAbelStiffenedGas {
  double gamma = 1.4;  ///< adiabatic exponent [-]
  double p_inf = 0;    ///< reference pressure [Pa]
  double b = 0;        ///< covolume [m^3/kg]

  static constexpr std::string_view name = "noble_abel_stiffened_gas";
  static constexpr std::array<FieldInfo<NobleAbelStiffenedGas>, 3> fields() {
    using Gas = NobleAbelStiffenedGas;
    return {{{"gamma", "-", &Gas::gamma, 1, infinity, false, false, "adiabatic exponent"},
             {"p_inf", "Pa", &Gas::p_inf, 0, infinity, true, false, "reference pressure"},
             {"b", "m^3/kg", &Gas::b, 0, infinity, true, false, "covolume; densities stay below 1 / b"}}};
  }

  template <class Real>
  Real pressure(const Real& rho, const Real& e_h) const {
    return (gamma - 1) * rho * e_h / (1.0 - b * rho) - gamma * p_inf;
  }
  template <class Real>
  Real energy(const Real& rho, const Real& p) const {
    return (p + gamma * p_inf) * (1.0 - b * rho) / (rho * (gamma - 1));
  }
  template <class Real>
  Real sound_speed_squared(const Real& rho, const Real& p) const {
    return gamma * (p + p_inf) / (rho * (1.0 - b * rho));
  }
  double lowest_pressure() const { return -p_inf; }
  double densest() const { return b > 0 ? 1 / b : infinity; }
};

/// Mie and Grüneisen: p = p_H + rho0 gamma0 (e^h - e_H) around the states behind shocks with u_s = c0 + s u_p into the
/// undeformed material, eta = 1 - rho0 / rho:
///     p_H = rho0 c0^2 eta / (1 - s eta)^2,  e_H = p_H eta / (2 rho0).
/// In tension, eta < 0, there are no shocks: p_H = rho0 c0^2 eta there, and with it e_H is that of the cold isentrope.
struct MieGruneisen {
  double rho0 = 1000;  ///< density of the undeformed material [kg/m^3]
  double c0 = 1500;    ///< its sound speed [m/s]
  double s = 1.5;      ///< slope of u_s over u_p [-]
  double gamma0 = 1;   ///< Grüneisen's coefficient there; rho gamma = rho0 gamma0 [-]

  static constexpr std::string_view name = "mie_gruneisen";
  static constexpr std::array<FieldInfo<MieGruneisen>, 4> fields() {
    using Law = MieGruneisen;
    return {{{"rho0", "kg/m^3", &Law::rho0, 0, infinity, false, false, "density where p = e = 0"},
             {"c0", "m/s", &Law::c0, 0, infinity, false, false, "sound speed there"},
             {"s", "-", &Law::s, 0, infinity, true, false, "slope of shock over particle velocity"},
             {"gamma0", "-", &Law::gamma0, 0, infinity, false, false, "Grueneisen's coefficient there"}}};
  }

  /// Of shocks, at one compression.
  template <class Real>
  struct Hugoniot {
    Real eta, p, slope;  ///< slope: dp_H / deta
  };
  template <class Real>
  Hugoniot<Real> hugoniot(const Real& rho) const {
    const Real eta = 1.0 - rho0 / rho;
    const Real compression = s * larger(eta, Real(0.0));
    const Real of_room = 1.0 / (1.0 - compression);
    const Real stiffness = rho0 * c0 * c0 * (of_room * of_room);
    return {eta, stiffness * eta, stiffness * of_room * (1.0 + compression)};
  }
  template <class Real>
  Real pressure(const Real& rho, const Real& e_h) const {
    const Hugoniot<Real> H = hugoniot(rho);
    return H.p * (1.0 - 0.5 * gamma0 * H.eta) + rho0 * gamma0 * e_h;
  }
  template <class Real>
  Real energy(const Real& rho, const Real& p) const {
    const Hugoniot<Real> H = hugoniot(rho);
    return (p - H.p * (1.0 - 0.5 * gamma0 * H.eta)) / (rho0 * gamma0);
  }
  template <class Real>
  Real sound_speed_squared(const Real& rho, const Real& p) const {
    const Hugoniot<Real> H = hugoniot(rho);
    return rho0 / (rho * rho) * (H.slope * (1.0 - 0.5 * gamma0 * H.eta) + gamma0 * (p - 0.5 * H.p));
  }
  /// Where the sound speed vanishes at rho0; at other densities it still is real there, if gamma0 <= 2 s.
  double lowest_pressure() const { return -rho0 * c0 * c0 / gamma0; }
  double densest() const { return s > 1 ? rho0 * s / (s - 1) : infinity; }
};

using Eos = std::variant<StiffenedGas, IdealGas, NobleAbelStiffenedGas, MieGruneisen>;

/// Calls f with the equation of state as kernels are compiled for it: a gas without covolume is that of Noble and Abel,
/// to the last bit, at no cost that could be measured.
template <class F>
auto visit_compiled(const Eos& eos, const F& f) {
  return std::visit(
      [&]<class Law>(const Law& law) {
        if constexpr (std::is_same_v<Law, IdealGas>)
          return f(NobleAbelStiffenedGas{law.gamma, 0, 0});
        else if constexpr (std::is_same_v<Law, StiffenedGas>)
          return f(NobleAbelStiffenedGas{law.gamma, law.p_inf, 0});
        else
          return f(law);
      },
      eos);
}

}  // namespace cobasis
