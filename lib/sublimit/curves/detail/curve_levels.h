// SPDX-License-Identifier: Apache-2.0
#pragma once
// Levels of curves in any number type: the matrix of a step, filled from the masks of a curve scheme, and the
// levels that curve_refine.h makes of it in double.
#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sublimit/base/error.h"
#include "sublimit/curves/curve_refine.h"
#include "sublimit/curves/detail/check_curve_scheme.h"
#include "sublimit/curves/detail/curve_layout.h"
#include "sublimit/mesh/control_polygon.h"

namespace sublimit {

/// Builder of a CurveMatrix, row by row. One thread at a time.
template <class T>
class CurveRows {
 public:
  using Term = std::pair<Index, T>;
  CurveRows(Index rows, Index columns) : S_(rows, columns) {}

  /// Appends a row. Terms may be in any order; those of one column are summed, zeros are dropped.
  void append(std::vector<Term> terms) {
    std::stable_sort(terms.begin(), terms.end(), [](const Term& a, const Term& b) { return a.first < b.first; });
    S_.startVec(row_);
    for (size_t i = 0; i < terms.size();) {
      T sum = terms[i].second;
      const Index column = terms[i].first;
      for (++i; i < terms.size() && terms[i].first == column; ++i) sum += terms[i].second;
      if (sum != T(0)) S_.insertBack(row_, column) = sum;
    }
    ++row_;
  }
  /// Returns the matrix; the builder is empty afterwards.
  CurveMatrix<T> finish() {
    S_.finalize();
    return std::move(S_);
  }

 private:
  CurveMatrix<T> S_;
  Index row_ = 0;
};

/// Returns the matrix of one step. Row i has the weights of child point i over the points of the curves of
/// level `number`; for Hermite schemes rows 2i and 2i + 1 are those of the point and of its derivative.
/// @throws ResourceError  more points than 32-bit indices count
template <class T>
CurveMatrix<T> curve_matrix(const CurveScheme<T>& scheme, const std::vector<CurveOutline>& parents, int number) {
  const CurveLayout layout(scheme, number);
  const auto& masks = scheme.masks;
  const Index unknowns = layout.unknowns();
  std::vector<Stencil<T>> inner;  // by child and unknown
  for (int which : {0, 1})
    for (int component = 0; component < unknowns; ++component)
      inner.push_back(check_mask(scheme, which, component,
                                 masks.child(which, component)(CurveSite<T>(number, unknowns)), -curve_reach,
                                 curve_reach));
  std::int64_t rows = 0, columns = 0;
  for (const CurveOutline& curve : parents) {
    rows += 2 * std::int64_t{curve.size} * unknowns;
    columns += std::int64_t{curve.size} * unknowns;
  }
  if (rows * 8 > std::numeric_limits<Index>::max())
    throw ResourceError(std::to_string(rows) + " points of level " + std::to_string(number + 1) +
                        " are more than 32-bit indices can hold the weights of; use fewer levels");
  rows = 0;
  for (const CurveOutline& curve : parents) rows += layout.child(curve).size * unknowns;
  CurveRows<T> S(static_cast<Index>(rows), static_cast<Index>(columns));
  Index start = 0;
  std::vector<std::pair<Index, T>> row;
  for (const CurveOutline& curve : parents) {
    const CurveOutline child = layout.child(curve);
    const Index margin = layout.keeps_ends() && layout.is_dual() ? 1 : 0;
    for (Index j = 0; j < child.size * unknowns; ++j) {
      const auto [parent, which] = layout.source(curve, child, j / unknowns);
      row.clear();
      if (which < 0) {
        row.push_back({start + parent, T(1)});
      } else {
        const int component = static_cast<int>(j % unknowns);
        const auto& terms = inner[which * unknowns + component].terms();
        const bool inside = parent + layout.steps(terms.front().first) >= margin &&
                            parent + layout.steps(terms.back().first) < curve.size - margin;
        if (curve.closed || inside) {
          const Index size = curve.size * unknowns;
          for (const auto& [slot, weight] : terms)
            row.push_back({start + ((parent * unknowns + slot) % size + size) % size, weight});
        } else {
          const Stencil<T> stencil = check_mask(
              scheme, which, component,
              masks.child(which, component)(CurveSite<T>(number, scheme.ends, layout.is_dual(), parent, curve.size)),
              -parent, curve.size - 1 - parent);
          for (const auto& [slot, weight] : stencil.terms()) row.push_back({start + parent + slot, weight});
        }
      }
      S.append(row);
    }
    start += curve.size * unknowns;
  }
  return S.finish();
}

/// Returns level 0 of a control polygon.
/// @throws InvalidParameter     a scheme whose masks are missing or not affine
/// @throws InvalidMesh          no curves, an index that points nowhere
/// @throws UnsupportedTopology  a curve of too few points for the scheme
template <class T>
CurveLevelOf<T> control_level(const CurveScheme<T>& scheme, const ControlPolygon& polygon) {
  const CurveLayout layout(scheme);
  CurveLevelOf<T> level;
  level.unknowns = layout.unknowns();
  Index count = 0;
  for (const ControlPolygon::Curve& curve : polygon.curves) {
    const Index size = static_cast<Index>(curve.points.size()), least = layout.least_points(curve.closed);
    if (size < least)
      throw UnsupportedTopology(
          "curve " + std::to_string(level.curves.size()) + " has " + std::to_string(size) +
          (size == 1 ? " point; " : " points; ") + scheme.name + " needs at least " + std::to_string(least) +
          (curve.closed ? " points in a closed curve" : " points in an open curve") +
          (layout.end_points() > 2 && !curve.closed             ? " (2 with the option ends=linear)"
           : !layout.keeps_ends() && !curve.closed && least > 3 ? " (fewer with the option ends=interpolate)"
                                                                : ""));
    level.curves.push_back(layout.control(size, curve.closed));
    count += size;
  }
  if (count == 0) throw InvalidMesh("there are no curves; a polygon is needed");
  CurveRows<T> choice(count * level.unknowns, polygon.num_points() * level.unknowns);
  for (const ControlPolygon::Curve& curve : polygon.curves)
    for (const Index i : curve.points) {
      if (i < 0 || i >= polygon.num_points())
        throw InvalidMesh("a curve has point " + std::to_string(i) + "; there are points 0 to " +
                          std::to_string(polygon.num_points() - 1));
      for (int component = 0; component < level.unknowns; ++component)
        choice.append({{i * level.unknowns + component, T(1)}});
    }
  level.S = choice.finish();
  level.made_by = std::make_shared<const CurveScheme<T>>(scheme);
  return level;
}

/// Returns the level after `parent`.
/// @throws ResourceError  more points than 32-bit indices count
template <class T>
CurveLevelOf<T> next_level(const CurveScheme<T>& scheme, const CurveLevelOf<T>& parent) {
  CurveLevelOf<T> level;
  level.number = parent.number + 1;
  level.unknowns = parent.unknowns;
  const bool is_parents = parent.made_by && parent.made_by->name == scheme.name;
  level.made_by = is_parents ? parent.made_by : std::make_shared<const CurveScheme<T>>(scheme);
  const CurveLayout layout(scheme, parent.number);
  level.S = curve_matrix(scheme, parent.curves, parent.number);
  for (const CurveOutline& curve : parent.curves) level.curves.push_back(layout.child(curve));
  return level;
}

}  // namespace sublimit
