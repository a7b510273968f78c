// SPDX-License-Identifier: Apache-2.0
#include "sublimit/scheme/detail/mask_reach.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <set>
#include <string>
#include <tuple>

#include "sublimit/base/error.h"
#include "sublimit/scheme/detail/refine_impl.h"
#include "sublimit/scheme/detail/subdivision_rows.h"

namespace sublimit {
namespace {

/// Two vertices of valence n, and n (triangles) or 2n (quadrilaterals) between them, of valence 4 or 3.
Mesh bipyramid(Index n, Index face_size) {
  const Index ring = face_size == 3 ? n : 2 * n, step = face_size == 3 ? 1 : 2;
  Mesh mesh;
  mesh.positions = Points::Zero(ring + 2, 3);
  for (Index i = 0; i < n; ++i) {
    const auto at = [&](Index k) { return (step * i + k + ring) % ring; };
    const auto add = [&](std::initializer_list<Index> corners) {
      mesh.face_sizes.push_back(face_size);
      mesh.face_vertices.insert(mesh.face_vertices.end(), corners);
    };
    if (face_size == 3) {
      add({at(0), at(1), ring});
      add({at(1), at(0), ring + 1});
    } else {
      add({ring, at(0), at(1), at(2)});
      add({ring + 1, at(1), at(0), at(-1)});
    }
  }
  return mesh;
}

/// Lists for each vertex of a face the size of the face, the faces around the vertex, whether it is on a border, and
/// its sharp edges; then the same for the faces beside it. Faces with equal lists are looked at once.
using Signature = std::vector<std::tuple<Index, Index, bool, Index>>;
Signature signature_of(const Level& level, Face face) {
  const Topology& t = level.topology();
  Signature signature;
  const auto add = [&](Face f) {
    for (const Index v : t.vertices(f)) {
      Index sharp = is_sharp(level.sharpness.vertex[v]) ? 100 : 0;
      for (const Edge e : t.edges(Vertex{v})) sharp += is_sharp(level.sharpness.edge[index(e)]);
      signature.emplace_back(t.size(f), t.num_faces(Vertex{v}), !exists(t.twin(t.outgoing(Vertex{v}))), sharp);
    }
  };
  add(face);
  std::sort(signature.begin(), signature.end());
  const auto own = std::ssize(signature);
  for (Index k = 0; k < t.size(face); ++k)
    if (const HalfEdge twin = t.twin(t.corner(face, k)); exists(twin)) add(t.face(twin));
  std::sort(signature.begin() + own, signature.end());
  return signature;
}

LabelledLevel labelled(const Scheme<double>& scheme, const Mesh& mesh) {
  LabelledLevel result{control_level(scheme, mesh), {}, {}};
  // Eight edges between one vertex of another valence and the next, more where a level has many steps.
  const double wanted = scheme.steps.size() > 4 ? 16 : 8;
  for (double edges = 1; edges < wanted; edges *= scheme.dilation())
    for (int k = 0; k < scheme.period; ++k) result.level = next_topology(scheme, result.level, [](const auto&...) {});
  for (int k = 0; k < scheme.period; ++k)
    result.period.push_back(next_level(scheme, k == 0 ? result.level : result.period.back()));
  std::set<Signature> seen;
  for (Index f = 0; f < result.level.topology().num_faces(); ++f)
    if (seen.insert(signature_of(result.level, Face{f})).second) result.faces.push_back(f);
  return result;
}

/// Vertices of the children of a face, child by child.
std::vector<Index> child_vertices(const Level& child, Index face) {
  const Topology& t = child.topology();
  std::vector<Index> vertices;
  for (Index f = 0; f < t.num_faces(); ++f) {
    Index parent = f;
    for (auto step = child.steps.rbegin(); step != child.steps.rend(); ++step) parent = step->face_parent[parent];
    if (parent != face) continue;
    const std::span<const Index> own = t.vertices(Face{f});
    vertices.insert(vertices.end(), own.begin(), own.end());
  }
  return vertices;
}

/// Whether the children of a face have the same rows if only some rings around it are refined.
bool are_enough(const Scheme<double>& scheme, const LabelledLevel& labelled, Index face, int rings) {
  const Part around = part(labelled.level, std::span(&face, 1), rings);
  const auto own = std::lower_bound(around.faces.begin(), around.faces.end(), face) - around.faces.begin();
  const Level& whole = labelled.period[0];
  try {
    // If a level has one step, only the needed rows are made: masks may have no rule for the rim of the part.
    const bool few = scheme.steps.size() == 1;
    const Level child =
        few ? next_topology(scheme, around.level, [](const auto&...) {}) : next_level(scheme, around.level);
    const std::vector<Index> vertices = child_vertices(child, Index(own));
    std::vector<Index> ascending = vertices;
    std::sort(ascending.begin(), ascending.end());
    ascending.erase(std::unique(ascending.begin(), ascending.end()), ascending.end());
    const SparseMatrix S = few ? subdivision_rows(scheme, around.level, child, ascending) : child.S;
    return std::ranges::equal(child_vertices(whole, face), vertices, [&](Index of_whole, Index of_part) {
      return has_same_weights(row_of(whole.S, of_whole), row_of(S, of_part, &around.vertices));
    });
  } catch (const Error&) {
    return false;  // a mask that sees the rim
  }
}

}  // namespace

MaskRow row_of(const SparseMatrix& S, Index v, const std::vector<Index>* number) {
  MaskRow row;
  for (SparseMatrix::InnerIterator it(S, v); it; ++it)
    if (it.value() != 0) row[number ? (*number)[size_t(it.col())] : Index(it.col())] = it.value();
  return row;
}

bool has_same_weights(const MaskRow& a, const MaskRow& b) {
  constexpr double rounding = 1e-12;  // sums may have another order
  return std::ranges::equal(a, b, [](const auto& x, const auto& y) {
    return x.first == y.first && std::abs(x.second - y.second) <= rounding;
  });
}

bool has_narrow_masks(const Scheme<double>& scheme) { return scheme.steps.size() == 1 && !scheme.is_wide(); }

std::vector<LabelledLevel> labelled_levels(const Scheme<double>& scheme) {
  Scheme<double> steps = scheme;
  steps.preparation.clear();
  const Index face_size = steps.face_size() == 3 ? 3 : 4;
  std::vector<LabelledLevel> levels;
  // A scheme may have no rule for a border, say. It refines no such meshes then.
  std::exception_ptr refused;
  const auto add = [&](const Mesh& mesh) {
    try {
      levels.push_back(labelled(steps, mesh));
    } catch (const Error&) {
      refused = std::current_exception();
    }
  };
  for (const Index n : {Index{5}, Index{7}}) {
    const Mesh closed = bipyramid(n, face_size);
    add(closed);
    Mesh open = closed;
    open.face_sizes.resize(open.face_sizes.size() - 2);
    open.face_vertices.resize(open.face_vertices.size() - 2 * size_t(face_size));
    add(open);
    if (steps.sharpening == Sharpening::boundary) continue;
    Mesh creased = closed;  // all around, between the poles
    const Index ring = closed.num_vertices() - 2;
    for (Index i = 0; i < ring; ++i) creased.creases.push_back({i, (i + 1) % ring, infinite_sharpness});
    add(creased);
    if (steps.sharpening != Sharpening::semi_sharp) continue;
    Mesh darts = closed;
    darts.creases = {{0, 1, infinite_sharpness}};
    add(darts);
  }
  if (levels.empty()) std::rethrow_exception(refused);
  return levels;
}

int rings_for_refinement(const Scheme<double>& scheme) {
  // If masks are narrow, the split decides: dual splits lose the faces at the rim, and knots reach one face further.
  if (has_narrow_masks(scheme))
    return scheme.is_dual() ? 3 : scheme.period > 1 || scheme.knots != NewKnots::none ? 2 : 1;
  const std::vector<LabelledLevel> levels = labelled_levels(scheme);
  int rings = 1;
  for (const LabelledLevel& labelled : levels)
    for (const Index face : labelled.faces)
      while (!are_enough(scheme, labelled, face, rings))
        if (++rings > most_rings)
          throw AnalysisError(scheme.name + ": masks reach beyond " + std::to_string(most_rings) + " rings of faces");
  return rings;
}

}  // namespace sublimit
