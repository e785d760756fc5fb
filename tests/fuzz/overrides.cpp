// --set: a line of the input is a word of the command line.
#include <sstream>

#include "app/case.hpp"
#include "app/case_toml.hpp"
#include "fuzz.hpp"
#include "math/errors.hpp"

using namespace cobasis;

namespace {

constexpr const char* text = R"(schema = 1
mesh = "mesh.geo"
end_time = 1e-3
[phase.air]
material = "air"
[[region]]
shape = "box"
low = [0, 0]
high = [1, 1]
fill = "air"
pressure = "1e5 + x"
[boundary]
"*" = "wall"
)";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Scratch scratch;
  static const std::string mesh = scratch.write("mesh.geo", "// a mesh\n"), file = scratch.write("case.toml", text);
  CaseOverrides overrides;
  std::istringstream lines(text_of(data, size));
  for (std::string line; std::getline(lines, line);) {
    const auto at = line.find('=');
    if (at != std::string::npos) overrides.set.emplace_back(line.substr(0, at), line.substr(at + 1));
  }
  static const TomlTable document = read_toml(file);
  try {
    TomlTable changed = document;
    for (const auto& [key, value] : overrides.set) set_value(changed, key, value);
    if (size % 16 == 0) read_case(file, overrides);  // which the target `case` looks at, and takes 50 times as long
  } catch (const InputError& error) {
    claim(*error.what() != 0);
  }
  return 0;
}
