// SPDX-License-Identifier: Apache-2.0
#include "truth/regular_patch.h"

#include <Eigen/LU>

#include <array>
#include <map>
#include <set>

#include "truth/regular_limit.h"

namespace sublimit::testing {
namespace {

using Weights = Eigen::Matrix<Precise, 6, Eigen::Dynamic>;

bool is_barrier(const Level& level, HalfEdge h) {
  return !exists(level.topology().twin(h)) || is_infinite(level.sharpness.edge[index(level.topology().edge(h))]);
}

/// Interior, nothing sharp.
bool is_smooth(const Level& level, Vertex v, Index valence) {
  const Topology& t = level.topology();
  if (t.is_nonmanifold(v) || t.is_boundary(v) || t.num_faces(v) != valence ||
      is_sharp(level.sharpness.vertex[index(v)]))
    return false;
  for (const Edge e : t.edges(v))
    if (is_sharp(level.sharpness.edge[index(e)])) return false;
  return true;
}

/// On a border or crease that never gets smooth, with this rule.
bool is_cut(const Level& level, Vertex v, Rule rule) {
  const VertexSharpness around(level.topology(), level.sharpness, v);
  if (around.rule() != rule || is_semi_sharp(around.vertex)) return false;
  for (const float s : around.edges)
    if (is_semi_sharp(s)) return false;
  return true;
}

// --- Grids of quads
// -------------------------------------------------------------------------------------------------------------

/// A half-edge stands for the square to its left, seen from the lower left corner.
HalfEdge stepped(const Topology& t, HalfEdge h, int direction) {  // right, up, left, down
  switch (direction) {
    case 0:
      return t.next(t.twin(t.next(h)));
    case 1:
      return t.twin(t.next(t.next(h)));
    case 2:
      return t.prev(t.twin(t.prev(h)));
    default:
      return t.next(t.next(t.twin(h)));
  }
}
HalfEdge side(const Topology& t, HalfEdge h, int direction) { return along(t, h, (direction + 1) % 4); }

/// Squares x[0] ... x[1] by y[0] ... y[1] around the base, which is (0,0).
struct Range {
  int x[2], y[2];
};

/// Control points of the rectangle, column by column, or nothing if it is not regular.
std::optional<PrecisePoints> grid_points(const Level& level, const PrecisePoints& points,
                                         const std::vector<char>& strays, HalfEdge base, const Range& wanted,
                                         bool may_end, bool may_have_corners) {
  const Topology& t = level.topology();
  const auto blocked = [&](HalfEdge h, int direction) { return is_barrier(level, side(t, h, direction)); };
  const auto is_quad = [&](HalfEdge h) { return t.size(t.face(h)) == 4; };
  if (!is_quad(base)) return std::nullopt;
  const auto reach = [&](int direction, int most) {
    int count = 0;
    for (HalfEdge h = base; count < most && !blocked(h, direction) && is_quad(stepped(t, h, direction)); ++count)
      h = stepped(t, h, direction);
    return count;
  };
  const Range have{{-reach(2, -wanted.x[0]), reach(0, wanted.x[1])}, {-reach(3, -wanted.y[0]), reach(1, wanted.y[1])}};
  const bool ends[] = {have.x[1]<wanted.x[1], have.y[1]<wanted.y[1], have.x[0]> wanted.x[0], have.y[0]> wanted.y[0]};
  if (!may_end && (ends[0] || ends[1] || ends[2] || ends[3])) return std::nullopt;

  std::map<std::pair<int, int>, HalfEdge> squares{{{0, 0}, base}};
  const auto walk = [&](int x, int y, int direction) {  // from (x,y)
    const HalfEdge h = squares.at({x, y});
    if (blocked(h, direction)) return false;
    const HalfEdge g = stepped(t, h, direction);
    const int dx[] = {1, 0, -1, 0}, dy[] = {0, 1, 0, -1};
    const auto [at, is_new] = squares.try_emplace({x + dx[direction], y + dy[direction]}, g);
    return is_quad(g) && at->second == g;
  };
  for (int x = 0; x < have.x[1]; ++x)
    if (!walk(x, 0, 0)) return std::nullopt;
  for (int x = 0; x > have.x[0]; --x)
    if (!walk(x, 0, 2)) return std::nullopt;
  for (int x = have.x[0]; x <= have.x[1]; ++x) {
    for (int y = 0; y < have.y[1]; ++y)
      if (!walk(x, y, 1)) return std::nullopt;
    for (int y = 0; y > have.y[0]; --y)
      if (!walk(x, y, 3)) return std::nullopt;
  }
  for (const auto& [at, h] : squares) {
    const auto [x, y] = at;
    const bool last[] = {x == have.x[1], y == have.y[1], x == have.x[0], y == have.y[0]};
    for (int d = 0; d < 4; ++d) {
      if (last[d] && ends[d] && !blocked(h, d)) return std::nullopt;
      if (!last[d] && !walk(x, y, d)) return std::nullopt;
    }
  }

  const auto vertex = [&](int x, int y) {
    const int i = std::min(x, have.x[1]), j = std::min(y, have.y[1]);
    return t.tail(along(t, squares.at({i, j}), x > i ? (y > j ? 2 : 1) : (y > j ? 3 : 0)));
  };
  const int first_x = wanted.x[0], first_y = wanted.y[0], columns = wanted.x[1] - first_x + 2,
            rows = wanted.y[1] - first_y + 2;
  std::vector<char> known(size_t(columns * rows), 0);
  PrecisePoints result(columns * rows, points.cols());
  const auto place = [&](int x, int y) { return (x - first_x) * rows + y - first_y; };
  for (int x = have.x[0]; x <= have.x[1] + 1; ++x)
    for (int y = have.y[0]; y <= have.y[1] + 1; ++y) {
      const Vertex v = vertex(x, y);
      if (!strays.empty() && strays[size_t(index(v))]) return std::nullopt;
      result.row(place(x, y)) = points.row(index(v));
      known[size_t(place(x, y))] = 1;
      if (x == first_x || x == first_x + columns - 1 || y == first_y || y == first_y + rows - 1) continue;
      const bool across = (x == have.x[0] && ends[2]) || (x == have.x[1] + 1 && ends[0]);
      const bool upward = (y == have.y[0] && ends[3]) || (y == have.y[1] + 1 && ends[1]);
      if (across && upward && !may_have_corners) return std::nullopt;
      const bool regular = across && upward   ? is_cut(level, v, Rule::corner)
                           : across || upward ? is_cut(level, v, Rule::crease)
                                              : is_smooth(level, v, 4);
      if (!regular) return std::nullopt;
    }
  // Beyond the ends: reflected, again and again where both ends are near.
  for (bool more = true; more;) {
    more = false;
    for (int x = first_x; x < first_x + columns; ++x)
      for (int y = first_y; y < first_y + rows; ++y) {
        if (known[size_t(place(x, y))]) continue;
        more = true;
        const bool beside = x < have.x[0] || x > have.x[1] + 1;
        const int mirror_x = x < have.x[0] ? have.x[0] : have.x[1] + 1,
                  mirror_y = y < have.y[0] ? have.y[0] : have.y[1] + 1;
        const int from_x = beside ? 2 * mirror_x - x : x, from_y = beside ? y : 2 * mirror_y - y;
        const int on_x = beside ? mirror_x : x, on_y = beside ? y : mirror_y;
        if (!known[size_t(place(from_x, from_y))] || !known[size_t(place(on_x, on_y))]) continue;
        result.row(place(x, y)) = Precise(2) * result.row(place(on_x, on_y)) - result.row(place(from_x, from_y));
        known[size_t(place(x, y))] = 1;
      }
  }
  return result;
}

/// B-splines of degree d on uniform knots that do not vanish on [0,1], with derivatives: Cox and de Boor.
std::array<std::vector<Precise>, 3> bsplines(int degree, const Precise& t) {
  std::vector<std::vector<Precise>> b{{Precise(1)}};
  const auto at = [](const std::vector<Precise>& list, int k) {
    return k >= 0 && k < int(list.size()) ? list[size_t(k)] : Precise(0);
  };
  for (int d = 1; d <= degree; ++d) {
    b.emplace_back();
    for (int k = 0; k <= d; ++k)
      b[size_t(d)].push_back(((t + (d - k)) * at(b[size_t(d - 1)], k - 1) + (k + 1 - t) * at(b[size_t(d - 1)], k)) / d);
  }
  const auto differences = [&](const std::vector<Precise>& list) {
    std::vector<Precise> result;
    for (int k = 0; k <= int(list.size()); ++k) result.push_back(at(list, k - 1) - at(list, k));
    return result;
  };
  const std::vector<Precise> none(size_t(degree) + 1, Precise(0));
  return {b[size_t(degree)], degree >= 1 ? differences(b[size_t(degree - 1)]) : none,
          degree >= 2 ? differences(differences(b[size_t(degree - 2)])) : none};
}

std::optional<PieceValues> tensor_piece(int degree, const Level& level, const PrecisePoints& points,
                                        const std::vector<char>& strays, const Range& range, HalfEdge base,
                                        const Precise& x, const Precise& y, bool may_end) {
  const bool odd = degree % 2 == 1;
  const auto grid = grid_points(level, points, strays, base, range, may_end, odd);
  if (!grid) return std::nullopt;
  const auto a = bsplines(degree, x), b = bsplines(degree, y);
  Weights w(6, grid->rows());
  for (int i = 0, at = 0; i <= degree; ++i)
    for (int j = 0; j <= degree; ++j, ++at) {
      const auto product = [&](int p, int q) { return Precise(a[size_t(p)][size_t(i)] * b[size_t(q)][size_t(j)]); };
      w.col(at) << product(0, 0), product(1, 0), product(0, 1), product(2, 0), product(1, 1), product(0, 2);
    }
  PieceValues result;
  result.rows = w * *grid;
  result.inside = x > 0 && x < 1 && y > 0 && y < 1;
  return result;
}

// --- Box splines
// ----------------------------------------------------------------------------------------------------------------

using Offset = std::array<int, 2>;

/// Shifts of a box spline as polynomials on one of its pieces, by their values inside it.
class BoxPiece {
 public:
  BoxPiece(const BoxSpline& spline, int degree, const std::array<Eigen::Matrix<Precise, 2, 1>, 3>& triangle,
           std::vector<Offset> shifts)
      : degree_(degree), shifts_(std::move(shifts)) {
    const Index terms = (degree + 1) * (degree + 2) / 2;
    Eigen::Matrix<Precise, Eigen::Dynamic, Eigen::Dynamic> V(terms, terms), values(terms, Index(shifts_.size()));
    Index at = 0;
    for (int a = 0; a <= degree; ++a)
      for (int b = 0; a + b <= degree; ++b, ++at) {
        const auto part = [&](int k) { return (k + Precise(1) / 3) / (degree + 1); };
        const Eigen::Matrix<Precise, 2, 1> p =
            part(a) * triangle[0] + part(b) * triangle[1] + part(degree - a - b) * triangle[2];
        V.row(at) = monomials(p[0], p[1]).row(0);
        for (size_t s = 0; s < shifts_.size(); ++s)
          values(at, Index(s)) = spline.inside(p[0] - shifts_[s][0], p[1] - shifts_[s][1]);
      }
    coefficients_ = V.fullPivLu().solve(values);
  }
  const std::vector<Offset>& shifts() const { return shifts_; }
  Weights weights(const Precise& x, const Precise& y) const { return monomials(x, y) * coefficients_; }

 private:
  /// Of x^p y^q: value, x, y, xx, xy, yy.
  Weights monomials(const Precise& x, const Precise& y) const {
    Weights m(6, (degree_ + 1) * (degree_ + 2) / 2);
    const auto power = [](const Precise& z, int p, int derivative) {
      Precise result = p >= derivative ? 1 : 0;
      for (int k = 0; k < derivative; ++k) result *= p - k;
      for (int k = derivative; k < p; ++k) result *= z;
      return result;
    };
    Index at = 0;
    for (int d = 0; d <= degree_; ++d)
      for (int p = 0; p <= d; ++p, ++at) {
        const int dx[] = {0, 1, 0, 2, 1, 0}, dy[] = {0, 0, 1, 0, 1, 2};
        for (int i = 0; i < 6; ++i) m(i, at) = power(x, p, dx[i]) * power(y, d - p, dy[i]);
      }
    return m;
  }
  int degree_;
  std::vector<Offset> shifts_;
  Eigen::Matrix<Precise, Eigen::Dynamic, Eigen::Dynamic> coefficients_;
};

constexpr Offset around[] = {{1, 0},  {0, 1},  {-1, 1},
                             {-1, 0}, {0, -1}, {1, -1}};  // of a vertex of triangles, counter-clockwise
constexpr Offset corners[] = {{0, 0}, {1, 0}, {0, 1}};

Offset sum(const Offset& a, const Offset& b, int sign = 1) { return {a[0] + sign * b[0], a[1] + sign * b[1]}; }

std::optional<PieceValues> quartic_piece(const Level& level, const PrecisePoints& points, const DescentPlace& place) {
  static const BoxPiece basis = [] {
    std::set<Offset> shifts;
    for (const Offset& c : corners)
      for (const Offset& d : around) shifts.insert(sum(c, d));
    return BoxPiece(BoxSpline({{1, 0}, {0, 1}, {1, -1}}, {2, 2, 2}), 4, {{{0, 0}, {1, 0}, {0, 1}}},
                    {shifts.begin(), shifts.end()});
  }();
  using Row = Eigen::Matrix<Precise, 1, Eigen::Dynamic>;
  const Topology& t = level.topology();
  std::map<Offset, Row> known;
  struct Border {
    Offset at;
    int first;  // direction of the first edge of its three triangles
  };
  std::vector<Border> borders;
  for (int c = 0; c < 3; ++c) {
    HalfEdge h = along(t, place.frame, c);
    int direction = 2 * c;  // the frame's edges have directions 0, 2 and 4
    const Vertex v = t.tail(h);
    known[corners[c]] = points.row(index(v));
    int count = 0;
    const bool whole = is_smooth(level, v, 6);
    if (!whole) {
      if (!is_cut(level, v, Rule::crease)) return std::nullopt;
      for (; !is_barrier(level, h) && count < 6; ++count) {  // back to the border
        h = t.next(t.twin(h));
        direction = (direction + 5) % 6;
      }
      if (count == 6) return std::nullopt;
      borders.push_back({corners[c], direction});
    }
    for (count = 0; count < 6; ++count) {
      known[sum(corners[c], around[(direction + count) % 6])] = points.row(index(t.head(h)));
      if (is_barrier(level, t.prev(h))) {
        known[sum(corners[c], around[(direction + count + 1) % 6])] = points.row(index(t.tail(t.prev(h))));
        ++count;
        break;
      }
      h = t.ccw(h);
    }
    if (count != (whole ? 6 : 3)) return std::nullopt;
  }
  for (const Border& border : borders) {
    const Offset& at = border.at;
    const int first = border.first;
    const auto point = [&](int k) -> const Row& { return known.at(sum(at, around[(first + k) % 6])); };
    const Row before = known.at(at) + point(3) - point(2), after = known.at(at) + point(0) - point(1);
    known.try_emplace(sum(at, around[(first + 4) % 6]), before);
    known.try_emplace(sum(at, around[(first + 5) % 6]), after);
  }
  PrecisePoints control(Index(basis.shifts().size()), points.cols());
  for (size_t i = 0; i < basis.shifts().size(); ++i) control.row(Index(i)) = known.at(basis.shifts()[i]);
  PieceValues result;
  result.rows = basis.weights(place.x, place.y) * control;
  return result;
}

std::optional<PieceValues> zwart_powell_piece(const Level& level, const PrecisePoints& points,
                                              const std::vector<char>& strays, const Range& range, HalfEdge base,
                                              const Precise& x, const Precise& y) {
  static const std::vector<BoxPiece> bases = [] {  // right, upper, left and lower quarter of the square around a point
    std::vector<Offset> shifts;
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j) shifts.push_back({i, j});
    const BoxSpline spline({{1, 0}, {0, 1}, {1, 1}, {1, -1}}, {1, 1, 1, 1});
    const Precise half(0.5);
    const Eigen::Matrix<Precise, 2, 1> corner[] = {{half, -half}, {half, half}, {-half, half}, {-half, -half}};
    std::vector<BoxPiece> result;
    for (int k = 0; k < 4; ++k)
      result.emplace_back(
          spline, 2, std::array<Eigen::Matrix<Precise, 2, 1>, 3>{{{0, 0}, corner[k], corner[(k + 1) % 4]}}, shifts);
    return result;
  }();
  const auto grid = grid_points(level, points, strays, base, range, false, false);
  if (!grid) return std::nullopt;
  const int quarter = abs(y) <= abs(x) ? (x >= 0 ? 0 : 2) : (y >= 0 ? 1 : 3);
  PieceValues result;
  result.rows = bases[size_t(quarter)].weights(x, y) * *grid;
  result.inside = abs(x) != abs(y) && abs(x) < 0.5 && abs(y) < 0.5;
  return result;
}

/// Half-edge that leaves corner (i,j) of a square.
HalfEdge turned_to(const Topology& t, HalfEdge base, int i, int j) { return along(t, base, j == 0 ? i : 3 - i); }

/// No other faces touch the edges of the four faces around the tail of h.
bool is_among_quads(const Topology& t, HalfEdge h) {
  for (int k = 0; k < 4; ++k, h = t.ccw(h))
    for (int side = 0; side < 4; ++side)
      if (const HalfEdge g = t.twin(along(t, h, side)); exists(g) && t.size(t.face(g)) != 4) return false;
  return true;
}

}  // namespace

bool is_regular_corner(const Level& level, HalfEdge corner, Index valence) {
  const Topology& t = level.topology();
  const Vertex v = t.tail(corner);
  if (is_smooth(level, v, valence)) return true;
  if (!is_cut(level, v, Rule::crease)) return false;
  HalfEdge h = corner;
  for (Index k = 0; !is_barrier(level, h) && k < valence; ++k) h = t.next(t.twin(h));
  Index count = 1;
  for (; !is_barrier(level, t.prev(h)) && count <= valence; ++count) h = t.ccw(h);
  return count == valence / 2;
}

Spline spline_of(const Scheme<Precise>& scheme) {
  const std::string& name = scheme.name;
  if (name == "bilinear") return {Spline::Kind::tensor, 1};
  if (name == "catmull-clark" || name == "catmull-clark-intervals") return {Spline::Kind::tensor, 3};
  if (name == "averaging") return {Spline::Kind::tensor, scheme.claims.regular + 1};
  if (name.starts_with("doo-sabin")) return {Spline::Kind::tensor, 2};
  if (name.starts_with("mid-edge")) return {Spline::Kind::zwart_powell, 2, name == "mid-edge-habib-warren"};
  if (name.starts_with("loop")) return {Spline::Kind::quartic, 4};
  return {};
}

std::optional<PieceValues> piece(const Spline& spline, const Level& level, const PrecisePoints& points,
                                 const std::vector<char>& strays, const DescentPlace& place) {
  if (spline.kind == Spline::Kind::none || place.cell == DescentPlace::Cell::corner) return std::nullopt;
  if (spline.kind == Spline::Kind::quartic) return quartic_piece(level, points, place);
  const Topology& t = level.topology();
  if (spline.degree % 2 == 1) {
    const int r = (spline.degree - 1) / 2;
    std::optional<PieceValues> result =
        tensor_piece(spline.degree, level, points, strays, {{-r, r}, {-r, r}}, place.frame, place.x, place.y, true);
    if (result) result->inside = true;  // twice differentiable everywhere; degree 1: on the side of the face
    return result;
  }
  // Pieces lie around control points: (i,j) of the base square.
  const bool is_square = place.cell == DescentPlace::Cell::square;
  const Precise half(0.5);
  const int i = is_square && place.x >= half, j = is_square && place.y >= half, r = spline.degree / 2;
  const HalfEdge base = is_square ? place.frame : turned(t, place.frame, 2);
  const Precise x = is_square ? Precise(place.x - i) : Precise(place.x - half),
                y = is_square ? Precise(place.y - j) : Precise(place.y - half);
  const Range range{{i - r, i + r - 1}, {j - r, j + r - 1}};
  if (spline.kind == Spline::Kind::zwart_powell) {
    const auto result = zwart_powell_piece(level, points, strays, range, base, x, y);
    const HalfEdge leaving = turned_to(t, base, i, j);
    return result && spline.looks_across && !is_among_quads(t, leaving) ? std::nullopt : result;
  }
  std::optional<PieceValues> result = tensor_piece(spline.degree, level, points, strays, range, base, x + half,
                                                   y + half, spline.degree == 2 && is_square);
  if (result) result->inside |= spline.degree > 2;
  return result;
}

}  // namespace sublimit::testing
