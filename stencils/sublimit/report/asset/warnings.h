// SPDX-License-Identifier: Apache-2.0
#pragma once
// Warnings for modellers.
#include <algorithm>

#include "sublimit/report/asset/inventory.h"

namespace sublimit::asset {

/// Returns all warnings on a mesh.
/// @param points  positions of the control points
std::vector<AssetWarning> warnings(const Scheme<double>& scheme, const Level& level, const Points& points,
                                   const Inventory& inventory, PointVerdicts& verdicts, const AssetOptions& options);

/// Returns warnings on faces without area, that cross themselves, or that are folded back onto a neighbour.
std::vector<AssetWarning> face_warnings(const Level& level, const Points& points, Index listed);

/// Counts places of one kind, keeping the first ones.
class WarningGroup {
 public:
  WarningGroup(AssetWarning::Severity severity, std::string says, std::string advice)
      : warning_{severity, std::move(says), std::move(advice), {}, {}, 0, {}} {}
  void add_vertex(Index v, const Points& points, Index listed) {
    add(warning_.vertices, v, listed);
    if (!warning_.place) warning_.place = points.row(v);
  }
  void add_face(Index f, const Eigen::Vector3d& place, Index listed) {
    add(warning_.faces, f, listed);
    if (!warning_.place) warning_.place = place;
  }
  void put_into(std::vector<AssetWarning>& out) const {
    if (warning_.count > 0) out.push_back(warning_);
  }

 private:
  void add(std::vector<Index>& list, Index i, Index listed) {
    ++warning_.count;
    if (Index(list.size()) < listed && std::find(list.begin(), list.end(), i) == list.end()) list.push_back(i);
  }
  AssetWarning warning_;
};

}  // namespace sublimit::asset
