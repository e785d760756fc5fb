// What a checkpoint holds, around and behind HDF5: head and checksum, the case it is of, the list of output, rows.
#include <vector>

#include "app/checkpoint_file.hpp"
#include "app/checkpoint_identity.hpp"
#include "app/state_keepers.hpp"
#include "app/written_output.hpp"
#include "fuzz.hpp"
#include "math/errors.hpp"

using namespace cobasis;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Scratch scratch;
  if (size == 0) return 0;
  const std::string text = text_of(data + 1, size - 1);
  try {
    switch (data[0] % 4) {
      case 0:
        what_is_wrong_with_checkpoint(scratch.write("a.h5", text));
        break;
      case 1: {
        const std::string half = text.substr(0, text.size() / 2);
        claim(differences(half, half).empty());
        claim(differences(half, text.substr(text.size() / 2)).size() < 10 * text.size() + 1000);
        break;
      }
      case 2: {
        const auto all = written_output(text, {2, 1, 3});
        claim(text_of(written_output(text_of(all), {2, 1, 3})) == text_of(all));
        for (const WrittenOutput& it : all)
          claim(it.file.find("/../") == std::string::npos && !it.file.starts_with('/'));
        break;
      }
      default: {
        std::vector<double> numbers(text.size() / sizeof(double));
        if (!numbers.empty()) std::memcpy(numbers.data(), text.data(), numbers.size() * sizeof(double));
        if (are_rows(numbers, 3, 100, -1, 1))
          for (std::size_t i = 0; i < numbers.size(); i += 3) claim(static_cast<std::int32_t>(numbers[i]) < 100);
      }
    }
  } catch (const SystemError&) {
  }
  return 0;
}
