// A formula in x, y, z.
#include "math/expression.hpp"

#include "fuzz.hpp"
#include "math/errors.hpp"

using namespace cobasis;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const Expression formula(text_of(data, size));
    if (formula.is_constant()) {
      const double value = formula(Point{1, 2, 3});
      claim(value == formula.constant() || value != value);
    }
    for (const Point& x : {Point{0, 0, 0}, Point{-1, 1e300, 1e-300}, Point{0.5, 2, 1e9}}) {
      const double once = formula(x), again = formula(x);
      claim(std::memcmp(&once, &again, sizeof once) == 0 || once != once);
    }
  } catch (const InputError&) {
  }
  return 0;
}
