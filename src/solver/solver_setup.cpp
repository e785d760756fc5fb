// From a case and a mesh to a solver at time zero.
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "math/errors.hpp"
#include "solver/boundary.hpp"
#include "solver/initial_condition.hpp"
#include "solver/solver.hpp"

namespace cobasis {
namespace {

using Cobasis9 = std::array<std::array<double, 3>, 3>;

double determinant(const Cobasis9& e) {
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

/// What formulas give at a point must be what the phase can hold; numbers the case reader has looked at.
void check_formulas(const PhaseSetup& phase, const PhaseState& state, const Point& x, const std::string& where) {
  const auto refuse = [&](const char* what, double value, const std::string& allowed) {
    throw InputError(fmt::format("{}: {} = {:g} of phase \"{}\" at ({:g}, {:g}, {:g}); allowed: {}", where, what, value,
                                 phase.name, x.x, x.y, x.z, allowed));
  };
  if (!state.pressure.is_constant()) {
    const double p = state.pressure(x),
                 lowest = std::visit([](const auto&e) { return e.lowest_pressure(); }, phase.eos);
    if (!(p > lowest && std::isfinite(p))) refuse("pressure", p, fmt::format("{:g} < pressure [Pa]", lowest));
  }
  if (state.density && !state.density->is_constant()) {
    const double rho = (*state.density)(x), densest = std::visit([](const auto&e) { return e.densest(); }, phase.eos);
    if (!(0 < rho && rho < densest)) refuse("density", rho, fmt::format("0 < density < {:g} [kg/m^3]", densest));
  }
  for (const Expression& component : state.velocity)
    if (const double u = component(x); !std::isfinite(u)) refuse("velocity", u, "finite numbers [m/s]");
}

/// The conserved state per volume of the phase: rho, rho u, rho E, e.
template <class G>
std::vector<double> conserved_state(const PhaseSetup& phase, const PhaseState& state, const Point& x) {
  double rho = state.density ? (*state.density)(x) : phase.density.value_or(phase.is_solid() ? phase.elastic->rho0 : 0);
  Cobasis9 rows{};  // x, y, z components of (e^1, e^2, e^3)
  if (phase.is_solid()) {
    if (state.cobasis) {
      rows = *state.cobasis;
      if (!state.density) rho = phase.elastic->rho0 * determinant(rows);
    } else {
      for (int i = 0; i < 3; ++i) rows[i][i] = std::cbrt(rho / phase.elastic->rho0);
    }
  }
  Vector<G, double> u;
  u.x = state.velocity[0](x), u.y = state.velocity[1](x);
  if constexpr (G::dimension == 3) u.z = state.velocity[2](x);
  double E =
      0.5 * dot(u, u) + std::visit([&](const auto& eos) { return eos.energy(rho, state.pressure(x)); }, phase.eos);
  std::vector<double> q{rho, rho * u.x, rho * u.y};
  if constexpr (G::dimension == 3) q.push_back(rho * u.z);
  if (!phase.is_solid()) {
    q.push_back(rho * E);
    return q;
  }
  std::vector<double> components;
  Cobasis<G, double> e;
  if constexpr (G::dimension == 2) {
    e = {{rows[0][0], rows[1][0], {}}, {rows[0][1], rows[1][1], {}}, {{}, {}, rows[2][2]}};
  } else {
    e = {{rows[0][0], rows[1][0], rows[2][0]},
         {rows[0][1], rows[1][1], rows[2][1]},
         {rows[0][2], rows[1][2], rows[2][2]}};
  }
  E += elastic_energy(*phase.elastic, normalised_metric(e));
  q.push_back(rho * E);
  q.resize(q.size() + G::n_cobasis);
  for_each_component(e, [&](int c, double value) { q[q.size() - G::n_cobasis + c] = value; });
  return q;
}

Rings rings_of(const Mesh& mesh, std::size_t n_all) {
  Rings rings;
  for (auto* values : {&rings.section, &rings.inverse_radius, &rings.to_section[0], &rings.to_section[1], &rings.lever})
    values->assign(n_all, 0);
  for (std::int32_t cell = 0; cell < mesh.n_cells(); ++cell) {
    const Point &ring = mesh.centroid[cell], &section = mesh.section_centroid[cell];
    rings.section[cell] = mesh.volume[cell] / section.y;
    rings.inverse_radius[cell] = 1 / ring.y;
    rings.to_section[0][cell] = section.x - ring.x;
    rings.to_section[1][cell] = section.y - ring.y;
    rings.lever[cell] = section.y / ring.y;
  }
  return rings;
}

template <class G>
void pick_kernels(const Setup& setup, bool scalar, std::vector<PhaseKernels>& phases, std::vector<PairKernels>& pairs) {
  const int n = static_cast<int>(setup.phases.size());
  const auto kind = [&](int k) { return setup.phases[k].is_solid() ? Kind::solid : Kind::fluid; };
  const int order = setup.scheme.order;
  phases.resize(n);
  pairs.assign(n * n, {});
  for (int l = 0; l < n; ++l) {
    if (setup.phases[l].is_void()) continue;
    phases[l] = scalar ? phase_kernels<G, double>(kind(l), order) : phase_kernels<G, Pack>(kind(l), order);
    for (int m = 0; m < n; ++m) {
      if (m == l || setup.phases[m].is_void()) continue;
      const Contact::Kind contact = setup.contact(l, m).kind;
      const Tangent tangent = contact == Contact::adherence  ? Tangent::bonded
                              : contact == Contact::friction ? Tangent::rubbing
                                                             : Tangent::free;
      pairs[l * n + m] = scalar ? pair_kernels<G, double>(kind(l), kind(m), tangent, order)
                                : pair_kernels<G, Pack>(kind(l), kind(m), tangent, order);
    }
  }
}

}  // namespace

Solver::Solver(const Setup& setup, Geometry geometry, const Mesh& mesh, const Mpi& mpi, SolverOptions options)
    : setup_(setup), geometry_(geometry), mesh_(mesh), mpi_(mpi), options_(std::move(options)) {
  boundaries_ = resolve_boundaries(setup_, mesh_);
  check_axis(setup_, mesh_, boundaries_, mpi_);
  faces_ = make_faces(mesh_);
  prescribe(mesh_, boundaries_, faces_);
  std::vector<FaceRange> inside{{0, mesh_.n_interior_faces}}, mirrors, prescribed;
  for (std::size_t i = 0; i < boundaries_.size(); ++i) {
    const BoundaryGroup& group = mesh_.boundary_groups[i];
    const bool is_mirror = is_mirror_image(boundaries_[i]), is_given = is_prescribed(boundaries_[i]);
    (is_mirror ? mirrors : is_given ? prescribed : inside).push_back({group.first, group.last});
    // zero gradient: the cell is its own neighbour; behind a mirror nothing is read
    if (!std::holds_alternative<Inflow>(boundaries_[i]))
      for (std::int32_t face = group.first; face < group.last; ++face) faces_.right[face] = faces_.left[face];
  }
  if (geometry_ != Geometry::space)
    pick_kernels<Plane>(setup_, options_.scalar, kernels_, pair_kernels_);
  else
    pick_kernels<Space>(setup_, options_.scalar, kernels_, pair_kernels_);
  assert(setup_.phases.size() <= Interfaces::most_phases);
  allocate();
  interfaces_.emplace(faces_, fields_, std::move(inside), std::move(mirrors),
                      std::vector<FaceRange>{{mesh_.n_interior_faces, mesh_.first_boundary_face()}},
                      std::move(prescribed));
  for (int l = 0; l < fields_.n_phases(); ++l)
    for (int m = 0; m < fields_.n_phases(); ++m)
      if (l != m) interfaces_->set_friction(l, m, setup_.contact(l, m).coefficient);
  for (const auto& [pair, rates] : setup_.relaxations) relaxed_pairs_.push_back({pair.first, pair.second, rates});
  set_initial_state();
  if (!fields_.multiphase())
    for (const Part part : {Part::inside, Part::mirror, Part::halo, Part::prescribed})
      interfaces_->sort(faces_, fields_, part);
  if (setup_.scheme.order == 2) reconstruction_.emplace(mpi_, mesh_, faces_, fields_, kernels_, boundaries_);
  const bool sharp = setup_.scheme.interface == InterfaceTreatment::sharp;
  if (fields_.multiphase() && setup_.scheme.interface != InterfaceTreatment::diffuse) {
    sharp_.emplace(mpi_, mesh_, faces_, fields_, setup_, kernels_, pair_kernels_, boundaries_);
    orphans_.emplace(mpi_, mesh_, fields_);
    if (sharp) redistribution_.emplace(mpi_, mesh_, fields_);
  }
  if (fields_.multiphase() && setup_.alpha_min == 0)
    exchange_.emplace(mpi_, mesh_, fields_, sharp ? sharp_exchange : diffuse_exchange);

  caution_.emplace(mpi_, mesh_);

  std::size_t per_cell = fields_.multiphase() ? fields_.n_phases() : 0;
  for (const Phase& phase : fields_.phases) per_cell += phase.n_conserved();
  halo_ = std::make_unique<NeighbourExchange>(mpi_, mesh_.neighbours, halo_capacities(mesh_.neighbours, per_cell), 10);
}

void Solver::allocate() {
  const std::size_t n_all = mesh_.n_all() + pack_width;
  fields_.dimension = geometry_ != Geometry::space ? 2 : 3;
  fields_.n_owned = mesh_.n_owned;
  fields_.n_all = mesh_.n_all();
  fields_.volume.assign(mesh_.volume.begin(), mesh_.volume.end());
  fields_.volume.resize(n_all, 1);
  fields_.pure.assign(n_all, 0);
  if (mesh_.axisymmetric) fields_.rings = rings_of(mesh_, n_all);
  const bool multiphase = setup_.phases.size() > 1;
  const std::size_t list_capacity = faces_.n + n_parts * pack_width;
  const std::size_t pure_slots = first_mixed_slot(faces_),
                    mixed_slots = multiphase ? list_capacity + 2 * pack_width : 0;
  for (std::size_t k = 0; k < setup_.phases.size(); ++k) {
    const PhaseSetup& from = setup_.phases[k];
    const PhaseKernels& kernels = kernels_[k];
    Phase& phase = fields_.phases.emplace_back();
    phase.name = from.name;
    phase.is_void = from.is_void();
    phase.kind = from.is_solid() ? Kind::solid : Kind::fluid;
    phase.eos = from.eos;
    phase.material = from.elastic.value_or(HyperelasticMaterial{});
    phase.void_pressure = from.void_pressure.value_or(0);
    phase.low_mach = setup_.scheme.low_mach ? 1 : 0;
    if (multiphase) phase.alpha.assign(n_all, 0);
    if (phase.is_void) continue;
    phase.conserved.resize(kernels.n_conserved);
    for (int c = 0; c < kernels.n_conserved; ++c)
      phase.conserved[c].assign(
          n_all, c < fields_.first_cobasis() ? 0 : identity_cobasis(fields_.dimension, c - fields_.first_cobasis()));
    if (mesh_.axisymmetric) phase.hoop = CellNumbers(n_all, n_hoop);
    phase.primitive.assign(kernels.n_primitive, AlignedVector<double>(n_all, 0));
    if (!multiphase) phase.primitive[0] = {};  // see Phase::density

    SlotLists& lists = phase.lists;
    lists.pure = CompactList<std::int32_t>(list_capacity);
    lists.slot_of_face.assign(faces_.n + 1, 0);
    const std::size_t flux_size = (pure_slots + mixed_slots) * kernels.n_flux;
    if (flux_size > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
      throw InputError(fmt::format("{}: {} faces on one rank are too many for 32-bit positions; use more ranks",
                                   setup_.case_file, faces_.n));
    phase.flux = RawStorage(flux_size);
    if (setup_.scheme.order == 2) {
      phase.face_states.stride = FaceStates::stride_for(faces_.n + 1);
      phase.face_states.storage = RawStorage(2 * phase.face_states.stride * kernels.n_face_state);
    }
    if (multiphase) {
      lists.mixed = CompactList<std::int32_t>(list_capacity);
      lists.mixed_share = CompactList<double>(list_capacity);
      phase.gain = RawStorage(mixed_slots * kernels.n_gain);
      phase.sides = RawStorage(mixed_slots * 2 * kernels.n_side);
    }
  }
  pure_cells_.resize(fields_.n_phases());
  mixed_cells_.resize(fields_.n_phases());
  const std::size_t cells = mesh_.n_cells() + pack_width;
  for (auto* lists : {&pure_cells_, &mixed_cells_})
    for (CellList& list : *lists) list = CellList(cells);
  for (auto* list : {&material_cells_, &scratch_cells_, &touched_cells_}) *list = CellList(cells);
  booked_.assign(fields_.n_phases(), std::vector<std::vector<double>>(
                                         fields_.dimension + 2, std::vector<double>(mesh_.n_boundary_faces, 0.0)));
}

void Solver::set_state(int k, std::int32_t cell, double alpha, const PhaseState& state, const Point& x) {
  Phase& phase = fields_.phases[k];
  if (fields_.multiphase()) phase.alpha[cell] = alpha;
  if (phase.is_void || alpha == 0) return;
  const std::vector<double> q = geometry_ != Geometry::space ? conserved_state<Plane>(setup_.phases[k], state, x)
                                                             : conserved_state<Space>(setup_.phases[k], state, x);
  for (int c = 0; c < phase.n_conserved(); ++c)
    phase.conserved[c][cell] = (c < fields_.first_cobasis() ? alpha : 1) * q[c];
}

void Solver::set_initial_state() {
  const int n = fields_.n_phases();
  InitialState initial;
  std::vector<CellList> ghosts(n);
  for (CellList& list : ghosts) list = CellList(mesh_.n_ghosts);
  const auto set_checked = [&](int k, std::int32_t cell, double alpha, const PhaseState& state, const Point& x,
                               const std::string& where) {
    if (alpha > 0 && !fields_.phases[k].is_void) check_formulas(setup_.phases[k], state, x, where);
    set_state(k, cell, alpha, state, x);
  };
  std::string mistake;
  try {
    initial = paint(setup_.regions, n, mesh_);
    for (std::int32_t cell = 0; cell < mesh_.n_owned; ++cell)
      for (int k = 0; k < n; ++k)
        if (initial.region[k][cell] >= 0) {
          const Point& x = mesh_.centroid[cell];
          const RegionSetup& region = setup_.regions[initial.region[k][cell]];
          set_checked(k, cell, initial.alpha[k][cell],
                      options_.initial_state ? options_.initial_state(k, x) : region.filling.states[k], x,
                      region.where);
        }
    for (std::size_t i = 0; i < boundaries_.size(); ++i) {
      const auto* inflow = std::get_if<Inflow>(&boundaries_[i]);
      if (!inflow) continue;
      const BoundaryGroup& group = mesh_.boundary_groups[i];
      for (std::int32_t face = group.first; face < group.last; ++face)
        for (int k = 0; k < n; ++k) {
          const double alpha = inflow->filling.alpha[k];
          set_checked(k, mesh_.ghost_of(face), alpha, inflow->filling.states[k], mesh_.face_centroid[face],
                      fmt::format("{}: boundary '{}'", setup_.case_file, group.name));
          if (alpha > 0 && !fields_.phases[k].is_void) ghosts[k].push(mesh_.ghost_of(face));
        }
    }
  } catch (const InputError& error) {
    mistake = error.what();
  }
  if (const auto first = mpi_.min(mistake.empty() ? mpi_.size() : mpi_.rank()); first < mpi_.size()) {
    std::vector<std::int64_t> letters;
    if (mpi_.rank() == static_cast<int>(first)) letters.assign(mistake.begin(), mistake.end());
    letters = mpi_.gather(std::span<const std::int64_t>(letters));
    mistake.assign(letters.begin(), letters.end());
    mpi_.broadcast(mistake);
    throw InputError(mistake);
  }

  if (fields_.multiphase()) {
    for (std::int32_t cell = 0; cell < mesh_.n_owned; ++cell) fields_.complete(cell);
    for (std::size_t i = 0; i < boundaries_.size(); ++i)
      if (std::holds_alternative<Inflow>(boundaries_[i]))
        for (std::int32_t face = mesh_.boundary_groups[i].first; face < mesh_.boundary_groups[i].last; ++face)
          fields_.complete(mesh_.ghost_of(face));
  } else {
    for (CellList* list : {&material_cells_, &pure_cells_[0]}) {
      for (std::int32_t cell = 0; cell < mesh_.n_owned; ++cell) list->push(cell);
      list->fill(pack_width);
    }
    material_count_ = mesh_.n_owned;
  }
  for (int k = 0; k < n; ++k) {
    Phase& phase = fields_.phases[k];
    if (phase.is_void) continue;
    CellList cells(mesh_.n_owned);
    for (std::int32_t cell = 0; cell < mesh_.n_owned; ++cell)
      if (!fields_.multiphase() || phase.alpha[cell] > 0) cells.push(cell);
    bad_.clear();
    for (CellList* list : {&cells, &ghosts[k]}) {
      const std::int32_t count = list->size();
      list->fill(pack_width);
      kernels_[k].primitives(phase, *list, count, bad_);
    }
    for (const std::int32_t cell : bad_)
      if (cell < mesh_.n_owned) note_unphysical(k, cell);
  }
  if (mpi_.any(!unphysical_.empty())) throw Unphysical(unphysical_report());
  if (fields_.multiphase()) set_reference_states(initial);
}

/// The centroid of the first of all ranks' cells, by global id, of those that are; nullopt: none is. Collective.
std::optional<Point> Solver::first_of(const std::function<bool(std::int32_t)>& is) const {
  std::int32_t first = -1;
  for (std::int32_t cell = 0; cell < mesh_.n_owned; ++cell)
    if (is(cell) && (first < 0 || mesh_.global_id[cell] < mesh_.global_id[first])) first = cell;
  const double own = first < 0 ? infinity : static_cast<double>(mesh_.global_id[first]), least = mpi_.min(own);
  if (least == infinity) return std::nullopt;
  const Point x = own == least ? mesh_.centroid[first] : Point{infinity, infinity, infinity};
  return Point{mpi_.min(x.x), mpi_.min(x.y), mpi_.min(x.z)};
}

/// The padding behind all cells holds for each phase the state of the first region that shows it; else that of the
/// first inflow through which it comes.
void Solver::set_reference_states(const InitialState& initial) {
  for (int k = 0; k < fields_.n_phases(); ++k) {
    Phase& phase = fields_.phases[k];
    if (phase.is_void) continue;
    std::optional<Point> x;
    const PhaseState* state = nullptr;
    for (std::size_t region = 0; region < setup_.regions.size() && !x; ++region) {
      if (!(setup_.regions[region].filling.alpha[k] > 0)) continue;
      state = &setup_.regions[region].filling.states[k];
      x = first_of([&](std::int32_t cell) { return initial.region[k][cell] == static_cast<std::int32_t>(region); });
    }
    for (std::size_t i = 0; i < boundaries_.size() && !x; ++i) {
      const auto* inflow = std::get_if<Inflow>(&boundaries_[i]);
      if (!inflow || !(inflow->filling.alpha[k] > 0)) continue;
      state = &inflow->filling.states[k];
      const BoundaryGroup& group = mesh_.boundary_groups[i];
      std::vector<std::int32_t> beside(mesh_.left.begin() + group.first, mesh_.left.begin() + group.last);
      std::ranges::sort(beside);
      x = first_of([&](std::int32_t cell) { return std::ranges::binary_search(beside, cell); });
    }
    if (!x) continue;
    set_state(k, fields_.n_all, 1, *state, *x);
    CellList cell(pack_width);
    cell.push(fields_.n_all);
    cell.fill(pack_width);
    BadCells none;
    kernels_[k].primitives(phase, cell, 1, none);
    phase.alpha[fields_.n_all] = 0;
  }
}

}  // namespace cobasis
