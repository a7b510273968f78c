// SPDX-License-Identifier: Apache-2.0
#include "sublimit/scheme/refine.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <string>
#include <unordered_set>
#include <utility>

#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"
#include "sublimit/scheme/detail/check_levels.h"
#include "sublimit/scheme/detail/refine_impl.h"
#include "sublimit/scheme/detail/renumbered_level.h"
#include "sublimit/scheme/detail/sheet_part.h"

namespace sublimit {
namespace {

/// Elements of a level, as far as sizes go: faces grow by the split, whatever the connectivity.
struct Counts {
  double corners, faces, edges, vertices;
  Counts next(Split split) const {
    switch (split) {
      case Split::ptq:
        return {4 * corners, 4 * faces, 2 * edges + corners, vertices + edges};
      case Split::dqq:
        return {2 * corners + 4 * edges, faces + edges + vertices, corners + 2 * edges, corners};
      case Split::mid_edge:
        return {2 * corners, faces + vertices, corners, edges};
      case Split::sqrt3:
        return {3 * corners, corners, edges + corners, vertices + faces};
      case Split::dual:
        return {corners, vertices, edges, faces};
      case Split::quads:
        return {4 * edges, edges, 2 * edges, vertices + faces};
      case Split::keep:
        return *this;
      default:
        return {4 * corners, corners, 2 * edges + corners, vertices + faces + edges};
    }
  }
  /// With connectivity, sharpness and positions.
  double bytes() const { return 20 * corners + 12 * edges + 8 * vertices + 4 * (edges + vertices) + 24 * vertices; }
  double matrix_bytes() const { return 8 * 12 * vertices; }  // about 8 nonzeros a row
  /// Faces and positions alone.
  double mesh_bytes() const { return 4 * (corners + faces) + 24 * vertices; }
};

void sort_distinct(std::vector<Index>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

/// Those of `list` that are not in `known`; both ascending.
std::vector<Index> without(const std::vector<Index>& list, const std::vector<Index>& known) {
  std::vector<Index> rest;
  std::set_difference(list.begin(), list.end(), known.begin(), known.end(), std::back_inserter(rest));
  return rest;
}

void merge_into(std::vector<Index>& known, const std::vector<Index>& more) {
  const auto middle = static_cast<std::ptrdiff_t>(known.size());
  known.insert(known.end(), more.begin(), more.end());
  std::inplace_merge(known.begin(), known.begin() + middle, known.end());
}

/// Faces within some rings around others, ascending. Rings grow from what the last one added: each vertex is walked
/// around once, that of a thousand faces too.
class Rings {
 public:
  /// @param apart  not null: on sheets alone that have been met, where these are apart
  Rings(const Topology& t, std::span<const Index> faces, const Sharpness* apart = nullptr)
      : t_(t), apart_(apart), faces_(faces.begin(), faces.end()) {
    sort_distinct(faces_);
    added_ = faces_;
  }
  const std::vector<Index>& faces() const { return faces_; }
  /// Those that share a vertex with them, too.
  void add_ring() {
    std::vector<Index> corners, around;
    for (const Index f : added_) {
      if (!apart_) {
        corners.insert(corners.end(), t_.vertices(Face{f}).begin(), t_.vertices(Face{f}).end());
        continue;
      }
      for (Index k = 0; k < t_.size(Face{f}); ++k) {
        const HalfEdge h = t_.corner(Face{f}, k);
        if (are_sheets_apart(t_, *apart_, t_.tail(h)))
          add_fan(h, around);
        else
          corners.push_back(index(t_.tail(h)));
      }
    }
    sort_distinct(corners);
    const std::vector<Index> reached = without(corners, vertices_);
    merge_into(vertices_, reached);
    for (const Index v : reached)
      for (const HalfEdge start : t_.fans(Vertex{v})) {
        HalfEdge h = start;
        do {
          around.push_back(index(t_.face(h)));
          h = t_.ccw(h);
        } while (exists(h) && h != start);
      }
    sort_distinct(around);
    added_ = without(around, faces_);
    merge_into(faces_, added_);
  }
  /// Adds the rest of each fan that has been met where sheets meet along a crease, at corners of some faces: an edge of
  /// the rim there would be one more crease.
  void complete_creases(const std::vector<Index>& faces) {
    std::unordered_set<Index> creases;
    for (const Index f : faces)
      for (const Index v : t_.vertices(Face{f}))
        if (!is_infinite(apart_->vertex[v]) && are_sheets_apart(t_, *apart_, Vertex{v})) creases.insert(v);
    if (creases.empty()) return;
    for (added_ = faces_; !added_.empty();) {
      std::vector<Index> around;
      for (const Index f : added_)
        for (Index k = 0; k < t_.size(Face{f}); ++k)
          if (const HalfEdge h = t_.corner(Face{f}, k); creases.contains(index(t_.tail(h)))) add_fan(h, around);
      sort_distinct(around);
      added_ = without(around, faces_);
      merge_into(faces_, added_);
    }
  }

 private:
  /// Adds the faces around a vertex on one sheet, unless they have been added.
  void add_fan(HalfEdge h, std::vector<Index>& around) {
    if (walked_.contains(index(h))) return;
    for_each_in_fan(t_, h, [&](HalfEdge g) {
      walked_.insert(index(g));
      around.push_back(index(t_.face(g)));
    });
  }

  const Topology& t_;
  const Sharpness* apart_;
  std::unordered_set<Index> walked_;  // half-edges of fans
  std::vector<Index> faces_, added_;
  std::vector<Index> vertices_;  // that were walked around
};

/// Places of numbers in an ascending list, -1 elsewhere: by a table where the list is a good part of all there are.
class Positions {
 public:
  Positions(const std::vector<Index>& list, Index count) : list_(list) {
    if (list.size() * 32 < static_cast<size_t>(count)) return;
    table_.assign(static_cast<size_t>(count), -1);
    for (size_t i = 0; i < list.size(); ++i) table_[static_cast<size_t>(list[i])] = static_cast<Index>(i);
  }
  Index operator()(Index i) const {
    if (!table_.empty()) return i < 0 ? -1 : table_[static_cast<size_t>(i)];
    const auto at = std::lower_bound(list_.begin(), list_.end(), i);
    return at != list_.end() && *at == i ? static_cast<Index>(at - list_.begin()) : -1;
  }

 private:
  const std::vector<Index>& list_;
  std::vector<Index> table_;
};

SparseMatrix selected_rows(const SparseMatrix& S, const std::vector<Index>& rows) {
  SparseMatrix result(static_cast<Index>(rows.size()), S.cols());
  std::int64_t count = 0;
  for (const Index r : rows) count += S.outerIndexPtr()[r + 1] - S.outerIndexPtr()[r];
  resize_nonzeros(result, count);
  Index at = 0;
  for (size_t i = 0; i < rows.size(); ++i) {
    result.outerIndexPtr()[i] = at;
    for (Index k = S.outerIndexPtr()[rows[i]]; k < S.outerIndexPtr()[rows[i] + 1]; ++k, ++at) {
      result.innerIndexPtr()[at] = S.innerIndexPtr()[k];
      result.valuePtr()[at] = S.valuePtr()[k];
    }
  }
  result.outerIndexPtr()[rows.size()] = at;
  return result;
}

SparseMatrix identity(Index size) {
  SparseMatrix I(size, size);
  I.setIdentity();
  return I;
}

}  // namespace

void check_levels(const Scheme<double>& scheme, const Topology& t, int levels, LevelMemory memory) {
  if (levels < 0) throw InvalidParameter("levels is " + std::to_string(levels) + "; it must be 0 or more");
  const std::string amount = std::to_string(levels) + " levels of " + std::to_string(t.num_faces()) + " faces";
  Counts counts{double(t.num_half_edges()), double(t.num_faces()), double(t.num_edges()), double(t.num_vertices())};
  const bool all = memory == LevelMemory::matrices;
  double bytes = counts.bytes() + (all ? counts.matrix_bytes() : 0), before = bytes;
  int most = 0;  // levels that fit
  const auto advice = [&] { return "use at most " + std::to_string(most) + ", or refine a subset"; };
  // A scheme that makes no more faces may be asked for any number of levels: each takes memory, and is counted.
  constexpr int enough = 64;
  for (int k = 0; k < levels && t.num_faces() > 0; ++k) {
    for (const Step<double>& step : scheme.steps_at(k, t)) counts = counts.next(step.split);
    const double own = counts.bytes() + (all ? counts.matrix_bytes() : 0);
    bytes = before + (memory == LevelMemory::mesh ? counts.mesh_bytes() : own);
    before = all ? bytes : own;
    if (counts.corners > std::numeric_limits<Index>::max())
      throw ResourceError(amount + " take more than " + bytes_in_words(bytes) + " of memory, and level " +
                          std::to_string(k + 1) + " has more face corners than 32-bit indices count; " + advice());
    if (bytes <= memory_limit())
      most = k + 1;
    else if (k >= enough)
      break;
  }
  check_memory(amount, bytes, advice());
}

void check_sharpness(const std::string& scheme, Sharpening sharpening, bool is_dual, const Topology& t,
                     const Sharpness& sharpness, const Mesh& tags) {
  if (sharpening == Sharpening::semi_sharp) return;
  const auto refuse = [&](const std::string& what, bool is_dart = false) {
    const bool some = sharpening == Sharpening::sharp && !is_dart;
    throw UnsupportedTopology(
        what + ": " + scheme +
        (some ? " has rules for infinite sharpness (>= 10) only; make it 10, " : " has no rule for it; ") +
        "remove the tag, or use a scheme with semi-sharp creases: catmull-clark or loop");
  };
  for (Index i = 0; i < t.num_edges(); ++i) {
    const Edge e{i};
    const float s = sharpness.edge[i];
    if (!is_sharp(s) || !exists(t.twin(t.half_edge(e)))) continue;
    const auto [a, b] = std::minmax({index(t.tail(e)), index(t.head(e))});
    if (sharpening == Sharpening::boundary || !is_infinite(s))
      refuse("sharp edge (" + std::to_string(a) + "," + std::to_string(b) + ")");
  }
  for (Index v = 0; v < t.num_vertices() && sharpening == Sharpening::sharp; ++v)
    if (VertexSharpness(t, sharpness, Vertex{v}).rule() == Rule::dart)
      refuse("sharp edges that end inside, at vertex " + std::to_string(v) + " (a dart)", true);
  for (const Mesh::Corner& corner : tags.corners) {
    const Vertex v{corner.vertex};
    const bool interior = exists(t.outgoing(v)) && exists(t.twin(t.outgoing(v)));
    if (!is_sharp(corner.sharpness)) continue;
    if (is_dual || (interior && sharpening == Sharpening::boundary) || !is_infinite(corner.sharpness))
      refuse("corner " + std::to_string(corner.vertex));
  }
}

void check_wide_faces(const std::string& scheme, int corners, const Topology& t, int level) {
  if (t.num_faces() == 0) return;
  const Index right = corners ? corners : t.size(Face{0});
  if (t.uniform_face_size() == right) return;
  Index f = 0;
  while (t.size(Face{f}) == right) ++f;
  throw UnsupportedTopology("face " + std::to_string(f) + " of level " + std::to_string(level) + " has " +
                            std::to_string(t.size(Face{f})) + " corners; " + scheme + " refines faces of " +
                            std::to_string(right) +
                            " here: begin at level 0 with the scheme's own preparation, or cut the faces before");
}

template LevelOf<double> control_level(const Scheme<double>&, const Mesh&, const SubdivisionOptions&);
template LevelOf<double> next_level<double>(const Scheme<double>&, const LevelOf<double>&);

std::vector<Level> refine(const Scheme<double>& scheme, const Mesh& mesh, int levels, const SubdivisionOptions& options,
                          const std::function<void(int)>& progress) {
  return refine(scheme, control_level(scheme, mesh, options), levels, progress);
}

std::vector<Level> refine(const Scheme<double>& scheme, Level control, int levels,
                          const std::function<void(int)>& progress) {
  std::vector<Level> result;
  result.push_back(std::move(control));
  check_levels(scheme, result[0].topology(), levels);
  result.reserve(levels + 1);
  for (int k = 1; k <= levels; ++k) {
    if (progress) progress(k);
    result.push_back(next_level(scheme, result.back()));
  }
  return result;
}

SparseMatrix refinement_matrix(const std::vector<Level>& levels) {
  SparseMatrix P;  // returned wherever: these matrices copy where others move
  if (levels.size() == 1) identity(levels[0].topology().num_vertices()).swap(P);
  if (levels.size() == 2) P = levels[1].S;
  if (levels.size() > 2) product(levels[2].S, levels[1].S).swap(P);
  for (size_t k = 3; k < levels.size(); ++k) product(levels[k].S, P).swap(P);
  return P;
}

ControlFaces::ControlFaces(Index count) : faces_(size_t(count)) { std::iota(faces_.begin(), faces_.end(), 0); }

void ControlFaces::follow(const Topology& parent, const Refinement& step) {
  const Topology& t = step.topology;
  std::vector<Index> children(step.face_parent.size());
  for (size_t f = 0; f < children.size(); ++f) children[f] = faces_[size_t(step.face_parent[f])];
  const bool is_sqrt3 = step.split == Split::sqrt3;
  // A child is at a half-edge of its parent, of which one end at least is the point of the face that it lies in.
  for (size_t f = 0; is_sqrt3 && straddles_ && f < children.size(); ++f) {
    const Vertex first = t.tail(t.corner(Face{static_cast<Index>(f)}, 0));
    if (step.origin(first) != Refinement::Origin::vertex) continue;
    for (Index k = 0; k < 3; ++k) {
      const HalfEdge h = parent.corner(Face{step.face_parent[f]}, k);
      if (index(parent.tail(h)) != step.parent(first)) continue;
      for (const Vertex end : {parent.head(h), parent.tail(h)})
        if (const Index i = index(end) - from_vertices_; i >= 0 && i < from_faces_)
          children[f] = before_[size_t(face_list_.empty() ? i : face_list_[size_t(i)])];
    }
  }
  before_ = std::exchange(faces_, std::move(children));
  from_vertices_ = step.from_vertices, from_faces_ = step.from_faces, face_list_ = step.face_list;
  straddles_ = is_sqrt3 && !straddles_;
}

std::vector<Index> control_faces(std::span<const Level> levels) {
  ControlFaces control(levels.front().topology().num_faces());
  const Topology* parent = &levels.front().topology();
  for (const Level& level : levels.subspan(1))
    for (const Refinement& step : level.steps) {
      control.follow(*parent, step);
      parent = &step.topology;
    }
  return control.faces();
}

double predicted_vertices(const Scheme<double>& scheme, const Topology& t, int level) {
  Counts counts{double(t.num_half_edges()), double(t.num_faces()), double(t.num_edges()), double(t.num_vertices())};
  for (int k = 0; k < level; ++k)
    for (const Step<double>& step : scheme.steps_at(k, t)) counts = counts.next(step.split);
  return counts.vertices;
}

double predicted_bytes(const Scheme<double>& scheme, const Topology& t, int levels) {
  Counts counts{double(t.num_half_edges()), double(t.num_faces()), double(t.num_edges()), double(t.num_vertices())};
  double bytes = counts.bytes();
  for (int k = 0; k < levels; ++k) {
    for (const Step<double>& step : scheme.steps_at(k, t)) counts = counts.next(step.split);
    bytes += counts.bytes();
  }
  return bytes;
}

namespace {

/// Part of a level around some faces.
/// @param apart  as `Rings`
Part part_around(const Level& whole, std::span<const Index> chosen, int rings, const Sharpness* apart) {
  const Topology& t = whole.topology();
  Rings grown(t, chosen, apart);
  for (int k = 1; k < rings; ++k) grown.add_ring();
  // Of these every vertex has all its faces in the part, but for those of sheets that are apart.
  const std::vector<Index> complete = grown.faces();
  grown.add_ring();
  if (apart) grown.complete_creases(complete);
  Part part;
  part.faces = grown.faces();

  RenumberedFaces order{.faces = part.faces, .offsets = {0}, .corners = {}};
  for (const Index f : part.faces) {
    for (Index k = 0; k < t.size(Face{f}); ++k) order.corners.push_back(index(t.corner(Face{f}, k)));
    order.offsets.push_back(static_cast<Index>(order.corners.size()));
  }
  std::vector<Index>& vertices = part.vertices;
  for (const Index h : order.corners) vertices.push_back(index(t.tail(HalfEdge{h})));
  sort_distinct(vertices);
  const Positions corner(order.corners, t.num_half_edges()), vertex(vertices, t.num_vertices());
  part.level = renumbered_level(whole, order, static_cast<Index>(vertices.size()), corner, vertex);
  part.halves = std::move(order.corners);

  Level& level = part.level;
  const Topology& own = level.topology();
  // Vertices on the rim stay out of the next refinement, and any rule will do.
  level.sharpness.vertex.assign(vertices.size(), infinite_sharpness);
  for (const Index f : complete)
    for (const Index v : t.vertices(Face{f})) level.sharpness.vertex[vertex(v)] = whole.sharpness.vertex[v];
  // An edge of the rim has lost a face; without this it would be asked for its smooth mask.
  for (Index e = 0; e < own.num_edges(); ++e)
    if (!exists(own.twin(own.half_edge(Edge{e})))) level.sharpness.edge[e] = infinite_sharpness;
  return part;
}

}  // namespace

Part part(const Level& whole, std::span<const Index> chosen, int rings) {
  return part_around(whole, chosen, rings, nullptr);
}

Part sheet_part(const Level& whole, std::span<const Index> chosen, int rings) {
  return part_around(whole, chosen, rings, &whole.sharpness);
}

Subset subset(const Level& whole, std::span<const Index> chosen, int rings) {
  const Topology& t = whole.topology();
  for (const Index f : chosen)
    if (f < 0 || f >= t.num_faces())
      throw InvalidParameter("face " + std::to_string(f) + " does not exist; the level has " +
                             std::to_string(t.num_faces()));
  // Chaikin sharpness at the far end of an edge depends on the edges around that end: one ring more.
  if (whole.sharpness.creasing == Creasing::chaikin) ++rings;
  Part around = part(whole, chosen, rings);
  Subset result;
  for (const Index f : chosen)
    result.faces.push_back(
        static_cast<Index>(std::lower_bound(around.faces.begin(), around.faces.end(), f) - around.faces.begin()));
  result.level = std::move(around.level);
  result.level.S = selected_rows(identity(t.num_vertices()), around.vertices);
  result.parents = std::move(around.faces);
  return result;
}

Subset refine(const Scheme<double>& scheme, const Subset& part) {
  const Level refined = next_level(scheme, part.level);
  std::vector<bool> is_chosen(part.level.topology().num_faces(), false);
  for (const Index f : part.faces) is_chosen[f] = true;
  std::vector<Index> children;
  for (Index f = 0; f < refined.topology().num_faces(); ++f) {
    Index parent = f;
    for (auto step = refined.steps.rbegin(); step != refined.steps.rend(); ++step) parent = step->face_parent[parent];
    if (is_chosen[parent]) children.push_back(f);
  }
  Subset result = subset(refined, children, rings_for_refinement(scheme));
  std::vector<Index> rows(result.level.S.innerIndexPtr(), result.level.S.innerIndexPtr() + result.level.S.nonZeros());
  result.level.S = selected_rows(refined.S, rows);
  return result;
}

}  // namespace sublimit
