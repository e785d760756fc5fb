// The meshes of a study, from the numbers that the case's mesh script takes.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "solver/setup.hpp"

namespace cobasis {

/// What `cobasis study` takes besides a case.
struct StudyOptions {
  int meshes = 3;
  double ratio = 2;  ///< of the sizes of cells of two meshes
  std::string
      refine;  ///< comma-separated: NAME, a count that grows; 1/NAME, a size that shrinks; or split. Empty: n, 1/h
  std::vector<double> accuracies = {1e-2, 1e-3, 1e-4};  ///< relative
};

struct StudyMesh {
  double h = 1;                              ///< size of the cells, in that of the case's own mesh
  std::map<std::string, double> parameters;  ///< all mesh_parameters
  int splits = 0;                            ///< how often Gmsh splits the mesh
  std::string name;                          ///< "n = 500"
};

/// How a case's mesh is refined.
class Refinement {
 public:
  /// Throws InputError: no such number, or none that can be chosen without being told.
  Refinement(const Setup& setup, const std::string& refine);

  bool splits() const { return parameters_.empty(); }
  /// The mesh with cells of about the size h, in that of the case's own mesh; its own h is exact. Counts are rounded to
  /// whole numbers if the case's are. Splitting: h is cut to a power of 1/2.
  StudyMesh mesh(double h) const;
  /// Throws InputError if whole numbers keep the mesh's counts from what h asks for.
  void check(const StudyMesh& mesh, double h) const;

 private:
  struct Parameter {
    std::string name;
    bool is_size;
  };
  std::map<std::string, double> all_;
  std::vector<Parameter> parameters_;  ///< empty: split
};

/// From coarse to fine, each finer than the one before. The finest is the case's own; where the mesh is split, the
/// coarsest is. Throws InputError.
std::vector<StudyMesh> mesh_sequence(const Refinement& refinement, const StudyOptions& options);

}  // namespace cobasis
