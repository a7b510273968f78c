// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/joins/seam_vertices.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "sublimit/patches/joins/line_samples.h"

namespace sublimit {
namespace {

using Eigen::Vector3d;

/// A corner by number: 4 patch + u_end + 2 v_end.
size_t number(const PatchCorner& corner) { return 4 * corner.patch + (corner.u_end ? 1 : 0) + (corner.v_end ? 2 : 0); }
PatchCorner corner(size_t number) { return {number / 4, number % 2 == 1, number / 2 % 2 == 1}; }

/// A corner's two sides: that of constant v, which runs along u, and that of constant u.
enum class Arm { along_u, along_v };
Arm other(Arm arm) { return arm == Arm::along_u ? Arm::along_v : Arm::along_u; }
using ArmOfCorner = std::pair<size_t, Arm>;

/// The corner at an end of a side.
ArmOfCorner corner_at(const PatchLine& side, bool at_end) {
  const bool across_end = side.end == KnotSide::right;
  const PatchCorner found =
      side.along_v ? PatchCorner{side.patch, across_end, at_end} : PatchCorner{side.patch, at_end, across_end};
  return {number(found), side.along_v ? Arm::along_v : Arm::along_u};
}

/// What a patch has at its corner, its parameters leaving the vertex.
struct CornerJet {
  bool is_regular = false;
  Vector3d position, normal;     // unit, of du x dv; its sign is the corner's own
  Vector3d tangent[2];           // du, dv
  double curvature[2] = {0, 0};  // normal curvatures of the sides along u, v
  double twist = 0;              // N.x_uv/|du x dv|
  double angle = 0;              // of the tangents

  const Vector3d& along(Arm arm) const { return tangent[arm == Arm::along_u ? 0 : 1]; }
  double curvature_along(Arm arm) const { return curvature[arm == Arm::along_u ? 0 : 1]; }
};

CornerJet corner_jet(const PatchColumns& patch, Coordinates coordinates, const PatchCorner& corner) {
  const SplineSurface& surface = *patch.surface;
  const Place place{.face = (corner.u_end ? surface.u().num_faces() - 1 : 0) +
                            surface.u().num_faces() * (corner.v_end ? surface.v().num_faces() - 1 : 0),
                    .u = corner.u_end ? 1.0 : 0.0,
                    .v = corner.v_end ? 1.0 : 0.0};
  const LimitSamples at = surface.evaluate(patch.columns, {&place, 1}, 2, coordinates);
  CornerJet jet;
  if (!has_position(at.status[0])) return jet;
  jet.position = at.position.row(0);
  const double u_sign = corner.u_end ? -1 : 1, v_sign = corner.v_end ? -1 : 1;
  jet.tangent[0] = u_sign * at.du.row(0), jet.tangent[1] = v_sign * at.dv.row(0);
  const Vector3d cross = jet.tangent[0].cross(jet.tangent[1]);
  const double lengths = jet.tangent[0].norm() * jet.tangent[1].norm();
  constexpr double parallel = 1e-9;
  if (!(lengths > 0) || cross.norm() <= parallel * lengths) return jet;
  jet.is_regular = true;
  jet.normal = cross.normalized();
  jet.curvature[0] = jet.normal.dot(at.duu.row(0)) / jet.tangent[0].squaredNorm();
  jet.curvature[1] = jet.normal.dot(at.dvv.row(0)) / jet.tangent[1].squaredNorm();
  jet.twist = u_sign * v_sign * jet.normal.dot(at.duv.row(0)) / cross.norm();
  jet.angle = std::atan2(cross.norm(), jet.tangent[0].dot(jet.tangent[1]));
  return jet;
}

/// Fills what the corners around a vertex say together.
void compare_corners(SeamVertex& vertex, const std::vector<CornerJet>& jets, const std::vector<Arm>& first,
                     double diagonal, const JoinTolerance& tolerance) {
  const size_t n = jets.size();
  for (const CornerJet& a : jets)
    for (const CornerJet& b : jets) {
      const double angle = 2 * std::atan2((a.normal - b.normal).norm(), (a.normal + b.normal).norm());
      vertex.plane_angle = std::max(vertex.plane_angle, std::min(angle, std::numbers::pi - angle));
    }
  vertex.planes_agree = vertex.plane_angle <= tolerance.angle;
  if (!vertex.is_interior || !vertex.planes_agree) return;
  // Numbers with respect to the first corner's normal. M_i changes its sign with that and with the order of u and v,
  // so in du x dv of each corner's own order it does not depend on the latter.
  const auto sign = [&](size_t i) { return jets[i].normal.dot(jets[0].normal) < 0 ? -1.0 : 1.0; };
  double residual = 0, alternating = 0, scale = 1 / std::max(diagonal, 1e-300);
  for (size_t i = 0; i < n; ++i) {
    const size_t before = (i + n - 1) % n;
    const double curvature = sign(i) * jets[i].curvature_along(first[i]);
    const double r = curvature * (1 / std::tan(jets[before].angle) + 1 / std::tan(jets[i].angle));
    residual = std::max(residual, std::abs(sign(i) * jets[i].twist + sign(before) * jets[before].twist - r));
    alternating += i % 2 == 0 ? r : -r;
    scale = std::max(scale, std::abs(curvature));
  }
  vertex.twist_residual = residual;
  if (n % 2 != 0) return;
  vertex.enclosure = alternating;
  vertex.can_be_enclosed = std::abs(alternating) <= tolerance.curvature * scale;
}

}  // namespace

std::vector<SeamVertex> seam_vertices(std::span<const PatchColumns> patches, Coordinates coordinates,
                                      const PatchSeams& seams, const JoinTolerance& tolerance) {
  // Across a side from corner to corner.
  std::map<ArmOfCorner, ArmOfCorner> across;
  std::map<ArmOfCorner, bool> is_collapsed;
  for (const PatchSeam& seam : seams.seams) {
    if (seam.kind == SeamKind::collapsed)
      for (const bool at_end : {false, true}) is_collapsed[corner_at(seam.lines[0], at_end)] = true;
    if (seam.kind != SeamKind::sides) continue;
    for (const bool at_end : {false, true}) {
      const ArmOfCorner a = corner_at(seam.lines[0], at_end), b = corner_at(seam.lines[1], at_end != seam.reversed[1]);
      across[a] = b, across[b] = a;
    }
  }
  std::vector<SeamVertex> vertices;
  std::vector<char> done(4 * patches.size());
  for (size_t start = 0; start < done.size(); ++start) {
    const SplineSurface& surface = *patches[start / 4].surface;
    if (done[start] || surface.u().is_closed() || surface.v().is_closed()) continue;
    // Backwards to the first corner, of a boundary, or around; then forwards.
    ArmOfCorner begin{start, Arm::along_u};  // the corner, and the arm through which it is entered
    SeamVertex vertex;
    for (size_t steps = 0; steps < done.size(); ++steps) {
      const auto before = across.find(begin);
      if (before == across.end()) break;
      begin = {before->second.first, other(before->second.second)};
      if (begin.first == start) {
        vertex.is_interior = true;
        break;
      }
    }
    std::vector<CornerJet> jets;
    std::vector<Arm> entered;
    ArmOfCorner at = begin;
    for (size_t steps = 0; steps < done.size() && !done[at.first]; ++steps) {
      done[at.first] = true;
      vertex.corners.push_back(corner(at.first));
      jets.push_back(corner_jet(patches[at.first / 4], coordinates, vertex.corners.back()));
      entered.push_back(at.second);
      if (!jets.back().is_regular || is_collapsed.contains({at.first, Arm::along_u}) ||
          is_collapsed.contains({at.first, Arm::along_v}))
        vertex.is_degenerate = true;
      const auto next = across.find({at.first, other(at.second)});
      if (next == across.end()) break;
      at = next->second;
    }
    Eigen::Map<Vector3d>(vertex.point.data()) = jets[0].is_regular ? jets[0].position : Vector3d(Vector3d::Zero());
    if (!vertex.is_degenerate) compare_corners(vertex, jets, entered, seams.diagonal, tolerance);
    vertices.push_back(std::move(vertex));
  }
  return vertices;
}

}  // namespace sublimit
