// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/spectra/mirror.h"

#include <algorithm>
#include <map>

namespace sublimit {

SectorLabel mirrored(const SectorLabel& label, int n, bool closed) {
  if (label.x2 == 0 && label.y2 == 0) return label;
  if (label.y2 != 0) return {n - 1 - label.sector, label.y2, label.x2};
  const int spoke = n - label.sector;
  return {closed && spoke == n ? 0 : spoke, label.x2, 0};
}

std::optional<std::vector<Index>> mirror_images(const LocalPatch<Algebraic>& patch) {
  // An open fan has points on a spoke of its own at its end.
  const bool closed = std::none_of(patch.labels.begin(), patch.labels.end(),
                                   [&](const SectorLabel& label) { return label.sector == patch.type.faces; });
  std::map<SectorLabel, Index> at;
  for (size_t i = 0; i < patch.labels.size(); ++i) at[patch.labels[i]] = static_cast<Index>(i);
  std::vector<Index> images;
  for (const SectorLabel& label : patch.labels) {
    const auto found = at.find(mirrored(label, patch.type.faces, closed));
    if (found == at.end()) return std::nullopt;
    images.push_back(found->second);
  }
  const DenseMatrix<Algebraic>& A = patch.A;
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    for (Eigen::Index j = 0; j < A.cols(); ++j)
      if (!(A(i, j) == A(images[static_cast<size_t>(i)], images[static_cast<size_t>(j)]))) return std::nullopt;
  return images;
}

ExactBlocks mirror_blocks(const DenseMatrix<Algebraic>& A, const std::vector<Index>& images) {
  ExactBlocks result;
  for (const bool odd : {false, true}) {
    std::vector<std::vector<Index>> pairs;
    for (Index i = 0; i < static_cast<Index>(images.size()); ++i) {
      const Index image = images[static_cast<size_t>(i)];
      if (image > i) pairs.push_back({i, image});
      if (image == i && !odd) pairs.push_back({i});
    }
    const auto size = static_cast<Eigen::Index>(pairs.size());
    DenseMatrix<Algebraic> B(size, size);
    for (Eigen::Index i = 0; i < size; ++i)
      for (Eigen::Index j = 0; j < size; ++j) {
        const Index row = pairs[static_cast<size_t>(i)][0];
        const std::vector<Index>& pair = pairs[static_cast<size_t>(j)];
        B(i, j) = A(row, pair[0]);
        if (pair.size() > 1) B(i, j) += odd ? -A(row, pair[1]) : A(row, pair[1]);
      }
    result.blocks.push_back(std::move(B));
    result.orbits.push_back(std::move(pairs));
  }
  return result;
}

}  // namespace sublimit
