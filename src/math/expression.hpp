// A formula in x, y, z, as a case file may give for a velocity or a region.
#pragma once

#include <memory>
#include <string>

#include "math/vec3.hpp"

namespace cobasis {

class Expression {
 public:
  Expression(double constant = 0);  // NOLINT: a number is an expression
  /// Throws InputError that quotes the text and says where in it (position) and what went wrong.
  explicit Expression(const std::string& text);

  double operator()(const Point& x) const;
  /// The constant's value; meaningless unless is_constant().
  double constant() const { return constant_; }
  bool is_constant() const { return parser_ == nullptr; }

 private:
  struct Parser;
  double constant_ = 0;
  std::shared_ptr<Parser> parser_;
};

}  // namespace cobasis
