// SPDX-License-Identifier: Apache-2.0
#pragma once
// Local subdivision matrices of any scheme. A centre of a given type, isolated among regular points, is refined
// until it has enough rings of points, then by one whole period. The matrix of this period takes the points
// around the centre to those around its child.
#include <algorithm>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "sublimit/neighborhood/closed_set.h"
#include "sublimit/neighborhood/local_matrix.h"
#include "sublimit/neighborhood/local_type.h"
#include "sublimit/neighborhood/sector_labels.h"
#include "sublimit/neighborhood/walk.h"
#include "sublimit/scheme/detail/mask_reach.h"
#include "sublimit/scheme/detail/refine_impl.h"
#include "sublimit/scheme/detail/subdivision_rows_impl.h"

namespace sublimit {

/// The points around a centre that its local matrix acts on.
struct LocalPlaces {
  LocalType type;
  int depth = 0;                           ///< depth of the walk that numbers the slots
  Walk places;                             ///< the walk to this depth, with its signature
  std::vector<Index> slots;                ///< slots of the smallest closed set
  std::vector<SectorLabel> labels;         ///< label of each of `slots`; empty if not requested
  std::vector<std::vector<Index>> orbits;  ///< closed centre: positions in `slots` that a rotation permutes, by sector
  std::vector<Index> outline;              ///< open centre: positions in `slots` of border points
};

/// A centre's points with the dense local matrix.
template <class T>
struct LocalPatch : LocalPlaces {
  DenseMatrix<T> A;  ///< matrix of one period over `slots`
};

/// Sparse form of LocalPatch: the matrix has O(#faces of the centre) nonzeros.
template <class T>
struct SparsePatch : LocalPlaces {
  SparseMatrixOf<T> A;
};

/// Returns an upper bound of the rings of points that masks of one level reach, by what their sites are given: those of
/// wide faces have edge points of the faces around them. Steps add up: averages of degree 9 need four rings.
template <class T>
int rings_of_masks(const Scheme<T>& scheme) {
  int rings = scheme.is_wide() ? 0 : -1;
  for (const Step<T>& step : scheme.steps) rings += step.masks.wide_edge || step.masks.wide_face ? 3 : 1;
  return std::max(3, rings);
}

/// Returns a mesh of n faces of `face_size` corners around vertex 0.
Mesh isolated_fan(Index n, Index face_size, bool open);
/// Returns a closed fan with sharp edges on spokes 0 and `faces`, which cut off a side of `faces` faces.
/// If `faces` is n, a single sharp edge ends at the vertex: a dart.
Mesh creased_fan(Index n, Index faces, Index face_size);

/// Returns the largest number of rings of faces around a point that masks of one level depend on.
template <class T>
int reach_of_masks(const Scheme<T>& scheme, bool open) {
  // On a border the curve's masks look along two edges.
  return scheme.steps.size() > 1 || scheme.is_wide() ? rings_of_masks(scheme) : open ? 2 : 1;
}

/// Replaces a level by the part within `rings` rings of faces around the face of a centre's start. The part has
/// no matrix; `centre` is renumbered.
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

/// Options of local patches.
struct LocalPatchOptions {
  /// Rings of points that the closed sets must contain, ascending; a patch is made for each. 1 is enough for tangents
  /// (0 for faces).
  std::vector<int> rings;
  /// Mesh whose vertex 0 is the centre; null: an isolated fan. For a side between sharp edges, the centre's
  /// first face is that of the edge to vertex 1.
  const Mesh* around = nullptr;
  bool labels = true;  ///< whether `LocalPlaces::labels` are computed
};

/// Returns the local matrices of a type, over a closed set for each requested number of rings; nothing if a
/// centre of this type has no child of its own type (a vertex in a dual scheme). Time and memory are linear in
/// the number of faces around the centre, except for polygon masks, in which each corner depends on all others.
/// @throws AnalysisError  no small closed set
/// @throws UnsupportedTopology  the scheme has no rule for what is sharp `around`
template <class T>
std::optional<std::vector<SparsePatch<T>>> sparse_patches(const Scheme<T>& scheme, const LocalType& type,
                                                          const LocalPatchOptions& options);

/// Returns the local matrix of a type; nothing if a centre of this type has no child of its own type (a vertex
/// in a dual scheme).
/// @param rings   rings of points that the closed set contains at least; -1: 1, or 0 for faces, enough for
///                tangents
/// @param around  mesh whose vertex 0 is the centre, as in LocalPatchOptions; null: an isolated fan
/// @throws AnalysisError  no small closed set
/// @throws UnsupportedTopology  the scheme has no rule for what is sharp `around`
template <class T>
std::optional<LocalPatch<T>> local_patch(const Scheme<T>& scheme, LocalType type, int rings = -1,
                                         const Mesh* around = nullptr) {
  if (rings < 0) rings = type.kind == Centre::Kind::face ? 0 : 1;
  auto sparse = sparse_patches(scheme, type, {.rings = {rings}, .around = around});
  if (!sparse) return std::nullopt;
  SparsePatch<T>& found = sparse->front();
  LocalPatch<T> patch;
  static_cast<LocalPlaces&>(patch) = std::move(static_cast<LocalPlaces&>(found));
  patch.A.setZero(found.A.rows(), found.A.cols());
  for (Eigen::Index i = 0; i < found.A.rows(); ++i)
    for (typename SparseMatrixOf<T>::InnerIterator it(found.A, i); it; ++it) patch.A(i, it.col()) = it.value();
  return patch;
}

namespace local_patch_detail {

/// Returns rows of the matrix of one period: of some vertices of the last level, over the vertices of the
/// first.
/// @param levels    first to last level, without matrices
/// @param vertices  vertices of the last level, ascending
template <class T>
SparseMatrixOf<T> period_rows(const Scheme<T>& scheme, std::vector<LevelOf<T>>& levels, std::vector<Index> vertices) {
  SparseMatrixOf<T> S;
  for (size_t k = levels.size() - 1; k > 0; --k) {
    const LevelOf<T>& parent = levels[k - 1];
    SparseMatrixOf<T> step_rows;
    if (scheme.steps.size() == 1)
      subdivision_rows(scheme, scheme.steps[0], parent.topology(), levels[k].steps[0], parent.sharpness,
                       levels[k].sharpness, parent.number, std::span<const Index>(vertices), nullptr)
          .swap(step_rows);
    else
      next_level(scheme, parent).S.swap(step_rows);
    if (S.rows() == 0)
      S.swap(step_rows);
    else
      SparseMatrixOf<T>(product(S, step_rows)).swap(S);
    if (k == 1) break;
    std::vector<bool> used(static_cast<size_t>(S.cols()), false);
    for (Eigen::Index row = 0; row < S.rows(); ++row)
      for (typename SparseMatrixOf<T>::InnerIterator it(S, row); it; ++it) used[static_cast<size_t>(it.col())] = true;
    vertices.clear();
    for (size_t v = 0; v < used.size(); ++v)
      if (used[v]) vertices.push_back(static_cast<Index>(v));
  }
  return S;
}

/// Computes patches whose points lie within `depth` rings.
/// @param patches  a patch for each of `options.rings`; empty if `depth` rings are too few
/// @return  false if a centre of this type has no child of its own type
template <class T>
bool patches_within(const Scheme<T>& scheme, const LocalType& type, const LocalPatchOptions& options, int depth,
                    std::vector<SparsePatch<T>>& patches) {
  const bool is_face = type.kind == Centre::Kind::face;
  const bool open = type.open || type.kind == Centre::Kind::border;
  const Index size = scheme.face_size() == 3 ? 3 : 4;
  const Mesh mesh =
      options.around ? *options.around : isolated_fan(type.kind == Centre::Kind::border ? 2 : type.faces, size, open);
  SubdivisionOptions subdivision;
  subdivision.boundary = Boundary::edge_only;

  LevelOf<T> level = control_level(scheme, mesh, subdivision);
  if (type.corner)
    level.sharpness.vertex[0] = infinite_sharpness;  // no tag: of vertices of several fans, under any scheme
  const Topology* t = &level.topology();
  Centre centre{Centre::Kind::vertex, t->outgoing(Vertex{0})};
  while (options.around && t->head(centre.start) != Vertex{1}) centre.start = t->ccw(centre.start);
  const auto follow = [&](const LevelOf<T>& from) {
    LevelOf<T> next = next_topology(scheme, from, [](const auto&...) {});
    const Topology* before = &from.topology();
    for (const Refinement& step : next.steps) {
      centre = child(centre, *before, step, from.number);
      before = &step.topology;
    }
    return next;
  };
  const int dilation = scheme.dilation();
  // Children within the rings lie within so many of the parent's, and their masks look further.
  const int needed =
      std::max(depth + 1, (depth + dilation - 2) / dilation + reach_of_masks(scheme, open) * scheme.period + 1);
  // A vertex that becomes a face has a level less of regular faces around it.
  const int wanted = scheme.is_dual() ? 2 * needed : needed;
  int levels = type.phase;
  for (int have = 1; have < wanted || levels < 2 * scheme.period; have *= dilation) levels += scheme.period;
  for (int k = 0; k < levels; ++k) level = follow(level);
  if (local_type(level.topology(), level.sharpness, centre, level.number, scheme.period) != type) return false;
  cut_out(level, centre, needed);

  const Centre parent_centre = centre;
  std::vector<LevelOf<T>> period(static_cast<size_t>(scheme.period) + 1);
  period[0] = std::move(level);
  for (size_t k = 1; k < period.size(); ++k) period[k] = follow(period[k - 1]);
  const Topology& topology = period.front().topology();
  const Sharpness& sharpness = period.front().sharpness;
  if (local_type(period.back().topology(), period.back().sharpness, centre, period.back().number, scheme.period) !=
      type)
    return false;
  const Walk parent = walk(topology, sharpness, parent_centre, depth - 1);
  const Walk after = walk(period.back().topology(), period.back().sharpness, centre, depth - 1);
  if (after.ring_end != parent.ring_end) return true;
  const Index known = parent.ring_end.back();
  std::vector<Index> rows(after.vertices.begin(), after.vertices.begin() + known);
  std::sort(rows.begin(), rows.end());
  const SparseMatrixOf<T> S = period_rows(scheme, period, std::move(rows));
  std::vector<Index> slot_of(static_cast<size_t>(S.cols()), -1);
  for (size_t s = 0; s < parent.vertices.size(); ++s) slot_of[parent.vertices[s]] = static_cast<Index>(s);

  for (const int rings : options.rings) {
    // The smallest closed set that contains the requested rings.
    SparsePatch<T> patch;
    patch.type = type;
    std::vector<Index> asked(parent.ring_end[rings]);
    std::iota(asked.begin(), asked.end(), Index{0});
    bool closed = true;
    patch.slots = closed_set(std::move(asked), known, [&](Index s, const auto& add) {
      for (typename SparseMatrixOf<T>::InnerIterator it(S, after.vertices[s]); it; ++it) {
        const Index column = slot_of[it.col()];
        if (column < 0)
          closed = false;
        else
          add(column);
      }
    });
    if (!closed) {
      patches.clear();
      return true;
    }
    std::vector<Index> position(known, -1);
    for (size_t i = 0; i < patch.slots.size(); ++i) position[patch.slots[i]] = static_cast<Index>(i);
    while (patch.slots.back() >= parent.ring_end[patch.depth]) ++patch.depth;
    ++patch.depth;
    patch.places = walk(topology, sharpness, parent_centre, patch.depth);
    if (options.labels) {
      const std::map<Index, SectorLabel> labels = sector_labels(topology, parent_centre, patch.depth + 1);
      for (const Index s : patch.slots) {
        const auto at = labels.find(parent.vertices[s]);
        if (at == labels.end()) throw AnalysisError(scheme.name + ": a point near a centre has no sector");
        patch.labels.push_back(at->second);
      }
    }
    const auto count = static_cast<Index>(patch.slots.size());
    patch.A.resize(count, count);
    std::vector<std::pair<Index, T>> row;
    for (Index i = 0; i < count; ++i) {
      row.clear();
      for (typename SparseMatrixOf<T>::InnerIterator it(S, after.vertices[patch.slots[i]]); it; ++it)
        row.emplace_back(position[slot_of[it.col()]], it.value());
      std::sort(row.begin(), row.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      patch.A.startVec(i);
      for (auto& [column, weight] : row) patch.A.insertBack(i, column) = std::move(weight);
    }
    patch.A.finalize();

    if (open) {
      for (Index i = 0; i < count; ++i)
        if (patch.places.on_border[patch.slots[i]]) patch.outline.push_back(i);
      patches.push_back(std::move(patch));
      continue;
    }
    const HalfEdge turned = is_face ? topology.next(parent_centre.start) : topology.ccw(parent_centre.start);
    const Walk rotated = walk(topology, sharpness, {parent_centre.kind, turned}, patch.depth - 1);
    std::vector<Index> rotation(count);  // position of the same place, one sector on
    for (Index i = 0; i < count; ++i) rotation[i] = position[slot_of[rotated.vertices[patch.slots[i]]]];
    std::vector<bool> seen(count, false);
    for (Index i = 0; i < count; ++i) {
      if (seen[i]) continue;
      std::vector<Index> orbit;
      for (Index p = i; !seen[p]; p = rotation[p]) {
        seen[p] = true;
        orbit.push_back(p);
      }
      patch.orbits.push_back(std::move(orbit));
    }
    patches.push_back(std::move(patch));
  }
  return true;
}

}  // namespace local_patch_detail

template <class T>
std::optional<std::vector<SparsePatch<T>>> sparse_patches(const Scheme<T>& scheme, const LocalType& type,
                                                          const LocalPatchOptions& options) {
  if (type.corner && scheme.is_dual()) return std::nullopt;  // dual schemes round corners
  for (int depth = options.rings.back() + (scheme.is_wide() ? 2 : 1); depth <= most_rings; ++depth) {
    std::vector<SparsePatch<T>> patches;
    if (!local_patch_detail::patches_within(scheme, type, options, depth, patches)) return std::nullopt;
    if (!patches.empty()) return patches;
  }
  throw AnalysisError(scheme.name + ": a neighbourhood is not closed under refinement");
}

extern template std::optional<LocalPatch<double>> local_patch<double>(const Scheme<double>&, LocalType, int,
                                                                      const Mesh*);
extern template std::optional<std::vector<SparsePatch<double>>> sparse_patches<double>(const Scheme<double>&,
                                                                                       const LocalType&,
                                                                                       const LocalPatchOptions&);

}  // namespace sublimit
