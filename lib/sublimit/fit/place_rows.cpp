// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>
#include <string>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/fit/scattered_fit.h"
#include "sublimit/source/detail/why_outside.h"

namespace sublimit {
namespace {

void check(const FaceCount& faces, const Place& s, size_t i) {
  if (!is_inside(faces, s))
    throw InvalidParameter("target " + std::to_string(i) + ": " + why_outside(faces, s.face, s.u, s.v));
}

}  // namespace

SparseMatrix place_rows(const LinearSource& surface, const std::vector<Place>& places) {
  const size_t count = places.size();
  if (count > size_t(std::numeric_limits<Index>::max()))
    throw ResourceError(std::to_string(count) + " targets; 32-bit indices count fewer");
  for (size_t i = 0; i < count; ++i) check(surface.faces(), places[i], i);
  std::vector<LimitStencil> stencils(count);
  parallel_for_blocks(
      std::int64_t(count),
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) stencils[i] = surface.stencil(places[i]);
      },
      256);
  double entries = 0;
  for (size_t i = 0; i < count; ++i) {
    if (stencils[i].status == LimitStatus::hole)
      throw InvalidParameter("target " + std::to_string(i) + ": face " + std::to_string(places[i].face) +
                             " is a hole, which is not part of the limit");
    if (!has_position(stencils[i].status))
      throw InvalidParameter("target " + std::to_string(i) + ": the surface has a pole there, and no point");
    entries += double(stencils[i].vertices.size());
  }
  if (entries > double(std::numeric_limits<Index>::max()))
    throw ResourceError("rows of " + std::to_string(count) + " targets with " + std::to_string(std::int64_t(entries)) +
                        " weights; 32-bit indices count fewer");
  SparseMatrix A(Index(count), surface.num_points());
  A.reserve(Eigen::Index(entries));
  for (size_t i = 0; i < count; ++i) {
    A.startVec(Eigen::Index(i));
    for (size_t j = 0; j < stencils[i].vertices.size(); ++j)
      A.insertBack(Eigen::Index(i), stencils[i].vertices[j]) = stencils[i].weights(0, Eigen::Index(j));
  }
  A.finalize();
  return A;
}

}  // namespace sublimit
