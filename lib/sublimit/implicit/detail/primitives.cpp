// SPDX-License-Identifier: Apache-2.0
#include "sublimit/implicit/detail/primitives.h"

#include <cmath>
#include <string>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using std::exp;
using std::sqrt;
using Extent = std::optional<AlignedBox3d>;

void check_finite(const Vector3d& x, const char* what) {
  if (!x.allFinite()) throw InvalidParameter(std::string(what) + " is not finite; it should be three numbers");
}

void check_number(double x, double least, bool or_more, const char* what) {
  if (std::isfinite(x) && (or_more ? x >= least : x > least)) return;
  throw InvalidParameter(std::string(what) + " is " + format_number(x) + "; it should be " +
                         (or_more ? format_number(least) + " or more" : "more than " + format_number(least)));
}

Vector3d unit(const Vector3d& d, const char* what) {
  check_finite(d, what);
  const double length = d.stableNorm();
  if (!(length > 0)) throw InvalidParameter(std::string(what) + " has no length; it should not be zero");
  return d / length;
}

/// All that is nearer than a distance to a box of points.
Extent around(AlignedBox3d box, double distance) {
  if (distance < 0) return AlignedBox3d();
  box.min().array() -= distance;
  box.max().array() += distance;
  return box;
}

template <class T>
T length(const Triple<T>& x) {
  return sqrt(squared_norm(x));
}
template <class T>
T to_point(const Triple<T>& x, const Vector3d& p) {
  return length(minus(x, p));
}
template <class T>
T to_line(const Triple<T>& x, const Vector3d& p, const Vector3d& d) {
  const Triple<T> w = minus(x, p);
  const T t = dot(w, d);
  return length(Triple<T>{w[0] - t * d[0], w[1] - t * d[1], w[2] - t * d[2]});
}
/// From p, so far along the unit vector d.
template <class T>
T to_segment(const Triple<T>& x, const Vector3d& p, const Vector3d& d, double far) {
  const double t = value_of(dot(minus(x, p), d));
  if (t <= 0) return up_to(to_point(x, p), t < 0 ? 2 : 1);
  if (t >= far) return up_to(to_point(x, p + far * d), t > far ? 2 : 1);
  return to_line(x, p, d);
}

AlignedBox3d box_of(std::initializer_list<Vector3d> points) {
  AlignedBox3d box;
  for (const Vector3d& p : points) box.extend(p);
  return box;
}

struct Polygon {
  std::vector<Vector3d> points, directions;  // of edges, unit
  std::vector<double> lengths;
  Vector3d normal;

  /// By how often a ray in the plane crosses the edges.
  bool is_above(const Vector3d& x) const {
    const Vector3d u = directions[0], v = normal.cross(u);
    const auto flat = [&](const Vector3d& p) { return Eigen::Vector2d((p - x).dot(u), (p - x).dot(v)); };
    bool inside = false;
    for (size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector2d a = flat(points[i]), b = flat(points[(i + 1) % points.size()]);
      if ((a.y() > 0) != (b.y() > 0) && a.x() + (b.x() - a.x()) * (-a.y()) / (b.y() - a.y()) > 0) inside = !inside;
    }
    return inside;
  }

  template <class T>
  T distance(const Triple<T>& x) const {
    const Vector3d at(value_of(x[0]), value_of(x[1]), value_of(x[2]));
    if (is_above(at)) return magnitude(dot(minus(x, points[0]), normal));
    T least = to_segment(x, points[0], directions[0], lengths[0]);
    for (size_t i = 1; i < points.size(); ++i)
      least = lesser(least, to_segment(x, points[i], directions[i], lengths[i]));
    return least;
  }
};

Polygon polygon_of(const Points& given) {
  if (given.rows() < 3 || given.cols() != 3)
    throw InvalidParameter("a polygon of " + format_number(given.rows()) +
                           " points; it should have 3 or more, in space");
  if (!given.allFinite()) throw InvalidParameter("points of a polygon are not finite; they should be numbers");
  Polygon polygon;
  const size_t count = size_t(given.rows());
  for (size_t i = 0; i < count; ++i) polygon.points.emplace_back(given.row(Eigen::Index(i)));
  Vector3d area = Vector3d::Zero();
  for (size_t i = 0; i < count; ++i) {
    const Vector3d edge = polygon.points[(i + 1) % count] - polygon.points[i];
    if (!(edge.norm() > 0))
      throw InvalidParameter("points " + format_number(i) + " and " + format_number((i + 1) % count) +
                             " of a polygon are the same; leave one out (it closes by itself)");
    polygon.directions.push_back(edge.normalized());
    polygon.lengths.push_back(edge.norm());
    area += (polygon.points[i] - polygon.points[0]).cross(polygon.points[(i + 1) % count] - polygon.points[0]);
  }
  const double size = (given.colwise().maxCoeff() - given.colwise().minCoeff()).norm();
  if (!(area.norm() > 1e-12 * size * size))
    throw InvalidParameter("a polygon without area; a segment or a point is a field of its own");
  polygon.normal = area.normalized();
  for (size_t i = 0; i < count; ++i) {
    const double off = std::abs((polygon.points[i] - polygon.points[0]).dot(polygon.normal));
    if (off > 1e-9 * size)
      throw InvalidParameter("point " + format_number(i) + " of a polygon is " + format_number(off) +
                             " off the plane of the others; it should be in it");
  }
  return polygon;
}

void check_blobs(double threshold, const std::vector<Blob>& blobs, const char* size) {
  check_number(threshold, 0, false, "the threshold");
  if (blobs.empty()) throw InvalidParameter("no blobs; there should be one at least");
  for (size_t i = 0; i < blobs.size(); ++i) {
    const std::string blob = "blob " + format_number(i) + ": ";
    check_finite(blobs[i].center, (blob + "the center").c_str());
    if (!std::isfinite(blobs[i].height)) throw InvalidParameter(blob + "the height is not finite");
    check_number(blobs[i].size, 0, false, (blob + size).c_str());
  }
}

/// Balls where a blob can be above the threshold together with all others.
Extent blob_extent(const std::vector<Blob>& blobs, double threshold, const auto& radius) {
  if (!(threshold > 0)) return std::nullopt;
  const auto count = double(std::ranges::count_if(blobs, [](const Blob& blob) { return blob.height > 0; }));
  AlignedBox3d box;
  for (const Blob& blob : blobs) {
    // Where all are below their part of it, so is the sum.
    if (count * blob.height <= threshold) continue;
    box.extend(*around(box_of({blob.center}), radius(blob, threshold / (count * blob.height))));
  }
  return box;
}

/// T - sum of height * shape(r^2, R^2).
template <class Shape>
FieldPointer blob_field(double threshold, std::vector<Blob> blobs, Shape shape) {
  const auto extent = [=](double level) {
    return blob_extent(blobs, threshold - level, [](const Blob& blob, double) { return blob.size; });
  };
  return formula_field(
      [=]<class T>(const Triple<T>& x) -> T {
        T sum = threshold;
        for (const Blob& blob : blobs) sum = sum - blob.height * shape(squared_norm(minus(x, blob.center)), blob.size);
        return sum;
      },
      extent);
}

}  // namespace

FieldPointer sphere_field(const Vector3d& center, double radius) {
  check_finite(center, "the center");
  check_number(radius, 0, false, "the radius");
  return formula_field(
      [=]<class T>(const Triple<T>& x) -> T { return squared_norm(minus(x, center)) - radius * radius; },
      [=](double level) -> Extent {
        const double squared = radius * radius + level;
        return squared < 0 ? AlignedBox3d() : around(box_of({center}), std::sqrt(squared));
      });
}

FieldPointer distance_to_point(const Vector3d& point, double radius) {
  check_finite(point, "the point");
  check_number(radius, 0, true, "the radius");
  return formula_field([=]<class T>(const Triple<T>& x) -> T { return to_point(x, point) - radius; },
                       [=](double level) { return around(box_of({point}), radius + level); });
}

FieldPointer distance_to_line(const Vector3d& point, const Vector3d& direction, double radius) {
  check_finite(point, "the point");
  check_number(radius, 0, true, "the radius");
  const Vector3d d = unit(direction, "the direction");
  return formula_field([=]<class T>(const Triple<T>& x) -> T { return to_line(x, point, d) - radius; });
}

FieldPointer distance_to_segment(const Vector3d& from, const Vector3d& to, double radius) {
  check_finite(from, "from");
  check_finite(to, "to");
  check_number(radius, 0, true, "the radius");
  if (from == to) throw InvalidParameter("from and to are the same point; distance-point is its field");
  const Vector3d d = unit(to - from, "the segment");
  const double far = (to - from).norm();
  return formula_field([=]<class T>(const Triple<T>& x) -> T { return to_segment(x, from, d, far) - radius; },
                       [=](double level) {
                         return around(box_of({from, to}), radius + level);
                       });
}

FieldPointer distance_to_plane(const Vector3d& point, const Vector3d& normal, double offset, bool is_signed) {
  check_finite(point, "the point");
  const Vector3d n = unit(normal, "the normal");
  if (!is_signed) check_number(offset, 0, true, "the offset");
  if (!std::isfinite(offset)) throw InvalidParameter("the offset is not finite; it should be a number");
  if (is_signed)
    return formula_field([=]<class T>(const Triple<T>& x) -> T { return dot(minus(x, point), n) - offset; });
  return formula_field([=]<class T>(const Triple<T>& x) -> T { return magnitude(dot(minus(x, point), n)) - offset; });
}

FieldPointer distance_to_circle(const Vector3d& center, const Vector3d& normal, double ring, double radius) {
  check_finite(center, "the center");
  const Vector3d n = unit(normal, "the normal");
  check_number(ring, 0, false, "the ring");
  check_number(radius, 0, true, "the radius");
  AlignedBox3d box(center, center);
  for (int i = 0; i < 3; ++i) {
    const double reach = ring * std::sqrt(std::max(0., 1 - n[i] * n[i]));
    box.min()[i] -= reach;
    box.max()[i] += reach;
  }
  return formula_field(
      [=]<class T>(const Triple<T>& x) -> T {
        const T height = dot(minus(x, center), n), across = to_line(x, center, n) - ring;
        return sqrt(across * across + height * height) - radius;
      },
      [=](double level) { return around(box, radius + level); });
}

FieldPointer distance_to_polygon(const Points& points, double radius) {
  check_number(radius, 0, true, "the radius");
  const Polygon polygon = polygon_of(points);
  AlignedBox3d box;
  for (const Vector3d& p : polygon.points) box.extend(p);
  return formula_field([=]<class T>(const Triple<T>& x) -> T { return polygon.distance(x) - radius; },
                       [=](double level) { return around(box, radius + level); });
}

FieldPointer polynomial_field(std::vector<PolynomialTerm> terms) {
  if (terms.empty()) throw InvalidParameter("a polynomial without terms; there should be one at least");
  for (size_t i = 0; i < terms.size(); ++i) {
    const PolynomialTerm& t = terms[i];
    if (!std::isfinite(t.coefficient))
      throw InvalidParameter("term " + format_number(i) + ": the coefficient is not finite; it should be a number");
    if (std::min({t.i, t.j, t.k}) < 0)
      throw InvalidParameter("term " + format_number(i) + ": an exponent is negative; it should be 0 or more");
  }
  return formula_field([terms = std::move(terms)]<class T>(const Triple<T>& x) -> T {
    T sum = 0;
    for (const PolynomialTerm& t : terms) {
      T product = t.coefficient;
      if (t.i) product = product * power(x[0], t.i);
      if (t.j) product = product * power(x[1], t.j);
      if (t.k) product = product * power(x[2], t.k);
      sum = sum + product;
    }
    return sum;
  });
}

FieldPointer quadric_field(const Eigen::Matrix4d& Q) {
  if (!Q.allFinite()) throw InvalidParameter("the matrix of a quadric is not finite; it should be 4 x 4 numbers");
  const Eigen::Matrix4d S = (Q + Q.transpose()) / 2;
  return formula_field([=]<class T>(const Triple<T>& x) -> T {
    T sum = S(3, 3);
    for (int i = 0; i < 3; ++i) {
      T row = 2 * S(i, 3);
      for (int j = 0; j < 3; ++j) row = row + S(i, j) * x[size_t(j)];
      sum = sum + x[size_t(i)] * row;
    }
    return sum;
  });
}

FieldPointer blinn_field(double threshold, std::vector<Blob> blobs) {
  check_blobs(threshold, blobs, "the decay");
  const auto extent = [=](double level) {
    return blob_extent(blobs, threshold - level,
                       [](const Blob& blob, double part) { return std::sqrt(-std::log(part) / blob.size); });
  };
  return formula_field(
      [=]<class T>(const Triple<T>& x) -> T {
        T sum = threshold;
        for (const Blob& blob : blobs) sum = sum - blob.height * exp(-blob.size * squared_norm(minus(x, blob.center)));
        return sum;
      },
      extent);
}

FieldPointer metaballs_field(double threshold, std::vector<Blob> blobs) {
  check_blobs(threshold, blobs, "the radius");
  return blob_field(threshold, std::move(blobs), []<class T>(const T& squared, double R) -> T {
    const double r2 = value_of(squared), R2 = R * R;
    if (r2 >= R2) return up_to(T(0), r2 > R2 ? 2 : 1);
    if (9 * r2 <= R2) return up_to(1 - 3 / R2 * squared, 9 * r2 < R2 ? 2 : 1);
    const T s = 1 - sqrt(squared) / R;
    return 1.5 * s * s;
  });
}

FieldPointer soft_objects_field(double threshold, std::vector<Blob> blobs) {
  check_blobs(threshold, blobs, "the radius");
  return blob_field(threshold, std::move(blobs), []<class T>(const T& squared, double R) -> T {
    const double r2 = value_of(squared), R2 = R * R;
    if (r2 >= R2) return up_to(T(0), r2 > R2 ? 2 : 1);
    const T q = squared / R2;
    return 1 + q * (-22. / 9 + q * (17. / 9 - 4. / 9 * q));
  });
}

}  // namespace sublimit
