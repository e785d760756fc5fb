#include "support/scene.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace cobasis::test {
namespace {

Scene open_scene(Setup setup, const Mpi& mpi, const SceneOptions& options) {
  Scene scene{std::move(setup), {}, nullptr};
  MeshRequest request;
  request.file = scene.setup.mesh_file;
  request.parameters = scene.setup.mesh_parameters;
  request.dimension = !scene.setup.scene ? 0 : *scene.setup.scene == Geometry::space ? 3 : 2;
  request.axisymmetric = scene.setup.scene == Geometry::axisymmetric;
  request.periodic = periodic_pairs(scene.setup);
  request.partition = options.partition;
  scene.mesh = read_mesh(request, mpi);
  if (options.change_mesh) options.change_mesh(scene.mesh);
  return scene;
}

}  // namespace

const Mpi& ranks() {
  static const Mpi mpi(MPI_COMM_WORLD);
  return mpi;
}

Scene make_scene(const std::string& text, const Mpi& mpi, const SceneOptions& options) {
  namespace fs = std::filesystem;
  std::string full = "schema = 1\ntitle = \"test\"\n" + text;
  if (const auto at = full.find("\"@"); at != std::string::npos) full.replace(at + 1, 1, SOURCE_DIR "/meshes/");
  const fs::path file = fs::temp_directory_path() / ("cobasis_test_" + std::to_string(getpid()) + ".toml");
  std::ofstream(file) << full;
  Scene scene = open_scene(read_case(file.string()), mpi, options);
  fs::remove(file);
  scene.solver = std::make_unique<Solver>(scene.setup, geometry_of(scene.mesh), scene.mesh, mpi, options.solver);
  return scene;
}

Scene make_case(const std::string& name, const std::vector<std::pair<std::string, std::string>>& set, const Mpi& mpi,
                const SceneOptions& options) {
  CaseOverrides overrides;
  overrides.set = set;
  Scene scene = open_scene(read_case(SOURCE_DIR "/cases/" + name + ".toml", overrides), mpi, options);
  scene.solver = std::make_unique<Solver>(scene.setup, geometry_of(scene.mesh), scene.mesh, mpi, options.solver);
  return scene;
}

void Scene::run(std::int64_t steps) {
  for (std::int64_t i = 0; i < steps && solver->time() < setup.end_time; ++i) solver->advance(setup.end_time);
}

std::vector<std::vector<double>> state_by_global_cell(const Scene& scene, const Mpi& mpi) {
  const Fields& fields = scene.solver->fields();
  std::vector<double> rows;
  std::size_t width = 0;
  for (std::int32_t cell = 0; cell < scene.mesh.n_owned; ++cell) {
    rows.push_back(static_cast<double>(scene.mesh.global_id[cell]));
    for (const Phase& phase : fields.phases) {
      if (!phase.alpha.empty()) rows.push_back(phase.alpha[cell]);
      for (const auto& component : phase.conserved) rows.push_back(component[cell]);
    }
  }
  width = 1;
  for (const Phase& phase : fields.phases) width += phase.conserved.size() + (phase.alpha.empty() ? 0 : 1);
  rows = mpi.gather(rows);
  std::vector<std::vector<double>> states(mpi.root() ? scene.mesh.n_global : 0);
  for (std::size_t i = 0; i < rows.size(); i += width)
    states[static_cast<std::size_t>(rows[i])].assign(rows.begin() + i + 1, rows.begin() + i + width);
  return states;
}

double mean(const Scene& scene, const Mpi& mpi, const std::function<double(std::int32_t)>& value) {
  std::vector<double> volumes, values;
  for (std::int32_t cell = 0; cell < scene.mesh.n_owned; ++cell) {
    volumes.push_back(scene.mesh.volume[cell]);
    values.push_back(scene.mesh.volume[cell] * value(cell));
  }
  return mpi.exact_sum(values) / mpi.exact_sum(volumes);
}

double total(const Solver& solver, const std::string& column) {
  for (const Column& found : solver.totals())
    if (found.name == column) return found.value;
  throw std::runtime_error("no column " + column);
}

}  // namespace cobasis::test
