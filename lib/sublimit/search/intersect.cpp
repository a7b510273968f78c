// SPDX-License-Identifier: Apache-2.0
#include "sublimit/search/intersect.h"

#include <Eigen/Dense>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/base/parallel_for.h"
#include "sublimit/limit/net_derivatives.h"
#include "sublimit/search/closest_point.h"
#include "sublimit/search/surface_parts.h"

namespace sublimit {
namespace {

/// Hits nearer to each other than that, relative to the surface's size, are one; and how far outside of a part a zero
/// may be for the neighbour to have it.
constexpr double same_place = 1e-11, beyond = 1e-9;

struct Hit {
  double t = 0;
  double reach = 0;  ///< how far off t may be: much where the ray grazes the surface
  Sample place;
};

struct Extent {
  double low = 0, high = 0;
};

/// A ray as an origin and three axes, the last one along it.
struct Frame {
  Eigen::Vector3d origin;
  Eigen::Matrix3d axes;  ///< rows
  double length = 1;     ///< of the direction
  explicit Frame(const Ray& ray) : origin(ray.origin), length(ray.direction.stableNorm()) {
    const Eigen::Vector3d d = ray.direction / length;
    Eigen::Index least = 0;
    d.cwiseAbs().minCoeff(&least);
    axes.row(0) = d.cross(Eigen::Vector3d(Eigen::Vector3d::Unit(least))).normalized();
    axes.row(1) = d.cross(Eigen::Vector3d(axes.row(0)));
    axes.row(2) = d;
  }
  /// Of a net as parts have them.
  Points seen(const Points& net) const {
    if (net.cols() == 3) return (net.rowwise() - origin.transpose()) * axes.transpose();
    Points seen(net.rows(), 4);
    seen << (net.leftCols<3>() - net.col(3) * origin.transpose()) * axes.transpose(), net.col(3);
    return seen;
  }
};

/// Smallest and largest distance along the ray of a box that it meets; nothing if it does not.
std::optional<Extent> along(const Eigen::AlignedBox3d& box, const Ray& ray, double slack) {
  Extent t{ray.tmin, ray.tmax};
  for (int k = 0; k < 3; ++k) {
    const double low = box.min()[k] - slack - ray.origin[k], high = box.max()[k] + slack - ray.origin[k],
                 d = ray.direction[k];
    if (d == 0) {
      if (low > 0 || high < 0) return std::nullopt;
      continue;
    }
    const double a = low / d, b = high / d;
    t.low = std::max(t.low, std::min(a, b));
    t.high = std::min(t.high, std::max(a, b));
    if (t.low > t.high) return std::nullopt;
  }
  return t;
}

/// Of a net seen along a ray: whether it can be hit, and where, if that is one place at most.
class SeenNet {
 public:
  SeenNet(const PolynomialBasis& basis, Points net) : basis_(basis), net_(std::move(net)) {}

  /// No line through the ray has all of it on one side.
  /// @param slack  how far off counts as a hit
  bool can_be_hit(double slack) const {
    constexpr std::array<std::array<double, 2>, 4> directions{
        {{1, 0}, {0, 1}, {0.70710678, 0.70710678}, {0.70710678, -0.70710678}}};
    for (const auto& [a, b] : directions) {
      Eigen::VectorXd side = a * net_.col(0) + b * net_.col(1);
      if (is_rational()) side.array() /= net_.col(3).array();
      if (side.minCoeff() > slack || side.maxCoeff() < -slack) return false;
    }
    return true;
  }

  struct Zero {
    enum class Kind { none, one, unknown } kind;
    Eigen::Vector2d uv = Eigen::Vector2d::Zero();
    double s = 0;      ///< distance along the ray
    double reach = 0;  ///< how far off that may be
  };
  /// Of the part of a convex domain: the square, or the triangle.
  /// @param slack  how far off counts as a hit
  Zero zero(double slack) const {
    const NetDerivatives x(basis_, net_, 1);
    Eigen::Matrix2d middle, radius;
    for (int by = 0; by < 2; ++by) {  // columns: derivatives across the ray, by u and by v
      const Points& net = x.net(1 - by, by);
      const Eigen::Vector2d low = net.leftCols<2>().colwise().minCoeff(), high = net.leftCols<2>().colwise().maxCoeff();
      middle.col(by) = (low + high) / 2;
      radius.col(by) = (high - low) / 2;
    }
    if (!(std::abs(middle.determinant()) > 1e-12 * middle.squaredNorm())) return {Zero::Kind::unknown};
    const Eigen::Matrix2d inverse = middle.inverse();
    // At most that much of the distance to a zero is left after a step by the inverse of the middle, and going back to
    // the nearest place of the domain adds nothing.
    if (!((inverse.cwiseAbs() * radius).norm() < 0.5)) return {Zero::Kind::unknown};
    Eigen::Vector2d p = basis_.total() ? Eigen::Vector2d(1. / 3, 1. / 3) : Eigen::Vector2d(0.5, 0.5), move;
    NetDerivatives::Jet jet;
    for (int step = 0; step < 64; ++step) {
      jet = x.at(p.x(), p.y());
      move = inverse * jet.x.head<2>();  // no denominator is 0: zeros are those of the numerators
      const Eigen::Vector2d next = nearest_inside(p - move);
      const bool done = (next - p).cwiseAbs().maxCoeff() < 1e-16;
      p = next;
      if (done) break;
    }
    // What the neighbour may miss by as much as rounding moves zeros is taken here too.
    const double largest = is_rational() ? net_.col(3).maxCoeff() : 1;
    const Eigen::Vector2d off = (inverse.cwiseAbs().rowwise().sum() * (slack * largest)).array() + beyond;
    if (!(move.cwiseAbs().maxCoeff() <= off.maxCoeff())) return {Zero::Kind::none};
    const double w = is_rational() ? jet.x[3] : 1, s = jet.x[2] / w;
    const double su = (jet.u[2] - s * jet.u[3]) / w, sv = (jet.v[2] - s * jet.v[3]) / w;
    return {Zero::Kind::one, p, s, std::abs(su) * off[0] + std::abs(sv) * off[1]};
  }

 private:
  bool is_rational() const { return net_.cols() == 4; }
  Eigen::Vector2d nearest_inside(const Eigen::Vector2d& p) const {
    if (!basis_.total()) return p.cwiseMax(0).cwiseMin(1);
    if (p.x() >= 0 && p.y() >= 0 && p.x() + p.y() <= 1) return p;
    if (p.x() + p.y() <= 1 || p.x() - p.y() > 1 || p.y() - p.x() > 1) {
      const Eigen::Vector2d q = p.cwiseMax(0).cwiseMin(1);
      if (q.x() + q.y() <= 1) return q;
    }
    const double u = std::clamp((p.x() - p.y() + 1) / 2, 0.0, 1.0);
    return {u, 1 - u};
  }

  const PolynomialBasis& basis_;
  Points net_;
};

/// One ray through the parts.
class Tracer {
 public:
  explicit Tracer(const SurfaceParts& parts, const RayOptions& options = {}) : parts_(parts), options_(options) {}
  void set(const RayOptions& options) { options_ = options; }

  /// @param undecided  is counted up
  std::vector<Hit> operator()(const Ray& ray, std::int64_t& undecided) {
    begin(ray);
    const std::vector<BoxTree::Node>& nodes = parts_.tree().nodes();
    if (!nodes.empty()) push(nodes[0].box, 0, 0);
    return look(undecided);
  }

  /// Of the parts [first, last) alone.
  std::vector<Hit> operator()(const Ray& ray, std::int64_t first, std::int64_t last, std::int64_t& undecided) {
    begin(ray);
    for (std::int64_t i = first; i < last; ++i) {
      const SurfacePart& part = parts_.parts()[size_t(i)];
      const Eigen::AlignedBox3d box = box_of(part.part);
      if (!along(box, ray, slack_)) continue;
      cells_.push_back(part);
      push(box, -1, std::ssize(cells_) - 1);
    }
    return look(undecided);
  }

 private:
  struct Waiting {
    double t;    ///< at least
    Index node;  ///< of the tree, or -1
    std::int64_t number;
    friend bool operator<(const Waiting& a, const Waiting& b) { return a.t != b.t ? a.t > b.t : a.number > b.number; }
  };

  void begin(const Ray& ray) {
    ray_ = &ray;
    frame_.emplace(ray);
    slack_ = same_place * parts_.size() + 8 * parts_.rounding(ray.origin);
    hits_.clear();
    heap_.clear();
    cells_.clear();
    undecided_ = 0;
    nearest_ = ray.tmax;
  }

  /// At all that waits, nearest first.
  std::vector<Hit> look(std::int64_t& undecided) {
    const std::vector<BoxTree::Node>& nodes = parts_.tree().nodes();
    for (int looked = 0; !heap_.empty();) {
      std::pop_heap(heap_.begin(), heap_.end());
      const Waiting first = heap_.back();
      heap_.pop_back();
      if (!options_.all && first.t > nearest_) break;
      if (first.node >= 0) {
        const BoxTree::Node& node = nodes[size_t(first.node)];
        if (node.item >= 0) {
          cells_.push_back(parts_.parts()[size_t(node.item)]);
          heap_.push_back({first.t, -1, std::ssize(cells_) - 1});
          std::push_heap(heap_.begin(), heap_.end());
        } else {
          for (const Index child : {node.first_child, node.first_child + 1})
            push(nodes[size_t(child)].box, child, child);
        }
        continue;
      }
      const SurfacePart part = std::move(cells_[size_t(first.number)]);
      if (++looked > options_.most_parts) {
        undecided_ += 1 + std::ssize(heap_);
        break;
      }
      look_at(part);
    }
    undecided += undecided_;
    return merged();
  }

  void push(const Eigen::AlignedBox3d& box, Index node, std::int64_t number) {
    const std::optional<Extent> t = along(box, *ray_, slack_);
    if (!t) return;
    heap_.push_back({t->low, node, number});
    std::push_heap(heap_.begin(), heap_.end());
  }

  void look_at(const SurfacePart& cell) {
    const PiecePart& part = cell.part;
    const double slack = slack_;
    bool known = part.basis.has_value();
    for (size_t half = 0; half < part.nets.size(); ++half) {
      const SeenNet net(*part.basis, frame_->seen(part.nets[half]));
      if (!net.can_be_hit(slack)) continue;
      const SeenNet::Zero zero = net.zero(slack);
      const Eigen::Vector2d& uv = zero.uv;
      if (zero.kind == SeenNet::Zero::Kind::unknown) {
        known = false;
        break;
      }
      // Of a part that is cut along u = v each polynomial has its side.
      const bool own = part.nets.size() == 1 || (half == 0 ? uv.x() >= uv.y() - beyond : uv.y() >= uv.x() - beyond);
      if (zero.kind == SeenNet::Zero::Kind::one && own) add(cell, uv, zero.s, zero.reach);
    }
    if (known) return;
    const Eigen::AlignedBox3d box = box_of(part);
    if (box.diagonal().norm() <= slack) {
      ++undecided_;
      const Points middle = frame_->seen(box.center().transpose());
      // Where a ray touches, the surface is as near as that for the root of it.
      if (middle.leftCols(2).norm() <= 2 * slack)
        add(cell, {0.25, 0.25}, middle(0, 2), std::sqrt(slack * parts_.size()));
      return;
    }
    for_each_child(cell, cutter_, [&](SurfacePart&& child) {
      cells_.push_back(std::move(child));
      push(box_of(cells_.back().part), -1, std::ssize(cells_) - 1);
    });
  }

  void add(const SurfacePart& cell, const Eigen::Vector2d& uv, double s, double reach) {
    const bool triangle = cell.part.is_triangle();
    const auto [u, v] = at_place(cell.part.corners, triangle, uv.x(), uv.y());
    const double t = s / frame_->length;
    if (!(t >= ray_->tmin && t <= ray_->tmax)) return;
    reach /= frame_->length;
    hits_.push_back(
        {t,
         reach,
         {cell.address, std::clamp(u, 0.0, 1.0), std::clamp(v, 0.0, triangle ? 1 - std::clamp(u, 0.0, 1.0) : 1.0)}});
    nearest_ = std::min(nearest_, t + 2 * reach + apart());  // what counts as the same hit has to be found too
  }

  /// Hits that are nearer to each other along the ray are one.
  double apart() const { return 100 * slack_ / frame_->length; }

  /// By t; what several parts have is one hit: the one that is known best, of the least face.
  std::vector<Hit> merged() {
    std::sort(hits_.begin(), hits_.end(), [](const Hit& a, const Hit& b) {
      return std::tuple(a.t, a.place.face, a.place.u, a.place.v) < std::tuple(b.t, b.place.face, b.place.u, b.place.v);
    });
    std::vector<Hit> result;
    double end = 0;
    for (const Hit& hit : hits_) {
      if (!result.empty() && hit.t - hit.reach <= end) {
        Hit& best = result.back();
        if (hit.reach < best.reach / 2 || (hit.reach < 2 * best.reach && hit.place.face < best.place.face)) best = hit;
        end = std::max(end, hit.t + hit.reach + apart());
        continue;
      }
      if (!options_.all && !result.empty()) break;
      result.push_back(hit);
      end = hit.t + hit.reach + apart();
    }
    return result;
  }

  const SurfaceParts& parts_;
  RayOptions options_;
  PieceParts cutter_;
  const Ray* ray_ = nullptr;
  std::optional<Frame> frame_;
  std::vector<Hit> hits_;
  std::vector<Waiting> heap_;
  std::vector<SurfacePart> cells_;
  std::int64_t undecided_ = 0;
  double nearest_ = 0;
  double slack_ = 0;  // how far off a ray counts as a hit
};

/// Points of the surface at the places of hits. Where corners of parts are not known (next to borders of dual schemes)
/// or have too few digits (at extraordinary vertices) these are not the hits: there the places are those nearest to
/// them.
void place_on_rays(const SearchedSurface& surface, const std::vector<Ray>& rays, const SurfaceParts& parts,
                   RayHits& hits) {
  LimitSamples samples;
  surface.samples().evaluate(hits.places, 1, true, samples);
  Points on_rays(std::ssize(hits.t), 3);
  std::vector<Eigen::Index> off;
  for (size_t i = 0; i < rays.size(); ++i)
    for (std::int64_t k = hits.first[i]; k < hits.first[i + 1]; ++k) {
      on_rays.row(k) = rays[i].origin + hits.t[size_t(k)] * rays[i].direction;
      const double allowed = 10 * (same_place * parts.size() + 8 * parts.rounding(rays[i].origin));
      if (!((samples.position.row(k) - on_rays.row(k)).norm() <= allowed)) off.push_back(k);
    }
  if (!off.empty()) {
    const ClosestPoints found = closest_points(surface, on_rays(off, Eigen::all), {.prove = false});
    for (size_t m = 0; m < off.size(); ++m) hits.places[size_t(off[m])] = found.places[m];
    surface.samples().evaluate(hits.places, 1, true, samples);
  }
  hits.points.swap(samples.position);
  hits.normals.swap(samples.normal);
  hits.status = std::move(samples.status);
}

void check(const Ray& ray, const std::string& which) {
  if (!ray.origin.allFinite() || !ray.direction.allFinite() || std::isnan(ray.tmin) || std::isnan(ray.tmax))
    throw InvalidParameter(which + " is not finite");
  if (ray.origin.cwiseAbs().maxCoeff() > farthest_coordinate)
    throw InvalidParameter(which + " begins at a coordinate above 1e150 in size");
  if (ray.direction.isZero(0)) throw InvalidParameter(which + " has the direction (0, 0, 0)");
  if (ray.tmin > ray.tmax)
    throw InvalidParameter(which + " ends at t = " + std::to_string(ray.tmax) + ", before it begins");
}

void check(const std::vector<Ray>& rays) {
  for (size_t i = 0; i < rays.size(); ++i) check(rays[i], "ray " + std::to_string(i));
}

}  // namespace

RayHits intersect(const LimitSurface& surface, const Points& points, const std::vector<Ray>& rays,
                  const RayOptions& options) {
  return intersect(SearchedLimit(surface, points), rays, options);
}

RayHits intersect(const SearchedSurface& surface, const std::vector<Ray>& rays, const RayOptions& options) {
  check(rays);
  if (const std::string which = surface.without_parts(); !which.empty())
    throw UnsupportedTopology("rays need polynomial or rational surfaces: " + which);
  const SurfaceParts parts(surface);
  std::vector<std::vector<Hit>> found(rays.size());
  RayHits result;
  result.undecided.resize(rays.size());
  parallel_for_blocks(
      std::ssize(rays),
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        Tracer trace(parts, options);
        for (auto i = size_t(begin); i < size_t(end); ++i) found[i] = trace(rays[i], result.undecided[i]);
      },
      64);
  result.first = {0};
  for (const std::vector<Hit>& hits : found) {
    for (const Hit& hit : hits) {
      result.t.push_back(hit.t);
      result.places.push_back(hit.place);
    }
    result.first.push_back(std::ssize(result.t));
  }
  place_on_rays(surface, rays, parts, result);
  return result;
}

struct RayTracer::Prepared {
  SurfaceParts parts;
  std::vector<std::int64_t> first;  // parts of address a are [first[a], first[a + 1])
  // What cuts parts is made once a thread.
  tbb::enumerable_thread_specific<Tracer> tracers{[this] { return Tracer(parts); }};
};

RayTracer::RayTracer(const LimitSurface& surface, const Points& points)
    : prepared_(new Prepared{.parts = SurfaceParts(surface, points),
                             .first = std::vector<std::int64_t>(size_t(surface.addresses().size()) + 1)}) {
  std::vector<std::int64_t>& first = prepared_->first;
  for (const SurfacePart& part : prepared_->parts.parts()) ++first[size_t(part.address) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
}

RayTracer::RayTracer(RayTracer&&) noexcept = default;
RayTracer& RayTracer::operator=(RayTracer&&) noexcept = default;
RayTracer::~RayTracer() = default;

std::vector<RayHit> RayTracer::trace(const Ray& ray, const RayOptions& options, std::optional<Index> address,
                                     std::int64_t* undecided) const {
  check(ray, "the ray");
  const std::vector<std::int64_t>& first = prepared_->first;
  const Index addresses = static_cast<Index>(std::ssize(first) - 1);
  if (address && (*address < 0 || *address >= addresses))
    throw InvalidParameter("address " + std::to_string(*address) + " of " + std::to_string(addresses));
  Tracer& trace = prepared_->tracers.local();
  trace.set(options);
  std::int64_t not_decided = 0;
  const std::vector<Hit> found =
      address ? trace(ray, first[size_t(*address)], first[size_t(*address) + 1], not_decided) : trace(ray, not_decided);
  if (undecided) *undecided = not_decided;
  std::vector<RayHit> hits;
  hits.reserve(found.size());
  for (const Hit& hit : found) hits.push_back({hit.t, hit.place});
  return hits;
}

}  // namespace sublimit
