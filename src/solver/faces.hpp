// The faces of a rank as sweeps read them: aligned, padded, and ordered by what may be swept before the halo has come.
#pragma once

#include "math/aligned.hpp"
#include "math/pack.hpp"
#include "mesh/mesh.hpp"
#include "physics/scene_types.hpp"

namespace cobasis {

struct Faces {
  std::int32_t n = 0;  ///< the mesh's faces, in its order; entry n is the face of nobody
  AlignedVector<std::int32_t> left, right;
  AlignedVector<double> area;            ///< [m^2], [m] in a plane
  AlignedVector<double> nx, ny, nz;      ///< unit normal from left to right
  AlignedVector<double> tx, ty, tz;      ///< first tangent
  AlignedVector<double> fastest;         ///< lambda_f of the last sweep [m/s]

  std::int32_t max_cell_faces = 0, cell_stride = 0;
  AlignedVector<std::int32_t> cell_faces;  ///< [j * cell_stride + cell]: 2 face + side; absent: 2 n
};

Faces make_faces(const Mesh& mesh);

/// A part of a list. It begins at a multiple of the pack width, and repeats of its last entry fill its last pack.
struct Segment {
  std::int32_t first = 0;
  std::int32_t last = 0;
};

template <class G, class Real>
Frame<G, Real> load_frame(const Faces& faces, const Indices<Real>& at) {
  const Real nx = gather<Real>(faces.nx.data(), at), ny = gather<Real>(faces.ny.data(), at);
  if constexpr (G::dimension == 2) {
    return {{nx, ny, {}}, {-ny, nx, {}}, {{}, {}, Real(1.0)}};
  } else {
    const Vec3<Real> n{nx, ny, gather<Real>(faces.nz.data(), at)};
    const Vec3<Real> t1{gather<Real>(faces.tx.data(), at), gather<Real>(faces.ty.data(), at),
                        gather<Real>(faces.tz.data(), at)};
    return {n, t1, cross(n, t1)};
  }
}

}  // namespace cobasis
