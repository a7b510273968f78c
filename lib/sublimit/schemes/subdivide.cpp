// SPDX-License-Identifier: Apache-2.0
#include "sublimit/subdivide.h"

#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/scheme/detail/check_levels.h"
#include "sublimit/schemes/schemes.h"

namespace sublimit {

std::pair<SparseMatrix, FaceMatrix> subdivide(const std::string& name, Index num_vertices, const FaceMatrix& F,
                                              int levels, const SubdivisionOptions& options) {
  const Scheme<double> scheme = sublimit::scheme(name);
  Level level;
  level.steps.emplace_back();
  level.steps[0].topology = Topology(view<Eigen::Dynamic>(num_vertices, F));
  const Boundary boundary = options.boundary.value_or(Boundary::edge_and_corner);
  level.sharpness = initial_sharpness(level.topology(), {}, boundary, options.creasing.value_or(Creasing::uniform));
  level.holes.assign(level.topology().num_faces(), false);
  check_levels(scheme, level.topology(), levels);
  SparseMatrix P(num_vertices, num_vertices);
  P.setIdentity();
  for (int k = 0; k < levels; ++k) {
    level = next_level(scheme, level);
    k == 0 ? P.swap(level.S) : product(level.S, P).swap(P);
  }
  const Topology& t = level.topology();
  const Index columns = levels == 0 ? static_cast<Index>(F.cols()) : t.uniform_face_size();
  FaceMatrix faces(t.num_faces(), columns);
  for (Index f = 0; f < t.num_faces(); ++f)
    for (Index k = 0; k < columns; ++k) faces(f, k) = t.vertices(Face{f})[k];
  return {std::move(P), std::move(faces)};
}

}  // namespace sublimit
