// SPDX-License-Identifier: Apache-2.0
// Public functions, with their n-th allocation failing, or all from it on: std::bad_alloc or ResourceError comes out,
// nothing is left in memory, and the same call on the same objects then gives the bits that it gave before. C functions
// return SUBLIMIT_BAD_ALLOC or SUBLIMIT_RESOURCE_ERROR.
//
// Schemes are made before: g++ 12 destroys a string twice where `return {.name = ..., .steps = {{...}}, ...}` of a
// scheme gets no memory for one of its parts.
//
// All of it runs by one thread: which allocation is the n-th is the same in each run then.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <memory>
#include <new>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "failures/failing_memory.h"
#include "laws/full_sweep.h"
#include "meshes/meshes.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/error.h"
#include "sublimit/cad/limit_model.h"
#include "sublimit/certificates/c1/c1_certificate.h"
#include "sublimit/certificates/numbers/detail/out_of_memory.h"
#include "sublimit/certificates/spectra/exact_schemes.h"
#include "sublimit/curves/limit_curve.h"
#include "sublimit/curves/limit_curve.h"
#include "sublimit/curves/schemes/curve_schemes.h"
#include "sublimit/eval/eval.h"
#include "sublimit/eval/evaluate/pattern_evaluator.h"
#include "sublimit/eval/file/table_file.h"
#include "sublimit/fit/cloud_fit.h"
#include "sublimit/fit/detail/interpolate.h"
#include "sublimit/fit/scattered_fit.h"
#include "sublimit/geometric/geometric_schemes.h"
#include "sublimit/geometric/thinning.h"
#include "sublimit/io/detail/obj.h"
#include "sublimit/io/read_mesh.h"
#include "sublimit/io/write_mesh.h"
#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/scheme/refined_mesh.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/search/closest_point.h"
#include "sublimit/search/intersect.h"
#include "sublimit/stencils/bake/detail/bake.h"
#include "sublimit/stencils/bake/detail/pattern_edits.h"
#include "sublimit/stencils/files/export_table.h"
#include "sublimit/stencils/patterns/pattern_file.h"
#include "sublimit/stencils/recipes/detail/recipe_sources.h"
#include "sublimit/subdivide.h"
#include "sublimit/surface/limit_surface.h"
#include "sublimit/tessellation/tessellate.h"
#include "support/temporary_directory.h"

namespace sublimit::testing {
namespace {

/// Bits of a result.
std::string bits(const Points& points) {
  std::string text(points.size() * sizeof(double), '\0');
  for (Index row = 0; row < points.rows(); ++row)
    for (Index column = 0; column < points.cols(); ++column) {
      const double x = points(row, column);
      std::memcpy(text.data() + (row * points.cols() + column) * Index(sizeof x), &x, sizeof x);
    }
  return text;
}
std::string bits(const SparseMatrix& m) {
  Points values(m.nonZeros(), 1);
  for (Index i = 0; i < values.rows(); ++i) values(i, 0) = m.valuePtr()[i];
  return bits(values);
}

/// A call, again and again; what it needs and keeps lives in the function.
using Call = std::function<std::string()>;

int injected = 0;  // by all tests

/// Lets allocations of `call` fail, and expects the right thing each time.
/// @param lost  blocks that a library which it uses may lose
void expect_survives_failures(const std::string& name, const Call& call, std::int64_t lost = 0) {
  const std::string right = call();
  ASSERT_EQ(call(), right) << name << " is not the same twice";
  std::int64_t count = 0;
  {
    const FailingMemory none(0);
    call();
    count = none.count();
  }
  std::set<std::int64_t> at;
  for (std::int64_t n = 1; n <= count; n *= 2) at.insert(n);
  std::mt19937 random(40);
  for (int i = 0; i < (full_sweep() ? 200 : 6) && count > 0; ++i)
    at.insert(std::uniform_int_distribution<std::int64_t>(1, count)(random));
  bool in_array = false;
  const auto with_failures = [&](std::int64_t n, bool and_after) -> std::string {
    const FailingMemory failing(n, and_after);
    const struct Array {
      ~Array() { in_array = failing.failed_in_array(); }
      const FailingMemory& failing;
      bool& in_array;
    } array{failing, in_array};
    ++injected;
    try {
      return call() == right ? "" : "another result";  // what can do without may
    } catch (const std::bad_alloc&) {
      return "";
    } catch (const Error& error) {
      return error.code() == ErrorCode::resource_error ? "" : error.what();
    } catch (const std::exception& error) {
      return error.what();
    }
  };
  for (const std::int64_t n : at)
    for (const bool and_after : {false, true}) {
      const std::string what = name + ", allocation " + std::to_string(n) + (and_after ? " and all after it" : "");
      EXPECT_EQ(with_failures(n, and_after), "") << what;
      // What is kept for good, in caches of this thread or of the process, was taken by the first of these.
      const std::int64_t before = blocks_in_use();
      with_failures(n, and_after);
      EXPECT_LE(blocks_in_use(), before + lost + (in_array ? 1 : 0)) << what << ": memory is lost";
      EXPECT_EQ(call(), right) << what << ": then another result";
    }
}

class LackOfMemory : public ::testing::Test {
 protected:
  ~LackOfMemory() override { RecordProperty("injected", injected); }

  tbb::global_control one_thread_{tbb::global_control::max_allowed_parallelism, 1};
  TemporaryDirectory directory_;
  const Mesh quads_ = [] {
    Mesh mesh = jittered(cube());
    add_crease(mesh, {0, 1, 3}, 1.5F);
    return mesh;
  }();
  const Mesh triangles_ = jittered(octahedron());
  const Scheme<double> catmull_clark_ = find_scheme("catmull-clark").value();
};

// Not of glTF: nlohmann-json frees its values with a list that takes memory, and ends the program if there is none.
TEST_F(LackOfMemory, InFilesOfMeshesIsAnError) {
  for (const char* name : {"mesh.obj", "mesh.ply", "mesh.off", "mesh.stl", "mesh.usda", "mesh.usdz"}) {
    const std::filesystem::path path = directory_ / name;
    const Mesh mesh = quads_;
    expect_survives_failures(std::string("write ") + name, [&] {
      write_mesh(path, mesh);
      return read_file(path);
    });
    EXPECT_EQ(directory_.num_files(), 1);  // counted with all memory: libstdc++ ends the program without
    expect_survives_failures(std::string("read ") + name, [&] { return bits(read_mesh(path).positions); });
    std::filesystem::remove(path);
  }
  EXPECT_EQ(directory_.num_files(), 0);
}

TEST_F(LackOfMemory, InRefinementAndLimitsIsAnErrorUnderEveryScheme) {
  for (const Scheme<double>& scheme : all_schemes<double>()) {
    Mesh plain = scheme.face_size() == 3 ? triangles_ : quads_;
    plain.creases.clear();
    LimitCache kept(scheme);
    expect_survives_failures("limit of " + scheme.name, [&] {
      LimitCache fresh(scheme);
      const std::vector<Level> levels = refine(scheme, plain, 1);
      const Points points = refinement_matrix(levels) * plain.positions;
      const auto once = limit_points(limit_matrices(levels[1], fresh), levels[1].topology(), points);
      const auto again = limit_points(limit_matrices(levels[1], kept), levels[1].topology(), points);
      return bits(once.position) + bits(once.normal) + bits(again.position);
    });
  }
}

TEST_F(LackOfMemory, InRefinedMeshesIsAnError) {
  expect_survives_failures("refined_mesh", [&] { return bits(refined_mesh(catmull_clark_, quads_, 2).positions); });
  const Refiner refiner(catmull_clark_, quads_, 2);
  expect_survives_failures("Refiner::points", [&] { return bits(refiner.points(quads_.positions)); });
  FaceMatrix faces(2, 3);
  faces << 0, 1, 2, 0, 2, 3;
  expect_survives_failures("subdivide", [&] { return bits(subdivide("loop", 4, faces, 2).first); });
}

TEST_F(LackOfMemory, DoesNotMatterToALevelThatIsMoved) {
  std::vector<Level> levels = refine(catmull_clark_, quads_, 2);
  const std::string S = bits(levels[2].S);
  {
    const FailingMemory failing(1, true);
    Level moved = std::move(levels[2]);
    levels[2] = std::move(moved);
    std::swap(levels[1], levels[2]);
    EXPECT_EQ(failing.count(), 0);
  }
  EXPECT_EQ(bits(levels[1].S), S);
  Level from = std::move(levels[1]);
  levels[1] = from;
  const Level copy = levels[1];
  EXPECT_EQ(bits(copy.S), S);
  EXPECT_EQ(bits(levels[1].S), S) << "the matrix of what was copied was taken away";
}

TEST_F(LackOfMemory, OnSurfacesIsAnError) {
  const std::vector<Place> places{{0, 0.25, 0.5}, {1, 0, 0}, {5, 1e-6, 1e-7}, {3, 1, 0.125}};
  expect_survives_failures("LimitMap", [&] {
    const LimitMap surface(catmull_clark_, quads_);
    return bits(surface.evaluate(quads_.positions, places, 2).position);
  });
  const LimitMap surface(catmull_clark_, quads_);
  expect_survives_failures("LimitMap::evaluate_grid",
                           [&] { return bits(surface.evaluate_grid(quads_.positions, 3, 1).position); });
  expect_survives_failures("LimitMap::bounding_boxes",
                           [&] { return std::to_string(surface.bounding_boxes(quads_.positions).front().min().x()); });
  const LimitSurface bound(surface, quads_.positions);
  expect_survives_failures("LimitSurface::evaluate", [&] { return bits(bound.evaluate(places, 2).position); });
  expect_survives_failures("tessellate",
                           [&] { return bits(tessellate(surface, quads_.positions, {.chord = 0.1}).points); });
  Points queries(3, 3);
  queries << 0.1, 0.2, 0.3, 2, 2, 2, -1, 0, 4;
  expect_survives_failures(
      "closest_points", [&] { return bits(closest(surface, quads_.positions, queries, {.is_signed = true}).points); });
  const Ray ray{{0.1, 0.2, -5}, {0, 0, 1}};
  expect_survives_failures("intersect",
                           [&] { return bits(intersect(surface, quads_.positions, {ray}, {.all = true}).points); });
  const RayTracer tracer(surface, quads_.positions);
  expect_survives_failures("RayTracer::trace", [&] { return std::to_string(tracer.trace(ray).size()); });
  expect_survives_failures("limit_model", [&] {
    return std::to_string(limit_model(surface, quads_.positions, {.tolerance = 0.05, .progress = {}}).quads);
  });
}

TEST_F(LackOfMemory, OnCurvesIsAnError) {
  Points points(4, 2);
  points << 0, 0, 2, 0, 2, 1, 0, 3;
  const ControlPolygon polygon = polygon_through(points, true);
  for (const char* name : {"chaikin", "four-point", "lane-riesenfeld"}) {
    const CurveScheme<double> scheme = find_curve_scheme(name).value();
    expect_survives_failures(name, [&] {
      const auto levels = refine(scheme, polygon, 2);
      const LimitCurve fine(scheme, levels[2]);
      const LimitCurve curve(scheme, polygon);
      const std::vector<CurvePlace> places = curve.grid(3);
      return bits(place_stencils(fine, fine.point_places()).matrices[0]) +
             bits(curve.evaluate(points, places, 1).position);
    });
  }
}

TEST_F(LackOfMemory, OfTablesIsAnError) {
  Patterns kept(catmull_clark_);
  expect_survives_failures("bake", [&] {
    Patterns fresh(catmull_clark_);
    const Baked a = bake_level(fresh, quads_, 2),
                b = bake(kept, quads_, {.rows = TableRows::grid, .grid = 3, .derivatives = 1});
    return std::to_string(a.statistics.points) + " " + std::to_string(b.statistics.points);
  });
  const BakedTable<double> table = bake_level(kept, quads_, 2).table;
  const std::filesystem::path path = directory_ / "table.safetensors", types = directory_ / "types";
  expect_survives_failures("save_table", [&] {
    save_table(path, table);
    return read_file(path);
  });
  expect_survives_failures(
      "load_table", [&] { return std::to_string(std::get<BakedTable<double>>(load_table(path)).table.num_points()); });
  expect_survives_failures("save_patterns", [&] {
    save_patterns(types, kept);
    return read_file(types);
  });
  expect_survives_failures("load_patterns", [&] {
    Patterns read(catmull_clark_);
    load_patterns(types, read);
    return std::to_string(bake_level(read, quads_, 1).statistics.points);
  });
  for (const char* name : {"out.npz", "out.mtx"})
    expect_survives_failures(
        std::string("export ") + name,
        [&] {
          export_table(directory_ / name, AnyTable(table));
          return read_file(directory_ / name);
        },
        name == std::string("out.npz") ? 1 : 0);  // libzip 1.7 does
  EXPECT_EQ(directory_.num_files(), 4) << "temporaries are left";

  const PatternEvaluator<double> evaluator(table.table);
  std::vector<double> points(quads_.positions.data(), quads_.positions.data() + quads_.positions.size());
  std::vector<double> result(size_t(3 * table.table.num_points())), back(points.size());
  expect_survives_failures("PatternEvaluator", [&] {
    const PatternEvaluator<double> made(table.table);
    made.apply(points, 3, result);
    evaluator.apply(points, 3, result);
    evaluator.apply_transpose(result, 3, back);
    return std::string(reinterpret_cast<const char*>(result.data()), result.size() * sizeof(double)) +
           std::string(reinterpret_cast<const char*>(back.data()), back.size() * sizeof(double));
  });

  Patterns patterns(catmull_clark_);
  Mesh plain = quads_;
  plain.creases.clear();
  PatternEdits<double> editable(patterns, plain, 2);
  expect_survives_failures("PatternEdits::edit", [&] {
    PatternEdits<double> made(patterns, plain, 2);
    MeshEdit sharp, smooth;
    sharp.creases = {{0, 1, 2}};
    smooth.creases = {{0, 1, 0}};
    made.edit(sharp);
    editable.edit(sharp);
    editable.edit(smooth);
    return std::to_string(made.num_faces());
  });
}

TEST_F(LackOfMemory, InCIsAStatus) {
  const std::vector<std::int64_t> offsets{0, 2, 3};
  const std::vector<std::int32_t> columns{0, 1, 1};
  const std::vector<double> weights{0.5, 0.5, 1}, points{0, 0, 0, 2, 4, 6};
  const sublimit_rows_d rows{2, offsets.data(), columns.data(), weights.data()};
  const auto check = [](sublimit_status status) {
    if (status == SUBLIMIT_BAD_ALLOC || status == SUBLIMIT_RESOURCE_ERROR) throw std::bad_alloc();
    EXPECT_EQ(status, SUBLIMIT_OK) << sublimit_last_error();
  };
  Patterns patterns(catmull_clark_);
  const std::filesystem::path path = directory_ / "table.safetensors";
  save_table(path, bake_level(patterns, quads_, 1).table);
  sublimit_table* loaded = nullptr;
  ASSERT_EQ(sublimit_table_load(path.c_str(), 0, &loaded), SUBLIMIT_OK);
  expect_survives_failures("sublimit_table_from_rows_d", [&] {
    sublimit_table* table = nullptr;
    std::vector<double> result(6);
    const sublimit_status made = sublimit_table_from_rows_d(2, 1, &rows, 0, &table);
    const std::unique_ptr<sublimit_table, void (*)(sublimit_table*)> owner(table, sublimit_table_free);
    check(made);
    check(sublimit_apply_d(table, points.data(), points.size(), 3, result.data(), result.size()));
    return std::to_string(result[2]);
  });
  expect_survives_failures("sublimit_table_load", [&] {
    sublimit_table* table = nullptr;
    const sublimit_status made = sublimit_table_load(path.c_str(), SUBLIMIT_CHECKSUMS, &table);
    const std::unique_ptr<sublimit_table, void (*)(sublimit_table*)> owner(table, sublimit_table_free);
    check(made);
    return std::to_string(sublimit_table_num_points(table));
  });
  expect_survives_failures("sublimit_table_faces", [&] {
    std::int64_t faces = 0, corners = 0;
    check(sublimit_table_faces(loaded, &faces, &corners, nullptr, nullptr));
    return std::to_string(faces);
  });
  sublimit_table_free(loaded);
}

TEST_F(LackOfMemory, InFitsIsAnError) {
  const std::vector<VertexTarget> targets{{.vertex = 0, .position = {-1, -1, -1}},
                                          {.vertex = 7, .position = {1, 1, 1}}};
  expect_survives_failures("interpolate", [&] { return bits(interpolate(catmull_clark_, quads_, targets).points); });
  const LimitMap surface(catmull_clark_, quads_);
  const PlaceTargets places{.places = {{0, 0.5, 0.5}, {3, 0.25, 0.5}}, .values = Points::Ones(2, 3)};
  expect_survives_failures("fit_places", [&] { return bits(fit_places(surface, places, quads_.positions).points); });
  const Cloud cloud{.points = surface.evaluate_grid(quads_.positions, 3).position};
  expect_survives_failures("fit_cloud",
                           [&] { return bits(fit_cloud(surface, cloud, quads_.positions, {.iterations = 2}).points); });
}

TEST_F(LackOfMemory, InRecipesIsAnError) {
  const std::string text =
      R"({"kind": "revolution", "profile": {"degree": 2, "knots": [0, 0, 0, 1, 1, 1], "points": [[0, -1], [2, 0], [0, 1]]}})";
  expect_survives_failures("recipes", [&] {
    const std::vector<Recipe> recipes = parse_recipes(text, "spindle.json");
    const RecipePatches patches = recipe_patches(recipes, "spindle.json");
    const std::vector<Place> places{{0, 0.5, 0.5}, {1, 0.25, 0.75}};
    return bits(patches.columns) + bits(patches.patches.evaluate(patches.columns, places, 1).position);
  });
}

TEST_F(LackOfMemory, InProofsIsAnErrorOfOurOwnAllocations) {
  const Scheme<Algebraic> scheme = find_scheme<Algebraic>("loop").value();
  expect_survives_failures("C1Prover", [&] { return C1Prover(scheme).certify(3).verdict.because; });
}

/// Status of a process that makes numbers which no memory has room for.
TEST(LackOfMemoryInFlint, CallsTheHandler) {
  EXPECT_EXIT(
      {
        set_out_of_memory_handler([] { ::_exit(4); });
        Ball huge(1);
        const PrecisionScope bits(long(1) << 46);
        huge /= Ball(3);
      },
      ::testing::ExitedWithCode(4), "");
}

}  // namespace
}  // namespace sublimit::testing
