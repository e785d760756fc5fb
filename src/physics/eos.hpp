// Hydrodynamic equations of state, (7): the part e^h(p, rho) of the internal energy.
#pragma once

#include <array>
#include <string_view>
#include <variant>

#include "math/field_info.hpp"

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
  /// The pressure must stay above this [Pa].
  double lowest_pressure() const { return -p_inf; }
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
};

using Eos = std::variant<StiffenedGas, IdealGas>;

}  // namespace cobasis
