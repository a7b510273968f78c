// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/free_form/exact_net.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>
#include <utility>

#include "sublimit/patches/detail/finer_knots.h"
#include "sublimit/patches/detail/spline_rows.h"
#include "sublimit/report/free_form/curve_bezier.h"

namespace sublimit {
namespace {

using Ratios = std::vector<Rational>;
/// Points in space, or homogeneous columns: a row each.
using Rows = std::vector<Ratios>;

struct Curve {
  Knots<Rational> knots;
  Rows rows;
  bool homogeneous = false;
};

// Fields of an object that its reader has accepted.

Rational number_in(const JsonValue& value) {
  if (value.type == JsonValue::Type::number) return Rational(value.number);
  const std::optional<ExactNumber> fraction = parse_fraction(value.text);
  return {static_cast<long>(fraction->numerator), static_cast<long>(fraction->denominator)};
}

Ratios numbers_in(const JsonValue& value) {
  Ratios all;
  for (const JsonValue& item : value.items) all.push_back(number_in(item));
  return all;
}

int whole_number(const JsonValue& value) { return static_cast<int>(number_in(value).value()); }

/// Rows of numbers; of points in the plane z is 0.
Rows rows_in(const JsonValue& value, bool homogeneous) {
  Rows rows;
  for (const JsonValue& item : value.items) {
    Ratios row = numbers_in(item);
    const size_t wanted = homogeneous ? 4 : 3;
    while (row.size() < wanted) row.insert(row.end() - (homogeneous ? 1 : 0), Rational(0));
    rows.push_back(std::move(row));
  }
  return rows;
}

Ratios vector_in(const JsonValue& value) {
  Ratios all = numbers_in(value);
  all.resize(3, Rational(0));
  return all;
}

bool flag_in(const JsonValue* value, size_t i = 0) {
  if (!value) return false;
  return value->type == JsonValue::Type::array ? value->items[i].boolean : value->boolean;
}

Knots<Rational> knots_of(const JsonValue& values, int degree, size_t points, bool closed) {
  Ratios all = numbers_in(values);
  return closed ? Knots<Rational>::closed(degree, all)
                : Knots<Rational>::open(degree, static_cast<Index>(points), std::move(all));
}

/// `points` or `homogeneous`.
Rows columns_in(const JsonValue& object, bool& homogeneous) {
  const JsonValue* const columns = object.find("homogeneous");
  homogeneous = columns != nullptr;
  return rows_in(homogeneous ? *columns : *object.find("points"), homogeneous);
}

/// {degree, knots, points} or {degree, knots, homogeneous}.
Curve curve_in(const JsonValue& object) {
  bool homogeneous = false;
  Rows rows = columns_in(object, homogeneous);
  Knots<Rational> knots = knots_of(*object.find("knots"), whole_number(*object.find("degree")), rows.size(),
                                   flag_in(object.find("closed")));
  return {std::move(knots), std::move(rows), homogeneous};
}

// Arithmetic of rows.

void add(Ratios& sum, const Rational& factor, const Ratios& row) {
  for (size_t k = 0; k < sum.size(); ++k) sum[k] += factor * row[k];
}
Ratios zero_like(const Rows& rows) { return Ratios(rows[0].size(), Rational(0)); }

Rows applied(const BandRows<Rational>& band, const Knots<Rational>& coarse, const Rows& rows) {
  Rows result;
  for (Index r = 0; r < band.size(); ++r) {
    Ratios sum = zero_like(rows);
    for (Index i = 0; i < band.width; ++i)
      if (!band[r][i].is_zero()) add(sum, band[r][i], rows[coarse.point(band.first[r] + i)]);
    result.push_back(std::move(sum));
  }
  return result;
}

bool same_knots(const Knots<Rational>& a, const Knots<Rational>& b) {
  return a.degree() == b.degree() && a.is_closed() == b.is_closed() && std::ranges::equal(a.all(), b.all());
}

/// As `common_knots` of constructions.
Knots<Rational> common_space(const std::vector<Knots<Rational>>& all, int degree, bool clamped) {
  for (const Knots<Rational>& knots : all) degree = std::max(degree, knots.degree());
  const bool are_same = std::ranges::all_of(all, [&](const auto& knots) { return same_knots(knots, all[0]); });
  if (are_same && degree == all[0].degree() && !clamped) return all[0];
  Ratios merged;
  for (Knots<Rational> knots : all) {
    knots = clamped_knots(knots);
    while (knots.degree() < degree) knots = elevated_knots(knots);
    Ratios both;
    std::ranges::set_union(merged, knots.all(), std::back_inserter(both));
    merged = std::move(both);
  }
  const auto points = static_cast<Index>(merged.size()) - degree - 1;
  return Knots<Rational>::open(degree, points, std::move(merged));
}

Rows in_space(const Curve& curve, const Knots<Rational>& fine) {
  if (same_knots(curve.knots, fine)) return curve.rows;
  Knots<Rational> knots = clamped_knots(curve.knots);
  Rows rows = applied(refinement_rows(curve.knots, knots), curve.knots, curve.rows);
  while (knots.degree() < fine.degree()) {
    Knots<Rational> higher = elevated_knots(knots);
    rows = applied(elevation_rows(knots, higher), knots, rows);
    knots = std::move(higher);
  }
  return same_knots(knots, fine) ? rows : applied(refinement_rows(knots, fine), knots, rows);
}

/// All homogeneous if one of them is.
bool make_homogeneous(std::span<Curve> curves) {
  const bool any = std::ranges::any_of(curves, [](const Curve& curve) { return curve.homogeneous; });
  for (Curve& curve : curves) {
    if (!any || curve.homogeneous) continue;
    for (Ratios& row : curve.rows) row.push_back(1);
    curve.homogeneous = true;
  }
  return any;
}

/// An open spline with the first control points of a closed one again behind its last, as files have it.
Knots<Rational> unrolled(const Knots<Rational>& knots) {
  if (!knots.is_closed()) return knots;
  return Knots<Rational>::open(knots.degree(), knots.num_functions(), Ratios(knots.all().begin(), knots.all().end()));
}

SeamNet<Rational> net_of(const Knots<Rational>& u, const Knots<Rational>& v, const Rows& rows, bool homogeneous) {
  Ratios columns;
  for (Index j = 0; j < v.num_functions(); ++j)
    for (Index i = 0; i < u.num_functions(); ++i) {
      const Ratios& row = rows[size_t(u.point(i)) + size_t(u.num_points()) * size_t(v.point(j))];
      columns.insert(columns.end(), row.begin(), row.end());
    }
  return {unrolled(u), unrolled(v), std::move(columns), homogeneous ? Coordinates::homogeneous : Coordinates::plain};
}

// Polynomials.

/// Blossoms of 1, t, .., t^highest as polynomials of degree #arguments: means of products.
Ratios blossoms_of_powers(std::span<const Rational> arguments, size_t highest) {
  Ratios means(highest + 1, Rational(0));
  means[0] = 1;
  for (size_t m = 1; m <= arguments.size(); ++m)
    for (size_t k = std::min(m, highest); k > 0; --k) {
      const Rational share(static_cast<long>(k), static_cast<long>(m));
      means[k] = (Rational(1) - share) * means[k] + share * arguments[m - 1] * means[k - 1];
    }
  return means;
}

/// Control points of polynomials, a row for each power, 1 first, over knots of no lower degree.
Rows points_of(const Rows& powers, const Knots<Rational>& knots) {
  Rows rows;
  const auto degree = static_cast<size_t>(knots.degree());
  for (Index i = 0; i < knots.num_points(); ++i) {
    const Ratios blossoms = blossoms_of_powers(knots.all().subspan(size_t(i) + 1, degree), powers.size() - 1);
    Ratios sum = zero_like(powers);
    for (size_t k = 0; k < powers.size(); ++k) add(sum, blossoms[k], powers[k]);
    rows.push_back(std::move(sum));
  }
  return rows;
}

Knots<Rational> one_span(size_t points, const Rational& begin, const Rational& end) {
  Ratios knots(points, begin);
  knots.insert(knots.end(), points, end);
  return Knots<Rational>::open(static_cast<int>(points) - 1, static_cast<Index>(points), std::move(knots));
}

/// Powers of the polynomial through points at nodes, by divided differences.
Rows interpolating_powers(const Ratios& nodes, Rows points) {
  const size_t n = nodes.size();
  for (size_t order = 1; order < n; ++order)
    for (size_t i = n - 1; i >= order; --i)
      for (size_t k = 0; k < points[i].size(); ++k)
        points[i][k] = (points[i][k] - points[i - 1][k]) / (nodes[i] - nodes[i - order]);
  Rows powers(n, zero_like(points));
  for (size_t i = n; i-- > 0;) {  // p = points[i] + (t - nodes[i]) p
    for (size_t j = n - 1; j > 0; --j)
      for (size_t k = 0; k < powers[j].size(); ++k) powers[j][k] = powers[j - 1][k] - nodes[i] * powers[j][k];
    for (size_t k = 0; k < powers[0].size(); ++k) powers[0][k] = points[i][k] - nodes[i] * powers[0][k];
  }
  return powers;
}

/// Bezier points over the range of nodes.
std::pair<Knots<Rational>, Rows> interpolated(const Ratios& nodes, const Rows& points) {
  const auto [first, last] = std::ranges::minmax(nodes);
  Knots<Rational> knots = one_span(nodes.size(), first, last);
  Rows rows = points_of(interpolating_powers(nodes, points), knots);
  return {std::move(knots), std::move(rows)};
}

/// The cubic Hermite functions of values at 0 and 1, derivatives at 0 and 1, as control points over knots.
Rows hermite_functions(const Knots<Rational>& knots) {
  const Rows powers{{1, 0, 0, 0}, {0, 0, 1, 0}, {-3, 3, -2, -1}, {2, -2, 1, 1}};
  return points_of(powers, knots);
}
Rows linear_functions(const Knots<Rational>& knots) { return points_of(Rows{{1, 0}, {-1, 1}}, knots); }

// Surfaces.

SeamNet<Rational> hermite_surface(const JsonValue& object) {
  const std::string& vectors = object.find("vectors")->text;
  const auto corners = [&](const char* field) { return rows_in(*object.find(field), false); };
  const Rows p = corners("p"), pu = corners("pu"), pv = corners("pv");
  Rows twists(4, Ratios(3, Rational(0)));
  if (vectors == "16") twists = corners("puv");
  if (vectors == "adini")
    for (size_t b = 0; b < 2; ++b)
      for (size_t a = 0; a < 2; ++a)
        for (size_t k = 0; k < 3; ++k)
          twists[a + 2 * b][k] =
              (pu[a + 2][k] - pu[a][k]) + (pv[1 + 2 * b][k] - pv[2 * b][k]) - (p[0][k] - p[1][k] - p[2][k] + p[3][k]);
  const Rows* const data[] = {&p, &pu, &pv, &twists};
  const Knots<Rational> cubic = bezier_knots<Rational>(3);
  const Rows H = hermite_functions(cubic);
  Rows rows;
  for (size_t j = 0; j < 4; ++j)
    for (size_t i = 0; i < 4; ++i) {
      Ratios sum(3, Rational(0));
      for (size_t l = 0; l < 4; ++l)
        for (size_t k = 0; k < 4; ++k)  // values and derivatives at 0 and 1
          add(sum, H[i][k] * H[j][l], (*data[k / 2 + 2 * (l / 2)])[k % 2 + 2 * (l % 2)]);
      rows.push_back(std::move(sum));
    }
  return net_of(cubic, cubic, rows, false);
}

/// A value or a derivative at an end of a curve whose ends are interpolated.
Ratios at_end(const Curve& curve, size_t functional) {
  const auto n = static_cast<Index>(curve.rows.size());
  const bool last = functional % 2 == 1;
  if (functional < 2) return last ? curve.rows.back() : curve.rows.front();
  Ratios sum = zero_like(curve.rows);
  const int p = curve.knots.degree();
  if (p == 0) return sum;
  const std::span<const Rational> t = curve.knots.all();
  const Index from = last ? n - 2 : 0;
  const Rational factor = Rational(p) / (t[from + 1 + p] - t[from + 1]);
  add(sum, factor, curve.rows[from + 1]);
  add(sum, -factor, curve.rows[from]);
  return sum;
}

/// Coons patches as boolean sums.
SeamNet<Rational> coons(const JsonValue& object, bool general, int degree) {
  constexpr const char* names[] = {"c0", "c1", "d0", "d1", "xv0", "xv1", "xu0", "xu1"};
  std::vector<Curve> curves;
  for (size_t i = 0; i < (general ? 8 : 4); ++i) {
    Curve curve = curve_in(*object.find(names[i]));
    const Knots<Rational> knots = clamped_knots(curve.knots);
    curve.rows = in_space(curve, knots);
    curve.knots = knots;
    curves.push_back(std::move(curve));
  }
  const bool homogeneous = make_homogeneous(curves);
  constexpr std::array<size_t, 4> corners[] = {{0, 2, 0, 0}, {0, 3, 1, 0}, {1, 2, 0, 1}, {1, 3, 1, 1}};
  for (const auto& [c, d, u, v] : corners) {  // the means of corners that are one but for rounding
    Ratios &one = u == 0 ? curves[c].rows.front() : curves[c].rows.back(),
           &other = v == 0 ? curves[d].rows.front() : curves[d].rows.back();
    for (size_t k = 0; k < one.size(); ++k) one[k] = other[k] = (one[k] + other[k]) / 2;
  }
  std::vector<size_t> of_u{0, 1}, of_v{2, 3};
  if (general) of_u.insert(of_u.end(), {4, 5}), of_v.insert(of_v.end(), {6, 7});
  const auto space = [&](const std::vector<size_t>& which) {
    std::vector<Knots<Rational>> all;
    for (const size_t i : which) all.push_back(curves[i].knots);
    return common_space(all, degree, true);
  };
  const Knots<Rational> u = space(of_u), v = space(of_v);
  const Rows phi = degree == 1 ? linear_functions(u) : hermite_functions(u),
             psi = degree == 1 ? linear_functions(v) : hermite_functions(v);
  const size_t functionals = of_u.size();
  std::vector<Rows> C, D, Q(functionals);
  for (size_t l = 0; l < functionals; ++l) {
    C.push_back(in_space(curves[of_u[l]], u));
    D.push_back(in_space(curves[of_v[l]], v));
    for (size_t k = 0; k < functionals; ++k) Q[k].push_back(at_end(curves[of_u[l]], k));
  }
  if (general) {
    const Rows twists = rows_in(*object.find("twists"), false);
    for (size_t k = 2; k < 4; ++k)
      for (size_t l = 2; l < 4; ++l) Q[k][l] = twists[(k - 2) + 2 * (l - 2)];
  }
  const size_t m = C[0].size(), n = D[0].size();
  Rows rows;
  for (size_t j = 0; j < n; ++j)
    for (size_t i = 0; i < m; ++i) {
      Ratios sum = zero_like(C[0]);
      if (j == 0 || j == n - 1) {
        sum = C[j == 0 ? 0 : 1][i];
      } else if (i == 0 || i == m - 1) {
        sum = D[i == 0 ? 0 : 1][j];
      } else {
        for (size_t k = 0; k < functionals; ++k) {
          add(sum, phi[i][k], D[k][j]);
          add(sum, psi[j][k], C[k][i]);
          for (size_t l = 0; l < functionals; ++l) add(sum, -(phi[i][k] * psi[j][l]), Q[k][l]);
        }
      }
      rows.push_back(std::move(sum));
    }
  return net_of(u, v, rows, homogeneous);
}

SeamNet<Rational> between(const Knots<Rational>& u, Rows from, Rows to, bool homogeneous) {
  from.insert(from.end(), std::make_move_iterator(to.begin()), std::make_move_iterator(to.end()));
  return net_of(u, bezier_knots<Rational>(1), from, homogeneous);
}

SeamNet<Rational> ruled(const JsonValue& object) {
  Curve curves[] = {curve_in(*object.find("c0")), curve_in(*object.find("c1"))};
  const bool homogeneous = make_homogeneous(curves);
  const Knots<Rational> u = common_space({curves[0].knots, curves[1].knots}, 0, false);
  return between(u, in_space(curves[0], u), in_space(curves[1], u), homogeneous);
}

/// Straight lines from a curve: along a direction, or to an apex.
SeamNet<Rational> extrusion(const JsonValue& object, bool to_apex) {
  const Curve curve = curve_in(*object.find("curve"));
  const Ratios end = vector_in(*object.find(to_apex ? "apex" : "direction"));
  Rows moved = curve.rows;
  for (Ratios& row : moved) {
    const Rational w = curve.homogeneous ? row[3] : Rational(1);
    for (size_t k = 0; k < 3; ++k) row[k] = (to_apex ? Rational(0) : row[k]) + w * end[k];
  }
  return between(curve.knots, curve.rows, std::move(moved), curve.homogeneous);
}

SeamNet<Rational> translational(const JsonValue& object) {
  Curve curves[] = {curve_in(*object.find("c")), curve_in(*object.find("d"))};
  const bool homogeneous = make_homogeneous(curves);
  const Ratios origin = vector_in(*object.find("origin"));
  Rows rows;
  for (const Ratios& d : curves[1].rows)
    for (const Ratios& c : curves[0].rows) {
      const Rational w = homogeneous ? c[3] : Rational(1), z = homogeneous ? d[3] : Rational(1);
      Ratios row;
      for (size_t k = 0; k < 3; ++k) row.push_back(z * c[k] + w * d[k] - w * z * origin[k]);
      if (homogeneous) row.push_back(w * z);
      rows.push_back(std::move(row));
    }
  return net_of(curves[0].knots, curves[1].knots, rows, homogeneous);
}

SeamNet<Rational> spline_surface(const JsonValue& object) {
  bool homogeneous = false;
  const Rows rows = columns_in(object, homogeneous);
  const JsonValue& degree = *object.find("degree");
  if (!object.find("knots_u"))
    return net_of(bezier_knots<Rational>(whole_number(degree.items[0])),
                  bezier_knots<Rational>(whole_number(degree.items[1])), rows, homogeneous);
  const JsonValue& shape = *object.find("shape");
  const auto knots = [&](const char* field, size_t i) {
    return knots_of(*object.find(field), whole_number(degree.items[i]),
                    static_cast<size_t>(whole_number(shape.items[i])), flag_in(object.find("closed"), i));
  };
  return net_of(knots("knots_u", 0), knots("knots_v", 1), rows, homogeneous);
}

SeamNet<Rational> lagrange_surface(const JsonValue& object) {
  const Ratios nodes_u = numbers_in(*object.find("nodes_u")), nodes_v = numbers_in(*object.find("nodes_v"));
  const Rows points = rows_in(*object.find("points"), false);
  const size_t m = nodes_u.size(), n = nodes_v.size();
  // First along u, then along v.
  Rows half(m * n), rows(m * n);
  std::optional<Knots<Rational>> u, v;
  for (size_t j = 0; j < n; ++j) {
    auto [knots, line] = interpolated(
        nodes_u, Rows(points.begin() + std::ptrdiff_t(j * m), points.begin() + std::ptrdiff_t((j + 1) * m)));
    u = std::move(knots);
    for (size_t i = 0; i < m; ++i) half[j * m + i] = std::move(line[i]);
  }
  for (size_t i = 0; i < m; ++i) {
    Rows line;
    for (size_t j = 0; j < n; ++j) line.push_back(half[j * m + i]);
    auto [knots, column] = interpolated(nodes_v, line);
    v = std::move(knots);
    for (size_t j = 0; j < n; ++j) rows[j * m + i] = std::move(column[j]);
  }
  return net_of(*u, *v, rows, false);
}

// Curves.

std::vector<BezierPiece<Rational>> pieces_of_curve(const Curve& curve) {
  Ratios columns, ends;
  for (const Ratios& row : curve.rows) columns.insert(columns.end(), row.begin(), row.end());
  return bezier_pieces_of(curve.knots, columns, curve.homogeneous, curve.knots.begin(), curve.knots.end(), ends);
}

/// Pieces of one basis matrix.
std::vector<BezierPiece<Rational>> matrix_pieces(const JsonValue& object) {
  const Rows points = rows_in(*object.find("points"), false);
  Rows matrix;
  for (const JsonValue& row : object.find("matrix")->items) matrix.push_back(numbers_in(row));
  const size_t order = matrix.size(), step = static_cast<size_t>(whole_number(*object.find("step")));
  if (const JsonValue* const form = object.find("form"); form && form->text == "textbook") {
    const Rows given = matrix;
    for (size_t i = 0; i < order; ++i)
      for (size_t j = 0; j < order; ++j) matrix[i][j] = given[order - 1 - j][i];
  }
  Ratios ends;
  if (const JsonValue* const parm = object.find("parm")) ends = numbers_in(*parm);
  const Knots<Rational> unit = bezier_knots<Rational>(static_cast<int>(order) - 1);
  std::vector<BezierPiece<Rational>> pieces;
  for (size_t first = 0, s = 0; first + order <= points.size(); first += step, ++s) {
    Rows powers(order, zero_like(points));
    for (size_t k = 0; k < order; ++k)
      for (size_t i = 0; i < order; ++i) add(powers[k], matrix[i][k], points[first + i]);
    std::vector<BezierPiece<Rational>> one = pieces_of_curve({unit, points_of(powers, unit), false});
    if (!ends.empty()) one[0].length = ends[s + 1] - ends[s];
    pieces.push_back(std::move(one[0]));
  }
  return pieces;
}

Curve curve_over_domain(const JsonValue& object, Rows rows, bool homogeneous, bool are_powers) {
  Ratios domain{0, 1};
  if (const JsonValue* const given = object.find("domain")) domain = numbers_in(*given);
  Knots<Rational> knots = one_span(rows.size(), domain[0], domain[1]);
  if (are_powers) rows = points_of(rows, knots);
  return {std::move(knots), std::move(rows), homogeneous};
}

Curve hermite_curve(const JsonValue& object) {
  const Rows points = rows_in(*object.find("points"), false), tangents = rows_in(*object.find("tangents"), false);
  Curve curve{bezier_knots<Rational>(3), {points[0], points[0], points[1], points[1]}, false};
  const Rational third(1, 3);
  add(curve.rows[1], third, tangents[0]);
  add(curve.rows[2], -third, tangents[1]);
  return curve;
}

/// Fractions of 64 bits, multiplied by one another hundreds of times, take too long to be worth it.
constexpr size_t most_nodes = 24;

}  // namespace

std::optional<std::vector<BezierPiece<Rational>>> exact_pieces(const Recipe& recipe) {
  if (!recipe.object) return std::nullopt;
  const JsonValue& object = *recipe.object;
  const std::string_view kind = recipe.kind;
  bool homogeneous = false;
  if (kind == "bezier_curve") {
    Rows rows = columns_in(object, homogeneous);
    return pieces_of_curve(curve_over_domain(object, std::move(rows), homogeneous, false));
  }
  if (kind == "bspline_curve" || kind == "nurbs_curve") return pieces_of_curve(curve_in(object));
  if (kind == "taylor_curve")
    return pieces_of_curve(curve_over_domain(object, rows_in(*object.find("points"), false), false, true));
  if (kind == "hermite_curve") return pieces_of_curve(hermite_curve(object));
  if (kind == "bmatrix_curve") return matrix_pieces(object);
  if (kind == "lagrange_curve") {
    const Ratios nodes = numbers_in(*object.find("nodes"));
    if (nodes.size() > most_nodes) return std::nullopt;
    auto [knots, rows] = interpolated(nodes, rows_in(*object.find("points"), false));
    return pieces_of_curve({std::move(knots), std::move(rows), false});
  }
  return std::nullopt;
}

std::optional<SeamNet<Rational>> exact_net(const Recipe& recipe) {
  if (!recipe.object) return std::nullopt;
  const JsonValue& object = *recipe.object;
  const std::string_view kind = recipe.kind;
  if (kind == "bezier_surface" || kind == "bspline_surface" || kind == "nurbs_surface") return spline_surface(object);
  if (kind == "hermite_surface") return hermite_surface(object);
  if (kind == "coons_bilinear") return coons(object, false, 1);
  if (kind == "coons_bicubic") return coons(object, false, 3);
  if (kind == "coons_general") return coons(object, true, 3);
  if (kind == "ruled") return ruled(object);
  if (kind == "extrusion") return extrusion(object, false);
  if (kind == "cone") return extrusion(object, true);
  if (kind == "translational") return translational(object);
  if (kind == "lagrange_surface" && object.find("nodes_u")->items.size() <= most_nodes &&
      object.find("nodes_v")->items.size() <= most_nodes)
    return lagrange_surface(object);
  return std::nullopt;
}

}  // namespace sublimit
