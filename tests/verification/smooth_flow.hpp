// How fast the errors of smooth flow in a periodic box fall with the size of the cells.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "support/scene.hpp"

namespace cobasis::test {

enum class Cells { triangles, quadrilaterals, tetrahedra, hexahedra };
bool in_space(Cells cells);

/// Mesh, boundaries and scheme of a case: a box of side 1, periodic all around, n cells along a side.
std::string periodic_box(Cells cells, int n, int order);

/// Velocity, stress (xx yy zz xy yz xz), density, cobasis (e^1_x e^1_y e^1_z e^2_x ...; 0 of a fluid).
using Numbers = std::array<double, 19>;
struct Quantity {
  std::string name;
  int first, last;
};
inline const Quantity velocity{"velocity", 0, 3}, stress{"stress", 3, 9}, density{"density", 9, 10},
    cobasis_vectors{"cobasis", 10, 19};

/// Of the scene's only phase, per owned cell.
std::vector<Numbers> numbers(const Scene& scene);

/// Errors against the exact numbers on one mesh after another. An error is the mean distance from the exact values over
/// their own mean distance from their average.
class Convergence {
 public:
  explicit Convergence(std::vector<Quantity> quantities) : quantities_(std::move(quantities)) {}

  void add(const Scene& scene, const std::function<Numbers(const Point&)>& exact);
  const std::vector<Quantity>& quantities() const { return quantities_; }
  double error(int quantity, int mesh) const { return errors_[mesh][quantity]; }
  double order(int quantity) const { return order(quantity, static_cast<int>(h_.size()) - 1); }  ///< of the last two
  std::string report() const;

 private:
  double order(int quantity, int mesh) const;  ///< between this mesh and the one before

  std::vector<Quantity> quantities_;
  std::vector<double> h_;  ///< size of a cell [m]
  std::vector<std::string> names_;
  std::vector<std::vector<double>> errors_;
};

}  // namespace cobasis::test
