// SPDX-License-Identifier: Apache-2.0
#include "sublimit/implicit/detail/cage.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/mesh/sharpness.h"

namespace sublimit {
namespace {

using Eigen::Vector3d;

constexpr int relaxations = 10;
constexpr double least_angle = 10 * 3.14159265358979323846 / 180;  // that an edge is sharp at
/// Faces across an edge are as near to one side as to the other, but for this part of a cell: all are of the same one,
/// so that seams run straight.
constexpr double tied = .3;
constexpr double everything = std::numeric_limits<double>::infinity();

/// Faces of the vertex have these sides.
std::vector<std::vector<size_t>> sides_of_vertices(const Topology& topology, const std::vector<size_t>& side) {
  std::vector<std::vector<size_t>> all(size_t(topology.num_vertices()));
  for (Index f = 0; f < topology.num_faces(); ++f)
    for (const Index v : topology.vertices(Face{f})) all[size_t(v)].push_back(side[size_t(f)]);
  for (std::vector<size_t>& sides : all) {
    std::ranges::sort(sides);
    sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
  }
  return all;
}

Vector3d face_center(const Mesh& mesh, const Topology& topology, Face f) {
  Vector3d sum = Vector3d::Zero();
  for (const Index v : topology.vertices(f)) sum += mesh.positions.row(v).transpose();
  return sum / topology.size(f);
}

/// Faces that nearly all neighbours leave alone go over to them: seams run straighter.
void smooth_sides(const Topology& topology, std::vector<size_t>& side) {
  for (int round = 0; round < 4; ++round) {
    bool changed = false;
    for (Index f = 0; f < topology.num_faces(); ++f) {
      std::map<size_t, int> beside;
      for (Index i = 0; i < topology.size(Face{f}); ++i)
        ++beside[side[size_t(index(topology.face(topology.twin(topology.corner(Face{f}, i)))))]];
      for (const auto& [other, count] : beside)
        if (other != side[size_t(f)] && count + 1 >= topology.size(Face{f})) {
          side[size_t(f)] = other;
          changed = true;
          break;
        }
    }
    if (!changed) return;
  }
}

bool is_edge(const Topology& topology, Index from, Index to) {
  const HalfEdge first = topology.outgoing(Vertex{from});
  HalfEdge h = first;
  do {
    if (index(topology.head(h)) == to) return true;
    h = topology.ccw(h);
  } while (h != first);
  return false;
}

/// Where a seam turns at a corner of a single face, both of its edges come to lie along one smooth curve, and the face
/// would have a corner of 180 degrees. It is cut in two from there, so that no corner has more than about 90.
void cut_corners_of_seams(Cage& cage, const Topology& topology) {
  const std::vector<std::vector<size_t>> own = sides_of_vertices(topology, cage.side);
  std::vector<Index> sizes, corners;
  std::vector<size_t> side;
  const auto add = [&](Face f, std::initializer_list<Index> at) {
    sizes.push_back(Index(at.size()));
    for (const Index i : at) corners.push_back(topology.vertices(f)[size_t(i % topology.size(f))]);
    side.push_back(cage.side[size_t(index(f))]);
  };
  for (Index i = 0; i < topology.num_faces(); ++i) {
    const Face f{i};
    const auto is_seam = [&](Index k) {
      return cage.side[size_t(index(topology.face(topology.twin(topology.corner(f, k)))))] != cage.side[size_t(i)];
    };
    Index at = -1;
    for (Index k = 0; k < topology.size(f) && at < 0; ++k)
      if (is_seam(k) && is_seam((k + topology.size(f) - 1) % topology.size(f)) &&
          own[size_t(topology.vertices(f)[size_t(k)])].size() == 2)
        at = k;
    // A second edge between the same vertices would be no manifold.
    if (at < 0 || topology.size(f) != 4 ||
        is_edge(topology, topology.vertices(f)[size_t(at)], topology.vertices(f)[size_t((at + 2) % 4)])) {
      sizes.push_back(topology.size(f));
      corners.insert(corners.end(), topology.vertices(f).begin(), topology.vertices(f).end());
      side.push_back(cage.side[size_t(i)]);
      continue;
    }
    add(f, {at, at + 1, at + 2});
    add(f, {at, at + 2, at + 3});
  }
  cage.mesh.face_sizes = std::move(sizes);
  cage.mesh.face_vertices = std::move(corners);
  cage.side = std::move(side);
}

/// Where sides meet at an angle: creases, and corners where three or more of them end.
void tag(Cage& cage, const Topology& topology, const FieldSides& sides) {
  cage.mesh.creases.clear();
  cage.mesh.corners.clear();
  cage.rounded = 0;
  std::vector<int> ends(size_t(topology.num_vertices()), 0);
  for (Index e = 0; e < topology.num_edges(); ++e) {
    const HalfEdge h = topology.half_edge(Edge{e});
    const size_t a = cage.side[size_t(index(topology.face(h)))],
                 b = cage.side[size_t(index(topology.face(topology.twin(h))))];
    if (a == b) continue;
    const Index tail = index(topology.tail(h)), head = index(topology.head(h));
    const Vector3d middle = (cage.mesh.positions.row(tail) + cage.mesh.positions.row(head)) / 2;
    const Vector3d n = sides.jet(a, middle).gradient, m = sides.jet(b, middle).gradient;
    if (!(std::atan2(n.cross(m).norm(), n.dot(m)) > least_angle)) {
      ++cage.rounded;
      continue;
    }
    cage.mesh.creases.push_back({tail, head, infinite_sharpness});
    ++ends[size_t(tail)], ++ends[size_t(head)];
  }
  for (Index v = 0; v < topology.num_vertices(); ++v)
    if (ends[size_t(v)] > 2) cage.mesh.corners.push_back({v, infinite_sharpness});
}

/// Vertices move to the middle of the faces around them, along the surface; those of a crease between its neighbours.
void relax(Cage& cage, const Topology& topology, const FieldSides& sides, int rounds) {
  const std::vector<std::vector<size_t>> own = sides_of_vertices(topology, cage.side);
  const double reach = cage.cell;
  Points& positions = cage.mesh.positions;
  const auto moved = [&](Index v, const Vector3d& to) -> Vector3d {
    const Vector3d here = positions.row(v);
    const Projection p = sides.project(own[size_t(v)], to, reach);
    if (p.converged && (p.point - here).norm() <= 2 * reach) return p.point;
    const Projection stay = sides.project(own[size_t(v)], here, 2 * reach);
    return stay.converged ? stay.point : here;
  };
  for (int round = 0; round <= rounds; ++round) {
    Points next(positions.rows(), 3);
    parallel_for(topology.num_vertices(), [&](std::int64_t i) {
      const Index v = Index(i);
      const Vector3d here = positions.row(v);
      if (round == 0 || own[size_t(v)].size() > 2) {
        next.row(v) = moved(v, here);
        return;
      }
      const bool on_seam = own[size_t(v)].size() == 2;
      Vector3d sum = Vector3d::Zero();
      int count = 0;
      const HalfEdge first = topology.outgoing(Vertex{v});
      HalfEdge h = first;
      do {
        const bool seam =
            cage.side[size_t(index(topology.face(h)))] != cage.side[size_t(index(topology.face(topology.twin(h))))];
        if (!on_seam)
          sum += face_center(cage.mesh, topology, topology.face(h)), ++count;
        else if (seam)
          sum += positions.row(index(topology.head(h))).transpose(), ++count;
        h = topology.ccw(h);
      } while (h != first);
      const Vector3d to = on_seam && count != 2 ? here : Vector3d(sum / count);
      next.row(v) = moved(v, .3 * here + .7 * to);
    });
    positions = std::move(next);
  }
}

void finish(Cage& cage, const FieldSides& sides, int rounds) {
  const Topology topology(view(cage.mesh));
  relax(cage, topology, sides, rounds);
  if (sides.has_edges()) tag(cage, topology, sides);
}

}  // namespace

FieldSides::FieldSides(FieldPointer field, bool sharp)
    : field_(std::move(field)), sharp_(sharp && field_->has_edges()) {}

size_t FieldSides::side_at(const Vector3d& x, double width) const {
  if (!sharp_) return 0;
  const double steep = field_->jet(x).gradient.norm();
  size_t least = std::numeric_limits<size_t>::max();
  for (const FieldPiece& piece : field_->pieces(x, width * steep)) least = std::min(least, piece.name);
  return least;
}

FieldJet FieldSides::jet(size_t side, const Vector3d& x) const {
  if (!sharp_) return field_->jet(x);
  for (const FieldPiece& piece : field_->pieces(x, everything))
    if (piece.name == side) return piece.jet;
  return field_->jet(x);
}

Projection FieldSides::project(std::span<const size_t> sides, const Vector3d& x, double reach) const {
  if (!sharp_) return sublimit::project(*field_, x, reach);
  constexpr double eps = std::numeric_limits<double>::epsilon();
  Projection result{x, {}, false};
  const auto count = Eigen::Index(sides.size());
  for (int step = 0; step < 20; ++step) {
    Eigen::Matrix<double, Eigen::Dynamic, 3> J(count, 3);
    Eigen::VectorXd values(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const FieldJet jet = this->jet(sides[size_t(i)], result.point);
      if (i == 0) result.jet = jet;
      const double length = jet.gradient.norm();
      if (!(length > 0) || !std::isfinite(length)) return result;
      J.row(i) = jet.gradient / length;
      values[i] = jet.value / length;
    }
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> factors(J);
    factors.setThreshold(1e-3);  // sides that nearly touch do not throw places far away
    const Vector3d move = -factors.solve(values);
    if (move.norm() <= 4 * eps * (reach + result.point.norm())) {
      result.converged = values.cwiseAbs().maxCoeff() <= 1e-10 * reach;
      return result;
    }
    result.point += move;
    if ((result.point - x).norm() > reach) return result;
  }
  return result;
}

Cage make_cage(Mesh mesh, const FieldSides& sides, double cell) {
  Cage cage{.mesh = std::move(mesh), .side = {}, .cell = cell};
  const Topology topology(view(cage.mesh));
  for (Index v = 0; v < topology.num_vertices(); ++v) {
    const Projection p = project(sides.field(), cage.mesh.positions.row(v).transpose(), cell);
    if (p.converged) cage.mesh.positions.row(v) = p.point;
  }
  for (Index f = 0; f < topology.num_faces(); ++f)
    cage.side.push_back(sides.side_at(face_center(cage.mesh, topology, Face{f}), tied * cell));
  if (sides.has_edges()) {
    smooth_sides(topology, cage.side);
    cut_corners_of_seams(cage, topology);
  }
  finish(cage, sides, relaxations);
  return cage;
}

Cage split(const Cage& cage, const FieldSides& sides) {
  const Topology topology(view(cage.mesh));
  const Index V = topology.num_vertices(), E = topology.num_edges(), F = topology.num_faces();
  const bool triangles = topology.uniform_face_size() == 3;
  Cage fine{.mesh = {}, .side = {}, .cell = cage.cell / 2};
  Points& positions = fine.mesh.positions;
  positions.resize(V + E + (triangles ? 0 : F), 3);
  positions.topRows(V) = cage.mesh.positions;
  for (Index e = 0; e < E; ++e)
    positions.row(V + e) = (cage.mesh.positions.row(index(topology.tail(Edge{e}))) +
                            cage.mesh.positions.row(index(topology.head(Edge{e})))) /
                           2;
  const auto add = [&](std::initializer_list<Index> corners, Index f) {
    fine.mesh.face_sizes.push_back(Index(corners.size()));
    fine.mesh.face_vertices.insert(fine.mesh.face_vertices.end(), corners);
    fine.side.push_back(cage.side[size_t(f)]);
  };
  for (Index f = 0; f < F; ++f) {
    if (!triangles) positions.row(V + E + f) = face_center(cage.mesh, topology, Face{f});
    const Index n = topology.size(Face{f});
    const auto middle = [&](Index i) { return V + index(topology.edge(topology.corner(Face{f}, (i + n) % n))); };
    for (Index i = 0; i < n; ++i) {
      const Index v = topology.vertices(Face{f})[size_t(i)];
      if (triangles)
        add({v, middle(i), middle(i - 1)}, f);
      else
        add({v, middle(i), V + E + f, middle(i - 1)}, f);
    }
    if (triangles) add({middle(0), middle(1), middle(2)}, f);
  }
  finish(fine, sides, relaxations / 2);
  return fine;
}

Cage triangulated(const Cage& cage, const FieldSides& sides) {
  Cage result = cage;
  result.mesh.face_sizes.clear();
  result.mesh.face_vertices.clear();
  result.side.clear();
  const Points& positions = cage.mesh.positions;
  // A diagonal may be that of another quad with the same two corners: of valence 2, which there is none of, or around
  // a handle of three quads; then the other one is taken.
  std::set<std::pair<Index, Index>> edges;
  const auto ordered = [](Index a, Index b) { return std::pair(std::min(a, b), std::max(a, b)); };
  size_t first = 0;
  for (const Index size : cage.mesh.face_sizes) {
    for (Index i = 0; i < size; ++i)
      edges.insert(
          ordered(cage.mesh.face_vertices[first + size_t(i)], cage.mesh.face_vertices[first + size_t((i + 1) % size)]));
    first += size_t(size);
  }
  first = 0;
  for (size_t f = 0; f < cage.mesh.face_sizes.size(); ++f) {
    const Index* const v = &cage.mesh.face_vertices[first];
    const Index size = cage.mesh.face_sizes[f];
    first += size_t(size);
    const auto add = [&](Index a, Index b, Index c) {
      result.mesh.face_sizes.push_back(3);
      result.mesh.face_vertices.insert(result.mesh.face_vertices.end(), {a, b, c});
      result.side.push_back(cage.side[f]);
    };
    if (size == 3) {
      add(v[0], v[1], v[2]);
      continue;
    }
    const auto length = [&](Index a, Index b) { return (positions.row(a) - positions.row(b)).norm(); };
    bool even = length(v[0], v[2]) <= length(v[1], v[3]);
    if (edges.contains(even ? ordered(v[0], v[2]) : ordered(v[1], v[3]))) even = !even;
    edges.insert(even ? ordered(v[0], v[2]) : ordered(v[1], v[3]));
    if (even)
      add(v[0], v[1], v[2]), add(v[0], v[2], v[3]);
    else
      add(v[0], v[1], v[3]), add(v[1], v[2], v[3]);
  }
  finish(result, sides, 0);
  return result;
}

}  // namespace sublimit
