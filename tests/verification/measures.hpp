// What verification tests measure in a scene. For one rank.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/mixture.hpp"
#include "support/scene.hpp"

namespace cobasis::test {

/// Changes to a case, as --set.
using Changes = std::vector<std::pair<std::string, std::string>>;
Changes operator+(Changes a, const Changes& b);

/// A table of reference/, a line of names and then rows of numbers.
struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;

  /// Value of a column in the first row whose entry in the first column is at least `x`: the state at x of a table of
  /// constant states, or the row of a table of errors.
  double operator()(const std::string& column, double x) const;
};
Table read_table(const std::string& name);

/// The phase-weighted fields of the owned cells at one instant.
struct Result {
  const Scene& scene;
  Snapshot snapshot;
  Mixture mixture;

  explicit Result(const Scene& scene);
  const PhaseSnapshot& phase(const std::string& name) const;
  const Point& centre(std::int32_t cell) const { return scene.mesh.centroid[cell]; }
  std::int32_t cells() const { return scene.mesh.n_owned; }
};

/// Mean over the volume of the domain, or of the cells where `where` holds.
using CellValue = std::function<double(std::int32_t)>;
using CellChoice = std::function<bool(std::int32_t)>;
double mean(const Scene& scene, const CellValue& value, const CellChoice& where = nullptr);

/// Smallest and largest value over the cells where `where` holds.
struct Range {
  double low, high;
  double distance_to(double value) const;  ///< the largest |x - value| in the range
};
Range range(const Scene& scene, const CellValue& value, const CellChoice& where = nullptr);

/// A conserved total and what has left through all boundaries, together. `quantity`: mass.copper, momentum.air.x, …
double balance(const Solver& solver, const std::string& quantity);
/// Summed over phases: mass, momentum.x, energy.
double balance_of_phases(const Scene& scene, const std::string& quantity);

/// Largest difference of two states of the same phases (in any order) in the same cells, over volume fractions and, per
/// volume of the cell, mass, momentum, total energy, cobasis and stress, each relative to its largest value (to the
/// largest component of a vector or tensor, to 1 for the cobasis). `b_of_a`: cells of `b`; empty: the same numbers.
double largest_difference(const Scene& a, const Scene& b, const std::vector<std::int32_t>& b_of_a = {});

/// Steps of the given length, each of which must be a step the scheme allows.
void advance_by(Scene& scene, double dt, int steps);

}  // namespace cobasis::test
