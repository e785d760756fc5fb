#include "app/together.hpp"

#include <cstdint>
#include <exception>
#include <span>
#include <vector>

namespace cobasis {

void throw_together(const Mpi& mpi, const std::string& error) {
  const auto failed = static_cast<int>(mpi.min(error.empty() ? mpi.size() : mpi.rank()));
  if (failed == mpi.size()) return;
  std::vector<std::int64_t> letters;
  if (mpi.rank() == failed) letters.assign(error.begin(), error.end());
  letters = mpi.gather(std::span<const std::int64_t>(letters));
  std::string text(letters.begin(), letters.end());
  mpi.broadcast(text);
  throw SystemError(text);
}

void do_together(const Mpi& mpi, const std::function<void()>& action) {
  std::string error;
  try {
    action();
  } catch (const std::exception& caught) {
    error = caught.what();
  }
  throw_together(mpi, error);
}

}  // namespace cobasis
