#include "app/state_keepers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <exception>
#include <functional>
#include <limits>
#include <numeric>

#include "app/together.hpp"

namespace cobasis {
namespace {

constexpr std::size_t any_size = std::numeric_limits<std::size_t>::max();

std::vector<double> broadcast(const Mpi& mpi, const std::vector<double>& values) {
  std::vector<char> bytes(values.size() * sizeof(double));
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  mpi.broadcast(bytes);
  std::vector<double> result(bytes.size() / sizeof(double));
  if (!bytes.empty()) std::memcpy(result.data(), bytes.data(), bytes.size());
  return result;
}

}  // namespace

bool are_rows(std::span<const double> numbers, std::size_t columns, double n_cells, double least, double most) {
  if (numbers.size() % columns != 0) return false;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double x = numbers[i];
    const bool fits = i % columns == 0 ? x >= 0 && x < n_cells && x == std::floor(x) : !(x < least || x > most);
    if (!fits || (std::isfinite(least) && std::isnan(x))) return false;
  }
  return true;
}

BoundaryOrder::BoundaryOrder(const Mesh& mesh, const Mpi& mpi) {
  const std::int32_t first = mesh.first_boundary_face();
  std::vector<std::array<std::int64_t, 3>> keys(mesh.n_boundary_faces);
  for (std::size_t g = 0; g < mesh.boundary_groups.size(); ++g)
    for (std::int32_t f = mesh.boundary_groups[g].first; f < mesh.boundary_groups[g].last; ++f)
      keys[f - first] = {static_cast<std::int64_t>(g), mesh.global_id[mesh.left[f]], 0};
  for (std::int32_t cell = 0; cell < mesh.n_owned; ++cell)
    for (int j = 0; j < mesh.max_cell_faces; ++j)
      if (const std::int32_t entry = mesh.cell_faces[static_cast<std::size_t>(j) * mesh.cell_stride + cell];
          entry >= 0 && entry / 2 >= first)
        keys[entry / 2 - first][2] = j;
  std::vector<std::int64_t> flat;
  for (const auto& key : keys) flat.insert(flat.end(), key.begin(), key.end());
  const std::int64_t before = [&] {  // faces of the ranks below
    const std::int64_t mine = mesh.n_boundary_faces;
    std::vector<std::int64_t> counts = mpi.gather(std::span(&mine, 1));
    std::vector<double> starts;
    for (std::int64_t sum = 0; const std::int64_t count : counts)
      starts.push_back(static_cast<double>(sum)), sum += count;
    return static_cast<std::int64_t>(broadcast(mpi, starts)[mpi.rank()]);
  }();
  flat = mpi.gather(std::span<const std::int64_t>(flat));
  std::vector<std::int64_t> order(flat.size() / 3);
  std::iota(order.begin(), order.end(), 0);
  const auto key_of = [&](std::int64_t i) { return std::array{flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]}; };
  std::ranges::sort(order, {}, key_of);
  of_gathered.resize(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) of_gathered[order[i]] = static_cast<std::int64_t>(i);
  const std::vector<double> all = broadcast(mpi, {of_gathered.begin(), of_gathered.end()});
  own.assign(all.begin() + before, all.begin() + before + mesh.n_boundary_faces);
}

StateWriter::StateWriter(const std::string& path, const Mesh& mesh, const Mpi& mpi)
    : mesh_(mesh),
      mpi_(mpi),
      ids_(mpi.gather(std::span<const std::int64_t>(mesh.global_id.data(), mesh.n_owned))),
      boundary_(mesh, mpi) {
  on_root([&] { file_.emplace(path); });
}

template <class Action>
void StateWriter::on_root(const Action& action) {
  if (!mpi_.root() || !error_.empty()) return;
  try {
    action();
  } catch (const std::exception& error) {
    error_ = error.what();
  }
}

void StateWriter::number(const std::string& name, double& value) {
  on_root([&] { file_->write(name, std::span(&value, 1)); });
}

void StateWriter::counter(const std::string& name, std::int64_t& value) {
  auto sum = static_cast<double>(mpi_.sum(value));
  number(name, sum);
}

void StateWriter::cells(const std::string& name, std::span<double> values) {
  const std::vector<double> gathered = mpi_.gather(values);
  on_root([&] {
    std::vector<double> ordered(gathered.size());
    for (std::size_t i = 0; i < ids_.size(); ++i) ordered[ids_[i]] = gathered[i];
    file_->write(name, ordered);
  });
}

void StateWriter::boundary_faces(const std::string& name, std::span<double> values) {
  const std::vector<double> gathered = mpi_.gather(values);
  on_root([&] {
    std::vector<double> ordered(gathered.size());
    for (std::size_t i = 0; i < gathered.size(); ++i) ordered[boundary_.of_gathered[i]] = gathered[i];
    file_->write(name, ordered);
  });
}

void StateWriter::some_cells(const std::string& name, CellRows& rows) {
  std::vector<double> flat;
  for (std::size_t i = 0; i < rows.cells.size(); ++i) {
    flat.push_back(static_cast<double>(mesh_.global_id[rows.cells[i]]));
    const auto row = rows.row(i);
    flat.insert(flat.end(), row.begin(), row.end());
  }
  const std::vector<double> gathered = mpi_.gather(flat);
  on_root([&] {
    const auto columns = static_cast<std::size_t>(rows.width) + 1;
    std::vector<std::size_t> order(gathered.size() / columns);
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return gathered[i * columns]; });
    std::vector<double> ordered;
    for (const std::size_t i : order)
      ordered.insert(ordered.end(), gathered.begin() + static_cast<std::ptrdiff_t>(i * columns),
                     gathered.begin() + static_cast<std::ptrdiff_t>((i + 1) * columns));
    file_->write(name, ordered, columns);
  });
}

void StateWriter::text(const std::string& name, std::string& value) {
  on_root([&] { file_->write(name, value); });
}

void StateWriter::finish() {
  on_root([&] { file_->finish(); });
  file_.reset();
  throw_together(mpi_, error_);
}

StateReader::StateReader(const std::string& path, const Mesh& mesh, const Mpi& mpi)
    : mesh_(mesh), mpi_(mpi), path_(path), boundary_(mesh, mpi) {
  do_together(mpi_, [&] {
    if (mpi_.root()) file_.emplace(path);
  });
}

/// Rank 0's, on all ranks.
std::vector<double> StateReader::read(const std::string& name, std::size_t size) {
  std::vector<double> values;
  do_together(mpi_, [&] {
    if (!mpi_.root()) return;
    values = file_->read(name);
    if (size != any_size && values.size() != size)
      throw SystemError(
          fmt::format("cannot read '{}' in '{}': {} numbers instead of {}", name, path_, values.size(), size));
  });
  return broadcast(mpi_, values);
}

void StateReader::number(const std::string& name, double& value) { value = read(name, 1)[0]; }

void StateReader::counter(const std::string& name, std::int64_t& value) {
  const double sum = read(name, 1)[0];
  const std::int64_t all = whole(name, sum);
  value = mpi_.root() ? all : 0;
}

void StateReader::cells(const std::string& name, std::span<double> values) {
  const std::vector<double> all = read(name, static_cast<std::size_t>(mesh_.n_global));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = all[mesh_.global_id[i]];
}

void StateReader::boundary_faces(const std::string& name, std::span<double> values) {
  const auto size = static_cast<std::size_t>(mpi_.sum(mesh_.n_boundary_faces));
  const std::vector<double> all = read(name, size);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = all[boundary_.own[i]];
}

void StateReader::some_cells(const std::string& name, CellRows& rows) {
  const std::vector<double> all = read(name, any_size);
  const auto columns = static_cast<std::size_t>(rows.width) + 1;
  if (!are_rows(all, columns, static_cast<double>(mesh_.n_global), rows.least, rows.most))
    throw SystemError(
        fmt::format("cannot read '{}' in '{}': its numbers are not those of cells of this mesh", name, path_));
  rows.cells.clear();
  rows.values.clear();
  const auto begin = mesh_.global_id.begin(), end = begin + mesh_.n_owned;  // ascending
  for (std::size_t i = 0; i < all.size(); i += columns) {
    const auto id = static_cast<std::int64_t>(all[i]);
    const auto found = std::lower_bound(begin, end, id);
    if (found == end || *found != id) continue;
    rows.cells.push_back(static_cast<std::int32_t>(found - begin));
    rows.values.insert(rows.values.end(), all.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                       all.begin() + static_cast<std::ptrdiff_t>(i + columns));
  }
}

void StateReader::text(const std::string& name, std::string& value) {
  do_together(mpi_, [&] {
    if (mpi_.root()) value = file_->read_text(name);
  });
  mpi_.broadcast(value);
}

}  // namespace cobasis
