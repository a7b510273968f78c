// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/asset/seams.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/certificates/spectra/for_all.h"

namespace sublimit::asset {
namespace {

using Eigen::Vector3d;

/// Samples in hand at a time: some tens of megabytes.
constexpr size_t batch = 1 << 17;

struct Peak {
  double value = -1;
  Index row = 0;
  void raise(double other, Index at) {
    if (other > value) value = other, row = at;
  }
};
/// The largest deviations of one group.
struct Peaks {
  Peak g0, g1, g2;
  std::int64_t compared = 0;
};

void compare(const LimitSamples& s, Index i, Index j, bool positions, double diagonal, Peaks& peaks) {
  if (s.status[i] == LimitStatus::hole || s.status[j] == LimitStatus::hole) return;
  ++peaks.compared;
  if (positions) peaks.g0.raise((s.position.row(i) - s.position.row(j)).norm(), i);
  const Vector3d a = s.normal.row(i), b = s.normal.row(j);
  if (a.isZero(0) || b.isZero(0)) return;
  peaks.g1.raise(std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi, i);
  const std::optional<Bending> p = bending(s, i), q = bending(s, j);
  if (!p || !q) return;
  // Of a plane that is bent by rounding alone the difference counts by the size of the mesh.
  const double size = std::max({p->norm(), q->norm(), diagonal > 0 ? 1 / diagonal : 0});
  const double difference = (*p - *q).norm();
  if (std::isfinite(difference)) peaks.g2.raise(difference > 0 ? difference / size : 0, i);
}

struct Limits {
  double g0, g1, g2;
};

class Collector {
 public:
  Collector(AssetSeams& seams, const Topology& t, const SeamTolerance& tolerance, double diagonal, Index listed)
      : seams_(seams), t_(t), listed_(listed) {
    constexpr double any = std::numeric_limits<double>::infinity();
    limits_ = {tolerance.g0 ? *tolerance.g0 * (tolerance.g0_of_box ? diagonal : 1) : any,
               tolerance.g1_degrees.value_or(any), tolerance.g2.value_or(any)};
  }
  void add(const Seam& seam, const Peaks& peaks, const SeamSamples& work, const LimitSamples& samples) {
    const bool crease = seam.what == Seam::What::crease;
    SeamDeviation& all = crease                           ? seams_.across_creases
                         : seam.what == Seam::What::point ? seams_.around_points
                                                          : seams_.inside;
    all.compared += peaks.compared;
    const size_t part = &all == &seams_.inside ? 0 : crease ? 1 : 2;
    const auto one = [&](const Peak& peak, std::optional<double>& largest, const char* what, double limit, int k) {
      if (peak.value < 0) return;
      const bool is_worst = !largest || peak.value > *largest;
      const bool is_judged = std::isfinite(limit) && (!crease || k == 0), is_beyond = is_judged && peak.value > limit;
      if (is_judged) within_.look(!is_beyond);
      if (!is_worst && !is_beyond) return;
      const SeamExcess excess = this->excess(seam, what, peak, work.samples[size_t(peak.row)], samples);
      if (is_worst) {
        largest = peak.value;
        worst_[part][k] = excess;
      }
      if (!is_beyond) return;
      beyond_[k].push_back(excess);
      if (beyond_[k].size() >= 4 * size_t(listed_) + 64) keep_worst(k);
    };
    one(peaks.g0, all.g0, "g0", limits_.g0, 0);
    // Around a point that has a tangent plane normals differ by the distance; curvature should differ little.
    const bool is_plane = seam.what == Seam::What::point && seam.has_plane;
    one(peaks.g1, all.g1_degrees, "g1", is_plane ? limits_none : limits_.g1, 1);
    one(peaks.g2, all.g2, "g2", limits_.g2, 2);
  }
  void finish() {
    for (int k = 0; k < 3; ++k) {
      keep_worst(k);
      seams_.beyond.insert(seams_.beyond.end(), beyond_[k].begin(), beyond_[k].end());
    }
    seams_.within_tolerance = within_.holds();
    for (const auto& part : worst_)
      for (const std::optional<SeamExcess>& excess : part)
        if (excess) seams_.worst.push_back(*excess);
  }

 private:
  ForAll within_;
  static constexpr double limits_none = std::numeric_limits<double>::infinity();
  SeamExcess excess(const Seam& seam, const char* what, const Peak& peak, const Place& place,
                    const LimitSamples& samples) const {
    SeamExcess e;
    e.what = what;
    e.value = peak.value;
    e.address = place.face;
    e.u = place.u;
    e.v = place.v;
    e.place = samples.position.row(peak.row);
    e.face = index(t_.face(seam.half));
    const Index tail = index(t_.tail(seam.half));
    if (seam.what == Seam::What::point) {
      e.at = SeamExcess::At::point;
      e.edge = {tail, tail};
    } else if (seam.what == Seam::What::patch) {
      e.at = SeamExcess::At::patch;
    } else {
      e.edge = {tail, index(t_.head(seam.half))};
    }
    return e;
  }
  void keep_worst(int k) {
    std::stable_sort(beyond_[k].begin(), beyond_[k].end(),
                     [](const SeamExcess& a, const SeamExcess& b) { return a.value > b.value; });
    if (beyond_[k].size() > size_t(listed_)) beyond_[k].resize(size_t(listed_));
  }
  AssetSeams& seams_;
  const Topology& t_;
  Index listed_;
  Limits limits_{};
  std::optional<SeamExcess> worst_[3][3];
  std::vector<SeamExcess> beyond_[3];
};

}  // namespace

AssetSeams measure_seams(const SeamPlaces& places, const Topology& topology, const LimitSurface& surface,
                         double diagonal, const SeamTolerance& tolerance, Index listed,
                         const std::function<void(double)>& tick) {
  AssetSeams seams;
  seams.edges = places.num_smooth();
  seams.crease_edges = places.num_creases();
  seams.border_edges = places.num_borders();
  Collector collector(seams, topology, tolerance, diagonal, listed);
  SeamSamples work;
  LimitSamples samples;
  std::vector<Peaks> peaks;
  for (std::int64_t number = 0; number < places.size();) {
    work.clear();
    for (; number < places.size() && work.samples.size() < batch; ++number) places.add(number, work);
    surface.evaluate(work.samples, 2, true, samples);
    peaks.assign(work.groups.size(), {});
    parallel_for_blocks(
        std::int64_t(work.groups.size()),
        [&](std::int64_t, std::int64_t begin, std::int64_t end) {
          for (std::int64_t g = begin; g < end; ++g) {
            const SeamSamples::Group& group = work.groups[g];
            const bool point = group.seam.what == Seam::What::point;
            const auto first = Index(group.first), last = Index(group.first + group.count);
            if (point) {
              for (Index i = first; i < last; ++i)
                for (Index j = i + 1; j < std::min<Index>(last, i + 32); ++j)
                  compare(samples, i, j, false, diagonal, peaks[g]);
            } else {
              for (Index i = first; i + 1 < last; i += 2) compare(samples, i, i + 1, true, diagonal, peaks[g]);
            }
          }
        },
        256);
    for (size_t g = 0; g < work.groups.size(); ++g) {
      if (work.groups[g].seam.what == Seam::What::patch) seams.patch_seams += work.groups[g].count / 2;
      collector.add(work.groups[g].seam, peaks[g], work, samples);
    }
    if (tick) tick(double(number) / double(places.size()));
  }
  collector.finish();
  return seams;
}

}  // namespace sublimit::asset
