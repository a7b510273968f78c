// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/asset/curvature_statistics.h"
#include "sublimit/source/curvature.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace sublimit::asset {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t batch = 1 << 17;

struct Weighted {
  double value, area;
};

/// Values at parts of the area.
CurvatureRange range(std::vector<Weighted>& samples) {
  std::stable_sort(samples.begin(), samples.end(),
                   [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
  CurvatureRange r;
  double area = 0, sum = 0;
  for (const Weighted& s : samples) {
    area += s.area;
    sum += s.area * s.value;
  }
  r.min = samples.front().value;
  r.max = samples.back().value;
  r.mean = area > 0 ? sum / area : 0;
  constexpr double parts[] = {.01, .05, .25, .5, .75, .95, .99};
  double below = 0;
  size_t i = 0;
  for (size_t k = 0; k < std::size(parts); ++k) {
    while (i + 1 < samples.size() && below + samples[i].area < parts[k] * area) below += samples[i++].area;
    r.quantiles[k] = samples[i].value;
  }
  return r;
}

}  // namespace

Place CellMiddles::operator()(std::int64_t number) const {
  const std::int64_t face = number / per_face(), own = number % per_face();
  if (!triangles) {
    const double u = (double(own % side) + middle) / side, v = (double(own / side) + middle) / side;
    return {Index(face), u, v};
  }
  // Row j has side - j triangles that lie as the face does and side - j - 1 between them, the other way round.
  std::int64_t j = 0, i = own;
  while (i >= 2 * (side - j) - 1) i -= 2 * (side - j++) - 1;
  const double at = i % 2 == 0 ? third : 1 - third;
  return {Index(face), (double(i / 2) + at) / side, (double(j) + at) / side};
}

AssetCurvature curvature_statistics(const LimitMap& surface, const LimitSurface& bound, std::int64_t samples,
                                    const LimitTraits& traits, const std::function<void(double)>& tick) {
  CellMiddles cells{surface.addresses().triangles()};
  if (traits.dual) cells.middle += 0x1p-13;  // off the seams
  if (!traits.polynomial && !traits.thirds) cells.third = 3. / 8;
  if (!traits.polynomial) samples /= 50;  // each costs as much as so many
  const int finer = traits.thirds && !traits.polynomial ? 3 : 2;
  const std::int64_t faces = surface.addresses().size();
  while (cells.side < 64 && faces * cells.per_face() * finer * finer <= samples) cells.side *= finer;

  AssetCurvature result;
  std::vector<Weighted> gauss, mean;
  AssetPlace most[4] = {{"largest Gauss curvature", 0},
                        {"least Gauss curvature", 0},
                        {"largest mean curvature", 0},
                        {"least mean curvature", 0}};
  double total = 0;
  std::vector<Place> places;
  LimitSamples s;
  const std::int64_t count = faces * cells.per_face();
  for (std::int64_t begin = 0; begin < count; begin += batch) {
    const std::int64_t end = std::min(count, begin + batch);
    places.clear();
    for (std::int64_t i = begin; i < end; ++i) places.push_back(cells(i));
    bound.evaluate(places, 2, false, s);
    for (Index i = 0; i < Index(end - begin); ++i) {
      if (s.status[i] == LimitStatus::hole) continue;
      ++result.samples;
      const double cell = (cells.triangles ? .5 : 1) / double(cells.per_face());
      const double area = s.order[i] >= 1 ? cell * Vector3d(s.du.row(i)).cross(Vector3d(s.dv.row(i))).norm() : 0;
      result.area += area;
      const std::optional<Curvature> c = curvature(s, i);
      if (!c || !std::isfinite(c->gauss) || !std::isfinite(c->mean)) {
        ++result.without;
        continue;
      }
      const double values[] = {c->gauss, c->gauss, c->mean, c->mean};
      for (int k = 0; k < 4; ++k)
        if (gauss.empty() || (k % 2 == 0 ? values[k] > most[k].value : values[k] < most[k].value)) {
          const Place& at = places[size_t(i)];
          most[k] = {most[k].what, values[k], at.face, at.u, at.v, s.position.row(i)};
        }
      gauss.push_back({c->gauss, area});
      mean.push_back({c->mean, area});
      total += area * c->gauss;
    }
    if (tick) tick(double(end) / double(count));
  }
  if (gauss.empty()) return result;
  result.gauss = range(gauss);
  result.mean = range(mean);
  if (result.without == 0) result.total_gauss = total;
  result.worst.assign(std::begin(most), std::end(most));
  return result;
}

}  // namespace sublimit::asset
