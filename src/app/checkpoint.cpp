#include "app/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <csignal>
#include <filesystem>
#include <iostream>

#include "app/atomic_file.hpp"
#include "app/checkpoint_file.hpp"
#include "app/checkpoint_identity.hpp"
#include "app/state_keepers.hpp"
#include "app/together.hpp"
#include "math/errors.hpp"
#include "solver/stopwatch.hpp"

namespace cobasis {
namespace {

/// What is asked of the run between two steps; of several wishes the largest counts.
enum Wish : int { nothing = 0, on_time = 1, on_signal = 2, and_stop = 3 };

volatile std::sig_atomic_t signalled = nothing;

void note_signal(int signal) {
  const int wish = signal == SIGTERM ? and_stop : on_signal;
  if (wish > signalled) signalled = wish;
}

constexpr std::array signals{SIGTERM, SIGUSR1};

}  // namespace

/// Notes signals as long as it lives.
class SignalWatch {
 public:
  SignalWatch() {
    signalled = nothing;
    struct sigaction action {};
    action.sa_handler = note_signal;
    action.sa_flags = SA_RESTART;
    for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &action, &former_[i]);
  }
  ~SignalWatch() {
    for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &former_[i], nullptr);
  }
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

  int take() {
    const int wish = signalled;
    if (wish == on_signal) signalled = nothing;
    return wish;
  }

 private:
  std::array<struct sigaction, signals.size()> former_{};
};

Checkpoints::Checkpoints(const Setup& setup, Geometry geometry, const Mesh& mesh, const Mpi& mpi)
    : setup_(setup),
      geometry_(geometry),
      mesh_(mesh),
      mpi_(mpi),
      stem_(std::filesystem::path(setup.case_file).stem().string()),
      mesh_identity_(identity_of(mesh, mpi)),
      written_at_(seconds()),
      signals_(std::make_unique<SignalWatch>()) {
  do_together(mpi_, [&] {
    if (!mpi_.root()) return;
    make_writable_directory(setup_.output.directory, ".writable");
    make_writable_folder(directory(), ".writable");
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(directory(), ignored))
      if (entry.path().extension() == ".part") std::filesystem::remove(entry.path(), ignored);  // of a run that died
  });
}

Checkpoints::~Checkpoints() = default;

namespace {

/// Paths of a case's checkpoints, the oldest first.
std::vector<std::string> checkpoints_in(const std::string& directory, const std::string& stem) {
  std::vector<std::pair<std::int64_t, std::string>> found;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(directory, error)) {
    const std::string name = entry.path().filename().string(), prefix = stem + "_", suffix = ".h5";
    if (!name.starts_with(prefix) || !name.ends_with(suffix)) continue;
    const std::string digits = name.substr(prefix.size(), name.size() - prefix.size() - suffix.size());
    const bool is_number = !digits.empty() && digits.size() < 19 &&
                           std::ranges::all_of(digits, [](unsigned char c) { return std::isdigit(c) != 0; });
    if (is_number) found.emplace_back(std::stoll(digits), entry.path().string());
  }
  std::ranges::sort(found);
  std::vector<std::string> paths;
  for (auto& [step, path] : found) paths.push_back(std::move(path));
  return paths;
}

}  // namespace

void Checkpoints::begin() {
  do_together(mpi_, [&] {
    if (!mpi_.root()) return;
    for (const std::string& path : checkpoints_in(directory(), stem_)) std::filesystem::remove(path);
  });
}

void Checkpoints::keep_identity(Keeper& keeper) const {
  std::string mesh = mesh_identity_, keys = identity_of(setup_, geometry_);
  keeper.text("mesh", mesh);
  keeper.text("case", keys);
  std::string program = "Cobasis " COBASIS_VERSION;
  if (!keeper.reads()) keeper.text("program", program);
  if (mesh != mesh_identity_)
    throw InputError(
        fmt::format("{}: --restart: the checkpoint '{}' is of another mesh: {} there, {} now; allowed: the "
                    "same mesh, on any number of ranks",
                    setup_.case_file, latest(), mesh, mesh_identity_));
  if (const std::string other = differences(keys, identity_of(setup_, geometry_)); !other.empty())
    throw InputError(
        fmt::format("{}: --restart: the checkpoint '{}' is of another case: {}; allowed to change: "
                    "end_time, max_steps, cfl, checkpoint_every, title, when there is output and where",
                    setup_.case_file, latest(), other));
}

/// The newest that is whole; on rank 0.
std::string Checkpoints::choose() {
  std::vector<std::string> paths = checkpoints_in(directory(), stem_);
  if (paths.empty())
    throw InputError(fmt::format("{}: --restart: there is no checkpoint in '{}'; allowed: a run without --restart",
                                 setup_.case_file, directory()));
  for (; !paths.empty(); paths.pop_back()) {
    const std::string wrong = what_is_wrong_with_checkpoint(paths.back());
    if (wrong.empty()) return paths.back();
    std::cerr << fmt::format("cobasis: the checkpoint '{}' cannot be used: {}{}\n", paths.back(), wrong,
                             paths.size() > 1 ? "; trying the one before" : "");
  }
  throw InputError(fmt::format("{}: --restart: no checkpoint in '{}' is whole; allowed: a run without --restart",
                               setup_.case_file, directory()));
}

void Checkpoints::restore(const Keep& keep) {
  std::string path, mistake;
  do_together(mpi_, [&] {
    if (!mpi_.root()) return;
    try {
      path = choose();
    } catch (const InputError& error) {
      mistake = error.what();
    }
  });
  mpi_.broadcast(mistake);
  if (!mistake.empty()) throw InputError(mistake);
  mpi_.broadcast(path);
  good_ = {path};
  StateReader reader(path, mesh_, mpi_);
  keep_identity(reader);
  keep(reader);
  written_at_ = seconds();
}

bool Checkpoints::is_time(std::int64_t step) const {
  const CheckpointEvery& every = setup_.checkpoint_every.value_or(CheckpointEvery{});
  return every.steps ? step % *every.steps == 0 : mpi_.root() && seconds() - written_at_ >= 60 * every.minutes;
}

void Checkpoints::update(const Keep& keep, std::int64_t step, bool last) {
  const bool at_the_end = last && setup_.checkpoint_every;
  int wish = std::max<int>(signals_->take(), at_the_end || is_time(step) ? on_time : nothing);
  wish = static_cast<int>(mpi_.max(wish));
  if (wish == nothing) return;
  write(keep, step);
  if (wish == and_stop)
    throw SystemError(fmt::format(
        "cobasis: stopped by SIGTERM after step {}; --restart goes on from the checkpoint '{}'", step, latest()));
  if (wish == on_signal && mpi_.root()) std::cerr << fmt::format("cobasis: checkpoint '{}'\n", latest());
}

void Checkpoints::write(const Keep& keep, std::int64_t step) {
  const std::string path = fmt::format("{}/{}_{:09}.h5", directory(), stem_, step);
  StateWriter writer(path, mesh_, mpi_);
  keep_identity(writer);
  keep(writer);
  writer.finish();
  std::erase(good_, path);
  good_.push_back(path);
  if (good_.size() > 2) good_.erase(good_.begin());
  written_at_ = seconds();
  do_together(mpi_, [&] {
    if (!mpi_.root()) return;
    for (const std::string& other : checkpoints_in(directory(), stem_))
      if (std::ranges::find(good_, other) == good_.end()) std::filesystem::remove(other);
  });
}

}  // namespace cobasis
