// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/analysis/exports.h"

#include <fmt/core.h>

#include "sublimit/base/detail/atomic_file.h"
#include "sublimit/certificates/spectra/local_modes.h"
#include "sublimit/io/write_mesh.h"
#include "sublimit/report/analysis/neighborhood.h"

namespace sublimit::report {
namespace {

void write_matrix(const std::filesystem::path& path, const LocalPatch<Algebraic>& patch, const std::string& title) {
  AtomicFile file(path);
  file.write(fmt::format("# {}: new points from old ones over one period of levels\n# labels {}: sector x y\n", title,
                         patch.labels.size()));
  for (const SectorLabel& l : patch.labels) file.write(fmt::format("{} {} {}\n", l.sector, l.x(), l.y()));
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < patch.A.rows(); ++i)
    for (Eigen::Index j = 0; j < patch.A.cols(); ++j) count += !patch.A(i, j).is_zero();
  file.write(fmt::format(
      "# entries {}: row column weight, from 0 on; [N] a b c ... is a + b z + c z^2 ..., z = exp(2 pi i/N)\n", count));
  for (Eigen::Index i = 0; i < patch.A.rows(); ++i)
    for (Eigen::Index j = 0; j < patch.A.cols(); ++j)
      if (!patch.A(i, j).is_zero()) file.write(fmt::format("{} {} {}\n", i, j, patch.A(i, j).exact_text()));
  file.commit();
}

}  // namespace

void write_exports(const std::filesystem::path& directory, const std::vector<ReportedScheme>& schemes,
                   const std::vector<int>& valences) {
  for (const ReportedScheme& scheme : schemes)
    for (const NeighborhoodKind& kind : neighborhoods(scheme.scheme, valences)) {
      const LocalType type = local_type(kind);
      const auto patch = local_patch(scheme.exact, kind);
      if (!patch) continue;
      const std::string name = fmt::format("{}-{}-{}", scheme.scheme.name, kind.name(), kind.n);
      write_matrix(directory / (name + ".matrix.txt"), *patch, name);
      if (type.open) continue;
      const auto modes = local_modes(scheme.scheme, type);
      if (!modes || modes->leading.block == 0) continue;
      Mesh mesh = modes->net.mesh;
      mesh.positions.col(0) = modes->leading.net.real();
      mesh.positions.col(1) = modes->leading.net.imag();
      write_mesh(directory / (name + ".map.obj"), mesh);
    }
}

}  // namespace sublimit::report
