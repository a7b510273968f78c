// SPDX-License-Identifier: Apache-2.0
#include "sublimit/surface/detail/limit_map_parts.h"

#include <algorithm>
#include <string>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/neighborhood/vertex_sides.h"
#include "sublimit/scheme/detail/made_by.h"

namespace sublimit {

const PieceMap& quarter_map(int corner) {
  static const std::array<PieceMap, 4> maps = [] {
    using Axis = PieceMap::Axis;
    std::array<PieceMap, 4> m;
    m[0].axes = {Axis{0, Span::lower, false}, Axis{1, Span::lower, false}};
    m[1].axes = {Axis{1, Span::lower, false}, Axis{0, Span::upper, true}};
    m[2].axes = {Axis{0, Span::upper, true}, Axis{1, Span::upper, true}};
    m[3].axes = {Axis{1, Span::upper, true}, Axis{0, Span::lower, false}};
    return m;
  }();
  return maps[corner];
}

namespace {

/// The quarters as they lie.
const PieceMap& aligned_quarter_map(int corner) {
  static const std::array<PieceMap, 4> maps = [] {
    using Axis = PieceMap::Axis;
    std::array<PieceMap, 4> m;
    for (int i = 0; i < 4; ++i)
      m[i].axes = {Axis{0, i == 1 || i == 2 ? Span::upper : Span::lower, false},
                   Axis{1, i >= 2 ? Span::upper : Span::lower, false}};
    return m;
  }();
  return maps[corner];
}

std::optional<Level> prepared_level(const Scheme<double>& scheme, const Level& level) {
  if (level.number > 0 || scheme.preparation.empty() || level.topology().uniform_face_size() == scheme.corners)
    return std::nullopt;
  if (scheme.preparation.size() != 1 || scheme.preparation[0].split != Split::pqq)
    throw UnsupportedTopology(
        scheme.name +
        ": limits at any place are known of faces that are cut into one quadrilateral for each corner "
        "first (the option quads=catmull-clark), not for each edge");
  Scheme<double> first = scheme;
  first.steps = scheme.preparation;
  first.preparation.clear();
  Level prepared = next_level(first, level);
  prepared.made_by = level.made_by;  // a part of its way to the next level
  return prepared;
}

Scheme<double> without_preparation(Scheme<double> scheme) {
  scheme.preparation.clear();
  return scheme;
}

/// The dictionary that is shared, or one of its own where there is none or it is full.
/// @throws InvalidParameter  it is of another scheme
std::shared_ptr<LimitCache> dictionary(const Scheme<double>& scheme, const Level& level,
                                       std::shared_ptr<LimitCache> shared) {
  if (shared) check_same_scheme(scheme, shared->scheme(), level, "the cache");
  if (!shared || shared->pieces().is_full()) shared = std::make_shared<LimitCache>(scheme);
  shared->trust(level);
  return shared;
}

}  // namespace

LimitMap::Parts::Parts(const Scheme<double>& s, Level l, std::shared_ptr<LimitCache> shared)
    : scheme(without_preparation(check_scheme(s))),
      level(std::move(l)),
      prepared(prepared_level(s, level)),
      preparing(prepared ? std::optional(s) : std::nullopt),
      addresses(level.topology(), scheme.face_size() == 3),
      types(dictionary(scheme, level, std::move(shared))),
      corners(*types, base()) {
  if (level.number % scheme.period != 0)
    throw InvalidParameter(scheme.name + ": limits are taken from levels whose number is a multiple of " +
                           std::to_string(scheme.period) + ", not from level " + std::to_string(level.number));
}

LimitMap::Parts::Target LimitMap::Parts::target(const Place& s) const {
  const Topology& t = level.topology();
  const Addresses::FaceCorner at = addresses.place(s.face);
  if (prepared) {
    // Children of a quadrilateral keep its corners' positions, those of a polygon's corner begin with it.
    const Refinement& step = prepared->steps[0];
    const PieceCoordinates whole = quad_place(s.u, s.v);
    const int corner = at.corner >= 0 ? at.corner : nearest_corner(s.u, s.v);
    const HalfEdge child = step.halves(t, t.corner(at.face, corner)).first;
    const HalfEdge start = step.topology.first(step.topology.face(child));
    if (at.corner >= 0) return {{Kind::quad, start}, whole};
    const PieceMap& map = aligned_quarter_map(corner);
    return {{Kind::quad, start}, map(whole), &map, whole};
  }
  if (addresses.triangles()) return {{Kind::triangle, t.first(at.face)}, triangle_place(s.u, s.v)};
  if (at.corner >= 0)
    return {{scheme.is_dual() ? Kind::corner : Kind::cut, t.corner(at.face, at.corner)}, quad_place(s.u, s.v)};
  const PieceCoordinates whole = quad_place(s.u, s.v);
  if (!scheme.is_dual()) return {{Kind::quad, t.first(at.face)}, whole};
  const int corner = nearest_corner(s.u, s.v);
  const PieceMap& map = quarter_map(corner);
  return {{Kind::corner, t.corner(at.face, corner)}, map(whole), &map, whole};
}

bool LimitMap::Parts::is_on_cut(HalfEdge h) const {
  const Topology& t = base().topology();
  if (is_infinite(base().sharpness.vertex[index(t.tail(h))])) return true;
  int cut = 0;
  HalfEdge g = h;
  do {
    if (!exists(t.twin(g))) return true;
    if (cuts(g)) ++cut;
    g = t.next(t.twin(g));
  } while (g != h);
  return cut >= 2;  // one alone is a dart
}

unsigned LimitMap::Parts::sides(const Piece& piece) const {
  const Topology& t = base().topology();
  HalfEdge h = piece.start;
  unsigned bits = base().holes[index(t.face(h))] ? hole : 0;
  if (types->pieces().regular_smoothness() > 0 && is_regular(piece)) return bits;
  if (piece.kind == Kind::quad || piece.kind == Kind::triangle) {
    for (int k = 0; k < (piece.kind == Kind::quad ? 4 : 3); ++k, h = t.next(h)) {
      if (cuts(h)) bits |= 1u << k;
      if (is_on_cut(h)) bits |= first_corner << k;
    }
  } else {
    if (cuts(h)) bits |= 1;
    if (cuts(t.prev(h))) bits |= 8;
    if (is_on_cut(h)) bits |= first_corner;
  }
  return bits;
}

std::optional<Centre> LimitMap::Parts::centre(const Target& target) const {
  const Topology& t = base().topology();
  const PieceCoordinates& p = target.place;
  HalfEdge h = target.piece.start;
  using Of = Centre::Kind;
  switch (target.piece.kind) {
    case Kind::triangle:
      if (p.u == 0 && p.v == 0) return Centre{Of::vertex, h};
      if (p.v == 0 && p.u1 == 0) return Centre{Of::vertex, t.next(h)};
      if (p.u == 0 && p.u1 == 0) return Centre{Of::vertex, t.prev(h)};
      return std::nullopt;
    case Kind::quad:
      if ((p.u != 0 && p.u1 != 0) || (p.v != 0 && p.v1 != 0)) return std::nullopt;
      for (int turns = p.v == 0 ? (p.u == 0 ? 0 : 1) : (p.u == 0 ? 3 : 2); turns > 0; --turns) h = t.next(h);
      return Centre{Of::vertex, h};
    default:
      if (p.u == 0 && p.v == 0) return Centre{Of::vertex, h};
      if (p.u1 == 0 && p.v1 == 0) return Centre{Of::face, h};
      if (target.piece.kind != Kind::corner) return std::nullopt;
      if (p.u1 == 0 && p.v == 0 && !exists(t.twin(h))) return Centre{Of::border, h};
      if (p.u == 0 && p.v1 == 0 && !exists(t.twin(t.prev(h)))) return Centre{Of::border, t.prev(h)};
      return std::nullopt;
  }
}

std::vector<LimitRows> LimitMap::Parts::found_control_limits() const {
  const Index count = level.topology().num_vertices();
  std::vector<LimitRows> limits(static_cast<size_t>(count));
  std::vector<Index> vertices;
  std::vector<Centre> centres;
  for (Index v = 0; v < count; ++v)
    if (!level.topology().is_isolated(Vertex{v})) {
      vertices.push_back(v);
      centres.push_back(first_side(level, level.topology().fans(Vertex{v}).front()));
    }
  try {
    LimitCache cache(*preparing);
    std::vector<LimitRows> rows = limit_rows(level, cache, centres);
    for (size_t i = 0; i < rows.size(); ++i) limits[size_t(vertices[i])] = std::move(rows[i]);
  } catch (const AnalysisError&) {
    // A vertex has no limit: all positions are those of pieces.
  }
  return limits;
}

std::optional<LimitRows::Row> LimitMap::Parts::vertex_position(const Target& target) const {
  const std::optional<Centre> at = centre(target);
  if (!at || at->kind != Centre::Kind::vertex) return std::nullopt;
  // Left to do: at a vertex of two faces the parameters of mid-edge surfaces lead to the middle of the face opposite.
  const Topology& t = base().topology();
  const HalfEdge other = t.ccw(at->start);
  const bool two_faces = exists(other) && other != at->start && t.ccw(other) == at->start;
  if (two_faces && scheme.is_dual() && scheme.period > 1) return std::nullopt;
  if (!prepared) return corners.position(at->start);
  const Refinement& step = prepared->steps[0];
  const Vertex v = step.topology.tail(at->start);
  if (step.origin(v) != Refinement::Origin::vertex) return std::nullopt;
  const std::vector<LimitRows>& limits = control_limits_.get([this] { return found_control_limits(); });
  const LimitRows& limit = limits[size_t(step.parent(v))];
  if (limit.rows.size() == 0) return std::nullopt;
  return limit.position();
}

LimitMap::Parts::Regular LimitMap::Parts::found_regular() const {
  Regular regular;
  const Topology& t = base().topology();
  const int corners = addresses.triangles() ? 3 : 4;
  if (t.uniform_face_size() != corners || scheme.is_dual() || !base().intervals.empty() ||
      types->pieces().rings(base().sharpness) != 1)
    return regular;
  regular.faces.emplace(base(), corners);
  std::vector<Index> points(size_t(regular.faces->num_points()));
  for (Index f = 0; f < t.num_faces(); ++f) {
    if (!regular.faces->points(Face{f}, points.data())) continue;
    PieceWalker walker;
    const Piece piece{corners == 3 ? Kind::triangle : Kind::quad, t.first(Face{f})};
    const PieceWalk& walk = walker.walk(base(), piece, 1, scheme.period);
    if (walk.vertices == points) regular.type = types->pieces().type(base(), piece, walk);
    return regular;
  }
  return regular;
}

const PieceType* LimitMap::Parts::type_of(const Piece& piece, std::vector<Index>& vertices) const {
  if (piece.kind == Kind::quad || piece.kind == Kind::triangle)
    if (const Regular& known = regular(); known.type) {
      vertices.resize(size_t(known.faces->num_points()));
      if (known.faces->points(base().topology().face(piece.start), vertices.data())) return known.type;
    }
  static thread_local PieceWalker walker;
  const PieceWalk& walk = walker.walk(base(), piece, types->pieces().rings(base().sharpness), scheme.period);
  vertices = walk.vertices;
  return types->pieces().type(base(), piece, walk);
}

Piece LimitMap::Parts::piece(Index number) const {
  const Topology& t = base().topology();
  if (prepared) return {Kind::quad, t.first(Face{number})};
  if (scheme.is_dual()) return {Kind::corner, HalfEdge{number}};
  const Addresses::FaceCorner at = addresses.place(number);
  if (at.corner >= 0) return {Kind::cut, t.corner(at.face, at.corner)};
  return {addresses.triangles() ? Kind::triangle : Kind::quad, t.first(at.face)};
}

void LimitMap::Parts::check_points(const Points& points, const char* what) const {
  if (points.cols() != 3 || points.rows() != level.topology().num_vertices())
    throw InvalidParameter(std::string(what) + " need a point of three coordinates for each vertex");
}

Points LimitMap::Parts::points_of_pieces(const Points& points, const char* what) const {
  check_points(points, what);
  return prepared ? Points(prepared->S * points) : points;
}

const LimitMap::Parts::Pieces& LimitMap::Parts::pieces() const {
  return pieces_.get([this] { return found_pieces(); });
}

NoLimit LimitMap::Parts::without_limit(const Piece& piece, const std::string& why) const {
  Index face = index(base().topology().face(piece.start));
  if (prepared) face = prepared->steps[0].face_parent[face];
  return {"some place of face " + std::to_string(face), why};
}

LimitMap::Parts::Pieces LimitMap::Parts::found_pieces() const {
  const Index count = num_pieces();
  struct Block {
    std::vector<Index> vertices, sizes;
  };
  std::vector<Block> blocks(num_blocks(count, 1024));
  Pieces all;
  all.types.resize(count);
  parallel_for_blocks(
      count,
      [&](std::int64_t b, std::int64_t begin, std::int64_t end) {
        std::vector<Index> vertices;
        for (std::int64_t i = begin; i < end; ++i) {
          all.types[i] = type_of(piece(static_cast<Index>(i)), vertices);
          blocks[b].vertices.insert(blocks[b].vertices.end(), vertices.begin(), vertices.end());
          blocks[b].sizes.push_back(static_cast<Index>(vertices.size()));
        }
      },
      1024);
  all.first.assign(1, 0);
  for (const Block& block : blocks) {
    all.vertices.insert(all.vertices.end(), block.vertices.begin(), block.vertices.end());
    for (const Index size : block.sizes) all.first.push_back(all.first.back() + size);
  }
  std::vector<const PieceType*> distinct(all.types);
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  std::vector<std::unique_ptr<const PatchTree>> trees(distinct.size());
  std::vector<std::string> why(distinct.size());  // there is none
  parallel_for_blocks(
      static_cast<std::int64_t>(distinct.size()),
      [&](std::int64_t i, std::int64_t, std::int64_t) {
        try {
          trees[i] = std::make_unique<const PatchTree>(*distinct[i]);
        } catch (const AnalysisError& error) {
          why[i] = error.what();
        }
      },
      1);
  const auto number_of = [&](const PieceType* type) {
    return std::lower_bound(distinct.begin(), distinct.end(), type) - distinct.begin();
  };
  if (std::ranges::any_of(why, [](const std::string& reason) { return !reason.empty(); }))
    for (Index i = 0; i < count; ++i)  // the first piece, whatever the order of the types
      if (const std::string& reason = why[number_of(all.types[i])]; !reason.empty())
        throw without_limit(piece(i), reason);
  for (size_t i = 0; i < distinct.size(); ++i) all.tree_of[distinct[i]] = std::move(trees[i]);
  all.trees.resize(count);
  parallel_for(count, [&](std::int64_t i) { all.trees[i] = all.tree_of.find(all.types[i])->second.get(); });
  return all;
}

}  // namespace sublimit
