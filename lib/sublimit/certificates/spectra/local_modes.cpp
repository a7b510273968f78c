// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/spectra/local_modes.h"

#include <algorithm>
#include <numbers>

#include "sublimit/limit/detail/eigen_structure.h"

namespace sublimit {
namespace {

using Complex = std::complex<double>;

/// Orbits that begin in sector 0, so that amplitudes belong to that sector.
std::vector<std::vector<int>> aligned_orbits(const LocalPatch<double>& patch) {
  std::vector<std::vector<int>> orbits;
  for (const std::vector<Index>& orbit : patch.orbits) {
    orbits.emplace_back(orbit.begin(), orbit.end());
    std::rotate(
        orbits.back().begin(),
        std::find_if(orbits.back().begin(), orbits.back().end(), [&](int i) { return patch.labels[i].sector == 0; }),
        orbits.back().end());
  }
  return orbits;
}

LocalMode mode_on(const SectorMesh& net, const LocalPatch<double>& patch, const FourierBlocks& fourier,
                  const EigenCluster& cluster) {
  LocalMode mode{cluster.block, cluster.value, Eigen::VectorXcd::Zero(static_cast<Eigen::Index>(net.labels.size()))};
  const int first = cluster.block == 0 ? 0 : fourier.fixed;
  for (int i = first; i < static_cast<int>(fourier.orbits.size()); ++i)
    for (size_t s = 0; s < fourier.orbits[i].size(); ++s) {
      const auto at = net.find.find(patch.labels[fourier.orbits[i][s]]);
      if (at == net.find.end()) continue;
      const double turn = 2 * std::numbers::pi * cluster.block * static_cast<double>(s) / fourier.n;
      mode.net[at->second] = cluster.right(i - first, 0) * std::polar(1.0, turn);
    }
  return mode;
}

}  // namespace

std::optional<LocalModes> local_modes(const Scheme<double>& scheme, const LocalType& type, int rings) {
  const bool is_face = type.kind == Centre::Kind::face;
  const auto patch = local_patch(scheme, type, rings);
  if (!patch) return std::nullopt;
  const auto fourier = fourier_blocks(patch->A, aligned_orbits(*patch));
  if (!fourier) throw AnalysisError(scheme.name + ": an isolated neighbourhood is not rotationally symmetric");
  LocalModes result;
  result.dilation = scheme.dilation();
  result.net = sector_mesh(type.kind, type.faces, scheme.face_size() == 3 ? 3 : 4, rings);
  std::vector<EigenCluster> clusters;
  for (int k = 0; 2 * k <= fourier->n; ++k)
    for (EigenCluster& cluster : eigen_structure(fourier->blocks[k], k, 3).clusters)
      if (std::abs(cluster.value) < 1 - 1e-9) clusters.push_back(std::move(cluster));
  // Of equal moduli block 1 first: it is what a characteristic map comes from.
  std::stable_sort(clusters.begin(), clusters.end(), [](const EigenCluster& a, const EigenCluster& b) {
    const double x = std::abs(a.value), y = std::abs(b.value);
    if (std::abs(x - y) > 1e-9 * std::max(x, y)) return x > y;
    return std::pair(a.block != 1, a.block) < std::pair(b.block != 1, b.block);
  });
  if (clusters.empty()) throw AnalysisError(scheme.name + ": a local matrix has no mode below 1");
  for (size_t i = 0; i < clusters.size() && result.next.size() < 4; ++i) {
    LocalMode mode = mode_on(result.net, *patch, *fourier, clusters[i]);
    const double size = mode.net.cwiseAbs().maxCoeff();
    if (size > 0) mode.net /= size;
    if (i > 0) {
      result.next.push_back(std::move(mode));
      continue;
    }
    const SectorLabel spoke{0, is_face ? 1 : 2, is_face ? 1 : 0};
    const Complex at = mode.net[result.net.find.at(spoke)];
    if (std::abs(at) > 1e-9) mode.net /= at;
    if (is_face) mode.net *= std::polar(1.0, std::numbers::pi / type.faces);
    result.leading = std::move(mode);
  }
  return result;
}

}  // namespace sublimit
