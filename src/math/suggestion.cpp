#include "math/suggestion.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace cobasis {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

constexpr std::size_t longest = 60;  ///< of what is compared: a table of distances takes no time whatever a file holds

/// Letters to insert, delete, change or swap with their neighbour; upper and lower case are one.
std::size_t distance(std::string_view a, std::string_view b) {
  std::array<std::array<std::size_t, longest + 1>, longest + 1> d;
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  const auto same = [&](std::size_t i, std::size_t j) { return lower(a[i - 1]) == lower(b[j - 1]); };
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (same(i, j) ? 0 : 1)});
      if (i > 1 && j > 1 && same(i, j - 1) && same(i - 1, j)) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

bool begins(std::string_view name, std::string_view word) {
  return !word.empty() && word.size() <= name.size() &&
         std::equal(word.begin(), word.end(), name.begin(), [](char a, char b) { return lower(a) == lower(b); });
}

}  // namespace

std::optional<std::string> nearest_name(std::string_view word, std::span<const std::string> candidates) {
  word = word.substr(0, longest);
  std::optional<std::string> nearest;
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (const std::string& candidate : candidates) {
    const std::size_t d = begins(candidate, word) ? 0 : distance(word, std::string_view(candidate).substr(0, longest));
    if (d < least && d < std::max(word.size(), candidate.size())) {
      least = d;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string allowed_names(std::string_view word, std::span<const std::string> candidates) {
  std::string text = "allowed: ";
  for (const std::string& candidate : candidates) text += (&candidate == &candidates.front() ? "" : ", ") + candidate;
  if (candidates.empty()) text += "none";
  const auto nearest = nearest_name(word, candidates);
  return nearest ? text + "; did you mean \"" + *nearest + "\"?" : text;
}

}  // namespace cobasis
