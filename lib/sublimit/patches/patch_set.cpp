// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/patch_set.h"

#include <algorithm>
#include <limits>
#include <string>

#include "sublimit/base/error.h"

namespace sublimit {

PatchSet::PatchSet(std::vector<SplineSurface> patches, Coordinates coordinates)
    : patches_(std::move(patches)), coordinates_(coordinates), first_face_{0}, first_point_{0} {
  std::int64_t faces = 0, points = 0;
  for (const SplineSurface& patch : patches_) {
    faces += patch.num_faces();
    points += patch.num_points();
    if (std::max(faces, points) > std::numeric_limits<Index>::max())
      throw ResourceError(std::to_string(patches_.size()) +
                          " patches: more faces or control points than 32-bit indices count");
    first_face_.push_back(static_cast<Index>(faces));
    first_point_.push_back(static_cast<Index>(points));
  }
}

size_t PatchSet::patch_of(Index face) const {
  return static_cast<size_t>(std::upper_bound(first_face_.begin(), first_face_.end(), face) - first_face_.begin()) - 1;
}

LimitStencil PatchSet::stencil(const Sample& sample, int order) const {
  if (sample.face < 0 || sample.face >= faces().size)
    throw InvalidParameter("face " + std::to_string(sample.face) + " does not exist; there are " +
                           std::to_string(faces().size));
  const size_t patch = patch_of(sample.face);
  LimitStencil result = patches_[patch].stencil({sample.face - first_face_[patch], sample.u, sample.v}, order);
  for (Index& v : result.vertices) v += first_point_[patch];
  return result;
}

LimitSamples PatchSet::evaluate(const Points& columns, std::span<const Sample> samples, int order, bool) const {
  const auto count = static_cast<Index>(samples.size());
  LimitSamples all;
  const auto matrices = [](LimitSamples& s) {
    return std::array<Points*, 7>{&s.position, &s.du, &s.dv, &s.duu, &s.duv, &s.dvv, &s.normal};
  };
  const auto sized = [&](Points& m, bool wanted) { m = wanted ? Points::Zero(count, 3) : Points(0, 3); };
  sized(all.position, true);
  for (Points* m : {&all.du, &all.dv, &all.normal}) sized(*m, order >= 1);
  for (Points* m : {&all.duu, &all.duv, &all.dvv}) sized(*m, order >= 2);
  all.status.assign(samples.size(), LimitStatus::outside);
  all.order.assign(samples.size(), 0);
  std::vector<std::vector<Index>> rows(patches_.size());  // of the samples of each patch
  for (Index i = 0; i < count; ++i)
    if (samples[size_t(i)].face >= 0 && samples[size_t(i)].face < faces().size)
      rows[patch_of(samples[size_t(i)].face)].push_back(i);
  for (size_t p = 0; p < patches_.size(); ++p) {
    if (rows[p].empty()) continue;
    std::vector<Sample> own;
    for (const Index i : rows[p])
      own.push_back({samples[size_t(i)].face - first_face_[p], samples[size_t(i)].u, samples[size_t(i)].v});
    const Points points = columns.middleRows(first_point_[p], first_point_[p + 1] - first_point_[p]);
    LimitSamples found = patches_[p].evaluate(points, own, order, coordinates_);
    const auto from = matrices(found), to = matrices(all);
    for (size_t k = 0; k < rows[p].size(); ++k) {
      const Index i = rows[p][k];
      for (size_t m = 0; m < to.size(); ++m)
        if (to[m]->rows() > 0) to[m]->row(i) = from[m]->row(Eigen::Index(k));
      all.status[size_t(i)] = found.status[k];
      all.order[size_t(i)] = found.order[k];
    }
  }
  return all;
}

}  // namespace sublimit
