// A .msh, checked before Gmsh sees it.
#include "fuzz.hpp"
#include "math/errors.hpp"
#include "mesh/msh_check.hpp"

using namespace cobasis;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const std::string text = text_of(data, size), mesh = check_msh("a.msh", text);
    claim(mesh.starts_with("$MeshFormat") && mesh.size() <= text.size());
    claim(check_msh("a.msh", mesh) == mesh);  // what Gmsh sees holds nothing more that we would take away
  } catch (const InputError&) {
  }
  return 0;
}
