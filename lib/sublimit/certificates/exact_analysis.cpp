// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/exact_analysis.h"

#include <algorithm>
#include <map>

#include "sublimit/certificates/exact_masks.h"

namespace sublimit {
namespace {

struct Place {
  int x2 = 0, y2 = 0;  ///< in the chart of sector 0, doubled
};

/// Of a label, in the plane of its own regular centre: sector s is sector 0 turned s times.
Place in_plane(const SectorLabel& label, bool triangles) {
  Place p{label.x2, label.y2};
  for (int s = 0; s < label.sector; ++s) p = triangles ? Place{-p.y2, p.x2 + p.y2} : Place{-p.y2, p.x2};
  return p;
}

/// The other way round near an extraordinary centre, one sector to either side of sector 0.
std::optional<SectorLabel> label_at(Place p, int n, bool triangles, bool is_face) {
  const int least = is_face ? 1 : 0;
  if (p.x2 == 0 && p.y2 == 0) return SectorLabel{};
  if (p.x2 > 0 && p.y2 >= least) return SectorLabel{0, p.x2, p.y2};
  const int sum = triangles ? p.x2 + p.y2 : 0;
  if (p.x2 <= 0 && p.y2 > 0 && (!triangles || sum > 0)) return SectorLabel{1, triangles ? sum : p.y2, -p.x2};
  if (p.y2 < 0 && p.x2 > 0 && (!triangles || sum >= 0)) return SectorLabel{n - 1, -p.y2, triangles ? sum : p.x2};
  return std::nullopt;
}

}  // namespace

std::optional<ExactAnalysis> exact_analysis(const Scheme<Algebraic>& scheme, const LocalType& type, int rings) {
  std::optional<LocalPatch<Algebraic>> patch = local_patch(scheme, type, rings);
  if (!patch) return std::nullopt;
  ExactAnalysis analysis;
  analysis.scheme = scheme;
  analysis.patch = std::move(*patch);
  analysis.spectrum = exact_spectrum(analysis.patch);
  const bool is_face = scheme.is_dual();
  const LocalType regular{.kind = is_face ? Centre::Kind::face : Centre::Kind::vertex,
                          .faces = scheme.regular_valence()};
  try {
    if (auto there = local_patch(scheme, regular)) {
      analysis.regular_mask = exact_masks(*there).position;
      analysis.regular = std::move(there);
    }
  } catch (const AnalysisError&) {  // no limit there: nothing will be seen
  }
  return analysis;
}

std::vector<ComplexBall> mode(const ExactAnalysis& analysis, int block, const ExactKernel& kernel, int vector,
                              long bits) {
  const PrecisionScope scope(bits);
  const std::vector<ComplexBall> amplitudes = kernel.enclosure(vector, bits);
  std::vector<ComplexBall> values(analysis.patch.A.rows());
  const auto& orbits = analysis.spectrum.blocks.orbits.at(std::max(0, block));
  for (size_t i = 0; i < orbits.size(); ++i)
    for (size_t s = 0; s < orbits[i].size(); ++s)
      values[orbits[i][s]] =
          block > 0 ? amplitudes[i] * ComplexBall::root_of_unity(block * static_cast<long>(s), analysis.n())
                    : amplitudes[i];
  return values;
}

namespace {

/// The regular places next to an extraordinary centre, and the points around them.
class RegularPlaces {
 public:
  explicit RegularPlaces(const ExactAnalysis& analysis)
      : analysis_(analysis),
        triangles_(analysis.scheme.face_size() == 3),
        is_face_(analysis.patch.type.kind == Centre::Kind::face),
        dilation_(analysis.scheme.steps[0].split == Split::sqrt3 ? 3 : 2) {
    for (size_t i = 0; i < analysis.patch.labels.size(); ++i)
      position_[analysis.patch.labels[i]] = static_cast<Index>(i);
    for (const SectorLabel& label : analysis.regular->labels) offsets_.push_back(in_plane(label, triangles_));
  }

  /// Points around a place in the order of a regular centre's, -1 for those that the patch has not. Nothing where a
  /// point that the limit depends on is missing, or its like around the child, at dilation * place, is not made as on
  /// regular meshes. Points beyond the patch are.
  std::optional<std::vector<Index>> around(Place place) const {
    std::vector<Index> points;
    for (const Place& offset : offsets_) points.push_back(find(place, 1, offset));
    for (size_t p = 0; p < offsets_.size(); ++p) {
      if (analysis_.regular_mask[p].is_zero()) continue;
      if (points[p] < 0) return std::nullopt;
      const Index row = find(place, dilation_, offsets_[p]);
      if (row >= 0 && !is_regular_row(row, points, p)) return std::nullopt;
    }
    return points;
  }

 private:
  Index find(Place place, int scale, Place offset) const {
    const auto label =
        label_at({scale * place.x2 + offset.x2, scale * place.y2 + offset.y2}, analysis_.n(), triangles_, is_face_);
    const auto at = label ? position_.find(*label) : position_.end();
    return at == position_.end() ? -1 : at->second;
  }

  bool is_regular_row(Index row, const std::vector<Index>& points, size_t p) const {
    const DenseMatrix<Algebraic>&A = analysis_.patch.A, &R = analysis_.regular->A;
    std::map<Index, Algebraic> expected;
    for (size_t q = 0; q < points.size(); ++q)
      if (const Algebraic& weight = R(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(q)); !weight.is_zero()) {
        if (points[q] < 0) return false;
        expected[points[q]] += weight;
      }
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
      const auto at = expected.find(static_cast<Index>(j));
      if (at == expected.end() ? !A(row, j).is_zero() : !(A(row, j) == at->second)) return false;
    }
    return true;
  }

  const ExactAnalysis& analysis_;
  bool triangles_, is_face_;
  int dilation_;
  std::map<SectorLabel, Index> position_;
  std::vector<Place> offsets_;
};

}  // namespace

namespace {

std::optional<bool> look_for(const ExactAnalysis& analysis, const ExactEigenvalue& value) {
  const ExactKernel kernel =
      exact_chain_ends(analysis.spectrum.blocks.blocks.at(value.block), value.value, value.largest_jordan());
  const RegularPlaces places(analysis);
  std::vector<std::vector<Index>> found;
  for (const Place place : {Place{2, 0}, Place{2, 2}, Place{4, 0}, Place{4, 2}, Place{2, 4}, Place{4, 4}})
    if (auto points = places.around(place)) found.push_back(std::move(*points));
  const PrecisionScope scope(128);
  for (int v = 0; v < static_cast<int>(kernel.vectors.size()); ++v) {
    const std::vector<ComplexBall> values = mode(analysis, value.block, kernel, v);
    for (const std::vector<Index>& points : found) {
      ComplexBall limit;
      for (size_t p = 0; p < points.size(); ++p)
        if (!analysis.regular_mask[p].is_zero()) limit += analysis.regular_mask[p].enclosure() * values[points[p]];
      if (!limit.contains_zero()) return true;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<bool> is_seen(const ExactAnalysis& analysis, const ExactEigenvalue& value) {
  if (analysis.n() < 3 || analysis.regular_mask.empty()) return std::nullopt;
  const ComplexBall& at = value.value.enclosure();
  const std::array<double, 4> key{double(value.rank), double(value.block), at.re().mid(), at.im().mid()};
  const auto found = analysis.seen.find(key);
  if (found != analysis.seen.end()) return found->second;
  return analysis.seen[key] = look_for(analysis, value);
}

}  // namespace sublimit
