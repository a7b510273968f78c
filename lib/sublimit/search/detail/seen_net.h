// SPDX-License-Identifier: Apache-2.0
#pragma once
// A part of a surface as a ray sees it: a map to the plane across the ray, whose zeros are hits.
#include <Eigen/Dense>

#include <optional>
#include <span>

#include "sublimit/nets/piece_parts.h"

namespace sublimit {

/// How far outside of a part a zero may be for the neighbour to have it, beside what counts as on the ray.
inline constexpr double beyond_part = 1e-12;
/// Slack at the line u = v of a part that is cut along it: both halves may report a hit there.
inline constexpr double beyond_half = 1e-9;

/// A ray as an origin and three axes, the last one along it.
struct RayFrame {
  Eigen::Vector3d origin;
  Eigen::Matrix3d axes;  ///< rows
  double length = 1;     ///< of the direction
  RayFrame(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction);
  /// Returns a net in the coordinates of the ray.
  Points seen(const Points& net) const;
};

/// Where a part is hit, if that is one place at most.
struct SeenZero {
  enum class Kind { none, one, unknown } kind;
  Eigen::Vector2d uv = Eigen::Vector2d::Zero();
  double s = 0;      ///< distance along the ray
  double reach = 0;  ///< how far off that may be
  int side = 0;      ///< of the surface that the ray sees: 1 or -1; 0 where that turns over
};

/// A stretch of the ray along which a part is as near to it as counts as a hit.
struct SeenStrip {
  double low = 0, high = 0;  ///< distances along the ray
  Eigen::Vector2d uv = Eigen::Vector2d::Zero();
};

/// A point of the part's domain, the square or the triangle.
Eigen::Vector2d nearest_inside(const Eigen::Vector2d& p, bool triangle);

/// The middle of the angle, below 180 degrees, that points of the plane across the ray are in; nothing if they are in
/// none: their hull holds the ray.
std::optional<Eigen::Vector2d> facing(const Eigen::Matrix<double, Eigen::Dynamic, 2>& points);

/// True if a remaining step at a place of the domain is negligible.
/// @param off  by u, by v
bool is_none(const Eigen::Vector2d& step, const Eigen::Vector2d& off, bool triangle);

/// No line through the ray has all of these points on one side, of those across the middle of their angle and a few
/// more.
/// @param points  seen along the ray: x, y, s and, of rational ones, a positive weight
bool can_be_hit(const Points& points, double slack);

/// The stretch that points span which all lie in a strip along the ray, as wide as counts as a hit and much longer, if
/// they reach over the ray; else nothing.
/// @param corners  rows of points that are on the surface
/// @param within   how far from the points the surface may be
std::optional<SeenStrip> strip_of(const Points& points, std::span<const Eigen::Index> corners, double within,
                                  double slack);

class SeenNet {
 public:
  /// @param basis  which must stay
  /// @param net    seen along a ray
  SeenNet(const PolynomialBasis& basis, Points net) : basis_(basis), net_(std::move(net)) {}
  SeenNet(const PolynomialBasis&&, Points) = delete;

  /// No line through the ray has all of it on one side.
  /// @param slack  how far off counts as a hit
  bool can_be_hit(double slack) const { return sublimit::can_be_hit(net_, slack); }
  /// Returns where the ray meets a part over its domain, the square or the triangle, if that is one place at most.
  /// @param slack  how far off counts as a hit
  SeenZero zero(double slack) const;

  /// A side on the ray: a point, as poles and apexes are, or a line.
  struct Side {
    SeenStrip strip;
    double reach = 0;  ///< how far off the distances may be
    int side = 0;      ///< as of zeros, next to a point
  };
  /// A side on the ray if all else of the part leads away from it: the map is a power of the distance from the side,
  /// times a net that is on one side of the ray.
  std::optional<Side> side_on_ray(double slack) const;
  std::optional<SeenStrip> strip(double slack) const;
  /// How far lines along u and along v go across the ray, at most, and in space.
  struct Lengths {
    double u = 0, v = 0;
  };
  Lengths lengths_across() const { return lengths(2); }
  Lengths lengths_in_space() const { return lengths(3); }

 private:
  /// Returns the side lengths of a square net.
  Lengths lengths(Eigen::Index coordinates) const;
  bool is_rational() const { return net_.cols() == 4; }

  const PolynomialBasis& basis_;
  Points net_;
};

}  // namespace sublimit
