// SPDX-License-Identifier: Apache-2.0
#pragma once
// Foot points: local minimisation of the distance from a point, starting at a place on a surface, on the same
// square or triangle.
#include "sublimit/search/detail/search_domain.h"
#include "sublimit/source/linear_source.h"

namespace sublimit {

/// A foot point.
struct Foot {
  Place place;
  double squared_distance = 0;
};

/// Newton's method on half the squared distance with exact derivatives, or BFGS if second derivatives do not
/// exist. Steps are halved until the distance decreases. They end at the sides, along which the search
/// continues. At places without derivatives the search restarts once from nearby, then continues without
/// derivatives.
class FootSearch {
 public:
  /// @param surface    must outlive this
  /// @param triangles  whether faces are triangles
  /// @param size       size of the surface; steps up to 1e-14 of it count as zero
  FootSearch(const BoundSource& surface, bool triangles, double size)
      : surface_(surface), triangles_(triangles), tiny_(1e-14 * size) {}
  FootSearch(const BoundSource&&, bool, double) = delete;

  /// Returns a foot point.
  /// @param domain   domain of the search; contains `start`
  /// @param order    order of derivatives of the surface, 2 or 1; set to 1 if second ones turn out not to exist
  /// @param nearest  squared distance of the best known point; the search may end early if its result is
  ///                 farther
  Foot operator()(const Eigen::Vector3d& point, const Place& start, const SearchDomain& domain, int& order,
                  double nearest);

 private:
  struct State;
  State at(const Eigen::Vector3d& point, const Place& place, int order);
  void descend(const Eigen::Vector3d& point, const SearchDomain& domain, State& state, int& order, bool along_side);
  /// Descends without derivatives, by steps in eight directions.
  void probe(const Eigen::Vector3d& point, State& state, int& order);
  static Eigen::Vector2d direction(const State& state, const SearchDomain& domain, bool along_side);

  const BoundSource& surface_;
  bool triangles_;
  double tiny_;
  LimitSamples samples_;
};

}  // namespace sublimit
