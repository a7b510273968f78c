// SPDX-License-Identifier: Apache-2.0
// Tables of classical patches. A face is a block, which depends on its type alone, and a list of control points: the
// inside of a surface with uniform knots is one block, however large it is.
#include <algorithm>
#include <limits>
#include <string>
#include <unordered_map>

#include "sublimit/base/detail/memory.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/patches/detail/patch_levels.h"
#include "sublimit/stencils/bake/detail/bake.h"
#include "sublimit/stencils/bake/detail/bake_rows.h"
#include "sublimit/stencils/bake/detail/table_info.h"
#include "sublimit/stencils/patterns/point_status.h"

namespace sublimit {
namespace {

/// Faces of one type, by their statuses.
struct FaceType {
  Index num_slots = 0;
  std::vector<double> weights;  ///< quantities x places x slots
  struct Faces {
    std::vector<Index> all;
    std::vector<std::uint8_t> status;  ///< of each place
  };
  std::vector<Faces> groups;
};

/// Weights of all places of a face, and the statuses of each group.
void fill(const PatchSet& patches, std::span<const Place> places, int derivatives, FaceType& type) {
  const auto slots = static_cast<size_t>(type.num_slots);
  type.weights.assign(size_t(num_quantities(derivatives)) * places.size() * slots, 0);
  WeightRows weights;
  for (FaceType::Faces& group : type.groups) {
    const Index face = group.all.front();
    const size_t p = patches.patch_of(face);
    const Index own = face - patches.first_face(p);
    for (size_t i = 0; i < places.size(); ++i) {
      const LimitStatus status =
          patches.members()[p].patch->rows({own, places[i].u, places[i].v}, derivatives, weights);
      const int order = weights.rows() == 6 ? 2 : weights.rows() == 3 ? 1 : 0;
      group.status.push_back(point_status(status, order, derivatives));
      if (&group != &type.groups.front()) continue;
      for (size_t q = 0; q < size_t(weights.rows()); ++q)
        std::copy_n(weights.row(Eigen::Index(q)).data(), slots,
                    type.weights.begin() + std::ptrdiff_t((q * places.size() + i) * slots));
    }
  }
}

/// Faces by their types, in the order in which faces meet them.
std::vector<FaceType> types_of(const PatchSet& patches) {
  std::vector<FaceType> types;
  std::unordered_map<std::string, size_t> numbers;
  std::vector<std::unordered_map<std::string, size_t>> groups;
  for (Index face = 0; face < patches.faces().size; ++face) {
    const auto [at, is_new] = numbers.try_emplace(patches.type(face), types.size());
    if (is_new) {
      types.emplace_back().num_slots = static_cast<Index>(patches.slots(face).size());
      groups.emplace_back();
    }
    FaceType& type = types[at->second];
    const auto [group, is_new_group] = groups[at->second].try_emplace(patches.ends(face), type.groups.size());
    if (is_new_group) type.groups.emplace_back();
    type.groups[group->second].all.push_back(face);
  }
  return types;
}

PatternTable<double> grid_table(const PatchSet& patches, const BakeRequest& request, Baked& baked) {
  const Lattice lattice{request.grid - 1, patches.faces().triangles};
  const auto size = static_cast<std::size_t>(lattice.size());
  std::vector<Place> places;
  lattice.for_each([&](std::int32_t i, std::int32_t j) {
    places.push_back({0, double(i) / lattice.n, double(j) / lattice.n});
  });
  std::vector<FaceType> types = types_of(patches);
  double weights = 0, columns = 0;
  for (const FaceType& type : types) {
    weights += double(num_quantities(request.derivatives)) * double(size) * type.num_slots;
    for (const FaceType::Faces& group : type.groups) columns += double(group.all.size()) * type.num_slots;
  }
  check_memory(std::to_string(types.size()) + " blocks of " + std::to_string(size) + " places",
               3 * 8 * weights + 2 * 4 * columns, "use fewer places");
  parallel_for_blocks(
      std::ssize(types),
      [&](std::int64_t i, std::int64_t, std::int64_t) { fill(patches, places, request.derivatives, types[size_t(i)]); },
      1);
  PatternTable<double>::Arrays arrays;
  arrays.quantities = num_quantities(request.derivatives);
  std::vector<double> all_weights;
  std::vector<std::int32_t> rows, all_columns;
  std::vector<std::int64_t> patch_points;
  std::vector<std::uint8_t> status;
  all_weights.reserve(size_t(weights));
  all_columns.reserve(size_t(columns));
  for (FaceType& type : types) {
    const auto block = static_cast<std::int32_t>(arrays.blocks.size());
    arrays.blocks.push_back({lattice.size(), type.num_slots, std::ssize(all_weights)});
    all_weights.insert(all_weights.end(), type.weights.begin(), type.weights.end());
    for (const FaceType::Faces& group : type.groups) {
      arrays.groups.push_back({block, lattice.size(), std::ssize(rows), std::ssize(group.all)});
      for (std::int32_t i = 0; i < lattice.size(); ++i) rows.push_back(i);
      status.insert(status.end(), group.status.begin(), group.status.end());
      for (const Index face : group.all) {
        patch_points.push_back(std::int64_t{face} * lattice.size());
        const std::vector<Index> slots = patches.slots(face);
        all_columns.insert(all_columns.end(), slots.begin(), slots.end());
      }
    }
    type = {};
  }
  baked.statistics.types = static_cast<Index>(types.size());
  baked.statistics.faces = patches.faces().size;
  baked.statistics.method = BakeMethod::patterns;
  arrays.weights = std::move(all_weights);
  arrays.rows = std::move(rows);
  arrays.columns = std::move(all_columns);
  arrays.patch_points = std::move(patch_points);
  if (std::ranges::any_of(status, [](std::uint8_t s) { return s != 0; })) baked.table.row_status = std::move(status);
  return PatternTable<double>(patches.num_points(), std::move(arrays));
}

/// Points of the nets of level k.
SparseMatrix level_matrix(const PatchSet& patches, int level) {
  check_levels(patches, level, true);
  auto [fine, P] = patches.refined();
  for (int k = 1; k < level; ++k) {
    auto [next, S] = fine.refined();
    P = product(S, P);
    fine = std::move(next);
  }
  return P;
}

}  // namespace

Baked bake(const PatchSet& patches, const BakeRequest& request) {
  check(request);
  if (needs_refined_mesh(request))
    throw InvalidParameter(
        "face-varying channels, tags and the order of refinement are those of meshes, not of patches");
  if (request.rows == TableRows::limit)
    throw InvalidParameter("a level of patches is a net, whose points have no places of their own; take a grid");
  Baked baked;
  PatternTable<double>::Arrays arrays;
  arrays.quantities = num_quantities(request.derivatives);
  if (request.rows == TableRows::grid) {
    const double size = double(request.grid) * request.grid, faces = patches.faces().size;
    if (size * faces > std::numeric_limits<std::int32_t>::max())
      throw ResourceError("grids of " + std::to_string(request.grid) + " places a side on " +
                          std::to_string(patches.faces().size) + " faces are more points than 32-bit numbers count");
    baked.table.table = grid_table(patches, request, baked);
  } else if (request.rows == TableRows::samples) {
    add_places(patches, request.samples, request.derivatives, baked, arrays);
    set_samples(request, baked);
    baked.table.table = PatternTable<double>(patches.num_points(), std::move(arrays));
  } else {
    arrays.rest = as_table(level_matrix(patches, request.level));
    baked.table.table = PatternTable<double>(patches.num_points(), std::move(arrays));
  }
  baked.table.info = table_info(patches, request);
  count_table(baked);
  return baked;
}

}  // namespace sublimit
