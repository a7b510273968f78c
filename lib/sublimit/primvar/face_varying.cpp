// SPDX-License-Identifier: Apache-2.0
#include "sublimit/primvar/face_varying.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "sublimit/base/detail/rule_words.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/mesh/detail/topology_builder.h"
#include "sublimit/primvar/linear_scheme.h"
#include "sublimit/primvar/value_rules.h"
#include "sublimit/splits/detail/child_sharpness.h"

namespace sublimit {
namespace {

const char* name(FaceVaryingInterpolation interpolation) { return face_varying_words[size_t(interpolation)]; }

void check(const Mesh::FaceVarying& channel, const Topology& t) {
  const std::string what = "face-varying channel '" + channel.name + "': ";
  if (std::ssize(channel.indices) != t.num_half_edges())
    throw InvalidMesh(what + std::to_string(channel.indices.size()) + " indices, but the faces have " +
                      std::to_string(t.num_half_edges()) + " corners; give one for each corner");
  for (size_t h = 0; h < channel.indices.size(); ++h)
    if (channel.indices[h] < 0 || channel.indices[h] >= channel.values.rows())
      throw InvalidMesh(what + "corner " + std::to_string(h) + " has value " + std::to_string(channel.indices[h]) +
                        "; the channel has " + std::to_string(channel.values.rows()) + ", counted from 0");
}

/// The values of a channel and its faces over them.
class ValueFaces {
 public:
  ValueFaces(const Topology& t, const Mesh::FaceVarying& channel) : t_(t), is_cut(t.num_half_edges(), false) {
    number_values(channel.indices);
    find_seams();
  }

  Topology topology() const {
    TopologyBuilder b;
    b.face_offsets.reserve(t_.num_faces() + 1);
    for (Index f = 0; f < t_.num_faces(); ++f) b.face_offsets.push_back(index(t_.first(Face{f})));
    b.face_offsets.push_back(t_.num_half_edges());
    b.tail.assign(value_.begin(), value_.end());
    b.twin.resize(t_.num_half_edges());
    for (Index h = 0; h < t_.num_half_edges(); ++h) b.twin[h] = is_cut[h] ? -1 : index(t_.twin(HalfEdge{h}));
    for (Index e = 0; e < t_.num_edges() && !t_.is_manifold(); ++e) {
      if (exists(t_.twin(t_.half_edge(Edge{e}))) || !t_.is_nonmanifold(Edge{e})) continue;
      if (is_cut[index(t_.half_edge(Edge{e}))]) continue;
      std::vector<Index>& group = b.nonmanifold_edges.emplace_back();
      for (const HalfEdge h : t_.half_edges(Edge{e})) group.push_back(index(h));
    }
    b.find_fans(static_cast<Index>(vertices.size()));
    return std::move(b).build();
  }

 private:
  /// One value per vertex and index given, in the order of the indices: what is written and read again keeps its order.
  void number_values(const std::vector<Index>& indices) {
    std::vector<std::pair<Index, Index>> pairs;  // index given, vertex
    for (size_t h = 0; h < indices.size(); ++h) pairs.push_back({indices[h], index(t_.tail(HalfEdge{Index(h)}))});
    std::vector<Index> order(pairs.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](Index a, Index b) { return pairs[a] < pairs[b]; });
    value_.resize(pairs.size());
    for (size_t i = 0; i < order.size(); ++i) {
      if (i == 0 || pairs[order[i]] != pairs[order[i - 1]]) {
        given.push_back(pairs[order[i]].first);
        vertices.push_back(pairs[order[i]].second);
      }
      value_[order[i]] = static_cast<Index>(given.size()) - 1;
    }
  }

  void find_seams() {
    const auto tail = [&](HalfEdge h) { return value_[index(h)]; };
    const auto head = [&](HalfEdge h) { return value_[index(t_.next(h))]; };
    for (Index i = 0; i < t_.num_half_edges(); ++i) {
      const HalfEdge h{i}, g = t_.twin(h);
      if (exists(g)) is_cut[i] = tail(h) != head(g) || head(h) != tail(g);
    }
    for (Index e = 0; e < t_.num_edges() && !t_.is_manifold(); ++e) {
      if (exists(t_.twin(t_.half_edge(Edge{e}))) || !t_.is_nonmanifold(Edge{e})) continue;
      const std::vector<HalfEdge> halves = t_.half_edges(Edge{e});
      const auto ends = [&](HalfEdge h) {
        return t_.forward(h) ? std::pair{tail(h), head(h)} : std::pair{head(h), tail(h)};
      };
      const bool cut =
          std::any_of(halves.begin(), halves.end(), [&](HalfEdge h) { return ends(h) != ends(halves[0]); });
      for (const HalfEdge h : halves) is_cut[index(h)] = cut;
    }
  }

  const Topology& t_;
  std::vector<Index> value_;  // of each corner

 public:
  std::vector<Index> given, vertices;  // of each value
  std::vector<bool> is_cut;            // per half-edge
};

/// Under splits that rotate or cut off vertices a channel without seams is refined as the vertices are.
FaceVaryingLevel as_vertices(const Level& mesh) {
  FaceVaryingLevel result{.level = mesh, .vertices = {}, .rules = {}, .given = {}};
  result.vertices.resize(mesh.topology().num_vertices());
  std::iota(result.vertices.begin(), result.vertices.end(), 0);
  result.rules.assign(result.vertices.size(), ValueRule::vertex);
  return result;
}

/// Whether vertices and edges survive every level.
bool keeps_edges(const Scheme<double>& scheme, const Level& control) {
  return keeps_elements(scheme.steps) && keeps_elements(scheme.steps_at(control.number, control.topology()));
}

}  // namespace

Scheme<double> face_varying_scheme(const Scheme<double>& scheme, FaceVaryingInterpolation interpolation) {
  if (interpolation < FaceVaryingInterpolation::boundaries) return scheme;
  if (!keeps_elements(scheme.steps))
    throw InvalidOption("face-varying interpolation '" + std::string(name(interpolation)) +
                        "' is linear along edges, which the split of " + scheme.name +
                        " does not keep; use none, or a scheme that does: catmull-clark, loop");
  if (interpolation == FaceVaryingInterpolation::boundaries) return scheme;
  if (!keeps_elements(scheme.preparation))
    throw InvalidOption(
        "face-varying interpolation 'all' is linear along edges, which " + scheme.name +
        " does not keep where it makes quadrilaterals of the edges; use another interpolation, or quads=corners");
  return linear_scheme(scheme);
}

FaceVaryingLevel control_face_varying(const Scheme<double>& scheme, FaceVaryingInterpolation interpolation,
                                      const Mesh::FaceVarying& channel, const Level& control) {
  static_cast<void>(face_varying_scheme(scheme, interpolation));  // whether it exists
  const Topology& t = control.topology();
  check(channel, t);
  ValueFaces faces(t, channel);
  if (!keeps_edges(scheme, control)) {
    const auto seam = std::find(faces.is_cut.begin(), faces.is_cut.end(), true);
    // A vertex of two sheets may have two values without a seam.
    std::vector<Index> given(t.num_vertices(), -1);
    bool is_single = seam == faces.is_cut.end();
    for (size_t p = 0; p < faces.given.size(); ++p) {
      Index& value = given[faces.vertices[p]];
      is_single = is_single && value < 0;
      value = faces.given[p];
    }
    if (!is_single) {
      const HalfEdge h{seam == faces.is_cut.end() ? 0 : static_cast<Index>(seam - faces.is_cut.begin())};
      throw UnsupportedTopology(
          "face-varying channel '" + channel.name + "' has a seam, for one at edge (" +
          std::to_string(index(t.tail(h))) + "," + std::to_string(index(t.head(h))) + "), and " + scheme.name +
          " has no rule for seams under '" + name(interpolation) +
          "', since its split does not keep edges; use catmull-clark, loop or another scheme that does");
    }
    FaceVaryingLevel result = as_vertices(control);
    result.given = std::move(given);
    return result;
  }
  FaceVaryingLevel result;
  result.level.number = control.number;
  result.level.steps.emplace_back();
  result.level.steps[0].topology = faces.topology();
  result.level.holes = control.holes;
  const Topology& values = result.level.topology();
  result.rules = value_rules(control, values, faces.vertices, faces.is_cut, interpolation);
  result.level.sharpness = value_sharpness(t, control.sharpness, values, faces.vertices, result.rules, interpolation);
  result.vertices = std::move(faces.vertices);
  result.given = std::move(faces.given);
  return result;
}

FaceVaryingLevel next_face_varying(const Scheme<double>& scheme, FaceVaryingInterpolation interpolation,
                                   const FaceVaryingLevel& parent, const Level& mesh_parent, const Level& mesh_child) {
  if (!keeps_edges(scheme, mesh_parent)) return as_vertices(mesh_child);
  const Scheme<double> own = face_varying_scheme(scheme, interpolation);
  FaceVaryingLevel child;
  Level& level = child.level;
  level.number = mesh_child.number;
  level.holes = mesh_child.holes;
  child.rules = parent.rules;
  const Topology* topology = &parent.level.topology();
  const Sharpness* sharpness = &parent.level.sharpness;
  const std::vector<Step<double>> steps = own.steps_at(mesh_parent.number, mesh_parent.topology());
  level.steps.reserve(steps.size());
  for (size_t i = 0; i < steps.size(); ++i) {
    Refinement refinement = refine(*topology, steps[i].split, mesh_parent.number);
    child.rules = refine(child.rules, *topology, refinement, interpolation);
    Sharpness child_sharpness;
    if (i + 1 < steps.size()) {
      child_sharpness = refine(*sharpness, *topology, refinement);  // nothing semi-sharp in schemes of several steps
    } else {
      const Topology& mesh = mesh_child.topology();
      child.vertices.resize(refinement.topology.num_vertices());
      for (Index h = 0; h < mesh.num_half_edges(); ++h)
        child.vertices[index(refinement.topology.tail(HalfEdge{h}))] = index(mesh.tail(HalfEdge{h}));
      child_sharpness =
          value_sharpness(mesh, mesh_child.sharpness, refinement.topology, child.vertices, child.rules, interpolation);
    }
    std::optional<KnotSplit> knots;
    if (!mesh_parent.intervals.empty())
      knots = new_knots(
          renumbered(mesh_parent.intervals, mesh_parent.topology(), *topology, [](HalfEdge h) { return index(h); }));
    SparseMatrix S = subdivision_matrix(own, steps[i], *topology, refinement, *sharpness, child_sharpness,
                                        mesh_parent.number, knots && !knots->length.empty() ? &*knots : nullptr);
    if (i == 0) {
      level.S.swap(S);
    } else {
      product(S, level.S).swap(level.S);
    }
    level.sharpness = std::move(child_sharpness);
    level.steps.push_back(std::move(refinement));
    sharpness = &level.sharpness;
    topology = &level.topology();
  }
  return child;
}

std::vector<FaceVaryingLevel> refine_face_varying(const Scheme<double>& scheme, FaceVaryingInterpolation interpolation,
                                                  const Mesh::FaceVarying& channel, std::span<const Level> mesh) {
  if (mesh.empty()) throw InvalidParameter("no levels; a refinement has at least level 0");
  std::vector<FaceVaryingLevel> levels{control_face_varying(scheme, interpolation, channel, mesh[0])};
  for (size_t k = 1; k < mesh.size(); ++k)
    levels.push_back(next_face_varying(scheme, interpolation, levels.back(), mesh[k - 1], mesh[k]));
  return levels;
}

SparseMatrix refinement_matrix(std::span<const FaceVaryingLevel> levels, Index num_given) {
  if (levels.empty()) throw InvalidParameter("no levels; a refinement has at least level 0");
  const std::vector<Index>& given = levels[0].given;
  std::vector<Eigen::Triplet<double, Index>> ones;
  for (size_t p = 0; p < given.size(); ++p)
    if (given[p] >= 0) ones.emplace_back(static_cast<Index>(p), given[p], 1.0);
  SparseMatrix P(static_cast<Index>(given.size()), num_given);
  P.setFromTriplets(ones.begin(), ones.end());
  for (const FaceVaryingLevel& level : levels.subspan(1)) product(level.level.S, P).swap(P);
  return P;
}

Points control_values(const FaceVaryingLevel& control, const Points& given) {
  Points values = Points::Zero(static_cast<Index>(control.given.size()), given.cols());
  for (Index p = 0; p < values.rows(); ++p)
    if (control.given[p] >= 0) values.row(p) = given.row(control.given[p]);
  return values;
}

Points refined_values(std::span<const FaceVaryingLevel> levels, const Points& given) {
  if (levels.empty()) throw InvalidParameter("no levels; a refinement has at least level 0");
  Points values = control_values(levels[0], given);
  for (const FaceVaryingLevel& level : levels.subspan(1)) values = apply(level.level.S, values);
  return values;
}

}  // namespace sublimit
