// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/asset/inventory.h"

#include <algorithm>
#include <map>

#include "sublimit/base/detail/parallel_for.h"

namespace sublimit::asset {
namespace {

using What = VertexKind::What;

constexpr const char* names[] = {
    "regular vertex", "extraordinary vertex", "border vertex",   "crease vertex",   "corner",
    "dart",           "non-manifold vertex",  "isolated vertex", "vertex in a hole"};

using Key = std::tuple<int, Index, std::vector<Index>>;

void count(AssetKind& kind, Index example, Index listed) {
  ++kind.count;
  if (Index(kind.examples.size()) < listed) kind.examples.push_back(example);
}

PointVerdict worse(const PointVerdict& a, const PointVerdict& b) {
  if (a.plane != b.plane) return a.plane > b.plane ? a : b;
  if (!a.ratio || !b.ratio) return a.ratio ? b : a;
  return std::pair(a.curvature, *a.ratio) < std::pair(b.curvature, *b.ratio) ? b : a;
}

}  // namespace

VertexKind vertex_kind(const Scheme<double>& scheme, const Level& level, Vertex v) {
  const Topology& t = level.topology();
  VertexKind kind;
  if (t.is_isolated(v)) {
    kind.what = What::isolated;
    return kind;
  }
  const auto stays_sharp = [&](HalfEdge h) {
    return !exists(t.twin(h)) || is_infinite(level.sharpness.edge[index(t.edge(h))]);
  };
  bool in_hole = true;
  Index cuts = 0;
  for (const HalfEdge fan : t.fans(v)) {
    std::vector<Index> sides;  // of a closed fan the first one is the end of the last
    Index faces = 0;
    bool closed = exists(t.twin(fan));
    HalfEdge h = fan;
    do {
      in_hole = in_hole && level.holes[index(t.face(h))];
      ++kind.n;
      ++faces;
      if (stays_sharp(t.prev(h))) {
        sides.push_back(faces);
        faces = 0;
      }
      h = t.ccw(h);
    } while (exists(h) && h != fan);
    closed = closed && exists(h);
    if (!closed) kind.at_border = true;
    cuts += Index(sides.size()) + (closed ? 0 : 1);
    if (closed && !sides.empty()) sides[0] += faces;
    if (sides.empty()) sides.push_back(faces);
    kind.sides.insert(kind.sides.end(), sides.begin(), sides.end());
  }
  std::sort(kind.sides.rbegin(), kind.sides.rend());
  // Dual schemes round corners.
  const bool pinned = !scheme.is_dual() && is_infinite(level.sharpness.vertex[index(v)]);
  kind.what = in_hole                              ? What::in_hole
              : t.is_nonmanifold(v)                ? What::non_manifold
              : pinned || cuts > 2                 ? What::corner
              : cuts == 1                          ? What::dart
              : cuts == 2                          ? (kind.at_border ? What::border : What::crease)
              : kind.n == scheme.regular_valence() ? What::regular
                                                   : What::extraordinary;
  if (kind.what == What::regular || kind.what == What::extraordinary || kind.what == What::dart) kind.sides.clear();
  return kind;
}

PointVerdict verdict_of(const VertexKind& kind, PointVerdicts& verdicts) {
  switch (kind.what) {
    case What::regular:
    case What::extraordinary:
      return verdicts.inside(kind.n);
    case What::dart:
      return verdicts.dart(kind.n);
    case What::border:
    case What::crease:
    case What::corner: {
      PointVerdict worst = verdicts.side(kind.sides[0], kind.what == What::corner);
      for (const Index n : kind.sides) worst = worse(worst, verdicts.side(n, kind.what == What::corner));
      return worst;
    }
    default:
      return {};
  }
}

Inventory inventory(const Scheme<double>& scheme, const Level& level, PointVerdicts& verdicts, Index listed) {
  const Topology& t = level.topology();
  Inventory result;
  result.vertices.resize(t.num_vertices());
  parallel_for(t.num_vertices(),
               [&](std::int64_t v) { result.vertices[v] = vertex_kind(scheme, level, Vertex{Index(v)}); });

  std::map<Key, AssetKind> kinds;
  const auto is_unbounded = [](const PointVerdict& v) {
    return v.curvature == CurvatureVerdict::divergent || v.curvature == CurvatureVerdict::logarithmic;
  };
  for (Index v = 0; v < t.num_vertices(); ++v) {
    VertexKind& own = result.vertices[v];
    AssetKind& kind = kinds[{int(own.what), own.n, own.sides}];
    if (kind.count == 0) {
      kind.kind = names[int(own.what)];
      kind.n = own.n;
      kind.sides = own.sides;
      if (own.what <= What::dart) kind.verdict = verdict_of(own, verdicts);
    }
    count(kind, v, listed);
    if (kind.verdict) own.plane = kind.verdict->plane;
    if (own.what <= What::extraordinary && is_unbounded(*kind.verdict)) ++result.unbounded;
  }
  AssetKind holes{.kind = "hole"}, edges{.kind = "non-manifold edge"}, semi_sharp{.kind = "semi-sharp vertex"};
  for (Index f = 0; f < t.num_faces(); ++f) {
    if (level.holes[f]) {
      count(holes, f, listed);
      continue;
    }
    const Index n = t.size(Face{f});
    if (n == regular_size(scheme)) continue;
    AssetKind& kind = kinds[{100, n, {}}];
    if (kind.count == 0) {
      kind.kind = "extraordinary face";
      kind.n = n;
      kind.verdict = scheme.is_dual() ? verdicts.face(n) : verdicts.inside(n);  // its middle has n faces around it
    }
    count(kind, f, listed);
    if (is_unbounded(*kind.verdict)) ++result.unbounded;
  }
  std::vector<float> sharpness(t.num_vertices(), 0);
  const auto add = [&](Index v, float s) {
    if (is_semi_sharp(s)) sharpness[v] = std::max(sharpness[v], s);
  };
  for (Index e = 0; e < t.num_edges(); ++e) {
    add(index(t.tail(Edge{e})), level.sharpness.edge[e]);
    add(index(t.head(Edge{e})), level.sharpness.edge[e]);
    if (!t.is_nonmanifold(Edge{e})) continue;
    if (++edges.count <= listed)
      edges.examples.insert(edges.examples.end(), {index(t.tail(Edge{e})), index(t.head(Edge{e}))});
  }
  for (Index v = 0; v < t.num_vertices(); ++v) {
    add(v, level.sharpness.vertex[v]);
    const double s = sharpness[v];
    if (s == 0) continue;
    count(semi_sharp, v, listed);
    if (!semi_sharp.sharpness) semi_sharp.sharpness = {s, s};
    semi_sharp.sharpness = {std::min((*semi_sharp.sharpness)[0], s), std::max((*semi_sharp.sharpness)[1], s)};
  }
  for (auto& [key, kind] : kinds) result.kinds.push_back(std::move(kind));
  for (AssetKind* kind : {&semi_sharp, &edges, &holes})
    if (kind->count > 0) result.kinds.push_back(std::move(*kind));
  return result;
}

}  // namespace sublimit::asset
