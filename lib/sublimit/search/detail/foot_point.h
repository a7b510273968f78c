// SPDX-License-Identifier: Apache-2.0
#pragma once
// Feet of perpendiculars: from a place on a surface downhill to one that is nearest to a point among its
// neighbours on the same square or triangle.
#include "sublimit/source/linear_source.h"
#include "sublimit/search/detail/search_domain.h"

namespace sublimit {

struct Foot {
  Place place;
  double squared_distance = 0;
};

/// Newton's method on half the square of the distance, with the exact derivatives; where second ones do not exist,
/// with what first ones tell of them (BFGS). Steps are halved until they go down, and end at the sides, along which the
/// search goes on. At places without derivatives it starts once more from close by, then goes by trying.
class FootSearch {
 public:
  /// @param surface    which must stay
  /// @param triangles  whether faces are triangles
  /// @param size       of the surface: steps of 1e-14 of it are none
  FootSearch(const BoundSource& surface, bool triangles, double size)
      : surface_(surface), triangles_(triangles), tiny_(1e-14 * size) {}
  FootSearch(const BoundSource&&, bool, double) = delete;

  /// @param domain   where to look, `start` in it
  /// @param order    of derivatives that the surface has, 2 or 1; set to 1 if it turns out so
  /// @param nearest  square of a distance: what is farther is not tried to the end
  Foot operator()(const Eigen::Vector3d& point, const Place& start, const SearchDomain& domain, int& order,
                  double nearest);

 private:
  struct State;
  State at(const Eigen::Vector3d& point, const Place& place, int order);
  void descend(const Eigen::Vector3d& point, const SearchDomain& domain, State& state, int& order, bool along_side);
  /// Downhill without derivatives, by steps in eight directions.
  void probe(const Eigen::Vector3d& point, State& state, int& order);
  static Eigen::Vector2d direction(const State& state, const SearchDomain& domain, bool along_side);

  const BoundSource& surface_;
  bool triangles_;
  double tiny_;
  LimitSamples samples_;
};

}  // namespace sublimit
