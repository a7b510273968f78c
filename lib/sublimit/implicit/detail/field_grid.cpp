// SPDX-License-Identifier: Apache-2.0
#include "sublimit/implicit/detail/field_grid.h"

#include <cmath>
#include <limits>
#include <string>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

using Eigen::Vector3d;

constexpr int least_cells = 4;
/// Values here and in the polygoniser's tree, and its marks.
constexpr double bytes_each = 24;

std::string words(const Vector3d& x) {
  return "(" + format_number(x[0]) + ", " + format_number(x[1]) + ", " + format_number(x[2]) + ")";
}

/// What was found in a slab: places as numbers of values, -1: none.
struct Slab {
  double least = std::numeric_limits<double>::infinity(), largest = -least;
  std::ptrdiff_t at_least = -1, not_finite = -1, on_rim = -1;
};

}  // namespace

Eigen::AlignedBox3d padded_extent(const Field& field, int cells) {
  std::optional<Eigen::AlignedBox3d> box = field.extent();
  if (!box)
    throw InvalidParameter(
        "nothing tells how far the field goes; give a box [[x, y, z], [x, y, z]] around its surface");
  if (box->isEmpty() || !(box->sizes().maxCoeff() > 0))
    throw InvalidParameter("nothing is inside the field: it is nowhere negative");
  const double pad = box->sizes().maxCoeff() / std::max(1, cells - 2);
  box->min().array() -= pad;
  box->max().array() += pad;
  return *box;
}

FieldGrid sample_field(const Field& field, const Eigen::AlignedBox3d& box, int cells) {
  if (!box.min().allFinite() || !box.max().allFinite() || !(box.sizes().minCoeff() > 0))
    throw InvalidParameter("the box from " + words(box.min()) + " to " + words(box.max()) +
                           " has no inside; the second corner should be greater in x, y and z");
  if (cells < least_cells)
    throw InvalidParameter(format_number(cells) + " cells; there should be " + format_number(least_cells) + " or more");
  FieldGrid grid;
  grid.cell = box.sizes().maxCoeff() / cells;
  double count = 1;
  for (size_t i = 0; i < 3; ++i) {
    // A side that is a whole number of cells but for rounding has that number.
    grid.size[i] = std::max(2, int(std::ceil(box.sizes()[Eigen::Index(i)] / grid.cell - 1e-9))) + 1;
    count *= grid.size[i];
  }
  check_memory("fields of " + format_number(grid.size[0] - 1) + " x " + format_number(grid.size[1] - 1) + " x " +
                   format_number(grid.size[2] - 1) + " cells",
               count * bytes_each, "take fewer cells or a smaller box");
  const Vector3d covered(grid.size[0] - 1, grid.size[1] - 1, grid.size[2] - 1);
  grid.origin = box.center() - grid.cell / 2 * covered;
  grid.values.resize(size_t(count));
  const int nx = grid.size[0], ny = grid.size[1], nz = grid.size[2];  // clang 14 captures no structured bindings
  std::vector<Slab> slabs(size_t(nz), Slab{});
  parallel_for_blocks(
      nz,
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        for (int k = int(begin); k < int(end); ++k) {
          Slab& slab = slabs[size_t(k)];
          std::ptrdiff_t at = std::ptrdiff_t(k) * ny * nx;
          for (int j = 0; j < ny; ++j)
            for (int i = 0; i < nx; ++i, ++at) {
              const double value = field.value(grid.place(i, j, k));
              grid.values[size_t(at)] = value;
              if (!std::isfinite(value)) {
                if (slab.not_finite < 0) slab.not_finite = at;
                continue;
              }
              if (value < slab.least) slab.at_least = at;
              slab.least = std::min(slab.least, value);
              slab.largest = std::max(slab.largest, value);
              const bool rim = i == 0 || j == 0 || k == 0 || i == nx - 1 || j == ny - 1 || k == nz - 1;
              if (rim && value <= 0 && slab.on_rim < 0) slab.on_rim = at;
            }
        }
      },
      1);
  Slab all;
  for (const Slab& slab : slabs) {
    if (all.not_finite < 0) all.not_finite = slab.not_finite;
    if (all.on_rim < 0) all.on_rim = slab.on_rim;
    if (slab.least < all.least) all.at_least = slab.at_least;
    all.least = std::min(all.least, slab.least);
    all.largest = std::max(all.largest, slab.largest);
  }
  const auto place = [&, nx = nx, ny = ny](std::ptrdiff_t at) {
    return grid.place(int(at % nx), int(at / nx % ny), int(at / nx / ny));
  };
  if (all.not_finite >= 0)
    throw InvalidParameter("the field is " + format_number(grid.values[size_t(all.not_finite)]) + " at " +
                           words(place(all.not_finite)) + "; it should be a number everywhere in the box");
  grid.least = all.least;
  grid.largest = all.largest;
  const std::string range = "the field has no change of sign at " + format_number(grid.values.size()) +
                            " places of the box from " + words(box.min()) + " to " + words(box.max()) +
                            ": it is between " + format_number(all.least) + " and " + format_number(all.largest) + "; ";
  if (all.largest <= 0) throw InvalidParameter(range + "make the box larger, or change the sign of the field");
  if (!(all.least < 0)) {
    const Projection near = project(field, place(all.at_least), 2 * grid.cell);
    if (near.converged)
      throw InvalidParameter(range + "its surface is thinner than a cell of " + format_number(grid.cell) + " at " +
                             words(near.point) + "; take more cells");
    throw InvalidParameter(range + "nothing is inside; move the box, or take more cells if the surface is thin");
  }
  if (all.on_rim >= 0)
    throw InvalidParameter("the surface touches the rim of the box: the field is " +
                           format_number(grid.values[size_t(all.on_rim)]) + " at " + words(place(all.on_rim)) +
                           ", where it should be positive; make the box larger");
  return grid;
}

}  // namespace sublimit
