// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/page/map_net.h"

#include <Eigen/Geometry>

#include <cmath>
#include <map>

namespace sublimit::page {

MapNet map_net(const Json& characteristic_map) {
  MapNet net;
  for (const Json& entry : at(characteristic_map, "net")) {
    const std::optional<double> x = number(at(at(entry, "at"), 0)), y = number(at(at(entry, "at"), 1));
    if (!x || !y) return {};
    net.points.emplace_back(*x, *y);
    const Json& label = at(entry, "label");
    net.labels.push_back(
        {number(at(label, 0)).value_or(0), number(at(label, 1)).value_or(0), number(at(label, 2)).value_or(0)});
  }
  for (const Json& face : at(characteristic_map, "faces")) {
    std::vector<int> corners;
    for (const Json& v : face) {
      const int i = whole(v, -1);
      if (i >= 0 && i < static_cast<int>(net.points.size())) corners.push_back(i);
    }
    if (corners.size() >= 3) net.faces.push_back(corners);
  }
  return net;
}

std::vector<double> heights_of(const Json& eigenfunction, const MapNet& net) {
  std::vector<double> heights;
  for (const Json& h : at(eigenfunction, "heights")) {
    if (!number(h)) return {};
    heights.push_back(*number(h));
  }
  if (heights.size() != net.points.size()) heights.clear();
  return heights;
}

std::vector<double> turned_by_a_sector(const std::vector<double>& heights, const MapNet& net, int n) {
  std::map<std::array<double, 3>, std::size_t> index;
  for (std::size_t v = 0; v < net.labels.size(); ++v) index[net.labels[v]] = v;
  std::vector<double> turned(heights.size());
  for (std::size_t v = 0; v < heights.size(); ++v) {
    const auto [sector, x, y] = net.labels[v];
    const bool center = x == 0 && y == 0;
    const auto found = index.find({center ? sector : std::fmod(sector + n - 1, n), x, y});
    if (found == index.end()) return {};
    turned[v] = heights[found->second];
  }
  return turned;
}

Points soft_normals(const PictureMesh& mesh) {
  Points normals = Points::Zero(mesh.positions.rows(), 3);
  std::size_t begin = 0;
  for (Index size : mesh.face_sizes) {
    const auto vertex = [&](Index i) { return mesh.face_vertices[begin + static_cast<std::size_t>(i % size)]; };
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (Index i = 0; i < size; ++i) {
      const Eigen::Vector3d a = mesh.positions.row(vertex(i)).transpose(),
                            b = mesh.positions.row(vertex(i + 1)).transpose();
      normal += a.cross(b);
    }
    for (Index i = 0; i < size; ++i) normals.row(vertex(i)) += normal.transpose();
    begin += static_cast<std::size_t>(size);
  }
  return normals;
}

}  // namespace sublimit::page
