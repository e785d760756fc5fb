#include "mesh/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <new>

#include "math/errors.hpp"
#include "mesh/sandbox.hpp"

namespace cobasis {
namespace {

constexpr int status_done = 0, status_error = 1, status_out_of_memory = 2, status_write_failed = 3,
              status_ended_early = 4;

bool write_all(int file, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t n = write(file, data, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    data += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

std::vector<char> read_all(int file) {
  std::vector<char> bytes(static_cast<std::size_t>(lseek(file, 0, SEEK_END)));
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t n = pread(file, bytes.data() + at, bytes.size() - at, static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) throw SystemError(fmt::format("cannot read back from a child process: {}", std::strerror(errno)));
    at += static_cast<std::size_t>(n);
  }
  return bytes;
}

/// Not beyond what limits this process, by ulimit for example.
void limit_memory(std::size_t extra) {
  rlimit own{};
  if (getrlimit(RLIMIT_AS, &own) != 0) return;
  std::ifstream statm("/proc/self/statm");
  std::size_t pages = 0;
  if (!(statm >> pages)) return;
  const rlim_t bytes = std::min(own.rlim_cur, pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + extra);
  const rlimit limit{bytes, bytes};
  setrlimit(RLIMIT_AS, &limit);
}

[[noreturn]] void child(const std::function<std::vector<char>()>& work, const ChildLimits& limits, int file) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  // A library that calls exit() must not run the parent's destructors, MPI_Finalize among them.
  std::atexit([] { _exit(status_ended_early); });
  // MPI's handlers would print a backtrace of a crash that the parent is about to explain.
  for (const int s : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGTERM, SIGINT}) signal(s, SIG_DFL);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  const int null = open("/dev/null", O_RDWR);
  for (int stream = 0; stream < 3; ++stream) dup2(null, stream);
  if (limits.extra_memory > 0) limit_memory(limits.extra_memory);
  if (limits.no_side_effects) enter_sandbox();

  int status = status_done;
  try {
    const std::vector<char> bytes = work();
    if (!write_all(file, bytes.data(), bytes.size())) status = status_write_failed;
  } catch (const std::bad_alloc&) {
    status = status_out_of_memory;
  } catch (const std::exception& error) {
    status = write_all(file, error.what(), std::strlen(error.what())) ? status_error : status_write_failed;
  }
  // A function that ends the process itself must not look like success: only here the last byte is written.
  const char end = '.';
  write_all(file, &end, 1);
  _exit(status);
}

}  // namespace

ChildResult run_in_child(const std::function<std::vector<char>()>& work, const ChildLimits& limits) {
  const int file = memfd_create("cobasis", MFD_CLOEXEC);
  if (file < 0) throw SystemError(fmt::format("cannot create a file in memory: {}", std::strerror(errno)));
  std::fflush(nullptr);
  const pid_t pid = fork();
  if (pid < 0) {
    close(file);
    throw SystemError(fmt::format("cannot start a child process: {}", std::strerror(errno)));
  }
  if (pid == 0) child(work, limits, file);

  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  ChildResult result;
  if (WIFSIGNALED(status)) {
    result.error = fmt::format("it was stopped by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  } else {
    std::vector<char> bytes = read_all(file);
    const bool ended = !bytes.empty();
    if (ended) bytes.pop_back();
    switch (ended ? WEXITSTATUS(status) : -1) {
      case status_done:
        result.bytes = std::move(bytes);
        break;
      case status_error:
        result.error.assign(bytes.begin(), bytes.end());
        break;
      case status_out_of_memory:
        result.error = "it asked for more memory than there is or than the file can need";
        break;
      case status_write_failed:
        result.error = "its result does not fit into memory";
        break;
      default:
        result.error = "it ended early";
    }
  }
  close(file);
  return result;
}

}  // namespace cobasis
