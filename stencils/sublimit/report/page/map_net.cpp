// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/page/map_net.h"

#include <Eigen/Geometry>

namespace sublimit::page {

MapNet map_net(const Json& characteristic_map) {
  MapNet net;
  for (const Json& entry : at(characteristic_map, "net")) {
    const std::optional<double> x = number(at(at(entry, "at"), 0)), y = number(at(at(entry, "at"), 1));
    if (!x || !y) return {};
    net.points.emplace_back(*x, *y);
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
