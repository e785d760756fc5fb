#include "math/suggestion.hpp"

#include <catch2/catch.hpp>
#include <vector>

using namespace cobasis;

TEST_CASE("the nearest name is the one with the fewest letters to mend") {
  const std::vector<std::string> names{"wall", "symmetry", "transmissive", "inflow", "periodic"};
  CHECK(nearest_name("wal", names) == "wall");
  CHECK(nearest_name("walll", names) == "wall");
  CHECK(nearest_name("WALL", names) == "wall");
  CHECK(nearest_name("symetry", names) == "symmetry");
  CHECK(nearest_name("inlfow", names) == "inflow");
  CHECK(nearest_name("outflow", names) == "inflow");
  CHECK_FALSE(nearest_name("xyz", {}));
  CHECK_FALSE(nearest_name("b", std::vector<std::string>{"a", "c"}));
}

TEST_CASE("a word cut short is the name that begins with it") {
  CHECK(nearest_name("mat", std::vector<std::string>{"case", "materials"}) == "materials");
  CHECK(nearest_name("WA", std::vector<std::string>{"axis", "wall"}) == "wall");
}

TEST_CASE("letters that changed places count once") {
  CHECK(nearest_name("every", std::vector<std::string>{"ovary", "evrey"}) == "evrey");
}

TEST_CASE("the allowed names are listed with the nearest") {
  const std::vector<std::string> names{"run", "check"};
  CHECK(allowed_names("rnu", names) == "allowed: run, check; did you mean \"run\"?");
  CHECK(allowed_names("", names) == "allowed: run, check");
  CHECK(allowed_names("x", {}) == "allowed: none");
}

TEST_CASE("a name of any length is compared in bounded time") {
  CHECK(nearest_name(std::string(1000000, 'a'), std::vector<std::string>{"aa"}) == "aa");
}
