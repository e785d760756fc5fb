// Checkpoints of a run: when they are written, which of them a restart takes, and whether that is of the same case.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/mpi.hpp"
#include "solver/keeper.hpp"
#include "solver/setup.hpp"

namespace cobasis {

class SignalWatch;

/// <output directory>/checkpoints/<case>_<step>.h5, of which the last two stay. All members are collective. SIGUSR1
/// asks for one, SIGTERM for one and the end.
class Checkpoints {
 public:
  /// Gives the keeper all that the run is made of.
  using Keep = std::function<void(Keeper&)>;

  Checkpoints(const Setup& setup, Geometry geometry, const Mesh& mesh, const Mpi& mpi);
  ~Checkpoints();

  /// Takes away those of an earlier run of the case. Throws SystemError.
  void begin();
  /// Reads the newest that is whole; those that are not are told of on standard error. Throws InputError if there is
  /// none, or if it is one of another case or mesh; SystemError.
  void restore(const Keep& keep);
  /// Between steps: writes one if it is time or a signal asks for it. `last`: the run is over. Throws SystemError, also
  /// when SIGTERM has come.
  void update(const Keep& keep, std::int64_t step, bool last);

  /// Path of the latest; empty: there is none.
  std::string latest() const { return good_.empty() ? std::string() : good_.back(); }

 private:
  std::string directory() const { return setup_.output.directory + "/checkpoints"; }
  void write(const Keep& keep, std::int64_t step);
  void keep_identity(Keeper& keeper) const;
  std::string choose();
  bool is_time(std::int64_t step) const;

  Setup setup_;
  Geometry geometry_;
  const Mesh& mesh_;
  const Mpi& mpi_;
  std::string stem_, mesh_identity_;
  std::vector<std::string> good_;  ///< paths of the last two, the newest last
  double written_at_;              ///< [s], clock of rank 0
  std::unique_ptr<SignalWatch> signals_;
};

}  // namespace cobasis
