#include "solver/orphans.hpp"

#include <catch2/catch.hpp>

#include "sample_fields.hpp"
#include "small_scene.hpp"

using namespace cobasis;

namespace {

using Volumes = std::vector<std::pair<std::int32_t, int>>;

}  // namespace

TEST_CASE("orphans are the fragments with no neighbour that has a state of its own") {
  const Mesh mesh = strip({0, 1, 2, 3, 4, 5, 6, 7, 8});
  Fields fields = empty_fields(mesh);
  std::vector<std::int32_t> cell;
  const std::vector<double> alpha = {0.8, 0.02, 0.01, 0, 0.02, 0, 1e-9, 0.02};
  for (std::size_t i = 0; i < alpha.size(); ++i) {
    cell.push_back(cell_at(mesh, static_cast<double>(i) + 0.5));
    for (Phase& phase : fields.phases) phase.alpha[cell[i]] = 0;
    fields.phases[1].alpha[cell[i]] = alpha[i];
  }
  fields.phases[0].alpha[cell[3]] = 0.7;  // of another phase
  const Faces faces = make_faces(mesh);
  Orphans orphans(one_rank(), mesh, fields);
  const auto find = [&](const Volumes& fragments) { return orphans.find(mesh, faces, fields, fragments, 1e-6); };

  CHECK(find({}).empty());
  CHECK(find({{cell[1], 1}}).empty());
  CHECK(find({{cell[1], 1}, {cell[2], 1}}) == Volumes{{cell[2], 1}});  // what is next to it is no better
  CHECK(find({{cell[4], 1}}) == Volumes{{cell[4], 1}});
  CHECK(find({{cell[7], 1}}) == Volumes{{cell[7], 1}});  // beside it is dust
  CHECK(find({{cell[6], 1}}).empty());                   // which is too little to count
}
