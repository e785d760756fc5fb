// What a number's values on meshes of different size say of its exact value: Richardson's extrapolation, with an error
// bar that is only as narrow as the values deserve.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace cobasis {

/// How the values approach each other from mesh to mesh.
enum class Trend {
  asymptotic,   ///< with an order that a scheme can have: extrapolation holds
  same,         ///< they do not differ beyond round-off
  fast,         ///< faster than with order 3, which no scheme here has
  slow,         ///< slower than with order 1/2
  growing,      ///< not: the last two differ by more than the two before
  oscillating,  ///< up and down
  none          ///< there is no value on one of the meshes
};

/// "converging", "oscillating, not in the asymptotic range"
std::string_view describe(Trend trend);

struct Convergence {
  Trend trend = Trend::none;
  double value = 0;             ///< best estimate: extrapolated if asymptotic, else that of the finest mesh
  double error = 0;             ///< the exact value is expected within value ± error
  std::optional<double> order;  ///< observed; absent where the values do not tell one
  double falls_with = 1;        ///< the error is taken to fall with this power of the size of the cells
};

/// Orders between which extrapolation is trusted.
constexpr double least_order = 0.5, largest_order = 3;

/// From the three finest meshes. `h`: sizes of cells in any unit, strictly falling; `values` on these meshes; at least
/// three each. `scale`: what the values' round-off is measured by, where that is larger than the values themselves.
///
/// With d the distance from the finest mesh's value to the extrapolated one, for an order p: d(p), and Roache's factors
/// of safety (1.25 for an order that was observed, 3 for one that was not):
///   asymptotic   the extrapolated value; 1.25 d(p) if the three meshes before tell the same order within a tenth, else
///                2 d(min(p, 1)): shocks and contacts allow no higher order, and three values alone may feign one
///   slow, growing  the finest value; 3 d(1/2)
///   fast         the finest value; 3 d(1), and not less than 1.25 times what the three values span
///   oscillating  the finest value; 3 times what all values span
/// Measured at first order on the plateaus of sections 5.2 and 5.3 of the paper, finest meshes of 200 to 3200 cells
/// along x: 11 of 225 bars missed the exact value, all of meshes of 200; with 1.25 d(p) throughout it were 41.
Convergence converge(std::span<const double> h, std::span<const double> values, double scale = 0);

/// By what the size of the finest mesh's cells is to be divided for an error of `accuracy` times the value; less than 1
/// if a coarser mesh will do. Nothing for a value of 0, or none at all.
std::optional<double> refinement_for(const Convergence& convergence, double accuracy);

}  // namespace cobasis
