// What a message says when a name is not known: the allowed names and the nearest of them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace cobasis {

/// The first candidate that begins with the word, or else the one with the fewest letters to insert, delete, change or
/// swap; none if every letter would have to change.
std::optional<std::string> nearest_name(std::string_view word, std::span<const std::string> candidates);

/// "allowed: a, b, c; did you mean "b"?"
std::string allowed_names(std::string_view word, std::span<const std::string> candidates);

}  // namespace cobasis
