// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/spectra/knot_spectrum.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/dense_decompositions.h"
#include "sublimit/neighborhood/sector_mesh.h"
#include "sublimit/scheme/refine.h"

namespace sublimit {
namespace {

/// The interval of a spoke is that of all edges which run like it.
void set_spokes(SectorMesh& around, const Topology& t, std::span<const double> intervals) {
  const int n = static_cast<int>(intervals.size());
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
}

/// Towards the next corner of the face in the middle a corner has its interval, towards the one before 1.
void set_corners(SectorMesh& around, std::span<const double> intervals) {
  const int n = static_cast<int>(intervals.size());
  const auto corner = [&](int i) { return around.find.at({(i + n) % n, 1, 1}); };
  for (int i = 0; i < n; ++i) {
    around.mesh.knot_intervals.push_back({corner(i), corner(i + 1), intervals[size_t(i)]});
    around.mesh.knot_intervals.push_back({corner(i), corner(i - 1), 1});
  }
}

}  // namespace

std::vector<std::complex<double>> knot_spectrum(const Scheme<double>& scheme, std::span<const double> intervals) {
  const int n = static_cast<int>(intervals.size());
  if (scheme.knots != NewKnots::halving)
    throw InvalidParameter(scheme.name +
                           " does not put new knots in the middle: intervals around a centre do not stay");
  if (n < 3)
    throw InvalidParameter("a vertex has three spokes or more, a face three corners, not " + std::to_string(n));
  for (const double d : intervals)
    if (!(d > 0 && std::isfinite(d))) throw InvalidParameter("interval " + format_number(d) + " is not positive");
  constexpr int rings = 4, inner = 2;  // knots two rings beyond matter
  const bool of_points = scheme.is_dual();
  SectorMesh around = sector_mesh(of_points ? Centre::Kind::face : Centre::Kind::vertex, n, 4, rings);
  if (of_points)
    set_corners(around, intervals);
  else
    set_spokes(around, Topology(view(around.mesh)), intervals);
  Level level = control_level(scheme, around.mesh);
  const Topology& control = level.topology();
  Centre centre{Centre::Kind::face, control.corner(Face{0}, 0)};
  if (!of_points) centre = {Centre::Kind::vertex, control.outgoing(Vertex{around.find.at({0, 0, 0})})};
  // What is beyond a face has its corners' intervals from the next level on.
  for (int k = 0; of_points && k < 2; ++k) {
    Level finer = next_level(scheme, level);
    centre = child(centre, level.topology(), finer.steps[0], k);
    level = std::move(finer);
  }
  const Level next = next_level(scheme, level);
  const Topology& t = level.topology();
  const Centre child_centre = child(centre, t, next.steps[0], level.number);
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
  const Eigen::VectorXcd values = eigenvalues(block);
  std::vector<std::complex<double>> result(values.begin(), values.end());
  std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return std::abs(a) > std::abs(b); });
  return result;
}

}  // namespace sublimit
