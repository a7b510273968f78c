// SPDX-License-Identifier: Apache-2.0
#pragma once
// Local subdivision matrices of any scheme: a centre of one type, alone among regular points, refined until there are
// rings enough, then over one whole period. Its matrix takes the points around the centre to those around its child.
#include <algorithm>
#include <numeric>
#include <optional>

#include "sublimit/neighborhood/closed_set.h"
#include "sublimit/neighborhood/local_matrix.h"
#include "sublimit/neighborhood/local_type.h"
#include "sublimit/neighborhood/sector_labels.h"
#include "sublimit/neighborhood/walk.h"
#include "sublimit/scheme/refine_impl.h"

namespace sublimit {

template <class T>
struct LocalPatch {
  LocalType type;
  int depth = 0;                           ///< of the walk that makes the slots and the signature
  Walk places;                             ///< at that depth
  std::vector<Index> slots;                ///< those of the smallest closed set
  std::vector<SectorLabel> labels;         ///< where they lie
  DenseMatrix<T> A;                        ///< over `slots`: one period
  std::vector<std::vector<Index>> orbits;  ///< of a closed centre: positions in `slots`, rotated sector by sector
  std::vector<Index> outline;              ///< of an open one: positions in `slots` of border points
};

/// Rings of points that masks may reach. Steps of repeated averaging add up: degree 9 is closed with four rings.
template <class T>
int rings_of_masks(const Scheme<T>& scheme) {
  return std::max(3, static_cast<int>(scheme.steps.size()) - 1);
}

/// n faces of a scheme's regular size around a vertex, alone.
ControlMesh lone_fan(Index n, Index face_size, bool open);
/// The same, closed, with sharp edges that cut a side of `faces` faces off the vertex: from spoke 0 to spoke `faces`.
/// One edge alone, where `faces` is n, ends there: a dart.
ControlMesh creased_fan(Index n, Index faces, Index face_size);

/// The faces within some rings around a centre as a level of their own, without a matrix.
void cut_out(Level& level, Centre& centre, int rings);
template <class T>
void cut_out(LevelOf<T>& level, Centre& centre, int rings) {
  Level same;
  same.number = level.number;
  same.steps = std::move(level.steps);
  same.sharpness = std::move(level.sharpness);
  same.holes = std::move(level.holes);
  cut_out(same, centre, rings);
  level.number = same.number;
  level.steps = std::move(same.steps);
  level.sharpness = std::move(same.sharpness);
  level.holes = std::move(same.holes);
}

/// Local matrix of a type; nothing where a centre of this type does not have a child of its own type (a vertex in a
/// dual scheme).
/// @param rings  of points that the closed set shall hold at least; 1 is enough for tangents (0 for faces)
/// @param around  the mesh that the centre is in the middle of, its vertex 0; a lone fan where there is none. For one
///                side of sharp edges: the centre's first face is that of the edge to vertex 1
/// @throws AnalysisError  no small closed set
/// @throws UnsupportedTopology  the scheme has no rule for what is sharp `around`
template <class T>
std::optional<LocalPatch<T>> local_patch(const Scheme<T>& scheme, LocalType type, int rings = -1,
                                         const ControlMesh* around = nullptr) {
  const int margin = rings_of_masks(scheme);
  const bool is_face = type.kind == Centre::Kind::face;
  if (rings < 0) rings = is_face ? 0 : 1;
  if (type.corner && scheme.is_dual()) return std::nullopt;  // dual schemes round corners
  const bool open = type.open || type.kind == Centre::Kind::border;
  const Index size = scheme.face_size() == 3 ? 3 : 4;
  const ControlMesh mesh = around ? *around : lone_fan(type.kind == Centre::Kind::border ? 2 : type.faces, size, open);
  SubdivisionOptions options;
  options.boundary = Boundary::edge_only;

  LevelOf<T> level = control_level(scheme, mesh, options);
  if (type.corner)
    level.sharpness.vertex[0] = infinite_sharpness;  // no tag: of vertices of several fans, under any scheme
  const Topology* t = &level.topology();
  Centre centre{Centre::Kind::vertex, t->outgoing(Vertex{0})};
  while (around && t->head(centre.start) != Vertex{1}) centre.start = t->ccw(centre.start);
  const auto follow = [&](LevelOf<T>&& next) {
    const Topology* before = &level.topology();
    for (const Refinement& step : next.steps) {
      centre = child(centre, *before, step, level.number);
      before = &step.topology;
    }
    level = std::move(next);
  };
  int levels = type.phase;
  for (int have = 1; have < rings + margin + 3 || levels < 2 * scheme.period; have *= scheme.dilation())
    levels += scheme.period;
  for (int k = 0; k < levels; ++k) follow(next_topology(scheme, level, [](const auto&...) {}));
  const int deep = rings + margin;
  LocalPatch<T> patch;
  patch.type = local_type(level.topology(), level.sharpness, centre, level.number, scheme.period);
  if (patch.type != type) return std::nullopt;
  cut_out(level, centre, deep + scheme.period * (margin + 2));
  const Walk parent = walk(level.topology(), level.sharpness, centre, deep);
  const HalfEdge turned = is_face ? level.topology().next(centre.start) : level.topology().ccw(centre.start);
  const Walk rotated = open ? Walk{} : walk(level.topology(), level.sharpness, {centre.kind, turned}, deep);
  const LevelOf<T> before = level;
  const Centre before_centre = centre;
  SparseMatrixOf<T> S;
  for (int k = 0; k < scheme.period; ++k) {
    follow(next_level(scheme, level));
    if (k == 0)
      S.swap(level.S);
    else
      SparseMatrixOf<T>(level.S * S).swap(S);
  }
  const Walk after = walk(level.topology(), level.sharpness, centre, deep);
  if (local_type(level.topology(), level.sharpness, centre, level.number, scheme.period) != type) return std::nullopt;

  std::vector<Index> slot_of(S.cols(), -1);
  for (size_t s = 0; s < parent.vertices.size(); ++s) slot_of[parent.vertices[s]] = static_cast<Index>(s);
  // The smallest closed set that holds the rings asked for.
  const Index known = parent.ring_end.back();
  std::vector<Index> wanted(parent.ring_end[rings]);
  std::iota(wanted.begin(), wanted.end(), Index{0});
  patch.slots = closed_set(std::move(wanted), known, [&](Index s, const auto& add) {
    for (typename SparseMatrixOf<T>::InnerIterator it(S, after.vertices[s]); it; ++it) {
      const Index column = slot_of[it.col()];
      if (column < 0 || column >= parent.ring_end[deep - 1])
        throw AnalysisError(scheme.name + ": a neighbourhood is not closed under refinement");
      add(column);
    }
  });
  std::vector<Index> position(known, -1);
  for (size_t i = 0; i < patch.slots.size(); ++i) position[patch.slots[i]] = static_cast<Index>(i);
  while (patch.depth < deep && patch.slots.back() >= parent.ring_end[patch.depth]) ++patch.depth;
  ++patch.depth;
  patch.places = walk(before.topology(), before.sharpness, before_centre, patch.depth);
  const std::map<Index, SectorLabel> labels = sector_labels(before.topology(), before_centre, patch.depth + 1);
  for (const Index s : patch.slots) {
    const auto at = labels.find(parent.vertices[s]);
    if (at == labels.end()) throw AnalysisError(scheme.name + ": a point near a centre has no sector");
    patch.labels.push_back(at->second);
  }
  const auto count = static_cast<Eigen::Index>(patch.slots.size());
  patch.A.setZero(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (typename SparseMatrixOf<T>::InnerIterator it(S, after.vertices[patch.slots[i]]); it; ++it)
      patch.A(i, position[slot_of[it.col()]]) = it.value();

  if (open) {
    for (Eigen::Index i = 0; i < count; ++i)
      if (parent.on_border[patch.slots[i]]) patch.outline.push_back(static_cast<Index>(i));
    return patch;
  }
  std::vector<Index> rotation(count);  // position of the same place, one sector on
  for (Eigen::Index i = 0; i < count; ++i) rotation[i] = position[slot_of[rotated.vertices[patch.slots[i]]]];
  std::vector<bool> seen(count, false);
  for (Eigen::Index i = 0; i < count; ++i) {
    if (seen[i]) continue;
    std::vector<Index> orbit;
    for (Index p = static_cast<Index>(i); !seen[p]; p = rotation[p]) {
      seen[p] = true;
      orbit.push_back(p);
    }
    patch.orbits.push_back(std::move(orbit));
  }
  return patch;
}

extern template std::optional<LocalPatch<double>> local_patch<double>(const Scheme<double>&, LocalType, int,
                                                                      const ControlMesh*);

}  // namespace sublimit
