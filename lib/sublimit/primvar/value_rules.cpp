// SPDX-License-Identifier: Apache-2.0
#include "sublimit/primvar/value_rules.h"

#include <algorithm>
#include <numeric>

#include "sublimit/base/detail/parallel_for.h"

namespace sublimit {
namespace {

bool are_borders_linear(FaceVaryingInterpolation interpolation) {
  return interpolation >= FaceVaryingInterpolation::boundaries;
}

/// Values in groups of their vertices: those of vertex v are items[start[v]] .. items[start[v + 1] - 1].
struct ValuesOfVertices {
  std::vector<Index> start, items;
  ValuesOfVertices(const std::vector<Index>& vertices, Index num_vertices)
      : start(num_vertices + 1, 0), items(vertices.size()) {
    for (const Index v : vertices) ++start[v + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<Index> at(start.begin(), start.end() - 1);
    for (size_t p = 0; p < vertices.size(); ++p) items[at[vertices[p]]++] = static_cast<Index>(p);
  }
  std::span<const Index> operator[](Index v) const {
    return {items.data() + start[v], size_t(start[v + 1] - start[v])};
  }
};

/// Sharpness of the edges between the faces of a value, now and one level on, as it decays around the vertex of the
/// mesh.
struct InnerEdges {
  std::vector<float> now, next;
  InnerEdges(const Topology& mesh, const Sharpness& sharpness, const Topology& values, Index value, Vertex v) {
    const VertexSharpness around(mesh, sharpness, v);
    const std::vector<Edge> edges = mesh.edges(v);
    for (const Edge e : values.edges(Vertex{value})) {
      const HalfEdge h = values.half_edge(e);
      if (!exists(values.twin(h))) continue;
      const auto at = std::find(edges.begin(), edges.end(), mesh.edge(h)) - edges.begin();
      now.push_back(around.edges[at]);
      next.push_back(around.child_edges[at]);
    }
  }
  bool any(bool (*is)(float)) const { return std::any_of(now.begin(), now.end(), is); }
};

/// How long, and with which weight at last, a value with these inner edges is a corner, as the sharpness of a vertex
/// that is one for as long: whole levels, and then the weight of the level in which the last of the edges gets smooth.
float corner_sharpness(InnerEdges edges) {
  const auto is_any_sharp = [](const std::vector<float>& all) { return std::any_of(all.begin(), all.end(), is_sharp); };
  if (!is_any_sharp(edges.now)) return 0;
  float levels = 0;
  for (; is_any_sharp(edges.next); ++levels) {
    edges.now = edges.next;
    for (float& s : edges.next) s = decayed(s);
  }
  // Its two borders are sharp for ever; their rule is left when the inner edges are smooth.
  return levels + VertexSharpness(0, std::move(edges.now), Creasing::uniform).parent_weight();
}

/// The rules of the values at one vertex.
class RulesAt {
 public:
  RulesAt(const Level& mesh, const Topology& values, FaceVaryingInterpolation interpolation, Vertex v,
          std::span<const Index> at_vertex, bool at_seam)
      : t_(mesh.topology()),
        sharpness_(mesh.sharpness),
        values_(values),
        mode_(interpolation),
        v_(v),
        at_vertex_(at_vertex),
        at_seam_(at_seam),
        depends_(mode_ == FaceVaryingInterpolation::corners_plus1 || mode_ == FaceVaryingInterpolation::corners_plus2) {
  }

  void set(std::vector<ValueRule>& rules) const {
    if (at_vertex_.size() == 1 && !at_seam_) {
      rules[at_vertex_[0]] = is_corner_of_boundary() ? ValueRule::corner : ValueRule::vertex;
      return;
    }
    const bool all = are_all_corners();
    std::vector<InnerEdges> inner;
    for (const Index p : at_vertex_)
      if (!all) inner.emplace_back(t_, sharpness_, values_, p, v_);
    bool any_cut = false, any_single = false;
    for (size_t i = 0; i < inner.size(); ++i) {
      any_cut |= is_cut(inner[i], at_vertex_[i]);
      any_single |= is_single(at_vertex_[i]);
    }
    const bool both = depends_ && at_vertex_.size() == 2 &&
                      (any_cut || (mode_ == FaceVaryingInterpolation::corners_plus2 && any_single));
    for (size_t i = 0; i < at_vertex_.size(); ++i) {
      ValueRule& rule = rules[at_vertex_[i]];
      if (all || both || is_cut(inner[i], at_vertex_[i]) ||
          (mode_ != FaceVaryingInterpolation::none && is_single(at_vertex_[i]))) {
        rule = ValueRule::corner;
        continue;
      }
      const bool other_is_semi_sharp = at_vertex_.size() == 2 && inner[1 - i].any(is_semi_sharp);
      const bool is_dependent = depends_ && other_is_semi_sharp && !inner[i].any(is_semi_sharp) &&
                                !is_semi_sharp(sharpness_.vertex[index(v_)]);
      rule = is_dependent ? ValueRule::dependent : ValueRule::border;
    }
  }

 private:
  bool is_single(Index value) const { return values_.num_faces(Vertex{value}) == 1; }
  /// Seams or infinitely sharp edges part the faces of a value.
  bool is_cut(const InnerEdges& inner, Index value) const {
    return values_.is_nonmanifold(Vertex{value}) || inner.any(is_infinite);
  }
  bool is_corner_of_boundary() const {
    const bool single = mode_ != FaceVaryingInterpolation::none && t_.num_faces(v_) == 1;
    return (are_borders_linear(mode_) || single) && t_.is_boundary(v_);
  }
  bool are_all_corners() const {
    if (are_borders_linear(mode_) || t_.is_nonmanifold(v_) || is_infinite(sharpness_.vertex[index(v_)])) return true;
    if (depends_ && at_vertex_.size() > 2) return true;
    return mode_ == FaceVaryingInterpolation::corners_plus2 && at_vertex_.size() == 1 && !t_.is_boundary(v_);
  }

  const Topology& t_;
  const Sharpness& sharpness_;
  const Topology& values_;
  FaceVaryingInterpolation mode_;
  Vertex v_;
  std::span<const Index> at_vertex_;
  bool at_seam_, depends_;
};

}  // namespace

std::vector<ValueRule> value_rules(const Level& mesh, const Topology& values, const std::vector<Index>& vertices,
                                   const std::vector<bool>& is_cut, FaceVaryingInterpolation interpolation) {
  const Topology& t = mesh.topology();
  std::vector<std::uint8_t> at_seam(t.num_vertices(), false);
  for (Index h = 0; h < t.num_half_edges(); ++h)
    if (is_cut[h]) at_seam[index(t.tail(HalfEdge{h}))] = at_seam[index(t.head(HalfEdge{h}))] = true;
  std::vector<ValueRule> rules(vertices.size(), ValueRule::vertex);
  if (interpolation == FaceVaryingInterpolation::all) return rules;
  const ValuesOfVertices at_vertex(vertices, t.num_vertices());
  parallel_for(t.num_vertices(), [&](std::int64_t i) {
    const Vertex v{static_cast<Index>(i)};
    if (!at_vertex[index(v)].empty())
      RulesAt(mesh, values, interpolation, v, at_vertex[index(v)], at_seam[i]).set(rules);
  });
  return rules;
}

std::vector<ValueRule> refine(const std::vector<ValueRule>& rules, const Topology& values, const Refinement& r,
                              FaceVaryingInterpolation interpolation) {
  std::vector<ValueRule> children(r.topology.num_vertices(), ValueRule::vertex);
  const bool linear = interpolation == FaceVaryingInterpolation::boundaries;
  for (Index p = 0; p < r.topology.num_vertices(); ++p) {
    const Index parent = r.parent(Vertex{p});
    if (r.origin(Vertex{p}) == Refinement::Origin::vertex) children[p] = rules[parent];
    if (r.origin(Vertex{p}) == Refinement::Origin::edge && linear && values.is_boundary(Edge{parent}))
      children[p] = ValueRule::corner;
  }
  return children;
}

Sharpness value_sharpness(const Topology& mesh, const Sharpness& sharpness, const Topology& values,
                          const std::vector<Index>& vertices, const std::vector<ValueRule>& rules,
                          FaceVaryingInterpolation interpolation) {
  const bool is_linear = interpolation == FaceVaryingInterpolation::all;
  Sharpness result;
  result.creasing = sharpness.creasing;
  result.edge.resize(values.num_edges());
  result.vertex.resize(values.num_vertices());
  parallel_for(values.num_edges(), [&](std::int64_t e) {
    const HalfEdge h = values.half_edge(Edge{Index(e)});
    const float inside = is_linear ? 0 : sharpness.edge[index(mesh.edge(h))];
    result.edge[e] = exists(values.twin(h)) ? inside : infinite_sharpness;
  });
  parallel_for(values.num_vertices(), [&](std::int64_t p) {
    const float inside = is_linear ? 0 : sharpness.vertex[vertices[p]];
    result.vertex[p] = rules[p] == ValueRule::corner ? infinite_sharpness : inside;
  });
  if (std::find(rules.begin(), rules.end(), ValueRule::dependent) == rules.end()) return result;
  const ValuesOfVertices at_vertex(vertices, mesh.num_vertices());
  for (size_t p = 0; p < rules.size(); ++p) {
    if (rules[p] != ValueRule::dependent) continue;
    const std::span<const Index> both = at_vertex[vertices[p]];
    const Index other = both[0] == static_cast<Index>(p) ? both[1] : both[0];
    result.vertex[p] = corner_sharpness(InnerEdges(mesh, sharpness, values, other, Vertex{vertices[p]}));
  }
  return result;
}

}  // namespace sublimit
