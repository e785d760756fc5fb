// All mistakes of a case, told together.
#pragma once

#include <string>
#include <vector>

#include "app/case_toml.hpp"

namespace cobasis {

class Mistakes {
 public:
  explicit Mistakes(std::string file) : file_(std::move(file)) {}

  /// So many are told: a file that is no case may have a million.
  static constexpr std::size_t most = 200;

  /// "case.toml:12", "--set cfl"
  std::string where(const Place& place) const;
  /// Throws InputError, as throw_if_any, when there are too many.
  void add(const Place& place, const std::string& text);
  /// Likewise; where is told by the text itself.
  void add(const std::string& text);

  std::size_t count() const { return found_.size(); }
  /// InputError: one per line, in the order of the file. Nothing if there are none.
  void throw_if_any() const;

 private:
  struct Mistake {
    int line;
    std::string text;
  };
  void add(Mistake mistake);

  std::string file_;
  std::vector<Mistake> found_;
};

}  // namespace cobasis
