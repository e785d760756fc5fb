// What a run tells of itself: snapshots, totals, shares.
#include <array>
#include <span>

#include "solver/solver.hpp"

namespace cobasis {
namespace {

constexpr std::array axis_names = {"x", "y", "z"};

Symmetric<Space, double> metric_of(const Phase& phase, int dimension, std::int32_t cell) {
  const Indices<double> at{cell};
  if (dimension == 3) return normalised_metric(load_cobasis<Space, double>(phase, at));
  const Symmetric<Plane, double> g = normalised_metric(load_cobasis<Plane, double>(phase, at));
  return {g.xx, g.yy, g.zz, g.xy, 0, 0};
}

/// A fragment may have a volume and no mass: then it has neither velocity nor energy.
bool has_mass(const Phase& phase, std::int32_t cell) {
  return (phase.alpha.empty() || phase.alpha[cell] > 0) && phase.conserved[0][cell] > 0;
}
/// Nor is its cobasis always a deformation: then it has no stress and no pressure either.
bool has_state(const Phase& phase, int dimension, std::int32_t cell) {
  if (!has_mass(phase, cell)) return false;
  if (phase.kind == Kind::fluid) return true;
  const Indices<double> at{cell};
  return (dimension == 3 ? determinant(load_cobasis<Space, double>(phase, at))
                         : determinant(load_cobasis<Plane, double>(phase, at))) > 0;
}

}  // namespace

const ExchangeCounters& Solver::exchange_counters() const {
  static const ExchangeCounters none;
  return exchange_ ? exchange_->counters() : none;
}

double Solver::exchanged_volume() const { return exchange_ ? mpi_.exact_sum(exchange_->volume_of_cell()) : 0; }

double Solver::mixed_share() const {
  std::int64_t mixed = 0;
  for (std::int32_t cell = 0; cell < mesh_.n_owned; ++cell) mixed += fields_.pure[cell] < 0;
  return static_cast<double>(mpi_.sum(mixed)) / static_cast<double>(mesh_.n_global);
}

RobustnessCounters Solver::robustness() const {
  RobustnessCounters counters;
  counters.redone = redone_;
  if (reconstruction_) {
    const double all = static_cast<double>(mpi_.sum(reconstruction_->reconstructed()));
    const double fallen = static_cast<double>(mpi_.sum(reconstruction_->fallen()));
    counters.fallback_share = all > 0 ? fallen / all : 0;
  }
  if (redistribution_) counters.mended = mpi_.sum(redistribution_->counters().mended);
  counters.torn = mpi_.sum(torn_);
  counters.followed = mpi_.sum(followed_);
  return counters;
}

int Solver::equations() const {
  int n = fields_.n_phases() - 1;
  for (const Phase& phase : fields_.phases) n += phase.n_conserved();
  return n;
}

Snapshot Solver::snapshot(Content content) const {
  const std::int32_t n = mesh_.n_owned;
  const int D = fields_.dimension;
  Snapshot snapshot{step_, time_, last_dt_, {}};
  for (const Phase& phase : fields_.phases) {
    PhaseSnapshot& out = snapshot.phases.emplace_back();
    out.name = phase.name;
    out.is_void = phase.is_void;
    out.is_solid = !phase.is_void && phase.kind == Kind::solid;
    out.rho0 = phase.material.rho0;
    if (fields_.multiphase())
      out.alpha.assign(phase.alpha.begin(), phase.alpha.begin() + n);
    else
      out.alpha.assign(n, 1);
    if (phase.is_void || content == Content::alpha) continue;
    for (auto* field : {&out.density, &out.pressure, &out.energy}) field->assign(n, 0);
    for (auto& component : out.velocity) component.assign(n, 0);
    for (auto& component : out.stress) component.assign(n, 0);
    if (out.is_solid) {
      out.elastic_energy.assign(n, 0);
      for (auto& component : out.cobasis) component.assign(n, 0);
    }
    for (std::int32_t cell = 0; cell < n; ++cell) {
      if (!has_state(phase, D, cell)) continue;
      const auto primitive = [&](int c) { return phase.primitive[c][cell]; };
      const double rho = phase.density()[cell], p = primitive(1 + D);
      out.density[cell] = rho;
      out.pressure[cell] = p;
      out.energy[cell] = primitive(3 + D);
      for (int i = 0; i < D; ++i) out.velocity[i][cell] = primitive(1 + i);
      for (int i = 0; i < 3; ++i) out.stress[i][cell] = -p;
      if (!out.is_solid) continue;
      const Symmetric<Space, double> g = metric_of(phase, D, cell);
      const Symmetric<Space, double> S = deviatoric_stress(phase.material, rho, g);
      const double s[] = {S.xx, S.yy, S.zz, S.xy, S.yz, S.xz};
      for (int i = 0; i < 6; ++i) out.stress[i][cell] += s[i];
      out.elastic_energy[cell] = elastic_energy(phase.material, g);
      constexpr int plane_component[] = {0, 1, 3, 4, 8};
      for (int c = fields_.first_cobasis(); c < phase.n_conserved(); ++c) {
        const int i = c - fields_.first_cobasis();
        out.cobasis[D == 2 ? plane_component[i] : i][cell] = phase.conserved[c][cell];
      }
    }
  }
  return snapshot;
}

std::vector<Column> Solver::totals() const {
  std::vector<Column> columns;
  std::vector<double> values(mesh_.n_owned);
  const auto total = [&](std::string name, std::string unit, auto&& of_cell) {
    for (std::int32_t cell = 0; cell < mesh_.n_owned; ++cell) values[cell] = of_cell(cell);
    columns.push_back({std::move(name), std::move(unit), mpi_.exact_sum(values)});
  };
  const int D = fields_.dimension;
  for (const Phase& phase : fields_.phases) {
    if (fields_.multiphase())
      total("volume." + phase.name, "m^3", [&](std::int32_t c) { return phase.alpha[c] * fields_.volume[c]; });
    if (phase.is_void) continue;
    const auto conserved = [&](int i) {
      return [&, i](std::int32_t c) { return phase.conserved[i][c] * fields_.volume[c]; };
    };
    total("mass." + phase.name, "kg", conserved(0));
    for (int i = 0; i < D; ++i) total("momentum." + phase.name + "." + axis_names.at(i), "kg m/s", conserved(1 + i));
    total("energy." + phase.name, "J", conserved(1 + D));
    total("kinetic." + phase.name, "J", [&](std::int32_t c) {
      double u2 = 0;
      for (int i = 0; i < D; ++i) u2 += phase.primitive[1 + i][c] * phase.primitive[1 + i][c];
      return has_mass(phase, c) ? 0.5 * u2 * phase.conserved[0][c] * fields_.volume[c] : 0;
    });
    if (dot(setup_.gravity, setup_.gravity) > 0)
      total("potential." + phase.name, "J", [&](std::int32_t c) {
        return -dot(setup_.gravity, mesh_.centroid[c]) * phase.conserved[0][c] * fields_.volume[c];
      });
    if (phase.kind == Kind::solid)
      total("elastic." + phase.name, "J", [&](std::int32_t c) {
        return has_state(phase, D, c)
                   ? elastic_energy(phase.material, metric_of(phase, D, c)) * phase.conserved[0][c] * fields_.volume[c]
                   : 0;
      });
  }
  for (const BoundaryGroup& group : mesh_.boundary_groups) {
    const auto outflow = [&](int k, int component, const std::string& name, const std::string& unit) {
      const auto booked =
          std::span(booked_[k][component]).subspan(group.first - mesh_.first_boundary_face(), group.last - group.first);
      columns.push_back({"outflow." + group.name + "." + name, unit, mpi_.exact_sum(booked)});
    };
    for (int k = 0; k < fields_.n_phases(); ++k) {
      const std::string& phase = fields_.phases[k].name;
      if (fields_.phases[k].is_void) continue;
      outflow(k, 0, "mass." + phase, "kg");
      for (int i = 0; i < D; ++i) outflow(k, 1 + i, "momentum." + phase + "." + axis_names.at(i), "kg m/s");
      outflow(k, 1 + D, "energy." + phase, "J");
    }
  }
  return columns;
}

}  // namespace cobasis
