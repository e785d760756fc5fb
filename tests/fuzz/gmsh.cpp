// A .msh through the whole reader, Gmsh in its child process. Slow: a process per input.
#include "fuzz.hpp"
#include "math/errors.hpp"
#include "mesh/distribute.hpp"
#include "mesh/global_mesh.hpp"

using namespace cobasis;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Scratch scratch;
  MeshRequest request;
  request.file = scratch.write("a.msh", text_of(data, size));
  try {
    const GlobalMesh whole = read_global_mesh(request);
    const std::vector<int> owner(whole.n_cells(), 0);
    PartCutter cutter(whole, owner, 1);
    claim(cutter.cut(0).n_owned == whole.n_cells());
  } catch (const InputError&) {
  }
  return 0;
}
