// SPDX-License-Identifier: Apache-2.0
// Fits by any numbers of ranks are those of one process.
#include <gtest/gtest.h>

#include <fmt/core.h>

#include <fstream>
#include <random>
#include <sstream>

#include "meshes/meshes.h"
#include "stencils/distributed/run_ranks.h"
#include "sublimit/fit/scattered_fit.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/io/detail/ply.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/stencils/formats/npy.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit::testing {
namespace {

constexpr double fit_tolerance = 1e-10;  // of the box: systems are solved by other methods

Points read_points(const std::string& path) {
  const NpyArray array(path);
  Points points(array.shape().at(0), array.shape().at(1));
  array.read<double>(0, std::span(points.data(), size_t(points.size())));
  return points;
}

double box(const Points& points) { return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm(); }

/// Places all over the first addresses of a surface, and points near it.
PlaceTargets random_targets(const LimitMap& surface, const Points& points, Index count, Index addresses,
                            bool weighted) {
  std::mt19937 random(count);
  std::uniform_real_distribution<double> unit(0, 1);
  PlaceTargets targets;
  for (Index i = 0; i < count; ++i) {
    Place s{std::uniform_int_distribution<Index>(0, addresses - 1)(random), unit(random), unit(random)};
    if (surface.addresses().triangles() && s.u + s.v > 1) s = {s.face, 1 - s.u, 1 - s.v};
    targets.places.push_back(s);
    if (weighted) targets.weights.push_back(3 * unit(random));
  }
  targets.values = surface.evaluate(points, targets.places, 0, false).position;
  for (double& x : targets.values.reshaped()) x += 0.1 * (unit(random) - 0.5);
  return targets;
}

std::string csv_of(const PlaceTargets& targets) {
  std::ostringstream text;
  text.precision(17);
  text << "face,u,v,x,y,z" << (targets.weights.empty() ? "\n" : ",weight\n");
  for (size_t i = 0; i < targets.places.size(); ++i) {
    text << targets.places[i].face << ',' << targets.places[i].u << ',' << targets.places[i].v;
    for (Index c = 0; c < 3; ++c) text << ',' << targets.values(Index(i), c);
    if (!targets.weights.empty()) text << ',' << targets.weights[i];
    text << '\n';
  }
  return text.str();
}

void write(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

/// Of 1 to 3 ranks, beside `fit_places`.
void expect_same(const std::string& scheme, const Mesh& mesh, const PlaceTargets& targets,
                 const Fairness& fairness = {}, const std::string& more = "") {
  const TemporaryDirectory directory;
  const std::string obj = (directory / "m.obj").string(), in = (directory / "in.csv").string(),
                    out = (directory / "o.npy").string();
  write_obj(obj, mesh);
  write(in, csv_of(targets));
  const Mesh read = read_obj(obj);
  const ScatteredFit alone =
      fit_places(LimitMap(*find_scheme<double>(scheme), read), targets, read.positions, {.fairness = fairness});
  ASSERT_TRUE(alone.solution.converged);
  for (const int ranks : {1, 2, 3}) {
    const RanksRun run =
        run_ranks(ranks, fmt::format("fit {} --targets {} -s {} -o {} --thin-plate {} --membrane {} {}", obj, in,
                                     scheme, out, fairness.thin_plate, fairness.membrane, more));
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_LT((read_points(out) - alone.points).cwiseAbs().maxCoeff(), fit_tolerance * box(read.positions))
        << scheme << ", " << ranks << " ranks\n"
        << run.out;
    std::filesystem::remove(out);
  }
}

PlaceTargets random_targets(const std::string& scheme, const Mesh& mesh, Index count, bool weighted = false) {
  const LimitMap surface(*find_scheme<double>(scheme), mesh);
  return random_targets(surface, mesh.positions, count, surface.addresses().size(), weighted);
}

TEST(SpreadFit, IsTheFitOfOneProcess) {
  const Mesh mesh = jittered(torus(9, 6)), triangles = jittered(triangle_torus(7, 5));
  expect_same("catmull-clark", mesh, random_targets("catmull-clark", mesh, 600));
  expect_same("catmull-clark", mesh, random_targets("catmull-clark", mesh, 600, true));
  expect_same("doo-sabin", mesh, random_targets("doo-sabin", mesh, 600));
  expect_same("loop", triangles, random_targets("loop", triangles, 500, true));
}

TEST(SpreadFit, HoldsAtExtraordinaryVerticesCreasesAndPolygons) {
  Mesh polygons = jittered(polygon_ring({5, 4, 3, 6, 4}));
  expect_same("catmull-clark", polygons, random_targets("catmull-clark", polygons, 700));
  Mesh creased = jittered(fan(7, 4, 3));
  add_crease(creased, {1, 0, 5}, {10, 1.5f});
  expect_same("catmull-clark", creased, random_targets("catmull-clark", creased, 1500));
}

TEST(SpreadFit, FairnessCountsEachFaceOnce) {
  const Mesh mesh = jittered(disjoint_union(torus(9, 6), prism(5))), triangles = jittered(triangle_torus(7, 5));
  for (const auto& fairness : {Fairness{.thin_plate = 1e-3}, Fairness{.thin_plate = 1e-2, .membrane = 1e-2}}) {
    expect_same("catmull-clark", mesh, random_targets("catmull-clark", mesh, 400, true), fairness);
    expect_same("loop", triangles, random_targets("loop", triangles, 100), fairness, "--petsc '-pc_type jacobi'");
  }
}

TEST(SpreadFit, WithoutEnoughTargetsIsTheNearest) {
  const Mesh mesh = jittered(torus(9, 6));
  const LimitMap surface(*find_scheme<double>("catmull-clark"), mesh);
  PlaceTargets targets = random_targets(surface, mesh.positions, 12, 20, false);
  for (size_t i = 0; i < targets.places.size(); ++i) targets.places[i].face = Index(2 * i);
  expect_same("catmull-clark", mesh, targets);
}

TEST(SpreadFit, RanksWithoutFacesTakePart) {
  const Mesh face = jittered(grid(1, 1));
  const PlaceTargets targets = random_targets("catmull-clark", face, 20);
  expect_same("catmull-clark", face, targets);
  expect_same("catmull-clark", face, targets, {.thin_plate = 1e-2});
}

TEST(SpreadFit, FairnessMayLeaveSomethingFree) {  // affine maps of a plane have no thin plate energy
  const TemporaryDirectory directory;
  const std::string obj = (directory / "m.obj").string(), in = (directory / "in.csv").string(),
                    out = (directory / "o.npy").string();
  write_obj(obj, grid(1, 1));
  const LimitMap surface(*find_scheme<double>("catmull-clark"), read_obj(obj));
  const PlaceTargets targets = random_targets("catmull-clark", grid(1, 1), 2);
  write(in, csv_of(targets));
  for (const int ranks : {1, 3}) {
    const RanksRun run =
        run_ranks(ranks, "fit " + obj + " --targets " + in + " -s catmull-clark --thin-plate 1e-2 -o " + out);
    ASSERT_EQ(run.status, 0) << run.err;
    const Points found = surface.evaluate(read_points(out), targets.places, 0, false).position;
    EXPECT_LT((found - targets.values).cwiseAbs().maxCoeff(), fit_tolerance);
    std::filesystem::remove(out);
  }
}

TEST(SpreadFit, MeetsVertices) {
  const TemporaryDirectory directory;
  const std::string obj = (directory / "m.obj").string(), in = (directory / "in.csv").string(),
                    out = (directory / "o.npy").string(), alone = (directory / "alone.obj").string();
  const Mesh mesh = jittered(torus(9, 6)), targets = jittered(mesh, 0.05, 2);
  write_obj(obj, mesh);
  std::ostringstream text;
  text.precision(17);
  text << "vertex,x,y,z\n";
  for (Index v = mesh.num_vertices() - 1; v >= 0; --v)
    text << v << ',' << targets.positions(v, 0) << ',' << targets.positions(v, 1) << ',' << targets.positions(v, 2)
         << '\n';
  write(in, text.str());
  ASSERT_EQ(run_alone("fit " + obj + " --targets " + in + " -s catmull-clark --refine 0 -o " + alone), 0);
  const Points expected = read_obj(alone).positions;
  for (const int ranks : {1, 2, 3}) {
    ASSERT_EQ(run_ranks(ranks, "fit " + obj + " --targets " + in + " -s catmull-clark -o " + out).status, 0);
    EXPECT_LT((read_points(out) - expected).cwiseAbs().maxCoeff(), fit_tolerance * box(mesh.positions));
  }
  const std::string ply = (directory / "o.ply").string();
  ASSERT_EQ(run_ranks(3, "fit " + obj + " --targets " + in + " -s catmull-clark -o " + ply).status, 0);
  const Mesh fitted = read_ply(ply);
  EXPECT_EQ(fitted.face_vertices, mesh.face_vertices);
  EXPECT_LT((fitted.positions - expected).cwiseAbs().maxCoeff(), fit_tolerance * box(mesh.positions));
}

TEST(SpreadFit, TargetsOfAVertexThatCannotBeMetAreAnError) {  // the limits of a cube's corners depend on each other
  const TemporaryDirectory directory;
  const std::string obj = (directory / "m.obj").string(), in = (directory / "in.csv").string(),
                    out = (directory / "o.npy").string();
  write_obj(obj, cube());
  std::string text = "vertex,x,y,z\n";
  for (int v = 0; v < 8; ++v) text += fmt::format("{},{},{},{}\n", v, v * v, v % 3, v / 2);
  write(in, text);
  const std::string arguments = "fit " + obj + " --targets " + in + " -s catmull-clark -o " + out;
  const RanksRun run = run_ranks(2, arguments);
  EXPECT_EQ(run.status, 3);
  EXPECT_NE(run.error().find("m.obj: the targets cannot all be met: the limit comes as near as"), std::string::npos)
      << run.err;
  EXPECT_FALSE(std::filesystem::exists(out));
  EXPECT_EQ(run_ranks(2, arguments + " --best-effort").status, 0);
  EXPECT_TRUE(std::filesystem::exists(out));
}

TEST(SpreadFit, BadInputIsOneLine) {
  const TemporaryDirectory directory;
  const std::string obj = (directory / "m.obj").string(), in = (directory / "in.csv").string(),
                    out = (directory / "o.npy").string();
  Mesh mesh = jittered(torus(5, 4));
  mesh.holes = {3};
  write_obj(obj, mesh);
  struct Case {
    std::string text, message;  ///< after the name of the file
  };
  const std::string header = "face,u,v,x,y,z\n", good = "0,0.5,0.5,1,2,3\n";
  const std::vector<Case> cases = {
      {header + good + "20,0.5,0.5,1,2,3\n",
       ":3: face 20 does not exist; faces are 0 to 19, a quad each or a corner of another polygon"},
      {header + good + good + "1,0.5,1.5,1,2,3\n", ":4: (u, v) = (0.5, 1.5) is outside the square 0 <= u, v <= 1"},
      {header + good + "1,0.5,0.5,1,nan,3\n", ":3: y is 'nan'; it should be a finite number"},
      {header + good + "3,0.5,0.5,1,2,3\n", ":3: face 3 is a hole, which is no part of the limit; leave this row out"},
      {header, ": no targets after the header; every other line should be one"},
      {"face,u,v,x,y,z,weight\n0,0.5,0.5,1,2,3,0\n", ": all weights are 0; one at least should count"},
      {"face,u,v,x,y,z,weight\n0,0.5,0.5,1,2,3,-1\n", ":2: weight -1; it should be 0 or more"},
      {"a,b\n",
       ":1: the first line is 'a,b'; it should be the header vertex,x,y,z or face,u,v,x,y,z[,weight]; other targets "
       "are for `sublimit fit`"},
      {"vertex,x,y,z\n2,0,0,0\n20,0,0,0\n", ":3: vertex 20 does not exist; vertices are 0 to 19, counted from 0"},
      {"vertex,x,y,z\n2,0,0,0\n4,0,0,0\n2,0,0,1\n", ":4: vertex 2 has a target already, in line 2; leave one of them"},
  };
  for (const Case& c : cases) {
    write(in, c.text);
    const RanksRun run = run_ranks(2, "fit " + obj + " --targets " + in + " -s catmull-clark -o " + out);
    EXPECT_EQ(run.status, 3);
    EXPECT_EQ(run.error(), "sublimit-mpi: error: " + in + c.message + "\n");
    EXPECT_FALSE(std::filesystem::exists(out));
  }
}

TEST(SpreadFit, WhatDoesNotConvergeIsAnError) {
  const TemporaryDirectory directory;
  const std::string obj = (directory / "m.obj").string(), in = (directory / "in.csv").string(),
                    out = (directory / "o.npy").string();
  const Mesh mesh = jittered(torus(9, 6));
  write_obj(obj, mesh);
  write(in, csv_of(random_targets("catmull-clark", mesh, 600)));
  const std::string arguments = "fit " + obj + " --targets " + in + " -s catmull-clark -o " + out;
  const RanksRun run = run_ranks(2, arguments + " --max-iterations 3");
  EXPECT_EQ(run.status, 70);
  EXPECT_NE(run.error().find("the fit did not converge: after 3 iterations of lsqr (DIVERGED_ITS) its gradient is"),
            std::string::npos)
      << run.err;
  EXPECT_FALSE(std::filesystem::exists(out));
  EXPECT_EQ(run_ranks(2, arguments + " --max-iterations 3 --best-effort").status, 0);
  EXPECT_TRUE(std::filesystem::exists(out));
  EXPECT_EQ(run_ranks(2, arguments + " --petsc x").status, 2);
  EXPECT_EQ(run_ranks(2, arguments + " --petsc '-ksp_tipe cg -ksp_rtol 1e-9'").error(),
            "sublimit-mpi: warning: --petsc: -ksp_tipe has no effect; it is no option of this solver\n");
}

}  // namespace
}  // namespace sublimit::testing
