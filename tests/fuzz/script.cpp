// A .geo, read before Gmsh runs it.
#include "fuzz.hpp"
#include "math/errors.hpp"
#include "mesh/geo_script.hpp"

using namespace cobasis;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = text_of(data, size);
  for (const bool trust : {false, true}) {
    try {
      check_parameters("a.geo", read_geo_script("a.geo", text, trust), {{"n", 4}, {"h", 0.5}});
    } catch (const InputError&) {
    }
  }
  return 0;
}
