// SPDX-License-Identifier: Apache-2.0
#pragma once
// Intersection of a ray with a part of a surface: in coordinates of the ray the part maps to the plane across
// the ray, and hits are zeros of this map.
#include <Eigen/Dense>

#include <optional>
#include <span>

#include "sublimit/nets/piece_parts.h"

namespace sublimit {

/// Distance in parameters by which a zero outside a part still counts, in addition to the slack of the ray; the
/// neighbour reports the hit otherwise.
inline constexpr double beyond_part = 1e-12;
/// Slack at the line u = v of a part that is cut along it. Both halves may report a hit there.
inline constexpr double beyond_half = 1e-9;

/// A ray as an origin and three axes, the last one along it.
struct RayFrame {
  Eigen::Vector3d origin;
  Eigen::Matrix3d axes;  ///< axes as rows
  double length = 1;     ///< length of the ray's direction
  RayFrame(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction);
  /// Returns a net in the coordinates of the ray.
  Points seen(const Points& net) const;
};

/// The place at which a part is hit, if there is at most one.
struct SeenZero {
  enum class Kind { none, one, unknown } kind;
  Eigen::Vector2d uv = Eigen::Vector2d::Zero();
  double s = 0;      ///< distance along the ray
  double reach = 0;  ///< error bound of s
  int side = 0;      ///< side of the surface that is hit: 1 or -1; 0 if it changes here
};

/// An interval of the ray along which a part is so close to it that it counts as a hit.
struct SeenStrip {
  double low = 0, high = 0;  ///< distances along the ray
  Eigen::Vector2d uv = Eigen::Vector2d::Zero();
};

/// Returns the nearest point of the domain, the square or the triangle.
Eigen::Vector2d nearest_inside(const Eigen::Vector2d& p, bool triangle);

/// Returns the middle direction of the angle below 180 degrees that contains points in the plane across the
/// ray; nothing if there is no such angle, that is, their convex hull contains the ray.
std::optional<Eigen::Vector2d> facing(const Eigen::Matrix<double, Eigen::Dynamic, 2>& points);

/// True if a remaining step at a place of the domain is negligible.
/// @param off  negligible size by u, and by v
bool is_none(const Eigen::Vector2d& step, const Eigen::Vector2d& off, bool triangle);

/// True if none of a few lines through the ray, among them that across the middle of their angle, has all
/// points on one side.
/// @param points  in the coordinates of the ray: x, y, s and, if rational, a positive weight
bool can_be_hit(const Points& points, double slack);

/// Returns the interval spanned by points that all lie in a narrow strip along the ray, as wide as counts as a
/// hit and much longer, if they extend over the ray; else nothing.
/// @param corners  rows of points that are on the surface
/// @param within   largest distance of the surface from the points
std::optional<SeenStrip> strip_of(const Points& points, std::span<const Eigen::Index> corners, double within,
                                  double slack);

/// A polynomial or rational part in the coordinates of a ray.
class SeenNet {
 public:
  /// @param basis  must outlive this
  /// @param net    net in the coordinates of the ray (RayFrame::seen)
  SeenNet(const PolynomialBasis& basis, Points net) : basis_(basis), net_(std::move(net)) {}
  SeenNet(const PolynomialBasis&&, Points) = delete;

  /// False if a line through the ray has the whole net on one side.
  /// @param slack  largest distance that counts as a hit
  bool can_be_hit(double slack) const { return sublimit::can_be_hit(net_, slack); }
  /// Returns the place at which the ray meets the part, if there is at most one.
  /// @param slack  largest distance that counts as a hit
  SeenZero zero(double slack) const;

  /// A side on the ray: a point, as a pole or apex, or a line.
  struct Side {
    SeenStrip strip;
    double reach = 0;  ///< error bound of the distances
    int side = 0;      ///< as SeenZero::side, next to a point
  };
  /// Returns a side on the ray, if the rest of the part leads away from it: the map is a power of the distance
  /// from the side times a net on one side of the ray.
  std::optional<Side> side_on_ray(double slack) const;
  std::optional<SeenStrip> strip(double slack) const;
  /// Upper bounds of the lengths of lines along u and along v.
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
