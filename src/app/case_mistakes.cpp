#include "app/case_mistakes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "math/errors.hpp"

namespace cobasis {

std::string Mistakes::where(const Place& place) const {
  return place.from_command_line() ? "--set " + place.set_key : fmt::format("{}:{}", file_, place.line);
}

void Mistakes::add(const Place& place, const std::string& text) {
  const int line = place.from_command_line() ? std::numeric_limits<int>::max() : place.line;
  add({line, where(place) + ": " + text});
}

void Mistakes::add(const std::string& text) { add({std::numeric_limits<int>::max(), text}); }

void Mistakes::add(Mistake mistake) {
  found_.push_back(std::move(mistake));
  if (found_.size() < most) return;
  found_.push_back({std::numeric_limits<int>::max(), fmt::format("{}: and more; the first {} are told", file_, most)});
  throw_if_any();
}

void Mistakes::throw_if_any() const {
  if (found_.empty()) return;
  std::vector<Mistake> sorted = found_;
  std::ranges::stable_sort(sorted, {}, &Mistake::line);
  std::string text;
  for (const Mistake& mistake : sorted) text += (text.empty() ? "" : "\n") + mistake.text;
  throw InputError(text);
}

}  // namespace cobasis
