#include <fcntl.h>

#include "fuzz.hpp"

namespace cobasis {

std::string Scratch::write(const std::string& name, std::string_view bytes) const {
  const std::string file = path(name);
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  claim(descriptor >= 0 && ::write(descriptor, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()));
  ::close(descriptor);
  return file;
}

}  // namespace cobasis
