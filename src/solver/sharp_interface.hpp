// Sharp interfaces: a plane in every cell that an interface crosses. It says which part of a face each phase has during
// a step, and with which area and normal the phases meet inside the cell.
//
// Where two bodies move past each other along a straight interface, every cell and face sees the same plane: the faces
// carry each phase with itself, and what the phases do to each other happens along the interface's own normal. Neither
// sees the slip, on any mesh.
#pragma once

#include <span>

#include "mesh/geometry.hpp"
#include "mesh/neighbour_exchange.hpp"
#include "solver/keeper.hpp"
#include "solver/kernels.hpp"
#include "solver/plane_cut.hpp"

namespace cobasis {

class SharpInterface {
 public:
  /// Makes room in `fields`. Collective.
  SharpInterface(const Mpi& mpi, const Mesh& mesh, const Faces& faces, Fields& fields, const Setup& setup,
                 const std::vector<PhaseKernels>& kernels, const std::vector<PairKernels>& pairs,
                 const std::vector<Boundary>& boundaries);

  /// Planes from the volume fractions and states at the beginning of a step; the halo must be known. Where an interface
  /// may arrive, absent phases get the state with which they would come. So do `followers`, (cell, phase) of fragments
  /// whose own state is not admissible: what they contain stays theirs. Collective.
  void place(const Faces& faces, Fields& fields, std::span<const std::pair<std::int32_t, int>> followers);
  /// Fractions of the faces over a step of this length: Fields::near, Phase::wetted.
  void wet(const Faces& faces, Fields& fields, double dt);
  /// What phases do to each other inside the listed cells: Phase::inner.
  void act(const Faces& faces, Fields& fields, std::span<const std::int32_t> touched);
  /// Whether a small volume fraction is what the interface makes there, and not what it has left behind: whether a
  /// neighbour's plane, moved on by the step, cuts off the same of the cell, or no neighbour is cut.
  bool expects(const Fields& fields, int k, std::int32_t cell, double dt) const;
  /// The normals from which those of the next step are found, and which cells were cut once.
  void keep(Keeper& keeper);

 private:
  struct Cell {
    CutPlane plane;
    PlaneSection cut;
    double speed = 0;         ///< of the plane along its normal [m/s]
    double ripple_speed = 0;  ///< see ripple_speed [m/s]
    double blend = 1;         ///< how much of what the plane says counts for its faces, see blend_of
    int ring = 0;  ///< 1: the cell is cut; 2, 3: it has the plane of a neighbour; -1: it is cut, but keeps its
                   ///< plane for itself; valid if step is the present
    std::int64_t step = -1;  ///< in which it was placed
  };
  /// Where the sections of planes around a cell lie: sums of weight times 1, r and r r, r from the cell's centroid, and
  /// times the normals.
  struct Moments {
    double w = 0;
    Point r{0, 0, 0}, n{0, 0, 0};
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
    void add(const Moments& other, const Point& delta);  ///< `delta`: to the other cell's centroid
    Moments mirrored(const Point& m) const;
  };
  bool is_cut(const Fields& fields, int k, std::int32_t cell) const;
  bool knows_plane(std::int32_t cell) const;
  bool valid(int k, std::int32_t cell) const { return cells_[k][cell].step == step_; }
  bool is_symmetry(std::int32_t face) const {
    return face >= mesh_.first_boundary_face() && is_symmetry_[face - mesh_.first_boundary_face()];
  }
  Point gradient(const Faces& faces, const Fields& fields, int k, std::int32_t cell) const;
  /// Steps of a volume fraction around a cell, times the areas of its faces.
  struct Steps {
    Point vector{0, 0, 0};  ///< downward, which is outward
    double size = 0;        ///< without direction
    /// Whether those on opposite sides leave nothing that says where a plane could lie.
    bool cancel() const { return length(vector) < 0.01 * size; }
  };
  Steps steps_around(const Faces& faces, const Fields& fields, int k, std::int32_t cell) const;
  bool has_direction(const Faces& faces, const Fields& fields, std::int32_t cell) const;
  const CellCorners& find_corners(std::int32_t cell);
  void put_plane(const Fields& fields, int k, std::int32_t cell, const Point& n);
  Point mean_normal(int k, std::int32_t cell) const;
  static int hops_of(CellType type);
  Moments& moments_for(std::int32_t cell);
  Moments moments_of(std::int32_t cell) const {
    return moments_at_[cell] < 0 ? Moments{} : moments_[moments_at_[cell]];
  }
  void gather_moments(const Fields& fields, int k);
  Moments own_moments(const Fields& fields, int k, std::int32_t cell) const;
  void exchange_moments();
  Point fitted_normal(int k, std::int32_t cell) const;
  void exchange(Fields& fields);
  void find_entered(const Faces& faces, const Fields& fields, std::int32_t cell, double dt);
  void exchange_for_faces();
  /// Whether what lies where in a cell counts: at second order.
  bool knows_centres(const Fields& fields) const { return fields.phases[planes_of_[0]].centre.stride != 0; }
  template <class Part, class Place>
  void put_centroids(Fields& fields, const Part& part_of, const Place& place) const;
  void find_centres(Fields& fields);
  void find_wetted_centroids(Fields& fields, std::int32_t face, int side, double dt) const;
  void forget_wetted_centroids(Fields& fields, std::int32_t face) const;
  void find_speeds(Fields& fields);
  void find_ripple_speeds(Fields& fields);
  double extent(const Fields& fields, int k, std::int32_t cell) const;
  void level(const Faces& faces, Fields& fields, int k, std::int32_t face, double step, double dt);
  void seed(const Faces& faces, Fields& fields);
  void spread(Fields& fields, int ring);
  void adopt(Fields& fields, int k, std::int32_t cell, std::int32_t from, const CutPlane& plane, double speed,
             int ring);
  void follow(Fields& fields, std::span<const std::pair<std::int32_t, int>> followers);
  /// Whether the state of a phase that the cell's arrays hold is another cell's.
  bool borrows(int k, std::int32_t cell) const { return borrowed_[k][cell] >= first_stage_; }
  bool lends(const Fields& fields, int k, std::int32_t cell) const;
  void borrow(Fields& fields, int k, std::int32_t cell, std::int32_t from);
  void borrow_missing(Fields& fields, std::int32_t cell);
  std::int32_t richest_neighbour(const Fields& fields, int k, std::int32_t cell) const;
  void lend_to_faces(Fields& fields, int k, std::int32_t cell) const;
  bool has_state(const Fields& fields, int k, std::int32_t cell) const;
  void run_speeds(Fields& fields);
  void run_contacts(Fields& fields, FreeSurfaceKernel PhaseKernels::*before_void, ContactKernel PairKernels::*between);
  double blend_of(const Fields& fields, int k, std::int32_t cell, double dt) const;
  double left_weight(const Faces& faces, const Fields& fields, std::int32_t face) const;
  double side_fraction(const Fields& fields, int k, std::int32_t face, int side, double dt) const;
  void find_health(Fields& fields);
  bool has_planes(const Fields& fields, std::int32_t cell) const;
  void wet_face(const Faces& faces, Fields& fields, std::int32_t face, double dt);
  void contacts_of(const Faces& faces, const Fields& fields, std::int32_t cell);
  template <class Visit>
  void for_each_face(std::int32_t cell, const Visit& visit) const;  ///< visit(face, side of the cell)

  const Mesh& mesh_;
  FaceOutlines outlines_;
  std::vector<PhaseKernels> kernels_;
  std::vector<PairKernels> pairs_;
  std::vector<int> planes_of_;                              // phases that have planes
  int rest_ = -1;                                           // the phase that takes what they leave; -1: none
  bool before_void_ = false;                                // whether that is a void
  double most_surface_ = 1;                                 // of what is alone in a cell, see blend_of
  std::vector<std::vector<Cell>> cells_;                    // [phase][owned and halo cell]
  std::vector<CellCorners> corners_;                        // of owned cells that were cut once
  std::vector<std::int32_t> corners_at_;                    // where in corners_; -1: not yet
  std::vector<std::int32_t> halo_face_begin_, halo_faces_;  // faces of halo cells: 2 face + side
  std::vector<double> face_radius_;                         // largest distance of a corner from the centroid [m]
  std::vector<bool> is_transmissive_, is_symmetry_;         // boundary faces

  std::vector<std::int32_t> cut_cells_, mixed_cells_;  // owned cells of several phases, with planes and without
  std::vector<std::int32_t> frontier_, next_, near_faces_, centred_;
  std::vector<std::int32_t> thin_layers_;        // pure cells beside other phases, without a plane
  int hops_ = 1;                                 // the most of any cell, see hops_of
  std::vector<Moments> moments_, next_moments_;  // of the phase at hand, see gather_moments
  std::vector<std::int32_t> moments_at_;         // per cell: where in moments_; -1: it has none
  std::vector<std::int32_t> moment_cells_;       // owned cells that gather
  std::vector<ContactList> contacts_;            // [l * n + m], l < m, the void last
  std::vector<Point> between_;                   // [l * n + m], of the cell at hand: area vector from l to m
  std::vector<double> jump_;                     // of the volume fractions at the face at hand
  std::vector<std::vector<std::pair<std::int32_t, int>>> speed_users_;
  std::vector<std::vector<std::int8_t>> health_;   // [phase][cell]: see find_health
  std::vector<std::vector<std::int8_t>> entered_;  // [phase][cell]: see find_entered
  std::vector<std::vector<std::int64_t>>
      borrowed_;                         // [phase][cell]: the last stage in which it took another cell's state
  std::vector<std::int32_t> following_;  // cells of the present followers
  NeighbourExchange exchange_;
  bool shares_planes_;
  bool levels_ = false;  ///< whether ripples are levelled: beside solids
  std::int64_t step_ = 0;
  std::int64_t stage_ = 0, first_stage_ = 0;  // exchanges of planes so far; at the beginning of the step
  bool settled_ = false;                      // whether the normals have been found once
};

template <class Visit>
void SharpInterface::for_each_face(std::int32_t cell, const Visit& visit) const {
  if (cell < mesh_.n_owned) {
    for (int j = 0; j < mesh_.max_cell_faces; ++j) {
      const std::int32_t entry = mesh_.cell_faces[static_cast<std::size_t>(j) * mesh_.cell_stride + cell];
      if (entry >= 0) visit(entry >> 1, entry & 1);
    }
  } else {
    for (std::int32_t i = halo_face_begin_[cell - mesh_.n_owned]; i < halo_face_begin_[cell - mesh_.n_owned + 1]; ++i)
      visit(halo_faces_[i] >> 1, halo_faces_[i] & 1);
  }
}

}  // namespace cobasis
