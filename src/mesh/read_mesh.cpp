#include "mesh/read_mesh.hpp"

#include <new>

#include "math/errors.hpp"
#include "mesh/distribute.hpp"
#include "mesh/global_mesh.hpp"
#include "mesh/partition.hpp"

namespace cobasis {

Mesh read_mesh(const MeshRequest& request, const Mpi& mpi) {
  GlobalMesh whole;
  std::vector<int> owner;
  std::string error;  // the first character tells whose fault it is
  if (mpi.root()) {
    try {
      whole = read_global_mesh(request);
      owner = partition(whole, mpi.size(), request);
    } catch (const InputError& e) {
      error = std::string("i") + e.what();
    } catch (const std::bad_alloc&) {
      error = "s" + request.file + ": not enough memory for this mesh";
    } catch (const std::exception& e) {
      error = std::string("s") + e.what();
    }
  }
  mpi.broadcast(error);
  if (error.starts_with('i')) throw InputError(error.substr(1));
  if (!error.empty()) throw SystemError(error.substr(1));
  if (!mpi.root()) return unpack(mpi.receive(0));

  PartCutter cutter(whole, owner, mpi.size());
  for (int rank = 1; rank < mpi.size(); ++rank) mpi.send(rank, pack(cutter.cut(rank)));
  Mesh mesh = cutter.cut(0);
  mesh.notices = whole.raw.notices;
  return mesh;
}

}  // namespace cobasis
