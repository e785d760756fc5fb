// The time step of section 4.4 of the paper, with all sub-systems from one state: primitives, faces, cells.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/mpi.hpp"
#include "mesh/neighbour_exchange.hpp"
#include "solver/caution.hpp"
#include "solver/initial_condition.hpp"
#include "solver/interfaces.hpp"
#include "solver/keeper.hpp"
#include "solver/kernels.hpp"
#include "solver/orphans.hpp"
#include "solver/reconstruction.hpp"
#include "solver/redistribution.hpp"
#include "solver/relaxation.hpp"
#include "solver/setup.hpp"
#include "solver/sharp_interface.hpp"
#include "solver/snapshot.hpp"
#include "solver/volume_exchange.hpp"

namespace cobasis {

/// The state left the admissible set; the text says cell, place, phase, time and state. All ranks throw together.
struct Unphysical : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct SolverOptions {
  bool scalar = false;                     ///< kernels one cell or face at a time, to compare with
  std::function<void()> before_halo_send;  ///< called in every step before this rank sends its halo
  /// State of a phase at a cell's centroid at the start, instead of the regions'; where there is what, they still say.
  std::function<PhaseState(int phase, const Point& x)> initial_state;
};

/// Seconds since the start of the last step, and sums over all steps.
struct StepClock {
  double step_start = 0;                       ///< of the last step, on the clock's own scale
  double inside_swept = 0, halo_received = 0;  ///< of the last step
  double total = 0;                            ///< of whole steps, summed
  double kernels = 0;  ///< inside loops over packs: lists, contacts, sweeps, updates, conversions; summed
  double sweeps = 0;   ///< of these, in sweeps over faces; summed
};

/// How often the scheme had to help itself so far, on all ranks.
struct RobustnessCounters {
  std::int64_t redone = 0;    ///< steps that failed, and were taken again at first order there, or smaller
  double fallback_share = 0;  ///< of the cells with slopes, those whose states at faces would have been inadmissible
  std::int64_t mended = 0;    ///< inadmissible states averaged with a neighbour's
  std::int64_t torn = 0;      ///< splinters before a void that took its pressure
  std::int64_t followed = 0;  ///< fragments that took a neighbour's state, summed over steps
};

inline Geometry geometry_of(const Mesh& mesh) {
  return mesh.dimension == 3 ? Geometry::space : mesh.axisymmetric ? Geometry::axisymmetric : Geometry::plane;
}

class Solver {
 public:
  /// The mesh must outlive the solver. Throws InputError where case and mesh do not fit. Collective.
  Solver(const Setup& setup, Geometry geometry, const Mesh& mesh, const Mpi& mpi, SolverOptions options = {});

  /// One step, not beyond the time `until` [s], which is hit exactly; returns its length. Collective. Throws
  /// Unphysical, with the state as before the step.
  double advance(double until);

  double time() const { return time_; }
  std::int64_t step() const { return step_; }
  const Fields& fields() const { return fields_; }
  const StepClock& clock() const { return clock_; }
  const PhaseKernels& kernels(int phase) const { return kernels_[phase]; }
  const ExchangeCounters& exchange_counters() const;  ///< of this rank
  RobustnessCounters robustness() const;              ///< collective
  /// Sum of the volumes exchanged so far [m^3]. Collective.
  double exchanged_volume() const;
  /// Share of this rank's cells with more than one phase, over all ranks. Collective.
  double mixed_share() const;
  /// Equations per cell: 9 of a plane solid, 4 of a plane fluid, 14 and 5 in space, and alpha for all phases but one.
  int equations() const;

  enum class Content { all, alpha };
  Snapshot snapshot(Content content = Content::all) const;
  /// Conserved totals of the domain and what left it through each boundary: mass, momentum, energy of each phase, and
  /// the volume of each. Same bits for any number of ranks. Collective.
  std::vector<Column> totals() const;
  /// All that the steps to come depend on, and what the run tells of itself: a solver of the same case and mesh that
  /// reads it goes on with the same bits, on any number of ranks. Between steps. Collective.
  void keep(Keeper& keeper);

 private:
  void allocate();
  void set_initial_state();
  std::optional<Point> first_of(const std::function<bool(std::int32_t)>& is) const;
  void set_reference_states(const InitialState& initial);
  void set_state(int k, std::int32_t cell, double alpha, const PhaseState& state, const Point& x);
  void take_step(double until);
  void save();
  void restore();
  void keep_derived(Keeper& keeper);
  void derive_primitives(int k);
  void note_troubled(std::int32_t cell, int k);
  double sweep_first_order();
  double sweep_centred(double until);
  double step_to(double until, double stable_step) const;
  double stable_step();
  void begin_sweeps();
  void sweep(Part part);
  template <class With>
  void visit_state(std::int32_t cell, const With& with);
  void send_halo();
  void receive_halo();
  void list_cells();
  void update_cells(double dt);
  void book_boundaries(double dt);
  void choose_present(CellList& cells, const Phase& phase);
  void convert_present();
  void convert_owned(double dt);
  void add_halo_followers(int k);
  int find_void() const;
  void relax_pairs(double dt);
  void relax_dust();
  void relax_splinters(std::vector<std::pair<std::int32_t, int>>& inadmissible);
  void mend(std::vector<std::pair<std::int32_t, int>>& inadmissible);
  void note_unphysical(int k, std::int32_t cell);
  void find_undefined_speed();
  bool creeps() const;
  void find_slowest();
  void blame(std::int32_t cell, const std::string& why);
  std::string unphysical_report() const;

  Setup setup_;
  Geometry geometry_;
  const Mesh& mesh_;
  const Mpi& mpi_;
  SolverOptions options_;
  std::vector<Boundary> boundaries_;

  Faces faces_;
  Fields fields_;
  std::vector<PhaseKernels> kernels_;      // per phase
  std::vector<PairKernels> pair_kernels_;  // [l * n + m], null with a void
  std::vector<RelaxedPair> relaxed_pairs_;
  std::optional<Interfaces> interfaces_;
  std::optional<Reconstruction> reconstruction_;  // of order 2
  std::optional<SharpInterface> sharp_;
  std::optional<Redistribution> redistribution_;  // of sharp interfaces
  std::optional<VolumeExchange> exchange_;
  std::optional<Orphans> orphans_;  // of sharp interfaces
  std::optional<Caution> caution_;
  std::unique_ptr<NeighbourExchange> halo_;

  std::vector<CellList> pure_cells_, mixed_cells_;  // per phase: owned cells to update in the present step
  CellList material_cells_;          // owned cells that are not void or have a neighbour that is not, filled to a pack
  std::int32_t material_count_ = 0;  // of these, without the filling
  CellList touched_cells_;           // owned cells with a face that is not pure, ascending
  CellList scratch_cells_;
  BadCells bad_;
  std::vector<std::pair<std::int32_t, int>> followers_;   // (cell, phase) of fragments without a state of their own
  std::int64_t torn_ = 0;                                 // splinters relaxed to the void's pressure
  std::int64_t followed_ = 0;                             // of these, summed over steps
  std::vector<std::vector<std::vector<double>>> booked_;  // [phase][mass, momentum, energy][boundary face]
  std::string unphysical_;                                // this rank's report
  std::int64_t unphysical_id_ = 0;                        // its cell's global id

  double time_ = 0;
  std::int64_t step_ = 0;
  double last_dt_ = 0;
  int attempt_ = 0;                           // at the present step
  bool troubled_ = false;                     // whether a state of this rank's is not admissible after it
  std::int64_t redone_ = 0;                   // attempts that failed
  std::vector<AlignedVector<double>> saved_;  // volume fractions and conserved quantities before the step
  std::vector<std::pair<std::int32_t, int>> saved_followers_;
  double saved_stable_step_ = 0;
  double stable_step_ = 0;  // at cfl 1, by the signals of the last sweep; 0: none yet
  StepClock clock_;
};

}  // namespace cobasis
