#include "app/tables.hpp"

#include <fmt/format.h>

#include <limits>

namespace cobasis {
std::string csv_row(const std::vector<std::string>& names) { return fmt::format("{}\n", fmt::join(names, ",")); }

std::string csv_row(std::span<const double> values) { return fmt::format("{}\n", fmt::join(values, ",")); }

std::vector<std::string> columns_of(const std::vector<OutputField>& fields) {
  std::vector<std::string> names;
  for (const OutputField& field : fields) {
    for (std::size_t c = 0; c < field.values.size(); ++c) names.push_back(field.column(c));
  }
  return names;
}

std::vector<std::string> units_of(const std::vector<OutputField>& fields) {
  std::vector<std::string> units;
  for (const OutputField& field : fields) units.insert(units.end(), field.values.size(), field.unit);
  return units;
}

std::vector<double> rows_of(const std::vector<OutputField>& fields) {
  const std::size_t n = fields.empty() ? 0 : fields.front().values.front().size();
  std::vector<double> rows;
  for (std::size_t i = 0; i < n; ++i) {
    for (const OutputField& field : fields) {
      const bool absent = !field.presence.empty() && field.presence[i] == 0;
      for (const auto& values : field.values) {
        rows.push_back(absent ? std::numeric_limits<double>::quiet_NaN() : values[i]);
      }
    }
  }
  return rows;
}

std::string file_series(const std::vector<std::pair<double, std::string>>& files) {
  std::string text = "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [";
  const char* separator = "\n";
  for (const auto& [time, name] : files) {
    text += fmt::format("{}    {{ \"name\": \"{}\", \"time\": {} }}", separator, name, time);
    separator = ",\n";
  }
  return text + "\n  ]\n}\n";
}

}  // namespace cobasis
