// SPDX-License-Identifier: Apache-2.0
// Bases of segments against their formulas, parts of patches, and what types of faces promise.
#include "sublimit/patches/detail/basis_surface.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <tuple>

#include "sublimit/patches/detail/cut_patch.h"
#include "sublimit/patches/detail/finer_knots.h"
#include "sublimit/patches/detail/free_form_patches.h"
#include "sublimit/patches/patch_set.h"
#include "sublimit/patches/spline_surface.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

Points random_columns(Index rows, std::mt19937& random) {
  Points columns(rows, 3);
  for (Eigen::Index i = 0; i < columns.size(); ++i) columns.data()[i] = std::uniform_real_distribution<>(-1, 1)(random);
  return columns;
}

std::vector<Place> random_places(const Patch& patch, std::mt19937& random, int count = 40) {
  std::uniform_real_distribution<> parameter(0, 1);
  std::vector<Place> places;
  for (int i = 0; i < count; ++i) {
    const auto face = static_cast<Index>(random() % unsigned(patch.faces().size));
    places.push_back({face, i % 5 == 0 ? 0 : i % 5 == 1 ? 1 : parameter(random), i % 7 == 2 ? 0 : parameter(random)});
  }
  return places;
}

/// Equal points and derivatives at equal parameters, per unit of the patches' own.
void expect_same_surface(const Patch& a, const Points& columns_a, const Patch& b, const Points& columns_b,
                         const std::vector<Place>& places_of_a, double tolerance) {
  for (const Place& at : places_of_a) {
    const Patch::Parameters parameters = a.parameters(at);
    const Place other = b.place(parameters);
    const LimitSamples x = a.evaluate(columns_a, std::vector{at}, 2), y = b.evaluate(columns_b, std::vector{other}, 2);
    const Patch::Lengths h = a.lengths(at.face), k = b.lengths(other.face);
    const auto expect = [&](const Points& p, const Points& q, double of_p, double of_q) {
      EXPECT_LE((p / of_p - q / of_q).norm(), tolerance) << at.face << " " << at.u << " " << at.v;
    };
    expect(x.position, y.position, 1, 1);
    expect(x.du, y.du, h.u, k.u);
    expect(x.dv, y.dv, h.v, k.v);
    expect(x.duu, y.duu, h.u * h.u, k.u * k.u);
    expect(x.duv, y.duv, h.u * h.v, k.u * k.v);
    expect(x.dvv, y.dvv, h.v * h.v, k.v * k.v);
  }
}

// Row i: control point i, powers rising (patches.md has the formulas by control points).
const double coons_powers[] = {1.0 / 6, -0.5, 0.5, -1.0 / 6, 4.0 / 6, 0, -1, 0.5,
                               1.0 / 6, 0.5,  0.5, -0.5,     0,       0, 0,  1.0 / 6};

TEST(SegmentBasis, CardinalIsItsFormula) {
  const SegmentBasis basis = SegmentBasis::cardinal({0, 1, 2, 3});
  EXPECT_EQ(basis.num_points(), 6);
  std::array<double, 12> rows;
  for (const double t : {0.0, 0.1, 0.5, 0.9, 1.0}) {
    basis.rows(t, 2, rows);
    const double t2 = t * t, t3 = t2 * t;
    const double expected[3][4] = {
        {(-t3 + 2 * t2 - t) / 2, (3 * t3 - 5 * t2 + 2) / 2, (-3 * t3 + 4 * t2 + t) / 2, (t3 - t2) / 2},
        {(-3 * t2 + 4 * t - 1) / 2, (9 * t2 - 10 * t) / 2, (-9 * t2 + 8 * t + 1) / 2, (3 * t2 - 2 * t) / 2},
        {(-6 * t + 4) / 2, (18 * t - 10) / 2, (-18 * t + 8) / 2, (6 * t - 2) / 2}};
    for (int r = 0; r < 3; ++r)
      for (int i = 0; i < 4; ++i) EXPECT_NEAR(rows[size_t(4 * r + i)], expected[r][i], rounding(32)) << t;
  }
  EXPECT_EQ(basis.continuity(0, KnotSide::left), 3);
  EXPECT_EQ(basis.continuity(0, KnotSide::right), 1);
  EXPECT_EQ(basis.continuity(1, KnotSide::left), 1);
  // Segments of other lengths: still through the points, but no longer C^1 by the given parameters.
  EXPECT_EQ(SegmentBasis::cardinal({0, 1, 3}).continuity(0, KnotSide::right), 0);
}

TEST(SegmentBasis, TaylorIsThePowersAndJumps) {
  const SegmentBasis basis = SegmentBasis::taylor(4, {0, 1, 2});
  EXPECT_EQ(basis.num_points(), 10);
  std::array<double, 15> rows;
  basis.rows(0.3, 2, rows);
  for (int k = 0; k <= 4; ++k) {
    EXPECT_NEAR(rows[size_t(k)], std::pow(0.3, k), rounding(8));
    EXPECT_NEAR(rows[size_t(5 + k)], k == 0 ? 0 : k * std::pow(0.3, k - 1), rounding(32));
    EXPECT_NEAR(rows[size_t(10 + k)], k < 2 ? 0 : k * (k - 1) * std::pow(0.3, k - 2), rounding(64));
  }
  EXPECT_EQ(basis.continuity(0, KnotSide::right), -1);
}

TEST(BasisSurface, WithTheMatrixOfUniformBsplinesIsOne) {
  std::mt19937 random(3);
  const BasisSurface surface(SegmentBasis(3, 1, coons_powers, {0, 1, 2, 3}),
                             SegmentBasis(3, 1, coons_powers, {0, 1, 2}));
  const SplineSurface spline(Knots<double>::open(3, 6, {-3, -2, -1, 0, 1, 2, 3, 4, 5, 6}),
                             Knots<double>::open(3, 5, {-3, -2, -1, 0, 1, 2, 3, 4, 5}));
  ASSERT_EQ(surface.num_points(), spline.num_points());
  const Points columns = random_columns(surface.num_points(), random);
  expect_same_surface(surface, columns, spline, columns, random_places(surface, random), 1e-14);
  // C^2 joints are found from the matrix.
  for (const Place& at : random_places(surface, random)) {
    WeightRows weights;
    EXPECT_EQ(surface.rows(at, 2, weights), LimitStatus::regular);
  }
}

TEST(BasisSurface, BezierPiecesAreTheSameSurface) {
  std::mt19937 random(4);
  const BasisSurface surfaces[] = {
      {SegmentBasis::cardinal({0, 1, 2.5}), SegmentBasis::taylor(2, {0, 2, 3})},
      {SegmentBasis(3, 3, coons_powers, {0, 1, 4}), SegmentBasis(3, 2, coons_powers, {-1, 1, 2, 7})}};
  for (const BasisSurface& surface : surfaces) {
    const Points columns = random_columns(surface.num_points(), random);
    const Patch::Refined pieces = surface.refined();
    const Patch::Refined finer = pieces.patch->refined();
    const std::vector<Place> places = random_places(surface, random);
    expect_same_surface(surface, columns, *pieces.patch, pieces.S * columns, places, 1e-13);
    expect_same_surface(surface, columns, *finer.patch, finer.S * (pieces.S * columns), places, 1e-13);
  }
}

TEST(BasisSurface, RefusesWhatIsNone) {
  const std::vector<double> three(3, 0), sixteen(16, 1);
  expect_error<InvalidParameter>([&] { SegmentBasis(3, 1, three, {0, 1}); }, {"3 entries", "degree 3 has 16"});
  expect_error<InvalidParameter>([&] { SegmentBasis(3, 0, sixteen, {0, 1}); }, {"step of 0"});
  expect_error<InvalidParameter>([&] { SegmentBasis(3, 1, sixteen, {0, 0}); }, {"end 1", "rise"});
  expect_error<InvalidParameter>([&] { SegmentBasis(3, 1, sixteen, {0}); }, {"two ends"});
  expect_error<InvalidParameter>([&] { SegmentBasis::taylor(26, {0, 1}); }, {"degree 26", "0 to 25"});
  expect_error<InvalidParameter>([&] { SegmentBasis::cardinal({0, 1}).place(2, KnotSide::right); }, {"2"});
}

TEST(CutPatch, IsThePartInside) {
  std::mt19937 random(5);
  const auto whole = std::make_shared<const SplineSurface>(Knots<double>::open(3, 6, {0, 0, 0, 0, 1, 3, 4, 4, 4, 4}),
                                                           Knots<double>::open(2, 4, {0, 0, 0, 1, 2, 2, 2}));
  const Points columns = random_columns(whole->num_points(), random);
  const CutPatch part(whole, {0.5, 0.25}, {3, 1});
  EXPECT_EQ(part.faces().size, 2);  // [0.5, 1] and [1, 3] times [0.25, 1]
  expect_same_surface(part, columns, *whole, columns, random_places(part, random), 1e-13);
  for (const Place& at : random_places(part, random)) {
    const Place back = part.place(part.parameters(at));
    EXPECT_EQ(back.face, at.face);
    EXPECT_NEAR(back.u, at.u, rounding(8));
    EXPECT_NEAR(back.v, at.v, rounding(8));
  }
  EXPECT_EQ(part.parameters({.face = 0, .u = 0, .v = 0}).u, 0.5);
  EXPECT_EQ(part.parameters({.face = 1, .u = 1, .v = 1}).u, 3);
  expect_error<InvalidParameter>([&] { CutPatch(whole, {0.5, 0}, {5, 1}); }, {"5"});
  expect_error<InvalidParameter>([&] { CutPatch(whole, {1, 0}, {1, 1}); }, {"no area"});
  expect_error<InvalidParameter>([&] { part.place({.u = 0.2, .v = 0.5}); }, {"outside the part"});
  // Its end u = 3 is a knot: the piece behind it is another part's.
  const Place end = part.place({.u = 3, .v = 0.25});
  EXPECT_EQ(end.face, 1);
  EXPECT_EQ(end.u, 1);
  // Finer nets are the part's own.
  const Patch::Refined fine = part.refined();
  ASSERT_TRUE(fine.patch);
  EXPECT_EQ(fine.patch->faces().size, 8);
  const Points net = fine.S * columns;
  expect_same_surface(*fine.patch, net, *whole, columns, random_places(*fine.patch, random), 1e-12);
  const CutPatch middle(whole, {1, 1}, {3, 2});
  EXPECT_EQ(middle.faces().size, 1);
  const Place begin = middle.place({.u = 1, .v = 1, .u_side = KnotSide::left, .v_side = KnotSide::left});
  EXPECT_EQ(begin.face, 0);
  EXPECT_EQ(begin.u, 0);
  EXPECT_EQ(begin.v, 0);
}

TEST(Patches, FacesOfOneTypeHaveTheSameRowsAndStatuses) {
  std::mt19937 random(6);
  std::map<std::string, std::vector<std::pair<LimitStatus, WeightRows>>> known;
  int repeated = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const auto knots = [&] {
      const int degree = 1 + int(random() % 3);
      std::vector<double> all;
      double t = 0;
      const int count = 2 * degree + 2 + int(random() % 6);
      while (std::ssize(all) < count) {
        const auto times = std::min<size_t>(1 + random() % unsigned(degree + 1), size_t(count) - all.size());
        all.insert(all.end(), times, t);
        t += 1 + int(random() % 2);
      }
      return std::pair(degree, all);
    };
    const auto make = [&]() -> std::optional<Knots<double>> {
      const auto [degree, all] = knots();
      try {
        return Knots<double>::open(degree, static_cast<Index>(all.size()) - degree - 1, all);
      } catch (const InvalidParameter&) {
        return std::nullopt;  // a domain without length
      }
    };
    const std::optional<Knots<double>> u = make(), v = make();
    if (!u || !v) continue;
    const SplineSurface surface(*u, *v);
    for (Index face = 0; face < surface.num_faces(); ++face) {
      std::vector<std::pair<LimitStatus, WeightRows>> own;
      for (const auto& [a, b] : {std::pair(0.0, 0.0), {1.0, 0.0}, {0.0, 1.0}, {0.25, 0.75}})
        for (int order = 0; order <= 2; ++order) {
          WeightRows weights;
          const LimitStatus status = surface.rows({face, a, b}, order, weights);
          own.push_back({status, weights});
        }
      const auto [at, is_new] = known.try_emplace(surface.type(face) + surface.ends(face), own);
      if (is_new) continue;
      ++repeated;
      for (size_t i = 0; i < own.size(); ++i) {
        EXPECT_EQ(at->second[i].first, own[i].first);
        EXPECT_LE((at->second[i].second - own[i].second).cwiseAbs().maxCoeff(), rounding(16));
      }
    }
  }
  EXPECT_GT(repeated, 100);
}

TEST(FreeFormPatches, HaveEveryBasisAndThePartThatIsMeant) {
  const std::string points =
      "v 0 0 0\nv 1 0 1\nv 2 0 0\nv 3 0 1\nv 0 1 0\nv 1 1 1\nv 2 1 2\nv 3 1 0\n"
      "v 0 2 1\nv 1 2 0\nv 2 2 0\nv 3 2 1\nv 0 3 0\nv 1 3 0\nv 2 3 1\nv 3 3 0\n";
  const std::string list = " 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16\nparm u 0 1\nparm v 0 1\nend\n";
  const auto read = [&](const std::string& text) {
    return free_form_patches(parse_free_form(points + text, "s.obj"), "s.obj");
  };
  const FreeFormPatches cardinal = read("cstype cardinal\ndeg 3 3\nsurf 0 1 0 1" + list);
  EXPECT_LE((cardinal.patches.evaluate(cardinal.columns, std::vector<Place>{{0, 0, 1}}).position -
             Eigen::RowVector3d(1, 2, 0))
                .norm(),
            rounding(8));
  const FreeFormPatches taylor = read("cstype taylor\ndeg 3 3\nsurf 0 1 0 1" + list);
  EXPECT_LE((taylor.patches.evaluate(taylor.columns, std::vector<Place>{{0, 0, 0}}).position).norm(), rounding(8));
  // Beside a rational surface the same polynomial, though its coefficients are no points.
  const FreeFormPatches beside =
      read("cstype taylor\ndeg 3 3\nsurf 0 1 0 1" + list +
           "cstype rat bezier\ndeg 1 1\nv 0 0 0 2\nsurf 0 1 0 1 1 2 -1 3\nparm u 0 1\nparm v 0 "
           "1\nend\n");
  constexpr double quotient_rule = 1e-12;  // derivatives of quotients with coefficients that are no points
  for (const Place& at : {Place{0, 0, 0}, Place{0, 0.3, 0.8}, Place{0, 1, 1}})
    EXPECT_LE((beside.patches.evaluate(beside.columns, std::vector{at}, 1).du -
               taylor.patches.evaluate(taylor.columns, std::vector{at}, 1).du)
                  .norm(),
              quotient_rule);
  const FreeFormPatches matrix = read(
      "cstype bmatrix\ndeg 3 3\nstep 1 1\nbmat u 1 -3 3 -1 0 3 -6 3 0 0 3 -3 0 0 0 1\nbmat v 1 -3 3 -1 0 3 -6 3 0 0 3 -3 "
      "0 0 0 1\nsurf 0 1 0 1" +
      list);
  const FreeFormPatches bezier = read("cstype bezier\ndeg 3 3\nsurf 0 1 0 1" + list);
  std::mt19937 random(8);
  expect_same_surface(*matrix.patches.members()[0].patch, matrix.columns, *bezier.patches.members()[0].patch,
                      bezier.columns, random_places(*matrix.patches.members()[0].patch, random), 1e-13);
  const FreeFormPatches part = read("cstype bezier\ndeg 3 3\nsurf 0.25 1 0 0.5" + list);
  EXPECT_LE((part.patches.evaluate(part.columns, std::vector<Place>{{0, 0, 1}}).position -
             bezier.patches.evaluate(bezier.columns, std::vector<Place>{{0, 0.25, 0.5}}).position)
                .norm(),
            rounding(8));
}

TEST(FreeFormCurves, AreThePartThatIsMeant) {
  const std::string points = "v 0 0 0\nv 1 2 0\nv 2 0 1\nv 3 1 0\nv 4 0 0\nv 5 1 2\nv 6 0 0\n",
                    list = " 1 2 3 4 5 6 7\nparm u ";
  const auto read = [&](const std::string& text) {
    return free_form_curves(parse_free_form(points + text + "\nend\n", "c.obj"), "c.obj");
  };
  for (const auto& [state, knots, first, last] :
       {std::tuple("cstype bspline\ndeg 3\n", "0 0 0 0 1 1 2 3 3 3 3", 0.0, 3.0),
        {"cstype bspline\ndeg 3\n", "-3 -2 -1 0 1 3 4 5 6 7 8", 0.0, 5.0},
        {"cstype bezier\ndeg 3\n", "0 1 3", 0.0, 3.0},
        {"cstype cardinal\ndeg 3\n", "0 1 2 3 4", 0.0, 4.0}}) {
    SCOPED_TRACE(std::string(state) + knots);
    const auto curve = [&](double from, double to) {
      return read(state + ("curv " + std::to_string(from) + " " + std::to_string(to)) + list + knots);
    };
    const FreeFormCurves whole = curve(first, last);
    for (const auto& [from, to] : {std::pair(0.25, 2.5), {1.0, 2.0}, {first, 1.0}, {1.5, last}, {0.25, 0.5}}) {
      const FreeFormCurves part = curve(from, to);
      EXPECT_EQ(part.curves.curve(0).place(from, KnotSide::right).segment, 0);
      for (const double t : {from, from + (to - from) / 3, to})
        for (const KnotSide side : {KnotSide::left, KnotSide::right}) {
          const CurvePlace of_part = part.curves.curve(0).place(t, side);
          const KnotSide same = t == from ? KnotSide::right : t == to ? KnotSide::left : side;
          const CurvePlace of_whole = whole.curves.curve(0).place(t, same);
          const CurveSamples x = part.curves.evaluate(part.columns, {&of_part, 1}, 1),
                             y = whole.curves.evaluate(whole.columns, {&of_whole, 1}, 1);
          EXPECT_LE((x.position - y.position).norm(), rounding(16, 6)) << t;
          constexpr double of_length = 1e-12;  // derivatives divided by lengths of segments
          EXPECT_LE((x.first / part.curves.curve(0).length(of_part.segment) -
                     y.first / whole.curves.curve(0).length(of_whole.segment))
                        .norm(),
                    of_length * (1 + y.first.norm()))
              << t;
        }
    }
  }
}

}  // namespace
}  // namespace sublimit::testing
