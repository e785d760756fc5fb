// The faces of a rank as sweeps read them: aligned, padded, and ordered by what may be swept before the halo has come.
#pragma once

#include "math/aligned.hpp"
#include "math/pack.hpp"
#include "mesh/mesh.hpp"
#include "physics/face_state.hpp"

namespace cobasis {

/// What a case prescribes beyond boundary faces that are neither open nor mirrors, per face; empty if there are none.
struct Prescribed {
  AlignedVector<double> u[3];      ///< velocity of a wall [m/s]
  AlignedVector<double> bonded;    ///< 1: solids are bonded to it
  AlignedVector<double> outlet;    ///< 1: no wall, but an opening to …
  AlignedVector<double> pressure;  ///< … this pressure [Pa]
};

struct Faces {
  std::int32_t n = 0;  ///< the mesh's faces, in its order; entry n is the face of nobody
  AlignedVector<std::int32_t> left, right;
  AlignedVector<double> area;        ///< [m^2], [m] in a plane
  AlignedVector<double> nx, ny, nz;  ///< unit normal from left to right
  AlignedVector<double> tx, ty, tz;  ///< first tangent
  AlignedVector<double> fastest;     ///< lambda_f of the last sweep [m/s]

  Prescribed prescribed;

  std::int32_t max_cell_faces = 0, cell_stride = 0;
  AlignedVector<std::int32_t> cell_faces;  ///< [j * cell_stride + cell]: 2 face + side; absent: 2 n
};

Faces make_faces(const Mesh& mesh);

/// A part of a list. It begins at a multiple of the pack width, and repeats of its last entry fill its last pack.
struct Segment {
  std::int32_t first = 0;
  std::int32_t last = 0;
};

/// One pack of an ascending list of faces. Mostly they count up by one: then plain loads do. (Where the last pack is
/// filled up by repetition, its last two are equal.)
template <class Real>
struct FacePack {
  Indices<Real> at;
  bool consecutive;

  explicit FacePack(const std::int32_t* list)
      : at(load_indices<Real>(list)),
        consecutive(at.back() - at.front() == lanes<Real> - 1 &&
                    (lanes<Real> == 1 || at.back() != at[lanes<Real> - 2])) {}

  Real operator()(const AlignedVector<double>& values) const {
    return consecutive ? load<Real>(&values[at[0]]) : gather<Real>(values.data(), at);
  }
  Indices<Real> operator()(const AlignedVector<std::int32_t>& values) const {
    return consecutive ? load_indices<Real>(&values[at[0]]) : lookup<Real>(values.data(), at);
  }
  void put(const Real& value, AlignedVector<double>& values) const {
    if (consecutive)
      store(value, &values[at[0]]);
    else
      scatter(value, values.data(), at);
  }
};

template <class G, class Real>
Frame<G, Real> load_frame(const Faces& faces, const FacePack<Real>& of) {
  const Real nx = of(faces.nx), ny = of(faces.ny);
  if constexpr (G::dimension == 2) {
    return {{nx, ny, {}}, {-ny, nx, {}}, {{}, {}, Real(1.0)}};
  } else {
    const Vec3<Real> n{nx, ny, of(faces.nz)}, t1{of(faces.tx), of(faces.ty), of(faces.tz)};
    return {n, t1, cross(n, t1)};
  }
}

/// A face raises its fastest signal; several phases and pairs may speak for it.
template <class Real>
void raise_fastest(Faces& faces, const FacePack<Real>& of, const Real& speed) {
  of.put(faster(speed, of(faces.fastest)), faces.fastest);
}

}  // namespace cobasis
