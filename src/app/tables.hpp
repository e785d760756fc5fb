// CSV tables and their time series: C locale, shortest digits that read back to the same bits, `nan` where there is no
// value.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/output_fields.hpp"

namespace cobasis {

std::string csv_row(const std::vector<std::string>& names);
std::string csv_row(std::span<const double> values);

/// The columns of the fields, components as suffixes.
std::vector<std::string> columns_of(const std::vector<OutputField>& fields);
std::vector<std::string> units_of(const std::vector<OutputField>& fields);  ///< of the same columns

/// The fields cell by cell; NaN for a phase where it is absent. [cell][column]
std::vector<double> rows_of(const std::vector<OutputField>& fields);

/// ParaView's JSON of (time [s], path relative to it).
std::string file_series(const std::vector<std::pair<double, std::string>>& files);

}  // namespace cobasis
