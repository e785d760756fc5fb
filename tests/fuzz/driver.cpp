// Without libFuzzer: feeds the files of the folders named on the command line to a target, one second of processor
// time each.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <vector>

#include "fuzz.hpp"

namespace {

constexpr double most_seconds = 1;
constexpr unsigned patience = 60;  // [s]; that the machine is busy is no find, that nothing goes on is one

char current[4096] = "";

void tell_file(int signal) {
  const char text[] = " <- this input does not end well\n";
  [[maybe_unused]] auto written = ::write(2, current, std::strlen(current));
  written = ::write(2, text, sizeof text - 1);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

double seconds_used() {
  double sum = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    for (const timeval& time : {usage.ru_utime, usage.ru_stime})
      sum += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }
  return sum;
}

}  // namespace

int main(int argc, char** argv) {
  for (const int signal : {SIGALRM, SIGSEGV, SIGABRT, SIGILL, SIGTRAP, SIGFPE, SIGBUS}) std::signal(signal, tell_file);
  std::vector<std::filesystem::path> files;
  for (int i = 1; i < argc; ++i)
    for (const auto& entry : std::filesystem::directory_iterator(argv[i])) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  int slow = 0;
  for (const auto& file : files) {
    std::snprintf(current, sizeof current, "%s", file.c_str());
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(stream), {});
    // exactly as long as the input, so that AddressSanitizer sees who reads on
    const std::vector<std::uint8_t> exact(bytes.begin(), bytes.end());
    const double before = seconds_used();
    alarm(patience);
    LLVMFuzzerTestOneInput(exact.data(), exact.size());
    alarm(0);
    const double used = seconds_used() - before;
    if (used > most_seconds) {
      std::fprintf(stderr, "%s: %.2f s; allowed: %.0f s\n", current, used, most_seconds);
      ++slow;
    }
  }
  std::printf("%zu inputs\n", files.size());
  return slow > 0 || files.empty() ? 1 : 0;
}
