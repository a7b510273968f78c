// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/statements/regular.h"

#include <algorithm>
#include <climits>

#include "sublimit/neighborhood/regular_mask.h"
#include "sublimit/report/analysis/regular_json.h"

namespace sublimit::report {
namespace {

using Mask = std::map<Offset, Algebraic>;

/// Moved so that the least offsets are 0: which point is the origin is a convention.
Mask moved(const Mask& mask) {
  Offset least{INT_MAX, INT_MAX};
  for (const auto& [at, weight] : mask)
    for (const int k : {0, 1}) least[k] = std::min(least[k], at[k]);
  Mask result;
  for (const auto& [at, weight] : mask) result.emplace(Offset{at[0] - least[0], at[1] - least[1]}, weight);
  return result;
}

/// 4 times the product of (1 + z^d)/2.
Mask box_spline_mask(const Directions& directions) {
  Mask mask{{Offset{0, 0}, Algebraic(4)}};
  for (const std::vector<int>& d : directions) {
    Mask next;
    for (const auto& [at, weight] : mask)
      for (const int step : {0, 1}) {
        Algebraic& sum = next[{at[0] + step * d[0], at[1] + step * d[1]}];
        sum += weight * Algebraic::ratio(1, 2);
      }
    mask = std::move(next);
  }
  return mask;
}

int continuity(const Directions& directions) {
  int fewest = INT_MAX;
  for (const std::vector<int>& d : directions)
    fewest = std::min(
        fewest, static_cast<int>(std::count_if(directions.begin(), directions.end(),
                                               [&](const std::vector<int>& e) { return d[0] * e[1] != d[1] * e[0]; })));
  return fewest - 2;
}

Finding compared(const Mask& a, const Mask& b) {
  const bool same = a == b;
  double most = 0;
  Mask difference = a;
  for (const auto& [at, weight] : b) difference[at] -= weight;
  for (const auto& [at, weight] : difference) most = std::max(most, std::abs(static_cast<double>(weight)));
  Finding f{fate(same), "the mask of regular meshes, read off exact local matrices"};
  f.numbers["weights"] = a.size();
  f.numbers["largest difference"] = drawn(most);
  return f;
}

}  // namespace

Directions tensor_directions(int degree) {
  Directions directions;
  for (int i = 0; i <= degree; ++i) directions.insert(directions.end(), {{1, 0}, {0, 1}});
  return directions;
}

Finding is_box_spline(const Scheme<Algebraic>& scheme, const Directions& directions) {
  Finding f = compared(moved(regular_mask(scheme).weights), moved(box_spline_mask(directions)));
  f.computed += ", against the symbol of the box spline";
  return f;
}

Finding is_smooth_box_spline(const Scheme<Algebraic>& scheme, const Directions& directions, int k) {
  Finding f = is_box_spline(scheme, directions);
  const int found = continuity(directions);
  if (f.fate == Fate::confirmed) f.fate = fate(found >= k);
  f.computed += ", which is C^" + std::to_string(found);
  return f;
}

Finding is_regularly_smooth(const Scheme<Algebraic>& scheme, int k) {
  const Json regular = regular_json(scheme);
  Finding f{Fate::depends, "bounds of the joint spectral radius of differences on regular meshes"};
  if (!regular.is_object()) return f;
  const Json& smoothness = regular["smoothness"];
  f.numbers["regular continuity proved"] = smoothness["continuity"];
  f.numbers["Hoelder exponent between"] = Json::array();
  for (const Json& bound : smoothness["exponent"])
    f.numbers["Hoelder exponent between"].push_back(bound.is_number() ? drawn(bound.get<double>()) : Json());
  const Json& most = smoothness["exponent"][1];
  if (smoothness["continuity"].is_number() && smoothness["continuity"] >= k)
    f.fate = Fate::confirmed;
  else if (most.is_number() && most < k)
    f.fate = Fate::refuted;
  return f;
}

Finding same_regular_mask(const Scheme<Algebraic>& a, const Scheme<Algebraic>& b) {
  return compared(moved(regular_mask(a).weights), moved(regular_mask(b).weights));
}

Finding vertex_mask_has_points(const Scheme<Algebraic>& scheme, int points) {
  int of_vertex = 0, of_edge = 0;
  for (const auto& [at, weight] : regular_mask(scheme).weights) {
    of_vertex += at[0] % 2 == 0 && at[1] % 2 == 0;
    of_edge += at[0] % 2 != 0 && at[1] % 2 == 0;
  }
  Finding f{fate(of_vertex == points), "the mask of regular meshes, read off exact local matrices"};
  f.numbers["points of a new vertex"] = of_vertex;
  f.numbers["points of a new edge point"] = of_edge;
  return f;
}

}  // namespace sublimit::report
