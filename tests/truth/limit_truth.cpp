// SPDX-License-Identifier: Apache-2.0
#include "truth/limit_truth.h"

#include <algorithm>

#include "sublimit/base/error.h"
#include "sublimit/scheme/detail/refine_impl.h"
#include "truth/place_descent.h"
#include "truth/regular_patch.h"

namespace sublimit::testing {
namespace {

using Vector = TruePoint::Vector;

/// Part of a level around a place.
struct Stage {
  Level level;
  PrecisePoints points;
  std::vector<char> strays;  // dual schemes: vertices that borders have moved off their natural place
  DescentPlace place;
};

int rings_around(const Scheme<Precise>& scheme) {
  // As rings_for_refinement; two levels at once need more.
  if (scheme.is_wide()) return scheme.period == 2 ? 7 : 4;
  if (scheme.steps.size() > 1) return spline_of(scheme).degree / 2 + 2;  // every averaging takes one of the child's
  if (scheme.is_dual()) return scheme.period == 2 ? 5 : 3;
  return scheme.period == 2 ? 4 : 1;
}

/// What of the level the place depends on.
Stage cut_out(const Stage& whole, bool around_vertex, int rings) {
  const Topology& t = whole.level.topology();
  std::vector<Index> faces{index(t.face(whole.place.frame))};
  for (int k = 1; around_vertex && k < 4; ++k) faces.push_back(index(t.face(turned(t, whole.place.frame, k))));
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  Subset part = subset(whole.level, faces, rings);
  Stage result;
  result.place = whole.place;
  const auto face = std::lower_bound(part.parents.begin(), part.parents.end(), index(t.face(whole.place.frame)));
  result.place.frame =
      part.level.topology().corner(Face{Index(face - part.parents.begin())}, t.corner_index(whole.place.frame));
  const Index count = Index(part.level.S.rows());
  result.points.resize(count, whole.points.cols());
  for (Index i = 0; i < count; ++i) {
    const Index from = part.level.S.innerIndexPtr()[i];  // a selection: one column a row
    result.points.row(i) = whole.points.row(from);
    result.strays.push_back(whole.strays[size_t(from)]);
  }
  result.level = std::move(part.level);
  return result;
}

/// One level on; two in schemes of period 2.
Stage refined(const Scheme<Precise>& scheme, const Stage& stage) {
  std::vector<LevelOf<Precise>> levels(1);
  levels.reserve(3);
  levels[0].number = stage.level.number;
  levels[0].steps = stage.level.steps;
  levels[0].sharpness = stage.level.sharpness;
  levels[0].holes = stage.level.holes;
  Stage result;
  result.points = stage.points;
  result.strays = stage.strays;
  std::vector<TakenStep> steps;
  for (int k = 0; k < scheme.period; ++k) {
    levels.push_back(next_level(scheme, levels.back()));
    const LevelOf<Precise>& next = levels.back();
    const Topology* parent = &levels[levels.size() - 2].topology();
    for (const Refinement& r : next.steps) {
      steps.push_back({parent, &r});
      parent = &r.topology;
    }
    const PrecisePoints points = next.S * result.points;
    std::vector<char> strays(size_t(next.S.rows()), 0);
    for (Index i = 0; i < next.S.rows(); ++i)
      for (SparseMatrixOf<Precise>::InnerIterator it(next.S, i); it; ++it)
        strays[size_t(i)] |= result.strays[size_t(it.col())];
    result.points = points;
    result.strays = strays;
  }
  const TakenStep& last = steps.back();
  if (scheme.is_dual())  // points of the border stay there, the others come half as near
    for (Index i = 0; i < result.points.rows(); ++i) {
      const Vertex v{i};
      const Refinement::Origin origin = last.refinement->origin(v);
      const bool on_border = origin == Refinement::Origin::border || origin == Refinement::Origin::vertex ||
                             (origin == Refinement::Origin::edge && last.refinement->topology.is_boundary(v));
      if (on_border) result.strays[size_t(i)] = 1;
    }
  result.place = descend(stage.place, steps);
  const LevelOf<Precise>& next = levels.back();
  result.level.number = next.number;
  result.level.steps = next.steps;
  result.level.sharpness = next.sharpness;
  result.level.holes = next.holes;
  return result;
}

/// The place between the corners of its face, with the slopes of that; dual schemes: between the centroids of the four
/// faces.
struct Guess {
  Vector position, du, dv;
};
Guess guess(const Stage& stage) {
  const Topology& t = stage.level.topology();
  const DescentPlace& p = stage.place;
  const Precise &x = p.x, &y = p.y;
  const auto corner = [&](int k) -> Vector {
    if (p.cell != DescentPlace::Cell::around_vertex)
      return stage.points.row(index(t.tail(along(t, p.frame, k)))).transpose();
    const Face f = t.face(turned(t, p.frame, k));
    Vector sum = Vector::Zero(stage.points.cols());
    for (const Index v : t.vertices(f)) sum += stage.points.row(v).transpose();
    return sum / Precise(t.size(f));
  };
  const Vector a = corner(0), b = corner(1), c = corner(2);
  if (p.cell == DescentPlace::Cell::triangle)
    return {a + x * (b - a) + y * (c - a), p.scale * (b - a), p.scale * (c - a)};
  const Vector d = corner(3);
  const Precise x1 = 1 - x, y1 = 1 - y;
  return {y1 * (x1 * a + x * b) + y * (x1 * d + x * c), p.scale * (y1 * (b - a) + y * (c - d)),
          p.scale * (x1 * (d - a) + x * (c - b))};
}

/// Rules change until sharpness is gone.
bool is_decaying(const Level& level) {
  return std::any_of(level.sharpness.edge.begin(), level.sharpness.edge.end(), is_semi_sharp) ||
         std::any_of(level.sharpness.vertex.begin(), level.sharpness.vertex.end(), is_semi_sharp);
}

/// Not in an irregular vertex.
bool has_regular_place(const Stage& stage) {
  const DescentPlace& p = stage.place;
  if ((p.x != 0 && p.x != 1) || (p.y != 0 && p.y != 1)) return true;
  const bool right = p.x == 1, upper = p.y == 1;
  const HalfEdge corner = along(stage.level.topology(), p.frame,
                                p.cell == DescentPlace::Cell::triangle ? (right   ? 1
                                                                          : upper ? 2
                                                                                  : 0)
                                                                       : (upper ? 3 - right : right));
  return is_regular_corner(stage.level, corner, p.cell == DescentPlace::Cell::triangle ? 6 : 4);
}

double largest(const Vector& v) { return static_cast<double>(Precise(v.cwiseAbs().maxCoeff())); }

}  // namespace

TruePoint true_limit(const Scheme<Precise>& scheme, const Level& level, const Points& points, const Place& place,
                     const TruthOptions& options) {
  if (level.number % scheme.period != 0) throw InvalidParameter("the level's number must be even for " + scheme.name);
  const Spline spline = spline_of(scheme);
  const int rings = rings_around(scheme) + options.more_rings;
  Stage stage;
  stage.level.number = level.number;
  stage.level.steps = level.steps;
  stage.level.sharpness = level.sharpness;
  stage.level.holes = level.holes;
  stage.points = points.cast<Precise>();
  stage.strays.assign(size_t(points.rows()), 0);
  stage.place = place_of(level.topology(), scheme.face_size() == 3, place);
  // Which faces are prepared depends on all of them.
  if (scheme.preparation.empty() || level.number > 0) stage = cut_out(stage, false, rings);

  TruePoint result;
  const double size = std::max(1e-300, static_cast<double>(Precise(stage.points.cwiseAbs().maxCoeff())));
  std::optional<Guess> before;
  for (int quiet = 0;; ++result.levels) {
    if (scheme.is_dual() && stage.place.cell == DescentPlace::Cell::around_vertex &&
        stage.strays[size_t(index(stage.level.topology().tail(stage.place.frame)))]) {
      result.has_position = false;
      return result;
    }
    if (result.levels >= options.least_levels)
      if (const std::optional<PieceValues> found =
              piece(spline, stage.level, stage.points, stage.strays, stage.place)) {
        const auto row = [&](int i, int order) {
          Vector values = found->rows.row(i).transpose();
          for (int k = 0; k < order; ++k) values *= stage.place.scale;
          return values;
        };
        result.position = row(0, 0);
        result.du = row(1, 1), result.dv = row(2, 1);
        result.duu = row(3, 2), result.duv = row(4, 2), result.dvv = row(5, 2);
        result.has_first = result.is_exact = true;
        result.has_second = found->inside;
        return result;
      }
    if (stage.place.cell != DescentPlace::Cell::corner) {
      const Guess now = guess(stage);
      if (before) {
        result.error = largest(now.position - before->position);
        result.first_error = std::max(largest(now.du - before->du), largest(now.dv - before->dv));
        const double slope = std::max(largest(now.du), largest(now.dv));
        const bool has_slopes = spline.kind == Spline::Kind::none && has_regular_place(stage);
        const bool settled = result.error <= options.accuracy * size &&
                             (!has_slopes || result.first_error <= options.first_accuracy * slope);
        // Beside a corner a place stays on the chord of its crease until it is a vertex: no change says nothing yet.
        constexpr int levels_to_a_place = 44;
        const bool says_something = result.error > 0 || result.levels >= levels_to_a_place;
        quiet = settled && says_something && !is_decaying(stage.level) ? quiet + 1 : 0;
        if (quiet >= 3 || result.levels >= options.most_levels) {
          result.position = now.position;
          result.du = now.du, result.dv = now.dv;
          result.has_first = has_slopes && quiet >= 3;
          return result;
        }
      }
      before = now;
    }
    stage = cut_out(refined(scheme, stage), scheme.is_dual(), rings);
  }
}

}  // namespace sublimit::testing
