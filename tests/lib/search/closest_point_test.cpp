// SPDX-License-Identifier: Apache-2.0
// Closest points against search by brute force, and where the answer is known.
#include "sublimit/search/closest_point.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <random>

#include "laws/tested_schemes.h"
#include "meshes/places.h"
#include "support/expect_error.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

/// Of distances, relative to the surface's size: what the header promises.
constexpr double distance_accuracy = 1e-12;

class BruteForce {
 public:
  /// @param finest  step
  BruteForce(const LimitMap& surface, const Points& control, double finest)
      : finest_(finest),
        bound_(surface, control),
        triangles_(surface.addresses().triangles()),
        places_(surface.grid(a_side)) {
    samples_ = surface.evaluate(control, places_);
  }
  /// From the nearest of many samples on, by ever finer nets around the nearest so far.
  double distance(const Eigen::RowVector3d& query) const {
    std::vector<std::pair<double, size_t>> nearest;
    for (size_t i = 0; i < places_.size(); ++i)
      if (samples_.status[i] != LimitStatus::hole)
        nearest.push_back({(samples_.position.row(Eigen::Index(i)) - query).norm(), i});
    const size_t tried = std::min<size_t>(6, nearest.size());
    std::partial_sort(nearest.begin(), nearest.begin() + long(tried), nearest.end());
    double best = std::numeric_limits<double>::infinity();
    for (size_t k = 0; k < tried; ++k)
      best = std::min(best, refined(query, nearest[k].first, places_[nearest[k].second]));
    return best;
  }
  const LimitSamples& samples() const { return samples_; }

 private:
  static constexpr int a_side = 13;
  double refined(const Eigen::RowVector3d& query, double best, Place at) const {
    for (double h = 1.0 / (a_side - 1); h > finest_;) {
      std::vector<Place> net;
      for (int i = -2; i <= 2; ++i)
        for (int j = -2; j <= 2; ++j) {
          Place s{at.face, std::clamp(at.u + h * i / 2, 0.0, 1.0), std::clamp(at.v + h * j / 2, 0.0, 1.0)};
          if (triangles_ && s.u + s.v > 1) s.v = 1 - s.u;
          net.push_back(s);
        }
      const LimitSamples there = bound_.evaluate(net);
      Eigen::Index nearest = 0;
      const double distance = (there.position.rowwise() - query).rowwise().norm().minCoeff(&nearest);
      if (distance < best) {
        best = distance;
        at = net[size_t(nearest)];
      } else {
        h /= 2;
      }
    }
    return best;
  }
  double finest_;
  LimitSurface bound_;
  bool triangles_;
  std::vector<Place> places_;
  LimitSamples samples_;
};

/// Near the surface, far from it, on it, and in the middle.
Points queries(const LimitSamples& samples, double size, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Points q(count, 3);
  for (int i = 0; i < count; ++i) {
    const double amount = i % 5 == 0 ? 0 : size * std::pow(0.1, i % 4);
    q.row(i) = samples.position.row(Eigen::Index(random() % size_t(samples.position.rows())));
    for (int k = 0; k < 3; ++k) q(i, k) += amount * normal(random);
  }
  if (count > 1) q.row(1) = samples.position.colwise().mean();
  return q;
}

void expect_nearest(const Scheme<double>& scheme, const Mesh& mesh, int count) {
  const LimitMap surface(scheme, mesh);
  // Places of surfaces without polynomials cost a level a digit.
  const BruteForce brute(surface, mesh.positions, has_polynomials(scheme) ? 1e-7 : 1e-3);
  const double size = diagonal(mesh.positions);
  const Points q = queries(brute.samples(), size, count, 7);
  const ClosestPoints found = closest(surface, mesh.positions, q);
  const LimitSamples there = surface.evaluate(mesh.positions, found.places, 1);
  for (Index i = 0; i < count; ++i) {
    EXPECT_LE(found.distances[i], brute.distance(q.row(i)) + distance_accuracy * size) << scheme.name << " point " << i;
    EXPECT_LE((found.points.row(i) - there.position.row(i)).norm(), distance_accuracy * size);
    EXPECT_NEAR(found.distances[i], (there.position.row(i) - q.row(i)).norm(), distance_accuracy * size);
    EXPECT_EQ(found.status[size_t(i)], there.status[size_t(i)]);
    EXPECT_LE((found.normals.row(i) - there.normal.row(i)).norm(), reference_angle);
    EXPECT_LE(found.lower[i], brute.distance(q.row(i)) + distance_accuracy * size) << scheme.name << " point " << i;
    // From the middle much is nearly as near, and halves of mid-edge pieces are bounded together.
    if (has_polynomials(scheme) && i != 1 && scheme.period == 1) {
      EXPECT_GE(found.lower[i], found.distances[i] - distance_accuracy * size) << scheme.name << " point " << i;
    }
  }
}

TEST(ClosestPoints, AreAsNearAsBruteForceFindsThem) {
  for (const char* name : {"bilinear", "catmull-clark", "loop", "doo-sabin"}) {
    const Scheme<double> scheme = *find_scheme<double>(name);
    const std::vector<Mesh> hard = hard_meshes(scheme, 4);
    expect_nearest(scheme, hard[0], 8);
    expect_nearest(scheme, hard.back(), 8);
    expect_nearest(scheme, takes_triangles(scheme) ? octahedron() : cube(), 12);
  }
  // Without derivatives on the border; without polynomials; both are slow.
  expect_nearest(*find_scheme<double>("mid-edge"), grid(3, 2), 12);
  expect_nearest(*find_scheme<double>("butterfly"), octahedron(), 2);
}

// One mesh and a few queries; in the full sweep (full.closest_points) borders, creases, averaging up to degree 5 and
// many queries too, which is minutes of work.
TEST(ClosestPoints, AreAsNearForEveryScheme) {
  for (const TestedScheme& tested : schemes_and_degrees(5)) {
    const Scheme<double> scheme = tested.scheme();
    std::vector<Mesh> meshes = hard_meshes(scheme, 9);
    // Of sqrt3's surfaces the derivatives oscillate towards borders.
    if (!full_sweep() || scheme.name.find("sqrt3") != std::string::npos) meshes.resize(1);
    const int count = full_sweep() ? (has_polynomials(scheme) ? 60 : 8) : (has_polynomials(scheme) ? 2 : 1);
    for (const Mesh& mesh : meshes) expect_nearest(scheme, mesh, count);
  }
}

TEST(ClosestPoints, OfPointsOfTheSurfaceAreTheyThemselves) {
  for (const char* name : {"catmull-clark", "loop"}) {
    const Scheme<double> scheme = *find_scheme<double>(name);
    const Mesh mesh = hard_meshes(scheme, 5)[2];
    const LimitMap surface(scheme, mesh);
    std::vector<Place> places = random_places(surface.addresses(), 200, 2);
    const Topology& t = surface.level().topology();
    for (Index h = 0; h < t.num_half_edges(); h += 5) {
      places.push_back(from_corner(t, surface.addresses(), HalfEdge{h}, 0, 0));
      places.push_back(on_edge(t, surface.addresses(), HalfEdge{h}, 0.3));
    }
    const Points q = surface.evaluate(mesh.positions, places).position;
    EXPECT_LE(closest(surface, mesh.positions, q).distances.maxCoeff(), distance_accuracy * diagonal(mesh.positions));
  }
}

TEST(ClosestPoints, FromTheMiddleOfASymmetricSurfaceEndIt) {
  const Scheme<double> scheme = *find_scheme<double>("loop");
  const Mesh mesh = icosahedron();
  const LimitMap surface(scheme, mesh);
  const double least = surface.evaluate_grid(mesh.positions, 65).position.rowwise().norm().minCoeff();
  const Points middle = Points::Zero(3, 3);
  const ClosestPoints found = closest(surface, mesh.positions, middle);
  constexpr double between_samples = 1e-3;  // the least of a grid is not the least
  for (Index i = 0; i < 3; ++i) EXPECT_NEAR(found.distances[i], least, between_samples * least);
  EXPECT_LE(found.distances[0], least);
  // Cut short, it says by how much the answer may be wrong.
  const ClosestPoints quick = closest(surface, mesh.positions, middle, {.most_cells = 1});
  EXPECT_LT(quick.lower[0], quick.distances[0]);
  EXPECT_LE(quick.lower[0], found.distances[0]);
}

/// Of each face by itself: all others are holes.
std::vector<double> distances_by_face(const Scheme<double>& scheme, const Mesh& mesh, const Eigen::RowVector3d& q) {
  std::vector<double> all;
  for (Index f = 0; f < Index(mesh.face_sizes.size()); ++f) {
    Mesh one = mesh;
    for (Index g = 0; g < Index(mesh.face_sizes.size()); ++g)
      if (g != f) one.holes.push_back(g);
    all.push_back(closest(LimitMap(scheme, one), one.positions, q).distances[0]);
  }
  std::ranges::sort(all);
  return all;
}

TEST(ClosestPoints, NearestFacesAreInTurn) {
  for (const char* name : {"catmull-clark", "loop"}) {
    const Scheme<double> scheme = *find_scheme<double>(name);
    const Mesh mesh = jittered(takes_triangles(scheme) ? octahedron() : cube());
    const LimitMap surface(scheme, mesh);
    const double size = diagonal(mesh.positions);
    const Points q = queries(surface.evaluate_grid(mesh.positions, 5), size, 20, 3);
    const ClosestPoints found = closest(surface, mesh.positions, q, {.nearest = 100});
    for (Index i = 0; i < 20; ++i) {
      const std::vector<double> expected = distances_by_face(scheme, mesh, q.row(i));
      const std::int64_t first = found.first[size_t(i)];
      ASSERT_EQ(found.first[size_t(i) + 1] - first, std::ssize(expected));
      for (size_t k = 0; k < expected.size(); ++k) {
        const auto row = Index(first) + Index(k);
        EXPECT_NEAR(found.distances[row], expected[k], distance_accuracy * size) << name << " " << i << " " << k;
        EXPECT_LE(found.lower[row], expected[k] + distance_accuracy * size);
        if (i != 1) {
          EXPECT_GE(found.lower[row], expected[k] - distance_accuracy * size) << name << " " << i << " " << k;
        }
      }
      // Three of them, and those within a radius.
      const ClosestPoints three = closest(surface, mesh.positions, q.row(i), {.nearest = 3});
      ASSERT_EQ(three.first, (std::vector<std::int64_t>{0, 3}));
      const double radius = (expected[2] + expected[3]) / 2;
      const ClosestPoints within = closest(surface, mesh.positions, q.row(i), {.nearest = 100, .radius = radius});
      EXPECT_EQ(within.first[1], std::ranges::count_if(expected, [&](double d) { return d <= radius; })) << i;
    }
  }
}

TEST(ClosestPoints, AllFacesAreFoundWhereAllAreAskedFor) {
  const Mesh mesh = torus(12, 9);
  const LimitMap surface(*find_scheme<double>("catmull-clark"), mesh);
  const Points q = Eigen::RowVector3d(0.3, -2, 0.4);
  const ClosestPoints found = closest(surface, mesh.positions, q, {.prove = false, .nearest = 1000});
  EXPECT_EQ(std::ssize(found.places), surface.faces().size);
  EXPECT_TRUE(std::is_sorted(found.distances.begin(), found.distances.end()));
}

TEST(ClosestPoints, OutsideARadiusAreNone) {
  const Scheme<double> scheme = *find_scheme<double>("bilinear");
  const Mesh mesh = cube();  // [-1, 1]^3
  const LimitMap surface(scheme, mesh);
  Points q(3, 3);
  q << 0, 0, 3, 0, 0, 1.5, 9, 9, 9;
  const ClosestPoints found = closest(surface, mesh.positions, q, {.radius = 1});
  EXPECT_EQ(found.first, (std::vector<std::int64_t>{0, 0, 1, 1}));
  EXPECT_NEAR(found.distances[0], 0.5, rounding(4));
}

TEST(ClosestPoints, InsideHaveSignedDistances) {
  const Scheme<double> bilinear = *find_scheme<double>("bilinear");
  Mesh box = cube();
  Points q(6, 3);
  // Towards a face, an edge, a corner; from outside the same; next to a corner, where one face's normal would not do.
  q << 0, 0, 0.5, 0.9, 0.9, 0, 0.8, 0.8, 0.8, 0, 0, 2, 2, 2, 0, 1.1, 1.2, 0.9;
  const Eigen::VectorXd inside =
      (Eigen::VectorXd(6) << -0.5, -0.1, -0.2, 1, std::sqrt(2), std::hypot(0.1, 0.2)).finished();
  for (const bool inwards : {false, true}) {
    if (inwards) std::ranges::reverse(box.face_vertices);
    const LimitMap surface(bilinear, box);
    const ClosestPoints found = closest(surface, box.positions, q, {.is_signed = true});
    for (Index i = 0; i < 6; ++i) {
      EXPECT_NEAR(found.distances[i], inside[i], rounding(8)) << i;
      EXPECT_NEAR(found.lower[i], std::abs(inside[i]), distance_accuracy) << i;
    }
  }
  // Along the normal to either side, at corners and on edges too.
  for (const char* name : {"catmull-clark", "loop", "doo-sabin"}) {
    const Scheme<double> scheme = *find_scheme<double>(name);
    const Mesh mesh = takes_triangles(scheme) ? jittered(octahedron()) : jittered(prism(5));
    const LimitMap surface(scheme, mesh);
    const double size = diagonal(mesh.positions), step = 1e-3 * size;
    const LimitSamples on = surface.evaluate_grid(mesh.positions, 5, 1);
    const ClosestPoints in = closest(surface, mesh.positions, on.position - step * on.normal, {.is_signed = true}),
                        out = closest(surface, mesh.positions, on.position + step * on.normal, {.is_signed = true});
    for (Index i = 0; i < on.position.rows(); ++i) {
      EXPECT_NEAR(in.distances[i], -step, distance_accuracy * size) << name << " " << i;
      EXPECT_NEAR(out.distances[i], step, distance_accuracy * size) << name << " " << i;
    }
  }
  const Mesh open = grid(2, 2);
  expect_error<UnsupportedTopology>([&] { closest(LimitMap(bilinear, open), open.positions, q, {.is_signed = true}); },
                                    {"closed", "edge ("});
}

TEST(ClosestPoints, LeaveHolesOut) {
  Mesh mesh = torus(6, 5);
  mesh.holes = {0, 1, 2, 3, 4};
  const LimitMap surface(*find_scheme<double>("catmull-clark"), mesh);
  const std::vector<Place> in_holes{{0, 0.5, 0.5}, {3, 0.4, 0.6}};
  const ClosestPoints found = closest(surface, mesh.positions, surface.evaluate(mesh.positions, in_holes).position);
  for (const Place& s : found.places) EXPECT_GE(s.face, 5);
  EXPECT_GT(found.distances.minCoeff(), 0.01);
}

TEST(ClosestPoints, AreTheSameForAnyGuessAndAnyThreads) {
  const Scheme<double> scheme = *find_scheme<double>("catmull-clark");
  const Mesh mesh = hard_polygons(8, {.open = true});
  const LimitMap surface(scheme, mesh);
  const Points q = queries(surface.evaluate_grid(mesh.positions, 3), diagonal(mesh.positions), 200, 1);
  const ClosestPoints once = closest(surface, mesh.positions, q);
  const auto same = [&](const ClosestPoints& other) {
    return std::memcmp(once.points.data(), other.points.data(), sizeof(double) * size_t(once.points.size())) == 0;
  };
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_TRUE(same(closest(surface, mesh.positions, q)));
  }
  const std::vector<Place> guess = random_places(surface.addresses(), 200, 3);
  const ClosestPoints guessed = closest(surface, mesh.positions, q, {.guess = guess});
  EXPECT_LE((once.distances - guessed.distances).cwiseAbs().maxCoeff(), distance_accuracy * diagonal(mesh.positions));
}

TEST(ClosestPoints, SayWhatIsWrong) {
  const Scheme<double> scheme = *find_scheme<double>("catmull-clark");
  Mesh mesh = cube();
  const LimitMap surface(scheme, mesh);
  Points q = Points::Zero(4, 3);
  EXPECT_EQ(closest(surface, mesh.positions, Points(0, 3)).places.size(), 0u);
  q(2, 1) = std::numeric_limits<double>::infinity();
  expect_error<InvalidParameter>([&] { closest(surface, mesh.positions, q); }, {"point 2", "finite"});
  q(2, 1) = -1e151;
  expect_error<InvalidParameter>([&] { closest(surface, mesh.positions, q); }, {"point 2", "1e150"});
  expect_error<InvalidParameter>([&] { closest(surface, mesh.positions, Points::Zero(1, 2)); }, {"2", "3"});
  expect_error<InvalidParameter>([&] { closest(surface, Points::Zero(7, 3), Points::Zero(1, 3)); }, {"vertex"});
  const std::vector<Place> guess{{0, 0, 2}};
  expect_error<InvalidParameter>([&] { closest(surface, mesh.positions, Points::Zero(1, 3), {.guess = guess}); },
                                 {"face 0", "no face"});
  expect_error<InvalidParameter>([&] { closest(surface, mesh.positions, Points::Zero(2, 3), {.guess = guess}); },
                                 {"1 places", "2 points"});
  expect_error<InvalidParameter>([&] { closest(surface, mesh.positions, Points::Zero(1, 3), {.nearest = 0}); },
                                 {"0 nearest"});
  expect_error<InvalidParameter>([&] { closest(surface, mesh.positions, Points::Zero(1, 3), {.most_cells = 0}); },
                                 {"0 cells"});
  expect_error<InvalidParameter>([&] { closest(surface, mesh.positions, Points::Zero(1, 3), {.radius = -1}); },
                                 {"radius"});
  mesh.holes = {0, 1, 2, 3, 4, 5};
  const LimitMap nothing(scheme, mesh);
  expect_error<InvalidMesh>([&] { closest(nothing, mesh.positions, Points::Zero(1, 3)); }, {"holes"});
}

}  // namespace
}  // namespace sublimit::testing
