// The tables of keys, part by part; ranges that they share.
#pragma once

#include <vector>

#include "app/case_keys.hpp"

namespace cobasis {

inline constexpr Range positive{0, infinity, false, false};
inline constexpr Range not_negative{0, infinity, true, false};
inline constexpr Range one_only{1, 1, true, true};
inline constexpr Range fraction{0, 1, false, false};
inline constexpr Range any_number{};

constexpr Range from(double low, double high) { return {low, high, true, true}; }

void add_regions(std::vector<KeyTable>& tables);
void add_boundaries_and_output(std::vector<KeyTable>& tables);

}  // namespace cobasis
