// A case file, with all that is checked of it; and what a checkpoint says of the case.
#include "app/case.hpp"

#include "app/checkpoint_identity.hpp"
#include "fuzz.hpp"
#include "math/errors.hpp"

using namespace cobasis;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Scratch scratch;
  static const std::string mesh = scratch.write("mesh.geo", "// a mesh\n");  // a case names a file that is there
  const std::string file = scratch.write("case.toml", text_of(data, size));
  try {
    const Setup setup = read_case(file);
    claim(!setup.phases.empty() && !setup.regions.empty() && setup.end_time > 0);
    periodic_pairs(setup);
    for (const Geometry geometry : {Geometry::plane, Geometry::axisymmetric, Geometry::space}) {
      const std::string identity = identity_of(setup, geometry);
      claim(differences(identity, identity).empty());
      try {
        check_for_geometry(setup, geometry);
      } catch (const InputError&) {
      }
    }
  } catch (const InputError& error) {
    claim(*error.what() != 0);
  }
  return 0;
}
