#include "math/expression.hpp"

#include <catch2/catch.hpp>
#include <clocale>
#include <cmath>
#include <locale>
#include <numbers>

#include "math/errors.hpp"

using namespace cobasis;
using Catch::Matchers::Contains;

TEST_CASE("an expression is the number its formula says at a point") {
  const Point x{0.5, -2, 3};
  CHECK(Expression("-4000*y")(x) == 8000);
  CHECK(Expression("x + 10*y + 100*z")(x) == 280.5);
  CHECK(Expression("x^2 + y^2")(x) == 4.25);
  CHECK(Expression("sin(pi*x)")(x) == Approx(1).epsilon(1e-15));
  CHECK(Expression("x > 0 ? 2 : 3")(x) == 2);
  CHECK(Expression("1.5e-3*z")(x) == Approx(4.5e-3).epsilon(1e-15));
}

TEST_CASE("conditions are true where they hold and false elsewhere") {
  const Expression ring("x^2+y^2 < 0.25 && x^2+y^2 >= 0.04");
  CHECK(ring({0.3, 0, 0}) == 1);
  CHECK(ring({0.1, 0, 0}) == 0);
  CHECK(ring({0.6, 0, 0}) == 0);
  CHECK(Expression("x < 0 || y == 1")({2, 1, 0}) == 1);
  CHECK(Expression("x != 2")({2, 1, 0}) == 0);
}

TEST_CASE("formulas without coordinates are folded to their value, others are not") {
  const Expression folded("2*pi + 1");
  CHECK(folded.is_constant());
  CHECK(folded.constant() == 2 * std::numbers::pi + 1);
  CHECK(folded({9, 9, 9}) == folded.constant());
  CHECK_FALSE(Expression("0*x").is_constant());
  CHECK(Expression(3.5).is_constant());
  CHECK(Expression(3.5)({1, 2, 3}) == 3.5);
  CHECK(Expression{}.constant() == 0);
}

TEST_CASE("a copy evaluates like its original") {
  const Expression original("x - y");
  const Expression copy = original;
  CHECK(original({5, 2, 0}) == 3);
  CHECK(copy({7, 1, 0}) == 6);
  CHECK(original({5, 2, 0}) == 3);
}

TEST_CASE("a wrong formula is refused with its text and the position of the mistake") {
  CHECK_THROWS_WITH(Expression("x^2 + foo"), Contains("x^2 + foo") && Contains("position 6"));
  CHECK_THROWS_AS(Expression("x^2 + foo"), InputError);
  for (const char* text : {"", "x +", "(x", "x)", "1 2", "sin()", "1,2", "x y", "if(x)", "2 ** x", "x &"}) {
    INFO(text);
    CHECK_THROWS_AS(Expression(text), InputError);
  }
}

TEST_CASE("coordinates cannot be assigned and text in quotes is refused") {
  CHECK_THROWS_WITH(Expression("x = 3"), Contains("position 2") && Contains("assignment") && Contains("=="));
  for (const char* text : {"x=y=1", "y <= x = 3", "x === 3", "\"text\"", "x<==3", "x += 1"}) {
    INFO(text);
    CHECK_THROWS_AS(Expression(text), InputError);
  }
  CHECK_NOTHROW(Expression("x==3"));
}

TEST_CASE("a decimal point stays a point in a locale with decimal commas") {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  std::setlocale(LC_ALL, "de_DE.UTF-8");
  const double folded = Expression("1.25 + 0.5").constant();
  const double evaluated = Expression("1.25*x + 1234.5")({2, 0, 0});
  std::setlocale(LC_ALL, "C");
  std::locale::global(before);
  CHECK(folded == 1.75);
  CHECK(evaluated == 1237);
}
