// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/fit_jobs/fit_targets.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/geometric/curvature_mesh.h"
#include "sublimit/neighborhood/vertex_sides.h"
#include "sublimit/stencils/files/patch_places.h"
#include "sublimit/stencils/files/sample_files.h"
#include "sublimit/stencils/formats/csv_rows.h"

namespace sublimit {
namespace {

using Eigen::Vector3d;

const std::vector<std::vector<std::string>> headers = {
    {"vertex", "x", "y", "z"},
    {"vertex", "x", "y", "z", "nx", "ny", "nz"},
    {"vertex", "x", "y", "z", "nx", "ny", "nz", "k1", "k2", "d1x", "d1y", "d1z"},
    {"face", "u", "v", "x", "y", "z"},
    {"face", "u", "v", "x", "y", "z", "weight"},
    {"patch", "u", "v", "x", "y", "z"},
    {"patch", "u", "v", "x", "y", "z", "weight"},
};

constexpr const char* right =
    "vertex,x,y,z[,nx,ny,nz[,k1,k2,d1x,d1y,d1z]] or face,u,v,x,y,z[,weight] or patch,u,v,x,y,z[,weight]";

std::string in_words(const Vector3d& v) {
  return "(" + format_number(v.x()) + ", " + format_number(v.y()) + ", " + format_number(v.z()) + ")";
}

bool all_empty(const CsvRows& rows, size_t begin, size_t end) {
  for (size_t i = begin; i < end; ++i)
    if (!rows.is_empty(i)) return false;
  return true;
}

Vector3d vector(const CsvRows& rows, size_t column) {
  return {rows.finite(column), rows.finite(column + 1), rows.finite(column + 2)};
}

/// A number of a vertex or face; what no mesh can have is refused later, by those who know the mesh.
Index number(const CsvRows& rows, const char* kind) {
  const std::int64_t value = rows.integer(0, std::string(kind) + " are counted from 0");
  if (value < 0 || value > std::numeric_limits<Index>::max())
    throw FormatError(rows.place() + rows.columns()[0] + " " + format_number(value) + " does not exist; " + kind +
                      " are counted from 0");
  return static_cast<Index>(value);
}

/// Of length 1, whatever the range of its numbers.
Vector3d unit(const Vector3d& x) { return (x / x.cwiseAbs().maxCoeff()).normalized(); }

Vector3d normal(const CsvRows& rows) {
  const Vector3d n = vector(rows, 4);
  if (n.isZero(0))
    throw FormatError(rows.place() + "the normal has length 0; any other length will do, or leave nx,ny,nz empty");
  return unit(n);
}

TargetCurvature curvature(const CsvRows& rows, const std::optional<Vector3d>& normal) {
  if (!normal)
    throw FormatError(rows.place() + "curvatures without a normal; give nx,ny,nz, or leave k1,k2,d1x,d1y,d1z empty");
  if (all_empty(rows, 9, 12))
    throw FormatError(rows.place() +
                      "curvatures without a direction; give d1x,d1y,d1z, the direction of k1 in the tangent plane, or "
                      "leave k1,k2 empty too");
  TargetCurvature result{rows.finite(7), rows.finite(8), vector(rows, 9)};
  Vector3d& d = result.direction1;
  if (d.isZero(0)) throw FormatError(rows.place() + "the direction d1x,d1y,d1z has length 0; any other length will do");
  const Vector3d given = d;
  d = unit(d);
  const double off = std::abs(M_PI / 2 - std::atan2(normal->cross(d).norm(), normal->dot(d)));
  if (!(off <= direction_tolerance))
    throw FormatError(rows.place() + "the direction " + in_words(given) + " is " +
                      format_number(static_cast<float>(off * 180 / M_PI)) +
                      " degrees off the tangent plane; it should be at right angles to the normal " +
                      in_words(*normal));
  return result;
}

VertexTarget vertex_target(const CsvRows& rows) {
  VertexTarget target{.vertex = number(rows, "vertices"), .position = vector(rows, 1)};
  const size_t columns = rows.columns().size();
  if (columns > 4 && !all_empty(rows, 4, 7)) target.normal = normal(rows);
  if (columns > 7 && !all_empty(rows, 7, 12)) target.curvature = curvature(rows, target.normal);
  return target;
}

double weight(const CsvRows& rows) {
  const double w = rows.finite(6);
  if (w < 0) throw FormatError(rows.place() + "weight " + format_number(w) + "; it should be 0 or more");
  return w;
}

std::string place(const std::filesystem::path& file, std::int64_t line) {
  return file.string() + ":" + format_number(line) + ": ";
}

}  // namespace

std::string FitTargets::where(size_t target) const { return place(file, lines[target]); }

Points FitTargets::positions() const {
  if (by_place) return places.values;
  Points at(static_cast<Index>(vertices.size()), 3);
  for (size_t i = 0; i < vertices.size(); ++i) at.row(static_cast<Index>(i)) = vertices[i].position;
  return at;
}

FitTargets read_fit_targets(const std::filesystem::path& path) {
  CsvRows rows(path, headers, right);
  FitTargets targets;
  targets.file = path;
  targets.by_patch = rows.columns()[0] == "patch";
  targets.by_place = targets.by_patch || rows.columns()[0] == "face";
  const bool weighted = rows.columns().back() == "weight";
  std::unordered_map<Index, std::int64_t> seen;
  std::vector<double> values;
  while (rows.next()) {
    targets.lines.push_back(rows.line());
    if (targets.by_place) {
      targets.places.places.push_back(
          {number(rows, targets.by_patch ? "patches" : "faces"), rows.finite(1), rows.finite(2)});
      for (size_t c = 3; c < 6; ++c) values.push_back(rows.finite(c));
      if (weighted) targets.places.weights.push_back(weight(rows));
      continue;
    }
    targets.vertices.push_back(vertex_target(rows));
    const VertexTarget& target = targets.vertices.back();
    if (const auto [first, is_new] = seen.emplace(target.vertex, rows.line()); !is_new)
      throw FormatError(rows.place() + "vertex " + format_number(target.vertex) + " has a target already, in line " +
                        format_number(first->second) + "; leave one of them");
    targets.num_normals += target.normal.has_value();
    targets.num_curvatures += target.curvature.has_value();
  }
  if (targets.lines.empty())
    throw FormatError(path.string() + ": no targets after the header; every other line should be one");
  if (!targets.places.weights.empty() && std::ranges::all_of(targets.places.weights, [](double w) { return w == 0; }))
    throw FormatError(path.string() + ": all weights are 0; one at least should count");
  if (targets.by_place)
    targets.places.values = Eigen::Map<const Points>(values.data(), static_cast<Index>(targets.size()), 3);
  return targets;
}

void check_vertices(const FitTargets& targets, const Topology& topology, const std::vector<bool>& holes) {
  const std::vector<bool> outside = vertices_without_surface(topology, holes);
  for (size_t i = 0; i < targets.vertices.size(); ++i) {
    const Index v = targets.vertices[i].vertex;
    if (v >= topology.num_vertices())
      throw FormatError(targets.where(i) + "vertex " + format_number(v) + " does not exist; vertices are 0 to " +
                        format_number(topology.num_vertices() - 1) + ", counted from 0");
    if (outside[v])
      throw FormatError(targets.where(i) + "vertex " + format_number(v) +
                        " is in no face, or in holes alone, so the limit does not pass there; leave this row out");
  }
}

FitTargets targets_on(const PatchSet& patches, const FitTargets& targets) {
  if (!targets.by_place)
    throw FormatError(targets.file.string() +
                      ": targets at vertices are for meshes; of free-form surfaces the header should be "
                      "patch,u,v,x,y,z[,weight] or face,u,v,x,y,z[,weight]");
  FitTargets result = targets;
  result.by_patch = false;
  for (size_t i = 0; i < result.places.places.size(); ++i) {
    Place& s = result.places.places[i];
    if (targets.by_patch)
      s = own_place(patches, s.face, {.u = s.u, .v = s.v}, targets.where(i));
    else
      check_place(patches.faces(), s.face, s.u, s.v, targets.where(i));
  }
  return result;
}

void check_places(const FitTargets& targets, const Addresses& addresses, const std::vector<bool>& holes) {
  if (targets.by_patch)
    throw FormatError(targets.file.string() +
                      ": targets on patches are for free-form surfaces; of meshes the header should be "
                      "face,u,v,x,y,z[,weight]");
  for (size_t i = 0; i < targets.places.places.size(); ++i) {
    const Place& s = targets.places.places[i];
    check_place(addresses, s.face, s.u, s.v, targets.where(i));
    if (holes[index(addresses.place(s.face).face)])
      throw FormatError(targets.where(i) + "face " + format_number(s.face) +
                        " is a hole, which is no part of the limit; leave this row out");
  }
}

}  // namespace sublimit
