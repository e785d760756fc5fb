// A checkpoint with the right checksum and any HDF5 in it. Slow: processes for every input.
#include "app/checkpoint_file.hpp"
#include "fuzz.hpp"
#include "math/errors.hpp"

using namespace cobasis;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Scratch scratch;
  const std::string file = scratch.write("a.h5", std::string(512, '\n') + text_of(data, size));
  try {
    const CheckpointFileReader reader(file);
    claim(reader.read("x").size() <= size);
    claim(reader.read_text("t").size() <= size + 512);
  } catch (const SystemError&) {
  }
  return 0;
}
