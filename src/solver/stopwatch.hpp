// Where the time of a step goes.
#pragma once

#include <chrono>

namespace cobasis {

inline double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Adds the time until its end to a sum.
class Timed {
 public:
  explicit Timed(double& sum) : sum_(sum), start_(seconds()) {}
  ~Timed() { sum_ += seconds() - start_; }
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

 private:
  double& sum_;
  double start_;
};

}  // namespace cobasis
