// SPDX-License-Identifier: Apache-2.0
#include "sublimit/limit/knot_spectrum.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <string>

#include "sublimit/base/error.h"
#include "sublimit/base/format_number.h"
#include "sublimit/neighborhood/sector_mesh.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {

std::vector<std::complex<double>> knot_spectrum(const Scheme<double>& scheme, std::span<const double> intervals) {
  const int n = static_cast<int>(intervals.size());
  if (scheme.knots != NewKnots::halving)
    throw InvalidParameter(scheme.name +
                           " does not put new knots in the middle: intervals around a vertex do not stay");
  if (n < 3) throw InvalidParameter("a vertex has three spokes or more, not " + std::to_string(n));
  for (const double d : intervals)
    if (!(d > 0 && std::isfinite(d))) throw InvalidParameter("interval " + format_number(d) + " is not positive");
  constexpr int rings = 4, inner = 2;  // knots two rings beyond matter
  SectorMesh around = sector_mesh(Centre::Kind::vertex, n, 4, rings);
  const Topology t(view(around.mesh));
  for (Index e = 0; e < t.num_edges(); ++e) {
    // Along x of a sector its spoke runs, along y the next one; labels on a spoke are of the sector that it begins.
    const Index ends[] = {index(t.tail(Edge{e})), index(t.head(Edge{e}))};
    const SectorLabel &a = around.labels[ends[0]], &b = around.labels[ends[1]];
    const SectorLabel& inside = a.y2 > 0 ? a : b;
    const bool on_spoke = a.y2 == 0 && b.y2 == 0;
    int spoke =
        on_spoke ? std::max(a, b, [](const auto& p, const auto& q) { return p.x2 < q.x2; }).sector : inside.sector;
    if (!on_spoke) {
      // Both in one sector, or one of them on the next spoke, whose x is this sector's y.
      const auto in_sector = [&](const SectorLabel& l) {
        return l.sector == inside.sector ? std::pair(l.x2, l.y2) : std::pair(0, l.x2);
      };
      if (in_sector(a).first == in_sector(b).first) spoke = (spoke + 1) % n;
    }
    around.mesh.knot_intervals.push_back({ends[0], ends[1], intervals[size_t(spoke)]});
  }
  const Level control = control_level(scheme, around.mesh), next = next_level(scheme, control);
  const Vertex middle{around.find.at({0, 0, 0})};
  const Centre centre{Centre::Kind::vertex, t.outgoing(middle)};
  const Centre child_centre = child(centre, t, next.steps[0], 0);
  std::map<SectorLabel, Index> number;  // of what two rings have
  std::vector<Index> coarse, fine;
  for (const auto& [vertex, label] : sector_labels(t, centre, inner)) {
    number.try_emplace(label, static_cast<Index>(coarse.size()));
    coarse.push_back(vertex);
  }
  fine.resize(coarse.size());
  for (const auto& [vertex, label] : sector_labels(next.topology(), child_centre, inner))
    fine[number.at(label)] = vertex;
  std::vector<Index> column(t.num_vertices(), -1);
  for (size_t i = 0; i < coarse.size(); ++i) column[coarse[i]] = static_cast<Index>(i);
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(Eigen::Index(coarse.size()), Eigen::Index(coarse.size()));
  for (size_t i = 0; i < fine.size(); ++i)
    for (SparseMatrix::InnerIterator it(next.S, fine[i]); it; ++it)
      if (column[it.col()] >= 0) block(Index(i), column[it.col()]) = it.value();
  const Eigen::VectorXcd values = block.eigenvalues();
  std::vector<std::complex<double>> result(values.begin(), values.end());
  std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return std::abs(a) > std::abs(b); });
  return result;
}

}  // namespace sublimit
