// Numbers of every case on a coarse mesh, as they were: a change that was not meant to change results must not. What
// the numbers should be is the verification tests' question. After a change that was meant to:
//
//   COBASIS_REGENERATE=1 build/release/tests/regression '[golden]'
//
// writes the present numbers into golden.csv. Its columns: case; what follows --set; the quantity, a column of the last
// row of history.csv, or `axis COLUMN ROW` of the line of that name; its value.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "program.hpp"

using namespace cobasis::test;

namespace {

// Compilers and instruction sets round differently; a few hundred steps make of that 1e-12 or so. The digits of a
// mistake in a formula come far above.
constexpr double tolerance = 1e-9;

const std::string golden_file = SOURCE_DIR "/tests/regression/golden.csv";

struct Number {
  std::string name, settings, quantity;
  double value;
};

std::vector<Number> read_golden() {
  std::vector<Number> numbers;
  const auto lines = lines_of(contents_of(golden_file));
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto fields = fields_of(lines[i]);
    REQUIRE(fields.size() == 4);
    numbers.push_back({fields[0], fields[1], fields[2], std::stod(fields[3])});
  }
  return numbers;
}

std::vector<std::string> names_in_golden() {
  std::vector<std::string> names;
  for (const Number& number : read_golden())
    if (std::ranges::find(names, number.name) == names.end()) names.push_back(number.name);
  return names;
}

double value_in(const std::filesystem::path& table, const std::string& column, int row) {
  CAPTURE(table, column, row);
  const auto lines = lines_of(contents_of(table));
  const auto header = fields_of(lines.at(0));
  const auto at = std::ranges::find(header, column);
  REQUIRE(at != header.end());
  const std::size_t line = row < 0 ? lines.size() - 1 : static_cast<std::size_t>(row) + 1;
  return std::stod(fields_of(lines.at(line)).at(static_cast<std::size_t>(at - header.begin())));
}

double measured(const Folder& folder, const std::string& quantity) {
  std::istringstream words(quantity);
  std::string first, column;
  int row = -1;
  words >> first;
  if (words >> column >> row) return value_in(folder.path("out/" + first + ".csv"), column, row);
  return value_in(folder.path("out/history.csv"), first, -1);
}

void regenerate(const std::vector<Number>& numbers) {
  std::ofstream file(golden_file);
  file << "case,settings,quantity,value\n";
  for (const Number& n : numbers) file << fmt::format("{},{},{},{:.12g}\n", n.name, n.settings, n.quantity, n.value);
}

}  // namespace

TEST_CASE("a case on a coarse mesh gives the numbers it gave", "[golden]") {
  std::vector<Number> numbers = read_golden();
  const std::string name = GENERATE(from_range(names_in_golden()));
  CAPTURE(name);
  Folder folder;
  bool has_run = false;
  for (Number& number : numbers) {
    if (number.name != name) continue;
    if (!has_run) {
      const Outcome outcome = shell(
          program_with("run " + quoted(case_file(name)) + " --quiet --output out --set " + number.settings), folder);
      INFO(outcome.err);
      REQUIRE(outcome.status == 0);
      has_run = true;
    }
    const double value = measured(folder, number.quantity);
    if (std::getenv("COBASIS_REGENERATE")) {
      number.value = value;
      continue;
    }
    INFO(fmt::format("{}: {:.12g}, was {:.12g}", number.quantity, value, number.value));
    CHECK(number.value != 0);
    CHECK(std::fabs(value / number.value - 1) < tolerance);
  }
  if (std::getenv("COBASIS_REGENERATE")) regenerate(numbers);
}

TEST_CASE("every case has golden numbers", "[golden]") {
  const auto names = names_in_golden();
  int cases = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SOURCE_DIR "/cases")) {
    if (entry.path().extension() != ".toml") continue;
    ++cases;
    CAPTURE(entry.path());
    CHECK(std::ranges::find(names, entry.path().stem().string()) != names.end());
  }
  CHECK(cases >= 5);
}
