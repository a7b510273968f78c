// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/bake/detail/pattern_edits.h"

#include <algorithm>
#include <string>
#include <type_traits>
#include <unordered_map>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/stencils/bake/detail/bake_patterns.h"

namespace sublimit {
namespace {

template <class Real>
PatternTable<Real> in_precision(const PatternTable<double>& table) {
  if constexpr (std::is_same_v<Real, float>)
    return in_float(table);
  else
    return table;
}

std::pair<Index, Index> edge_key(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

}  // namespace

template <class Real>
PatternEdits<Real>::PatternEdits(Patterns& patterns, Mesh mesh, int level, const SubdivisionOptions& options,
                                 bool limit)
    : patterns_(&patterns), options_(options), level_(level), limit_(limit), num_vertices_(mesh.num_vertices()) {
  mesh.face_varying.clear();
  const BakeRequest request{.rows = limit ? TableRows::limit : TableRows::level, .level = level};
  check(request);
  // An edit may join sheets in an edge, where those of schemes that turn have points of their own.
  if (patterns.scheme().period > 1)
    throw UnsupportedTopology(patterns.scheme().name + ": a table can be edited where each level keeps edges");
  // Who has a point must be known from the faces there alone.
  const std::optional<Baked> made =
      bake_by_patterns(patterns, patterns.control_level(mesh, options), request, {.owners = OwnerRule::first});
  if (!made || !made->table.lattices)
    throw UnsupportedTopology(patterns.scheme().name +
                              ": a table can be edited where all faces are cut into four of their kind");
  const Baked& baked = *made;
  const FaceLattices& lattices = *baked.table.lattices;
  if (!lattices.has_addresses())
    throw UnsupportedTopology(patterns.scheme().name + ": a table can be edited where faces need no preparation");
  lattice_ = lattices.lattice();
  ranks_ = LatticeRanks(lattice_);
  base_ = std::make_shared<const Prepared>(in_precision<Real>(baked.table.table));
  faces_.resize(size_t(mesh.num_faces()));
  faces_of_.resize(size_t(num_vertices_));
  const Index sides = lattice_.num_sides();
  for (Index f = 0; f < mesh.num_faces(); ++f) {
    FaceState& face = faces_[f];
    face.corners.assign(mesh.face_vertices.begin() + f * sides, mesh.face_vertices.begin() + (f + 1) * sides);
    face.turn = lattices.place(f).turn;
    face.share = FaceLattices::share(lattices.arrays(), f);
    face.first_point = lattices.arrays().first_points[f];
    ranks_.add(face.share);
    for (const Index v : face.corners)
      if (faces_of_[v].empty() || faces_of_[v].back() != f) faces_of_[v].push_back(f);
  }
  for (const Mesh::Crease& crease : mesh.creases) set_crease(crease.tail, crease.head, crease.sharpness);
  for (const Mesh::Corner& corner : mesh.corners) corners_[corner.vertex] = corner.sharpness;
  tags_.boundary = mesh.boundary;
  tags_.creasing = mesh.creasing;
  tags_.triangles = mesh.triangles;
}

template <class Real>
void PatternEdits<Real>::set_crease(Index a, Index b, float sharpness) {
  if (sharpness > 0)
    creases_[edge_key(a, b)] = sharpness;
  else
    creases_.erase(edge_key(a, b));
}

template <class Real>
std::vector<Index> PatternEdits<Real>::faces_around(const std::set<Index>& vertices) const {
  std::vector<Index> faces;
  for (const Index v : vertices) faces.insert(faces.end(), faces_of_[v].begin(), faces_of_[v].end());
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

template <class Real>
Level PatternEdits<Real>::local_level(const std::vector<Index>& faces, std::vector<Index>& vertices) const {
  Mesh local = tags_;
  std::unordered_map<Index, Index> number;
  for (const Index f : faces) {
    local.face_sizes.push_back(static_cast<Index>(faces_[f].corners.size()));
    for (const Index v : faces_[f].corners) {
      const auto [at, is_new] = number.try_emplace(v, static_cast<Index>(vertices.size()));
      if (is_new) vertices.push_back(v);
      local.face_vertices.push_back(at->second);
    }
  }
  local.positions = Points::Zero(vertices.size(), 3);
  size_t corner = 0;
  for (const Index f : faces) {
    const std::vector<Index>& own = faces_[f].corners;
    for (size_t k = 0; k < own.size(); ++k) {
      const size_t next = (k + 1) % own.size();
      if (const auto at = creases_.find(edge_key(own[k], own[next])); at != creases_.end())
        local.creases.push_back({local.face_vertices[corner + k], local.face_vertices[corner + next], at->second});
    }
    corner += own.size();
  }
  for (size_t v = 0; v < vertices.size(); ++v)
    if (const auto at = corners_.find(vertices[v]); at != corners_.end())
      local.corners.push_back({static_cast<Index>(v), at->second});
  return patterns_->control_level(local, options_);
}

/// The face of the lowest number at the edge.
template <class Real>
typename PatternEdits<Real>::Owner PatternEdits<Real>::side_owner(Index face, int corner) const {
  const std::vector<Index>& own = faces_[face].corners;
  const Index a = own[corner], b = own[(corner + 1) % own.size()];
  for (const Index f : faces_of_[a]) {
    const std::vector<Index>& c = faces_[f].corners;
    for (size_t k = 0; k < c.size(); ++k) {
      const Index from = c[k], to = c[(k + 1) % c.size()];
      if (from == a && to == b) return {f, static_cast<int>(k), false};
      if (from == b && to == a) return {f, static_cast<int>(k), true};
    }
  }
  return {face, corner, false};
}

template <class Real>
typename PatternEdits<Real>::Owner PatternEdits<Real>::corner_owner(Index face, int corner) const {
  const Index v = faces_[face].corners[corner];
  const Index f = faces_of_[v].front();
  const std::vector<Index>& c = faces_[f].corners;
  return {f, static_cast<int>(std::find(c.begin(), c.end(), v) - c.begin()), false};
}

template <class Real>
MeshChange PatternEdits<Real>::edit(const MeshEdit& edit) {
  // All of it is checked before any of it is done.
  const auto fail = [](const std::string& what) { throw InvalidParameter("edit: " + what); };
  const int sides = lattice_.num_sides();
  std::set<Index> touched;
  for (const Index f : edit.removed_faces) {
    if (f < 0 || f >= num_faces() || is_removed(f)) fail("face " + std::to_string(f) + " does not exist");
    touched.insert(faces_[f].corners.begin(), faces_[f].corners.end());
  }
  if (edit.added_vertices < 0) fail("a negative number of vertices");
  const Index all_vertices = num_vertices_ + edit.added_vertices;
  for (const std::vector<Index>& face : edit.added_faces) {
    if (int(face.size()) != sides)
      throw UnsupportedTopology("edit: a face of " + std::to_string(face.size()) +
                                " corners; this table is of faces of " + std::to_string(sides) +
                                ", and a new one is needed");
    for (size_t k = 0; k < face.size(); ++k) {
      if (face[k] < 0 || face[k] >= all_vertices) fail("vertex " + std::to_string(face[k]) + " does not exist");
      if (std::count(face.begin(), face.end(), face[k]) > 1)
        throw InvalidMesh("edit: a face has vertex " + std::to_string(face[k]) + " twice");
    }
    touched.insert(face.begin(), face.end());
  }
  const auto check_vertex = [&](Index v) {
    if (v < 0 || v >= all_vertices) fail("vertex " + std::to_string(v) + " does not exist");
    touched.insert(v);
  };
  const auto has_edge = [](const std::vector<Index>& face, Index a, Index b) {
    for (size_t k = 0; k < face.size(); ++k)
      if (edge_key(face[k], face[(k + 1) % face.size()]) == edge_key(a, b)) return true;
    return false;
  };
  for (const Mesh::Crease& c : edit.creases) {
    check_vertex(c.tail), check_vertex(c.head);
    bool found = false;
    for (const std::vector<Index>& face : edit.added_faces) found |= has_edge(face, c.tail, c.head);
    for (const Index f : c.tail < num_vertices_ ? faces_of_[c.tail] : std::vector<Index>())
      found |= has_edge(faces_[f].corners, c.tail, c.head);
    if (!found)
      fail("no face has an edge between vertices " + std::to_string(c.tail) + " and " + std::to_string(c.head) +
           "; a crease runs along edges");
    if (!(c.sharpness >= 0)) fail("a sharpness of " + format_number(c.sharpness) + "; 0 or more is right");
  }
  for (const Mesh::Corner& c : edit.corners) {
    check_vertex(c.vertex);
    if (!(c.sharpness >= 0)) fail("a sharpness of " + format_number(c.sharpness) + "; 0 or more is right");
  }

  std::set<Index> removed(edit.removed_faces.begin(), edit.removed_faces.end());
  num_vertices_ = all_vertices;
  faces_of_.resize(size_t(all_vertices));
  for (const Index f : removed) {
    for (const Index v : faces_[f].corners) std::erase(faces_of_[v], f);
    faces_[f] = {};
    edited_.erase(f);
  }
  for (const std::vector<Index>& corners : edit.added_faces) {
    const Index f = num_faces();
    faces_.emplace_back().corners = corners;
    for (const Index v : corners) faces_of_[v].push_back(f);
  }
  for (const Mesh::Crease& c : edit.creases) set_crease(c.tail, c.head, c.sharpness);
  for (const Mesh::Corner& c : edit.corners) {
    if (c.sharpness > 0)
      corners_[c.vertex] = c.sharpness;
    else
      corners_.erase(c.vertex);
  }

  // Walks of as many rings see the change.
  const auto with_neighbors = [&](const std::vector<Index>& faces) {
    std::set<Index> vertices;
    for (const Index f : faces) vertices.insert(faces_[f].corners.begin(), faces_[f].corners.end());
    return faces_around(vertices);
  };
  MeshChange change;
  change.faces = faces_around(touched);
  Sharpness rules;
  rules.creasing = options_.creasing.value_or(tags_.creasing.value_or(Creasing::uniform));
  const int rings = patterns_->types()->pieces().rings(rules);
  for (int ring = 1; ring < rings; ++ring) change.faces = with_neighbors(change.faces);
  std::vector<Index> around = change.faces, vertices;
  for (int ring = 0; ring < rings; ++ring) around = with_neighbors(around);
  if (!change.faces.empty()) {
    const Level level = local_level(around, vertices);
    const auto kind = lattice_.triangle ? Piece::Kind::triangle : Piece::Kind::quad;
    for (const Index f : change.faces) {
      const auto local = static_cast<Index>(std::lower_bound(around.begin(), around.end(), f) - around.begin());
      const Piece piece{kind, level.topology().first(Face{local})};
      const Patterns::Match match = patterns_->match(level, piece);
      FaceState& face = faces_[f];
      face.pattern = match.pattern;
      face.turn = static_cast<std::int8_t>(match.turn);
      face.vertices.clear();
      for (const Index v : match.vertices) face.vertices.push_back(vertices[v]);
      face.is_edited = true;
      edited_.insert(f);
      const Patterns::Example example{level, piece, match.turn};
      face.weights = limit_ ? &patterns_->limit_rows(*match.pattern, example, level_)
                            : &patterns_->rows(*match.pattern, example, level_);
    }
  }
  for (const Index f : change.faces) {
    FaceState& face = faces_[f];
    int share = 0;
    for (int k = 0; k < sides; ++k) {
      const int corner = (face.turn + k) % sides;
      const Owner side = side_owner(f, corner), at = corner_owner(f, corner);
      if (side.face == f && side.corner == corner) share |= 1 << k;
      if (at.face == f && at.corner == corner) share |= 16 << k;
    }
    face.share = static_cast<LatticeRanks::Share>(share);
    ranks_.add(face.share);
  }
  rebuild();
  change.first_points = base_->table.num_points();
  return change;
}

/// The table of all edited faces.
template <class Real>
void PatternEdits<Real>::rebuild() {
  typename PatternTable<double>::Arrays arrays;
  std::map<size_t, std::int32_t> blocks;
  std::vector<double> weights;
  std::vector<std::int32_t> rows, columns;
  std::int64_t next = base_->table.num_points();
  // Patches of a block and share together; faces keep the order of their numbers within.
  std::map<std::pair<std::int32_t, LatticeRanks::Share>, std::vector<Index>> groups;
  for (const Index f : edited_) {
    const Pattern& pattern = *faces_[f].pattern;
    const auto [at, is_new] = blocks.try_emplace(pattern.number, static_cast<std::int32_t>(arrays.blocks.size()));
    if (is_new) {
      const RowMatrix& W = *faces_[f].weights;
      arrays.blocks.push_back({static_cast<std::int32_t>(W.rows()), static_cast<std::int32_t>(W.cols()),
                               static_cast<std::int64_t>(weights.size())});
      weights.insert(weights.end(), W.data(), W.data() + W.size());
    }
    groups[{at->second, faces_[f].share}].push_back(f);
  }
  for (const auto& [key, faces] : groups) {
    const std::vector<std::int32_t> own = LatticeRanks::rows(lattice_, key.second);
    for (const Index f : faces) {
      faces_[f].first_point = next;
      next += std::int64_t(own.size());
      if (!own.empty()) columns.insert(columns.end(), faces_[f].vertices.begin(), faces_[f].vertices.end());
    }
    if (own.empty()) continue;
    arrays.groups.push_back({key.first, static_cast<std::int32_t>(own.size()), static_cast<std::int64_t>(rows.size()),
                             static_cast<std::int64_t>(faces.size())});
    rows.insert(rows.end(), own.begin(), own.end());
  }
  arrays.weights = std::move(weights);
  arrays.rows = std::move(rows);
  arrays.columns = std::move(columns);
  edits_ = std::make_shared<const Prepared>(in_precision<Real>(PatternTable<double>(num_vertices_, std::move(arrays))));
}

template <class Real>
std::int64_t PatternEdits<Real>::num_points() const {
  return base_->table.num_points() + (edits_ ? edits_->table.num_points() : 0);
}

template <class Real>
void PatternEdits<Real>::apply(std::span<const Real> points, int channels, std::span<Real> result) const {
  if (channels < 1 || std::int64_t(points.size()) != std::int64_t{num_vertices_} * channels ||
      std::int64_t(result.size()) != num_points() * channels)
    throw InvalidParameter("editable table: points hold " + std::to_string(points.size()) + " numbers and the result " +
                           std::to_string(result.size()) + "; " + std::to_string(num_vertices_) + " and " +
                           std::to_string(num_points()) + " x " + std::to_string(channels) + " channels are needed");
  const size_t of_base = size_t(base_->table.num_points()) * size_t(channels);
  base_->evaluator.apply(points.first(size_t(base_->table.num_control_points()) * size_t(channels)), channels,
                         result.first(of_base));
  if (edits_) edits_->evaluator.apply(points, channels, result.subspan(of_base));
}

template <class Real>
std::int64_t PatternEdits<Real>::point(Index face, std::int32_t row) const {
  const int sides = lattice_.num_sides();
  const auto own = [&](Index f, std::int32_t r) { return faces_[f].first_point + ranks_.rank(faces_[f].share, r); };
  if (ranks_.rank(faces_[face].share, row) >= 0) return own(face, row);
  const auto [side, step] = ranks_.on_side(row);
  const int corner = (faces_[face].turn + side) % sides;
  const Owner owner = step == 0 ? corner_owner(face, corner) : side_owner(face, corner);
  const int there = (owner.corner - faces_[owner.face].turn + sides) % sides;
  return own(owner.face, lattice_.on_side(there, owner.reversed ? lattice_.n - step : step));
}

template <class Real>
Mesh PatternEdits<Real>::mesh() const {
  Mesh mesh = tags_;
  mesh.positions = Points::Zero(num_vertices_, 3);
  for (const FaceState& face : faces_) {
    if (face.corners.empty()) continue;
    mesh.face_sizes.push_back(static_cast<Index>(face.corners.size()));
    mesh.face_vertices.insert(mesh.face_vertices.end(), face.corners.begin(), face.corners.end());
  }
  for (const auto& [edge, sharpness] : creases_) mesh.creases.push_back({edge.first, edge.second, sharpness});
  for (const auto& [vertex, sharpness] : corners_) mesh.corners.push_back({vertex, sharpness});
  return mesh;
}

template class PatternEdits<float>;
template class PatternEdits<double>;

}  // namespace sublimit
