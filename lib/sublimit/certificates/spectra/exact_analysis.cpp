// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/spectra/exact_analysis.h"

#include <algorithm>
#include <map>

#include "sublimit/certificates/spectra/exact_masks.h"
#include "sublimit/certificates/spectra/sector_chart.h"

namespace sublimit {

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
      analysis.regular_position = exact_masks(*there).position;
      analysis.regular = std::move(there);
    }
  } catch (const AnalysisError&) {  // no limit there: nothing will be seen
  }
  return analysis;
}

std::vector<ComplexBall> mode(const ExactAnalysis& analysis, int block, const ExactKernel& kernel, int vector,
                              long bits) {
  return mode(analysis, block, kernel.enclosure(vector, bits), bits);
}

std::vector<ComplexBall> mode(const ExactAnalysis& analysis, int block, const std::vector<ComplexBall>& amplitudes,
                              long bits) {
  const PrecisionScope scope(bits);
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
        triangular_(analysis.scheme.face_size() == 3),
        dilation_(analysis.scheme.steps[0].split == Split::sqrt3 ? 3 : 2) {
    for (size_t i = 0; i < analysis.patch.labels.size(); ++i)
      position_[analysis.patch.labels[i]] = static_cast<Index>(i);
    for (const SectorLabel& label : analysis.regular->labels) offsets_.push_back(unrolled(label, triangular_));
  }

  /// Points around a place in the order of a regular centre's, -1 for those that the patch has not. Nothing where a
  /// point that the limit depends on is missing, or its like around the child, at dilation * place, is not made as on
  /// regular meshes. Points beyond the patch are.
  std::optional<std::vector<Index>> around(LatticePoint place) const {
    std::vector<Index> points;
    for (const LatticePoint offset : offsets_) points.push_back(find(place, 1, offset));
    for (size_t p = 0; p < offsets_.size(); ++p) {
      if (analysis_.regular_position[p].is_zero()) continue;
      if (points[p] < 0) return std::nullopt;
      const Index row = find(place, dilation_, offsets_[p]);
      if (row >= 0 && !is_regular_row(row, points, p)) return std::nullopt;
    }
    return points;
  }

 private:
  Index find(LatticePoint place, int scale, LatticePoint offset) const {
    const auto label = label_at(scale * place + offset, triangular_, analysis_.n());
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
  bool triangular_;
  int dilation_;
  std::map<SectorLabel, Index> position_;
  std::vector<LatticePoint> offsets_;
};

}  // namespace

namespace {

std::optional<bool> look_for(const ExactAnalysis& analysis, const ExactEigenvalue& value) {
  const RegularPlaces places(analysis);
  std::vector<std::vector<Index>> found;
  for (const LatticePoint place : {LatticePoint{2, 0}, {2, 2}, {4, 0}, {4, 2}, {2, 4}, {4, 4}})
    if (auto points = places.around(place)) found.push_back(std::move(*points));
  if (found.empty()) return std::nullopt;
  const auto shows = [&](const std::vector<ComplexBall>& values) {
    for (const std::vector<Index>& points : found) {
      ComplexBall limit;
      for (size_t p = 0; p < points.size(); ++p)
        if (!analysis.regular_position[p].is_zero())
          limit += analysis.regular_position[p].enclosure() * values[points[p]];
      if (!limit.contains_zero()) return true;
    }
    return false;
  };
  const DenseMatrix<Algebraic>& B = analysis.spectrum.blocks.blocks.at(value.block);
  for (const long bits : {128L, 512L}) {
    if (value.largest_jordan() > 1) break;
    const PrecisionScope scope(bits);
    const auto one = enclosed_eigenvector(B, value.value, bits);
    if (one && shows(mode(analysis, value.block, *one, bits))) return true;
  }
  const PrecisionScope scope(128);
  const ExactKernel kernel = exact_chain_ends(B, value.value, value.largest_jordan());
  for (int v = 0; v < static_cast<int>(kernel.vectors.size()); ++v)
    if (shows(mode(analysis, value.block, kernel, v))) return true;
  return std::nullopt;
}

}  // namespace

std::optional<bool> is_seen(const ExactAnalysis& analysis, const ExactEigenvalue& value) {
  if (analysis.n() < 3 || analysis.regular_position.empty()) return std::nullopt;
  const ComplexBall& at = value.value.enclosure();
  const std::array<double, 4> key{double(value.rank), double(value.block), at.re().mid(), at.im().mid()};
  return analysis.seen.get(key, [&] { return look_for(analysis, value); });
}

}  // namespace sublimit
