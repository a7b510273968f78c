// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/page/bands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace sublimit::page {
namespace {

/// A part as it grows: points are found again by what they are made of.
struct Part {
  std::map<std::tuple<Index, Index, double>, Index> points;  // edge and value on it; a vertex is an edge to itself
  std::vector<Eigen::Vector3d> positions, normals;
  std::vector<Index> face_sizes, face_vertices;
};

struct Corner {
  Index tail = 0, head = 0;  // tail < head, or a vertex
  double level = 0;
};

class Cutter {
 public:
  Cutter(const PictureMesh& mesh, const std::vector<double>& values) : mesh_(mesh), values_(values) {}

  void add(Part& part, const std::vector<Corner>& polygon) const {
    if (polygon.size() < 3) return;
    for (const Corner& c : polygon) part.face_vertices.push_back(point(part, c));
    part.face_sizes.push_back(static_cast<Index>(polygon.size()));
  }

  /// What of a triangle has low <= value < high.
  std::vector<Corner> cut(const std::array<Index, 3>& triangle, double low, double high) const {
    std::vector<Corner> polygon;
    for (int i = 0; i < 3; ++i) {
      const Index a = triangle[i], b = triangle[(i + 1) % 3];
      const double va = values_[a], vb = values_[b];
      if (va >= low && va < high) polygon.push_back({a, a, 0});
      const auto cross = [&](double level) {
        if ((va < level) != (vb < level)) polygon.push_back({std::min(a, b), std::max(a, b), level});
      };
      cross(va <= vb ? low : high);
      cross(va <= vb ? high : low);
    }
    return polygon;
  }

 private:
  Index point(Part& part, const Corner& c) const {
    const auto [found, fresh] =
        part.points.try_emplace({c.tail, c.head, c.level}, static_cast<Index>(part.positions.size()));
    if (fresh) {
      const double t = c.tail == c.head ? 0 : (c.level - values_[c.tail]) / (values_[c.head] - values_[c.tail]);
      const auto mean = [&](const Points& p) {
        return Eigen::Vector3d(((1 - t) * p.row(c.tail) + t * p.row(c.head)).transpose());
      };
      part.positions.push_back(mean(mesh_.positions));
      if (mesh_.vertex_normals.rows() > 0) part.normals.push_back(mean(mesh_.vertex_normals));
    }
    return found->second;
  }

  const PictureMesh& mesh_;
  const std::vector<double>& values_;
};

Points rows_of(const std::vector<Eigen::Vector3d>& points) {
  Points rows(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i) rows.row(static_cast<Eigen::Index>(i)) = points[i].transpose();
  return rows;
}

Points rows_of(const Json& list, std::size_t count) {
  Points rows = Points::Zero(static_cast<Eigen::Index>(count), 3);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      rows(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) = number(at(at(list, i), c)).value_or(0);
  return rows;
}

}  // namespace

std::vector<PictureMesh> bands(const PictureMesh& mesh, const std::vector<double>& values,
                               const std::vector<double>& thresholds, std::size_t count) {
  const Cutter cutter(mesh, values);
  std::vector<Part> parts(count > 0 ? count : thresholds.size() + 1);
  const auto part = [&](std::ptrdiff_t band) -> Part& { return parts[static_cast<std::size_t>(band) % parts.size()]; };
  const auto band = [&](double v) {
    return std::upper_bound(thresholds.begin(), thresholds.end(), v) - thresholds.begin();
  };
  const double all = std::numeric_limits<double>::infinity();
  std::size_t begin = 0;
  for (Index size : mesh.face_sizes) {
    const auto corner = [&](Index i) { return mesh.face_vertices[begin + static_cast<std::size_t>(i)]; };
    double low = all, high = -all;
    bool finite = true;
    for (Index i = 0; i < size; ++i) {
      const double v = values[corner(i)];
      finite &= std::isfinite(v);
      low = std::min(low, v), high = std::max(high, v);
    }
    if (finite && band(low) == band(high)) {
      std::vector<Corner> polygon;
      for (Index i = 0; i < size; ++i) polygon.push_back({corner(i), corner(i), 0});
      cutter.add(part(band(low)), polygon);
    } else if (finite) {
      for (Index i = 1; i + 1 < size; ++i) {
        const std::array<Index, 3> triangle = {corner(0), corner(i), corner(i + 1)};
        for (auto p = band(low); p <= band(high); ++p)
          cutter.add(part(p), cutter.cut(triangle, p == 0 ? -all : thresholds[p - 1],
                                         p == static_cast<int>(thresholds.size()) ? all : thresholds[p]));
      }
    }
    begin += static_cast<std::size_t>(size);
  }
  std::vector<PictureMesh> result(parts.size());
  for (std::size_t p = 0; p < parts.size(); ++p) {
    result[p].positions = rows_of(parts[p].positions);
    if (mesh.vertex_normals.rows() > 0) result[p].vertex_normals = rows_of(parts[p].normals);
    result[p].face_sizes = std::move(parts[p].face_sizes);
    result[p].face_vertices = std::move(parts[p].face_vertices);
    result[p].color = mesh.color;
  }
  return result;
}

PictureMesh mesh_of(const Json& surface) {
  PictureMesh mesh;
  const Json &positions = at(surface, "positions"), &normals = at(surface, "normals");
  if (!positions.is_array()) return mesh;
  mesh.positions = rows_of(positions, positions.size());
  if (normals.is_array() && normals.size() == positions.size()) mesh.vertex_normals = rows_of(normals, normals.size());
  for (const Json& face : at(surface, "faces")) {
    const auto good = [&](const Json& v) {
      return v.is_number_integer() && v.get<std::int64_t>() >= 0 &&
             v.get<std::int64_t>() < static_cast<std::int64_t>(positions.size());
    };
    if (!face.is_array() || face.size() < 3 || !std::all_of(face.begin(), face.end(), good)) continue;
    mesh.face_sizes.push_back(static_cast<Index>(face.size()));
    for (const Json& v : face) mesh.face_vertices.push_back(v.get<Index>());
  }
  return mesh;
}

}  // namespace sublimit::page
