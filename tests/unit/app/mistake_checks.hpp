// What a test demands of the message about a mistake in a case.
#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "case_file.hpp"

namespace cobasis {

inline int line_of(const std::string& text, const std::string& fragment) {
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<long>(text.find(fragment)), '\n'));
}

/// One mistake, at the line where `at` stands, that says all of these.
inline void check_mistake(const std::string& text, const std::string& at, const std::vector<std::string>& says) {
  INFO(text);
  REQUIRE(text.find(at) != std::string::npos);
  const std::string said = mistakes_in(text);
  CHECK_THAT(said, Catch::Matchers::StartsWith("case.toml:" + std::to_string(line_of(text, at)) + ": "));
  CHECK(std::count(said.begin(), said.end(), '\n') == 0);
  for (const std::string& piece : says) CHECK_THAT(said, Catch::Matchers::Contains(piece));
}

/// The same with `replacement` in place of `found`, standing where the mistake is.
inline void check_replaced(const std::string& found, const std::string& replacement,
                           const std::vector<std::string>& says) {
  check_mistake(with(rest, found, replacement), replacement, says);
}

}  // namespace cobasis
