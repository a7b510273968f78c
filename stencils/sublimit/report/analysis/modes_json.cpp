// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/analysis/modes_json.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/source/curvature.h"

namespace sublimit::report {
namespace {

/// Rings of a net that are written, and rings of faces that are drawn: further ones feel the rim.
constexpr int net_rings = 3, drawn_rings = 2;

/// Vertices of a net within its inner rings, as they are numbered there.
std::vector<Index> inner_vertices(const SectorMesh& net, int rings, bool triangles) {
  std::vector<Index> inner;
  for (size_t i = 0; i < net.labels.size(); ++i) {
    const SectorLabel& l = net.labels[i];
    if ((triangles ? l.x2 + l.y2 : std::max(l.x2, l.y2)) <= 2 * rings) inner.push_back(static_cast<Index>(i));
  }
  return inner;
}

struct FaceRange {
  Index face, first, size;  ///< corners in face_vertices
};
std::vector<FaceRange> faces_within(const SectorMesh& net, int rings) {
  std::vector<FaceRange> faces;
  Index at = 0;
  for (Index f = 0; f < net.mesh.num_faces(); ++f) {
    if (net.ring[f] < rings) faces.push_back({f, at, net.mesh.face_sizes[f]});
    at += net.mesh.face_sizes[f];
  }
  return faces;
}

/// Addresses of a face.
std::vector<Index> addresses_of(const Addresses& addresses, const FaceRange& face) {
  std::vector<Index> all;
  const bool whole = face.size == 4 || addresses.triangles();
  for (Index c = 0; c < (whole ? 1 : face.size); ++c) all.push_back(addresses.first(Face{face.face}) + c);
  return all;
}

SubdivisionOptions rim_rules() {
  SubdivisionOptions options;
  options.boundary = Boundary::edge_only;
  return options;
}

bool has_triangles(const Scheme<double>& scheme) { return scheme.face_size() == 3; }

}  // namespace

Json characteristic_map_json(const std::shared_ptr<LimitCache>& pieces, const LocalModes& modes) {
  const Scheme<double>& scheme = pieces->pieces().scheme();
  const LocalMode& mode = modes.leading;
  if (mode.block == 0 || std::abs(mode.value.imag()) > 1e-9 * std::abs(mode.value)) return nullptr;
  const bool triangles = has_triangles(scheme);
  Mesh mesh = modes.net.mesh;
  mesh.positions.col(0) = mode.net.real();
  mesh.positions.col(1) = mode.net.imag();
  Json json{{"net", Json::array()}, {"faces", Json::array()}, {"lines", Json::array()}};
  std::vector<Index> position(modes.net.labels.size(), -1);
  for (const Index v : inner_vertices(modes.net, net_rings, triangles)) {
    position[v] = static_cast<Index>(json["net"].size());
    json["net"].push_back(
        {{"label", to_json(modes.net.labels[v])}, {"at", point(mode.net[v].real(), mode.net[v].imag())}});
  }
  for (const FaceRange& face : faces_within(modes.net, net_rings)) {
    Json corners = Json::array();
    for (Index k = 0; k < face.size; ++k) corners.push_back(position[mesh.face_vertices[face.first + k]]);
    if (std::find(corners.begin(), corners.end(), Json(-1)) == corners.end()) json["faces"].push_back(corners);
  }
  // Parameter lines: sides and middles of faces.
  const LimitMap surface(scheme, mesh, rim_rules(), pieces);
  const bool thirds = scheme.dilation() == 3;
  const int steps = thirds ? 3 : 4;
  const std::vector<double> at_values =
      thirds ? std::vector<double>{0, 1 / 3.0, 2 / 3.0, 1} : std::vector<double>{0, .5, 1};
  std::vector<Place> samples;
  std::vector<int> lengths;
  for (const FaceRange& face : faces_within(modes.net, drawn_rings))
    for (const Index address : addresses_of(surface.addresses(), face))
      for (const double fixed : at_values)
        for (const bool along_u : {true, false}) {
          const double end = triangles ? 1 - fixed : 1;
          if (end == 0) continue;
          for (int i = 0; i <= steps; ++i) {
            const double t = end * i / steps;
            samples.push_back(along_u ? Place{address, t, fixed} : Place{address, fixed, t});
          }
          lengths.push_back(steps + 1);
        }
  const LimitSamples at = surface.evaluate(mesh.positions, samples, 1, false);
  Eigen::Index next = 0;
  double least = INFINITY, greatest = -INFINITY;
  for (const int length : lengths) {
    Json line = Json::array();
    for (int i = 0; i < length; ++i, ++next) {
      line.push_back(point(at.position(next, 0), at.position(next, 1)));
      if (at.order[static_cast<size_t>(next)] < 1 || at.position.row(next).norm() < 1e-9) continue;
      const double jacobian = at.du(next, 0) * at.dv(next, 1) - at.du(next, 1) * at.dv(next, 0);
      least = std::min(least, jacobian), greatest = std::max(greatest, jacobian);
    }
    json["lines"].push_back(std::move(line));
  }
  json["jacobian"] = nullptr;
  if (!(least <= greatest)) return json;  // no derivatives anywhere
  const int sign = least > 0 ? 1 : greatest < 0 ? -1 : 0;
  json["jacobian"] = {{"sign", sign}, {"least", drawn(least)}, {"greatest", drawn(greatest)}, {"by", "floating"}};
  return json;
}

Json eigenfunctions_json(const LocalModes& modes) {
  Json json = Json::array();
  const bool triangles = std::all_of(modes.net.mesh.face_sizes.begin(), modes.net.mesh.face_sizes.end(),
                                     [](Index size) { return size == 3; });
  const std::vector<Index> inner = inner_vertices(modes.net, net_rings, triangles);
  for (size_t i = 0; i < std::min<size_t>(modes.next.size(), 3); ++i) {
    const LocalMode& mode = modes.next[i];
    Json heights = Json::array();
    for (const Index v : inner) heights.push_back(drawn(mode.net[v].real(), 4));
    json.push_back(
        {{"block", mode.block}, {"value", point(mode.value.real(), mode.value.imag())}, {"heights", heights}});
  }
  return json;
}

SampleSurface sample_surface(const std::shared_ptr<LimitCache>& pieces, const LocalType& type, bool is_drawn,
                             bool is_dart) {
  const Scheme<double>& scheme = pieces->pieces().scheme();
  constexpr int rings = 5;
  const bool open = type.open && !is_dart;
  const bool triangles = has_triangles(scheme), is_face = type.kind == Centre::Kind::face;
  SectorMesh net = sector_mesh(type.kind, type.faces, triangles ? 3 : 4, rings, open);
  // One face alone would be flat between spokes that are opposite.
  const double angle = open ? std::numbers::pi / std::max<Index>(2, type.faces) : 2 * std::numbers::pi / type.faces;
  for (size_t i = 0; i < net.labels.size(); ++i) {
    const SectorLabel& l = net.labels[i];
    const double x = l.x() * std::cos(angle * l.sector) + l.y() * std::cos(angle * (l.sector + 1)),
                 y = l.x() * std::sin(angle * l.sector) + l.y() * std::sin(angle * (l.sector + 1)), r2 = x * x + y * y;
    // A cap, a saddle and a dent beside the centre, so that every mode has its part.
    double z = 1.1 * std::exp(-r2 / 5) + .08 * (x * x - y * y) * std::exp(-r2 / 8);
    if (l.sector == 0 && l.x2 + l.y2 == 2) z += .3;
    net.mesh.positions.row(static_cast<Eigen::Index>(i)) << x, y, z;
  }
  if (type.corner) net.mesh.corners.push_back({net.find.at({0, 0, 0}), infinite_sharpness});
  for (int x2 = 0; is_dart && x2 < 2 * rings; x2 += 2)
    net.mesh.creases.push_back({net.find.at({0, x2, 0}), net.find.at({0, x2 + 2, 0}), infinite_sharpness});
  const LimitMap surface(scheme, net.mesh, rim_rules(), pieces);
  const std::vector<FaceRange> faces = faces_within(net, drawn_rings);
  SampleSurface result;

  // Normals of places on circles of 2^-step (3^-step) edges around the centre. Places are those of some level: where
  // limits are no polynomials, these are at hand and others are not.
  std::vector<Place> samples;
  const int base = scheme.dilation(), circles = base == 3 ? 7 : 11, on_circle = base == 3 ? 4 : 5;
  int places = 0;
  for (int step = 0; step < circles; ++step) {
    const double r = std::pow(base, -step);
    for (const FaceRange& face : faces) {
      if (net.ring[face.face] != 0) continue;
      for (const Index address : addresses_of(surface.addresses(), face))
        for (int k = 0; k < on_circle; ++k) {
          const double t = static_cast<double>(k) / (on_circle - 1);
          if (is_face)
            samples.push_back({address, 1 - r * std::min(1.0, 2 * t), 1 - r * std::min(1.0, 2 - 2 * t)});
          else if (triangles)  // the face's first corner is the centre
            samples.push_back({address, r * (1 - t), r * t});
          else
            samples.push_back({address, r * std::min(1.0, 2 * t), r * std::min(1.0, 2 - 2 * t)});
        }
    }
    if (step == 0) places = static_cast<int>(samples.size());
  }
  const LimitSamples around = surface.evaluate(net.mesh.positions, samples, 1);
  Json steps = Json::array(), spreads = Json::array();
  for (int step = 0; step < circles; ++step) {
    std::optional<double> least;  // cosine of an angle between two
    const Points normals = around.normal.middleRows(static_cast<Eigen::Index>(step) * places, places);
    for (Eigen::Index i = 0; i < places; ++i)
      for (Eigen::Index j = 0; j < i; ++j)
        if (normals.row(i).squaredNorm() > 0 && normals.row(j).squaredNorm() > 0)
          least = std::min(least.value_or(1), normals.row(i).dot(normals.row(j)));
    steps.push_back(step);
    spreads.push_back(least ? drawn(std::acos(std::clamp(*least, -1.0, 1.0)) * 180 / std::numbers::pi, 4)
                            : Json(nullptr));
  }
  result.normals = {{"steps", steps}, {"spread_degrees", spreads}};
  if (!is_drawn) return result;

  const int N = base == 3 ? 10 : 9;  // places along a side
  samples.clear();
  Json cells = Json::array();
  for (const FaceRange& face : faces)
    for (const Index address : addresses_of(surface.addresses(), face)) {
      const auto first = static_cast<Index>(samples.size());
      const auto row = [&](int j) { return triangles ? j * N - j * (j - 1) / 2 : j * N; };
      for (int j = 0; j < N; ++j)
        for (int i = 0; i < (triangles ? N - j : N); ++i)
          samples.push_back({address, double(i) / (N - 1), double(j) / (N - 1)});
      for (int j = 0; j + 1 < N; ++j)
        for (int i = 0; i + 1 < (triangles ? N - j : N); ++i) {
          const Index a = first + row(j) + i, b = first + row(j + 1) + i;
          if (!triangles) {
            cells.push_back({a, a + 1, b + 1, b});
            continue;
          }
          cells.push_back({a, a + 1, b});
          if (i + 2 < N - j) cells.push_back({a + 1, b + 1, b});
        }
    }
  const LimitSamples at = surface.evaluate(net.mesh.positions, samples, 2);
  Json positions = Json::array(), normals = Json::array(), curvatures = Json::array();
  for (Eigen::Index i = 0; i < at.position.rows(); ++i) {
    positions.push_back(point(at.position(i, 0), at.position(i, 1), at.position(i, 2)));
    normals.push_back({drawn(at.normal(i, 0), 4), drawn(at.normal(i, 1), 4), drawn(at.normal(i, 2), 4)});
    const auto c = curvature(at, static_cast<Index>(i));
    curvatures.push_back(c ? Json{drawn(c->mean, 4), drawn(c->gauss, 4)} : Json(nullptr));
  }
  result.surface = {{"positions", positions}, {"faces", cells}, {"normals", normals}, {"curvature", curvatures}};
  return result;
}

}  // namespace sublimit::report
