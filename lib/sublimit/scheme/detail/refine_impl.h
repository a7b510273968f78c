// SPDX-License-Identifier: Apache-2.0
#pragma once
// Refinement in any number type (documented in refine.h); double is compiled into the library.
#include <utility>

#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/scheme/detail/same_scheme.h"
#include "sublimit/scheme/detail/subdivision_matrix_impl.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/splits/detail/child_intervals.h"
#include "sublimit/splits/detail/child_sharpness.h"

namespace sublimit {

/// Returns the product for numbers other than double, by Eigen (sparse_product.h has double).
template <class T>
SparseMatrixOf<T> product(const SparseMatrixOf<T>& A, const SparseMatrixOf<T>& B) {
  return A * B;
}

/// True if the limit of a face depends only on its own corners: edge points depend on the edge, and vertices
/// are kept.
template <class T>
bool needs_neighbors(const Scheme<T>& scheme) {
  const Index size = scheme.face_size() == 3 ? 3 : 4;
  for (const Step<T>& step : scheme.steps) {
    if (!step.masks.vertex || !step.masks.edge) return true;
    MaskTable<T> masks(scheme.name, step.masks, 0);
    const std::vector<T>& vertex = masks.vertex(4, size);
    const std::vector<T>& edge = masks.edge(size, size);
    const auto zero = [](const T& w) { return w == T(0); };
    if (!std::all_of(vertex.begin() + 1, vertex.end(), zero) || !std::all_of(edge.begin() + 2, edge.end(), zero))
      return true;
  }
  return false;
}

/// Throws unless the scheme has a rule for all sharpness of a level.
/// @throws UnsupportedTopology  sharpness without a rule
void check_sharpness(const std::string& scheme, Sharpening sharpening, bool is_dual, const Topology& topology,
                     const Sharpness& sharpness, const Mesh& tags);

/// Checks face sizes for steps whose masks depend on points beyond their element.
/// @param corners  required face size; 0: any, but the same for all faces
/// @throws UnsupportedTopology  names the first face of another size
void check_wide_faces(const std::string& scheme, int corners, const Topology& topology, int level);

template <class T>
LevelOf<T> control_level(const Scheme<T>& scheme, const Mesh& mesh, const SubdivisionOptions& options) {
  check_scheme(scheme);
  const Boundary boundary = options.boundary.value_or(mesh.boundary.value_or(Boundary::edge_and_corner));
  const Creasing creasing = options.creasing.value_or(mesh.creasing.value_or(Creasing::uniform));
  LevelOf<T> level;
  level.steps.emplace_back();
  level.steps[0].topology = Topology(view(mesh));
  // Now, while faces have the numbers of the mesh: limits refine parts of it.
  const Split first = scheme.steps_at(0, level.topology())[0].split;
  if (first == Split::ptq || first == Split::sqrt3) check_triangles(level.topology());
  level.sharpness = initial_sharpness(level.topology(), mesh, boundary, creasing);
  check_sharpness(scheme.name, scheme.sharpening, scheme.is_dual(), level.topology(), level.sharpness, mesh);
  const bool holes_at_boundary = boundary == Boundary::none && needs_neighbors(scheme);
  level.intervals =
      initial_intervals(level.topology(), mesh, scheme.knots, scheme.is_dual() ? KnotOwner::point : KnotOwner::edge);
  level.holes = initial_holes(level.topology(), mesh, holes_at_boundary ? boundary : Boundary::edge_only);
  level.made_by = std::make_shared<const Scheme<T>>(scheme);
  return level;
}

/// Returns the level after `parent`, without its matrix.
/// @param on_step  called for each step: (step, topology, refinement, sharpness, child sharpness, new knots or null)
template <class T, class OnStep>
LevelOf<T> next_topology(const Scheme<T>& scheme, const LevelOf<T>& parent, const OnStep& on_step) {
  LevelOf<T> child;
  child.number = parent.number + 1;
  child.made_by =
      !parent.made_by || is_alike(*parent.made_by, scheme) ? parent.made_by : std::make_shared<const Scheme<T>>(scheme);
  const Topology* topology = &parent.topology();
  const Sharpness* sharpness = &parent.sharpness;
  const std::vector<bool>* holes = &parent.holes;
  const KnotIntervals* intervals = &parent.intervals;
  const std::vector<Step<T>> steps = scheme.steps_at(parent.number, *topology);
  child.steps.reserve(steps.size());
  for (const Step<T>& step : steps) {
    Refinement refinement = refine(*topology, step.split, parent.number);
    if (step.masks.wide_edge || step.masks.wide_face)
      check_wide_faces(scheme.name, scheme.corners, *topology, parent.number);
    Sharpness child_sharpness = refine(*sharpness, *topology, refinement);
    std::optional<KnotSplit> knots;
    if (!intervals->empty()) knots = new_knots(*intervals);
    on_step(step, *topology, refinement, *sharpness, child_sharpness, knots ? &*knots : nullptr);
    KnotIntervals own_intervals;
    if (knots) own_intervals = child_intervals(*topology, refinement, *intervals, *knots);
    child.intervals = std::move(own_intervals);
    intervals = &child.intervals;
    std::vector<bool> child_holes = refine_holes(*holes, *topology, refinement);
    child.holes = std::move(child_holes);
    child.sharpness = std::move(child_sharpness);
    child.steps.push_back(std::move(refinement));
    holes = &child.holes;
    sharpness = &child.sharpness;
    topology = &child.steps.back().topology;
  }
  return child;
}

template <class T>
LevelOf<T> next_level(const Scheme<T>& scheme, const LevelOf<T>& parent) {
  SparseMatrixOf<T> product_of_steps;
  bool first = true;
  LevelOf<T> child =
      next_topology(scheme, parent,
                    [&](const Step<T>& step, const Topology& topology, const Refinement& refinement,
                        const Sharpness& sharpness, const Sharpness& child_sharpness, const KnotSplit* knots) {
                      SparseMatrixOf<T> S = subdivision_matrix(scheme, step, topology, refinement, sharpness,
                                                               child_sharpness, parent.number, knots);
                      if (first)
                        product_of_steps.swap(S);
                      else
                        product(S, product_of_steps).swap(product_of_steps);
                      first = false;
                    });
  child.S.swap(product_of_steps);
  return child;
}

}  // namespace sublimit
