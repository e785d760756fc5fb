#include "smooth_flow.hpp"

#include <fmt/format.h>

#include <cmath>

#include "measures.hpp"

namespace cobasis::test {

bool in_space(Cells cells) { return cells == Cells::tetrahedra || cells == Cells::hexahedra; }

std::string periodic_box(Cells cells, int n, int order) {
  std::string mesh, sides =
                        "left = { type = \"periodic\", with = \"right\" }\n"
                        "bottom = { type = \"periodic\", with = \"top\" }\n";
  switch (cells) {
    case Cells::triangles:
      mesh = fmt::format("\"@box.geo\"\nmesh_parameters = {{ n = {}, element = 3 }}", n);
      break;
    case Cells::quadrilaterals:
      mesh = fmt::format("\"@box.geo\"\nmesh_parameters = {{ n = {} }}", n);
      break;
    case Cells::tetrahedra:
      mesh = fmt::format("\"@../tests/verification/periodic_box.geo\"\nmesh_parameters = {{ n = {} }}", n);
      break;
    case Cells::hexahedra:
      mesh = fmt::format("\"@box_space.geo\"\nmesh_parameters = {{ n = {} }}", n);
      break;
  }
  if (in_space(cells)) sides += "back = { type = \"periodic\", with = \"front\" }\n";
  return fmt::format("mesh = {}\nend_time = 1\n[scheme]\norder = {}\ninterface = \"diffuse\"\n[boundary]\n{}", mesh,
                     order, sides);
}

std::vector<Numbers> numbers(const Scene& scene) {
  const Result result(scene);
  const PhaseSnapshot& phase = result.snapshot.phases[0];
  std::vector<Numbers> of_cells(result.cells());
  for (std::int32_t i = 0; i < result.cells(); ++i) {
    Numbers& q = of_cells[i] = {};
    for (int c = 0; c < 3; ++c) q[c] = result.mixture.velocity[c][i];
    for (int c = 0; c < 6; ++c) q[3 + c] = result.mixture.stress[c][i];
    q[9] = result.mixture.density[i];
    for (int c = 0; c < 9 && phase.is_solid; ++c) q[10 + c] = phase.cobasis[c][i];
  }
  return of_cells;
}

void Convergence::add(const Scene& scene, const std::function<Numbers(const Point&)>& exact_at) {
  const std::vector<Numbers> computed = numbers(scene);
  std::vector<Numbers> exact;
  for (std::int32_t i = 0; i < scene.mesh.n_owned; ++i) exact.push_back(exact_at(scene.mesh.centroid[i]));
  Numbers average;
  for (std::size_t c = 0; c < average.size(); ++c)
    average[c] = mean(scene, [&](std::int32_t i) { return exact[i][c]; });

  std::vector<double>& errors = errors_.emplace_back();
  for (const Quantity& quantity : quantities_) {
    const auto distance = [&](const Numbers& p, const Numbers& q) {
      double square = 0;
      for (int c = quantity.first; c < quantity.last; ++c) square += (p[c] - q[c]) * (p[c] - q[c]);
      return std::sqrt(square);
    };
    errors.push_back(mean(scene, [&](std::int32_t i) { return distance(computed[i], exact[i]); }) /
                     mean(scene, [&](std::int32_t i) { return distance(average, exact[i]); }));
  }
  const auto cells = static_cast<double>(scene.mesh.n_global);
  h_.push_back(std::pow(cells, -1.0 / scene.mesh.dimension));
  names_.push_back(fmt::format("{} cells, {} steps", cells, scene.solver->step()));
}

double Convergence::order(int quantity, int mesh) const {
  return std::log(error(quantity, mesh - 1) / error(quantity, mesh)) / std::log(h_[mesh - 1] / h_[mesh]);
}

std::string Convergence::report() const {
  std::string text;
  for (std::size_t mesh = 0; mesh < h_.size(); ++mesh) {
    text += names_[mesh] + ":";
    for (std::size_t q = 0; q < quantities_.size(); ++q) {
      text += fmt::format(" {} {:.3g}", quantities_[q].name, errors_[mesh][q]);
      if (mesh > 0) text += fmt::format(" (order {:.2f})", order(static_cast<int>(q), static_cast<int>(mesh)));
    }
    text += '\n';
  }
  return text;
}

}  // namespace cobasis::test
