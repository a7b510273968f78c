// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/bake/detail/bake.h"

#include <array>
#include <cmath>
#include <functional>
#include <string>

#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"
#include "sublimit/source/address.h"
#include "sublimit/stencils/bake/detail/bake_channels.h"
#include "sublimit/stencils/bake/detail/bake_patterns.h"
#include "sublimit/stencils/bake/detail/bake_rows.h"
#include "sublimit/stencils/bake/detail/table_info.h"

namespace sublimit {
namespace {

/// A face has four million points then.
constexpr int last_level = 11, last_grid = 2048;

/// Points that a face has, most of them.
double points_of_face(const BakeRequest& r) {
  return r.rows == TableRows::grid ? double(r.grid) * r.grid : std::pow(4.0, r.level);
}

/// Statistics alone.
Baked estimate_of_rows(const Scheme<double>& scheme, const Topology& t, const BakeRequest& r) {
  constexpr double weights_of_row = 24;  // about
  const bool triangles = scheme.face_size() == 3;
  double points = 0;
  if (r.rows == TableRows::samples) {
    points = double(r.samples.size());
  } else if (r.rows == TableRows::grid) {
    points =
        double(Addresses(t, triangles).size()) * (triangles ? r.grid * (r.grid + 1.0) / 2 : r.grid * double(r.grid));
  } else {
    points = predicted_vertices(scheme, t, r.level);
  }
  const double rows = points * num_quantities(r.derivatives);
  Baked baked;
  BakeStatistics& s = baked.statistics;
  s.points = static_cast<std::int64_t>(points);
  s.weights = static_cast<std::int64_t>(rows * weights_of_row);
  s.bytes = static_cast<std::int64_t>(8 * (rows + 1)) + 12 * s.weights;
  return baked;
}

void check_limit(double bytes, double limit) {
  if (bytes > limit)
    throw ResourceError("the bake takes about " + bytes_in_words(bytes) + " of memory; the limit is " +
                        bytes_in_words(limit) + "; use fewer points or a smaller mesh");
}

void check_faces(const BakeRequest& r) {
  if (r.face_sizes.empty() && r.face_vertices.empty()) return;
  if (r.rows != TableRows::samples) throw InvalidParameter("faces are given between samples alone");
  std::int64_t corners = 0;
  for (const Index size : r.face_sizes) {
    if (size < 3) throw InvalidParameter("a face between samples has " + std::to_string(size) + " corners");
    corners += size;
  }
  if (corners != std::ssize(r.face_vertices))
    throw InvalidParameter("sizes of the faces between samples do not add up to their corners");
  for (const Index v : r.face_vertices)
    if (v < 0 || v >= std::ssize(r.samples))
      throw InvalidParameter("a face has sample " + std::to_string(v) + " of " + std::to_string(r.samples.size()));
}

/// What is made in the first way of the request that is possible.
/// @param by_patterns  (how): nothing where that is not possible
Baked first_possible(const Patterns& patterns, const Level& control, const BakeRequest& request,
                     const std::function<std::optional<Baked>(PatternBake)>& by_patterns,
                     const std::function<Baked()>& by_rows) {
  const bool automatic = request.method == BakeMethod::automatic;
  if (automatic || request.method == BakeMethod::patterns) {
    PatternBake how{.must_pay = automatic};
    // Rows of level 1 take about 600 bytes a face, and lists of control points four times as many.
    const bool can_go_on = request.level > 1 && patterns.scheme().period == 1;
    if (automatic && can_go_on) how.most_bytes = 4 * (1000.0 * control.topology().num_faces() + 1e6);
    if (std::optional<Baked> baked = by_patterns(how)) return *std::move(baked);
  }
  // Patterns of level 1 on level 1 would be blocks of one row, which rows are without them.
  const bool only_first = request.rows == TableRows::level && request.level == 1;
  if ((automatic && !only_first) || request.method == BakeMethod::rows_then_patterns)
    if (std::optional<Baked> baked = by_patterns({.first_by_rows = true, .must_pay = automatic}))
      return *std::move(baked);
  if (automatic || request.method == BakeMethod::rows) return by_rows();
  throw InvalidParameter(patterns.scheme().name + ": such a table cannot be made by " + name(request.method));
}

}  // namespace

void check(const BakeRequest& r) {
  const auto check_range = [](const std::string& what, int value, int least, int most) {
    if (value < least || value > most)
      throw InvalidParameter(what + " " + std::to_string(value) + " of a table; " + std::to_string(least) + " to " +
                             std::to_string(most) + " are right");
  };
  if (r.rows == TableRows::level) check_range("level", r.level, 1, last_level);
  if (r.rows == TableRows::limit) check_range("level", r.level, 0, last_level);
  if (r.rows == TableRows::grid) check_range("grid", r.grid, 2, last_grid);
  check_range("derivatives", r.derivatives, 0, 2);
  if (r.rows == TableRows::level && r.derivatives > 0)
    throw InvalidParameter("a level has no derivatives; its limit has them");
  check_faces(r);
  if (needs_refined_mesh(r) && r.rows != TableRows::level && r.rows != TableRows::limit)
    throw InvalidParameter(
        std::string(
            "face-varying channels, tags and the order of refinement are those of a level or its limit, not of ") +
        name(r.rows));
}

const char* name(BakeMethod method) {
  constexpr std::array names{"automatic", "patterns", "rows then patterns", "rows"};
  return names[size_t(method)];
}

void count_table(Baked& baked) {
  BakeStatistics& s = baked.statistics;
  const auto& arrays = baked.table.table.arrays();
  s.blocks = static_cast<Index>(arrays.blocks.size());
  s.groups = static_cast<Index>(arrays.groups.size());
  s.points = baked.table.table.num_points();
  s.bytes = baked.table.table.num_bytes();
  s.weights = std::int64_t(arrays.weights.size()) + (arrays.first ? std::ssize(arrays.first->weights().span()) : 0) +
              (arrays.rest ? std::ssize(arrays.rest->weights().span()) : 0);
}

Baked bake(Patterns& patterns, const Mesh& mesh, const BakeRequest& request, const SubdivisionOptions& options) {
  check(request);
  const Scheme<double>& scheme = patterns.scheme();
  Level control = patterns.control_level(mesh, options);
  const double faces = control.topology().num_faces();
  const double bytes =
      request.rows == TableRows::samples ? double(request.samples.size()) * 1000 : faces * points_of_face(request) * 4;
  check_memory(request.rows == TableRows::grid ? "grids of " + std::to_string(request.grid) + " places a side"
                                               : "points of level " + std::to_string(request.level),
               bytes, "use fewer");
  std::vector<std::int8_t> turn;
  Baked baked = first_possible(
      patterns, control, request,
      [&](PatternBake how) {
        how.turns = &turn;
        if (!needs_refined_mesh(request)) how.spent = &control;
        return bake_by_patterns(patterns, control, request, how);
      },
      [&] { return bake_by_rows(patterns, control, request); });
  baked.table.info = table_info(scheme, mesh, request, options);
  if (needs_refined_mesh(request)) add_channels(scheme, mesh, control, request, options, turn, baked.table);
  count_table(baked);
  BakeStatistics& s = baked.statistics;
  for (const FaceVaryingValues& channel : baked.table.channels.list)
    s.channel_bytes += channel.values.num_bytes() + channel.indices.num_bytes();
  if (const std::optional<TableTags>& tags = baked.table.tags)
    s.channel_bytes += tags->creases.num_bytes() + tags->crease_sharpness.num_bytes() + tags->corners.num_bytes() +
                       tags->corner_sharpness.num_bytes();
  return baked;
}

BakePlan bake_plan(Patterns& patterns, const Mesh& mesh, const BakeRequest& request, const SubdivisionOptions& options,
                   double limit) {
  check(request);
  // While types are found, a face takes about as much: who is around it, its owners, its place in a group.
  constexpr double bytes_of_face = 300;
  check_limit(bytes_of_face * mesh.num_faces(), limit);
  const Scheme<double>& scheme = patterns.scheme();
  const Level control = patterns.control_level(mesh, options);
  const Topology& t = control.topology();
  const bool by_level = request.rows == TableRows::level || request.rows == TableRows::limit;
  // Where level 1 has the patterns it is there too.
  const bool refines =
      Patterns::is_possible(scheme) && by_level && t.uniform_face_size() != (scheme.face_size() == 3 ? 3 : 4);
  BakePlan plan;
  plan.memory = predicted_bytes(scheme, t, refines ? 1 : 0);
  check_limit(plan.memory, limit);
  plan.statistics = first_possible(
                        patterns, control, request,
                        [&](PatternBake how) {
                          how.only_count = true;
                          return bake_by_patterns(patterns, control, request, how);
                        },
                        [&] { return estimate_of_rows(scheme, t, request); })
                        .statistics;
  const BakeStatistics& s = plan.statistics;
  if (s.method == BakeMethod::rows) {
    plan.memory = predicted_bytes(scheme, t, by_level ? request.level : 0) + 2.5 * double(s.bytes);
  } else {
    plan.memory += bytes_of_face * s.faces;
    // Rows of types are kept in two forms, then laid one after the other; a table in float stands beside its original.
    plan.memory += 4.5 * double(sizeof(double)) * double(s.weights) + double(s.bytes);
  }
  if (needs_refined_mesh(request)) {
    // Values about as many as points, four corners a face, and of tags no more than a few.
    if (request.face_varying)
      for (const Mesh::FaceVarying& channel : mesh.face_varying)
        plan.statistics.channel_bytes += s.points * (8 * channel.values.cols() + 4 * 4);
    plan.memory = std::max(plan.memory, double(s.bytes) + predicted_channel_bytes(scheme, t, mesh, request)) +
                  2 * double(s.channel_bytes);
  }
  check_limit(plan.memory, limit);
  return plan;
}

Baked bake_level(Patterns& patterns, const Mesh& mesh, int levels, const SubdivisionOptions& options) {
  BakeRequest request;
  request.level = levels;
  return bake(patterns, mesh, request, options);
}

}  // namespace sublimit
