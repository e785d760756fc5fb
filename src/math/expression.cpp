#include "math/expression.hpp"

#include <muParser.h>

#include <numbers>

#include "math/errors.hpp"

namespace cobasis {
namespace {

[[noreturn]] void refuse(const std::string& text, std::size_t position, const std::string& why) {
  throw InputError("expression \"" + text + "\", position " + std::to_string(position) + ": " + why);
}

/// muParser would take `x = 1` for an assignment to the coordinate, and knows strings.
void refuse_assignments_and_strings(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"') refuse(text, i, "found text in quotes; allowed: numbers, x, y, z, pi, operators, functions");
    const bool comparison =
        i + 1 < text.size() && text[i + 1] == '=' && std::string_view("=<>!").find(text[i]) != std::string_view::npos;
    if (comparison)
      ++i;
    else if (text[i] == '=')
      refuse(text, i, "found an assignment; allowed: comparisons ==, !=, <, <=, >, >=");
  }
}

}  // namespace

struct Expression::Parser {
  mu::Parser formula;
  double x = 0, y = 0, z = 0;
};

Expression::Expression(double constant) : constant_(constant) {}

Expression::Expression(const std::string& text) {
  refuse_assignments_and_strings(text);
  auto parser = std::make_shared<Parser>();
  try {
    parser->formula.DefineVar("x", &parser->x);
    parser->formula.DefineVar("y", &parser->y);
    parser->formula.DefineVar("z", &parser->z);
    parser->formula.DefineConst("pi", std::numbers::pi);
    parser->formula.SetExpr(text);
    int results = 0;
    parser->formula.Eval(results);
    if (results != 1) refuse(text, text.find(','), "found several values separated by commas; allowed: one");
    if (parser->formula.GetUsedVar().empty())
      constant_ = parser->formula.Eval();
    else
      parser_ = std::move(parser);
  } catch (const mu::Parser::exception_type& error) {
    refuse(text, error.GetPos(), error.GetMsg());
  }
}

double Expression::operator()(const Point& x) const {
  if (is_constant()) return constant_;
  parser_->x = x.x;
  parser_->y = x.y;
  parser_->z = x.z;
  return parser_->formula.Eval();
}

}  // namespace cobasis
