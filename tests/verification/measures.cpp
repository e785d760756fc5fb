#include "measures.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace cobasis::test {

Changes operator+(Changes a, const Changes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

double Table::operator()(const std::string& column, double x) const {
  const auto found = std::find(names.begin(), names.end(), column);
  if (found == names.end()) throw std::runtime_error("no column " + column);
  for (const std::vector<double>& row : rows)
    if (row[0] >= x) return row[found - names.begin()];
  throw std::runtime_error("the table ends before " + std::to_string(x));
}

Table read_table(const std::string& name) {
  std::ifstream file(SOURCE_DIR "/tests/verification/reference/" + name);
  if (!file) throw std::runtime_error("cannot read reference/" + name);
  Table table;
  std::string line, entry;
  std::getline(file, line);
  for (std::istringstream entries(line); std::getline(entries, entry, ',');) table.names.push_back(entry);
  while (std::getline(file, line)) {
    std::vector<double> row;
    for (std::istringstream entries(line); std::getline(entries, entry, ',');) row.push_back(std::stod(entry));
    if (row.size() != table.names.size()) throw std::runtime_error("reference/" + name + ": a row of another length");
    table.rows.push_back(row);
  }
  return table;
}

Result::Result(const Scene& of) : scene(of), snapshot(of.solver->snapshot()), mixture(mix(snapshot, of.setup.phases)) {}

const PhaseSnapshot& Result::phase(const std::string& name) const {
  for (const PhaseSnapshot& phase : snapshot.phases)
    if (phase.name == name) return phase;
  throw std::runtime_error("no phase " + name);
}

double mean(const Scene& scene, const CellValue& value, const CellChoice& where) {
  double sum = 0, volume = 0;
  for (std::int32_t cell = 0; cell < scene.mesh.n_owned; ++cell) {
    if (where && !where(cell)) continue;
    sum += scene.mesh.volume[cell] * value(cell);
    volume += scene.mesh.volume[cell];
  }
  if (volume == 0) throw std::runtime_error("a mean over no cells");
  return sum / volume;
}

double Range::distance_to(double value) const { return std::max(std::fabs(low - value), std::fabs(high - value)); }

Range range(const Scene& scene, const CellValue& value, const CellChoice& where) {
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (std::int32_t cell = 0; cell < scene.mesh.n_owned; ++cell) {
    if (where && !where(cell)) continue;
    const double x = value(cell);
    if (std::isnan(x)) throw std::runtime_error("not a number in cell " + std::to_string(cell));
    range.low = std::min(range.low, x);
    range.high = std::max(range.high, x);
  }
  if (range.low > range.high) throw std::runtime_error("a range over no cells");
  return range;
}

double balance(const Solver& solver, const std::string& quantity) {
  double sum = total(solver, quantity);
  for (const Column& column : solver.totals())
    if (column.name.starts_with("outflow.") && column.name.ends_with("." + quantity)) sum += column.value;
  return sum;
}

double balance_of_phases(const Scene& scene, const std::string& quantity) {
  double sum = 0;
  const std::size_t split = std::min(quantity.find('.'), quantity.size());
  for (const PhaseSetup& phase : scene.setup.phases)
    if (!phase.is_void())
      sum += balance(*scene.solver, quantity.substr(0, split) + "." + phase.name + quantity.substr(split));
  return sum;
}

namespace {

/// Components of one vector or tensor of one phase, times its volume fraction.
using Components = std::vector<std::vector<double>>;

Components weighted(const PhaseSnapshot& phase, const std::vector<double>* first, int n, bool by_density) {
  Components components(n, std::vector<double>(phase.alpha.size(), 0));
  for (int c = 0; c < n; ++c)
    for (std::size_t i = 0; i < phase.alpha.size() && !first[c].empty(); ++i)
      components[c][i] = phase.alpha[i] * (by_density ? phase.density[i] : 1) * first[c][i];
  return components;
}

std::vector<Components> quantities(const PhaseSnapshot& phase) {
  std::vector<Components> all{{phase.alpha}};
  if (phase.is_void) return all;
  all.push_back(weighted(phase, &phase.density, 1, false));
  all.push_back(weighted(phase, phase.velocity, 3, true));
  all.push_back(weighted(phase, &phase.energy, 1, true));
  all.push_back(weighted(phase, phase.stress, 6, false));
  if (phase.is_solid) all.push_back(weighted(phase, phase.cobasis, 9, false));
  return all;
}

}  // namespace

double largest_difference(const Scene& a, const Scene& b, const std::vector<std::int32_t>& b_of_a) {
  const Result of_a(a), of_b(b);
  double largest = 0;
  for (const PhaseSnapshot& phase : of_a.snapshot.phases) {
    const std::vector<Components> q_a = quantities(phase), q_b = quantities(of_b.phase(phase.name));
    if (q_a.size() != q_b.size()) throw std::runtime_error("phases of different kind");
    for (std::size_t q = 0; q < q_a.size(); ++q) {
      double difference = 0, size = 0;
      for (std::size_t c = 0; c < q_a[q].size(); ++c) {
        for (std::size_t i = 0; i < q_a[q][c].size(); ++i) {
          difference = std::max(difference, std::fabs(q_a[q][c][i] - q_b[q][c][b_of_a.empty() ? i : b_of_a[i]]));
          size = std::max(size, std::fabs(q_a[q][c][i]));
        }
      }
      if (size > 0) largest = std::max(largest, difference / size);
    }
  }
  return largest;
}

void advance_by(Scene& scene, double dt, int steps) {
  for (int i = 0; i < steps; ++i) {
    const double done = scene.solver->advance(scene.solver->time() + dt);
    if (std::fabs(done - dt) > 1e-6 * dt) throw std::runtime_error("the step is longer than the scheme allows");
  }
}

}  // namespace cobasis::test
