#include "app/study_meshes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "math/errors.hpp"
#include "math/suggestion.hpp"

namespace cobasis {
namespace {

constexpr const char* split = "split";

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream stream(text);
  for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
  return words;
}

/// What --refine may name: numbers that the case sets, as counts.
std::vector<std::string> candidates(const Setup& setup) {
  std::vector<std::string> names;
  for (const auto& [name, value] : setup.mesh_parameters) names.push_back(name);
  names.emplace_back(split);
  return names;
}

/// Where nothing is said: the number of cells n, or their size h.
std::string default_refine(const Setup& setup) {
  if (setup.mesh_parameters.contains("n")) return "n";
  if (setup.mesh_parameters.contains("h")) return "1/h";
  throw InputError(fmt::format(
      "{}: the case sets no mesh_parameters n (cells along an edge) or h (size of a cell), so which numbers make the "
      "mesh finer? allowed: --refine NAME for a count in mesh_parameters, --refine 1/NAME for a size, several with "
      "commas; or --refine split: each cell is cut into 4 (plane) or 8 (space), the case's mesh is the coarsest",
      setup.case_file));
}

}  // namespace

Refinement::Refinement(const Setup& setup, const std::string& refine) : all_(setup.mesh_parameters) {
  const std::string given = refine.empty() ? default_refine(setup) : refine;
  if (given == split) return;
  for (const std::string& word : words_of(given)) {
    const bool is_size = word.starts_with("1/");
    const std::string name = is_size ? word.substr(2) : word;
    const auto found = all_.find(name);
    if (found == all_.end())
      throw InputError(
          fmt::format("--refine {}: \"{}\" is not among the case's mesh_parameters; {} (1/NAME for a size)", given,
                      name, allowed_names(name, candidates(setup))));
    if (!(found->second > 0))
      throw InputError(fmt::format("--refine {}: {} = {}; allowed: a number above 0", given, name, found->second));
    parameters_.push_back({name, is_size});
  }
  if (parameters_.empty()) throw InputError(fmt::format("--refine {}: names nothing", given));
}

StudyMesh Refinement::mesh(double h) const {
  StudyMesh mesh{h, all_, 0, {}};
  if (splits()) {
    mesh.splits = std::max(0, static_cast<int>(std::ceil(-std::log2(h) - 1e-9)));
    mesh.h = std::exp2(-mesh.splits);
    mesh.name = fmt::format("split {} times", mesh.splits);
    return mesh;
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const auto& [name, is_size] = parameters_[i];
    const double own = all_.at(name);
    double& value = mesh.parameters[name];
    value = is_size ? own * h : own / h;
    if (!is_size && own == std::floor(own)) value = std::round(value);
    if (i == 0) mesh.h = is_size ? value / own : own / value;
    names.push_back(fmt::format("{} = {:.6g}", name, value));
  }
  mesh.name = fmt::format("{}", fmt::join(names, ", "));
  return mesh;
}

void Refinement::check(const StudyMesh& mesh, double h) const {
  for (const auto& [name, is_size] : parameters_) {
    const double own = all_.at(name), value = mesh.parameters.at(name);
    if (!is_size && std::fabs(value * h / own - 1) > 0.25)
      throw InputError(fmt::format(
          "{} = {:g} cannot be divided by {:.4g} into whole cells; allowed: a finer mesh in the case (--set "
          "mesh_parameters.{}=...), a smaller --ratio, fewer --meshes",
          name, own, h, name));
  }
}

std::vector<StudyMesh> mesh_sequence(const Refinement& refinement, const StudyOptions& options) {
  if (refinement.splits() && options.ratio != 2)
    throw InputError(fmt::format("--ratio {}: splitting halves cells; allowed: 2", options.ratio));
  std::vector<StudyMesh> meshes;
  for (int i = 0; i < options.meshes; ++i) {
    const int level = refinement.splits() ? -i : options.meshes - 1 - i;
    meshes.push_back(refinement.mesh(std::pow(options.ratio, level)));
    refinement.check(meshes.back(), std::pow(options.ratio, level));
    if (i > 0 && !(meshes[i].h < 0.95 * meshes[i - 1].h))
      throw InputError(
          fmt::format("meshes {} and {} are as good as the same, {} and {}; allowed: a larger --ratio, or a "
                      "finer mesh in the case",
                      i, i + 1, meshes[i - 1].name, meshes[i].name));
  }
  return meshes;
}

}  // namespace cobasis
