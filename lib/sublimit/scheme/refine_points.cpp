// SPDX-License-Identifier: Apache-2.0
#include "sublimit/scheme/refine_points.h"

#include <memory>
#include <string>

#include "sublimit/base/error.h"
#include "sublimit/base/memory.h"
#include "sublimit/base/parallel_for.h"
#include "sublimit/scheme/check_levels.h"
#include "sublimit/scheme/refine_impl.h"

namespace sublimit {
namespace {

using assembly::RowMaker;

/// One row at a time. No row is longer than there are points; memory that no row reaches is never touched.
class Row {
 public:
  Row(RowMaker<double> maker, Index width)
      : maker_(std::move(maker)),
        columns_(std::make_unique_for_overwrite<Index[]>(size_t(width))),
        values_(std::make_unique_for_overwrite<double[]>(size_t(width))) {}

  template <class Visit>
  void visit(const Refinement& refinement, Vertex child, const Visit& term) {
    const Index count = assembly::write_row(maker_, refinement, child, columns_.get(), values_.get());
    for (Index k = 0; k < count; ++k) term(columns_[k], values_[k]);
  }

 private:
  RowMaker<double> maker_;
  std::unique_ptr<Index[]> columns_;
  std::unique_ptr<double[]> values_;
};

}  // namespace

RefinedPoints refine_points(const Scheme<double>& scheme, Level control, Points points, int levels,
                            const std::function<void(int)>& progress) {
  if (points.rows() != control.topology().num_vertices())
    throw InvalidParameter("the mesh has " + std::to_string(control.topology().num_vertices()) + " vertices, but " +
                           std::to_string(points.rows()) + " points are given");
  check_levels(scheme, control.topology(), levels, LevelMemory::points);
  RefinedPoints result{std::move(control), std::move(points)};
  for (int k = 1; k <= levels; ++k) {
    if (progress) progress(k);
    const auto on_step = [&](const Step<double>& step, const Topology& topology, const Refinement& refinement,
                             const Sharpness& sharpness, const Sharpness& child_sharpness, const KnotSplit* knots) {
      const std::vector<std::uint8_t> plain = assembly::plain_vertices(topology, sharpness);
      tbb::enumerable_thread_specific<Row> rows([&] {
        return Row(RowMaker<double>(scheme, step, topology, refinement, sharpness, child_sharpness, result.level.number,
                                    knots, plain),
                   topology.num_vertices());
      });
      const Points& coarse = result.points;
      Points fine(refinement.topology.num_vertices(), coarse.cols());
      prefer_huge_pages(fine.data(), size_t(fine.size()) * sizeof(double));
      parallel_for_blocks(fine.rows(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        Row& row = rows.local();
        for (std::int64_t r = begin; r < end; ++r) {
          const Vertex child{static_cast<Index>(r)};
          if (coarse.cols() == 3) {
            double x = 0, y = 0, z = 0;
            row.visit(refinement, child, [&](Index column, double weight) {
              const double* const p = coarse.data() + 3 * std::ptrdiff_t(column);
              x += weight * p[0], y += weight * p[1], z += weight * p[2];
            });
            double* const to = fine.data() + 3 * r;
            to[0] = x, to[1] = y, to[2] = z;
          } else {
            fine.row(r).setZero();
            row.visit(refinement, child,
                      [&](Index column, double weight) { fine.row(r) += weight * coarse.row(column); });
          }
        }
      });
      result.points = std::move(fine);
    };
    result.level = next_topology(scheme, result.level, on_step);
  }
  return result;
}

RefinedPoints refine_points(const Scheme<double>& scheme, const ControlMesh& mesh, int levels,
                            const SubdivisionOptions& options, const std::function<void(int)>& progress) {
  return refine_points(scheme, control_level(scheme, mesh, options), mesh.positions, levels, progress);
}

}  // namespace sublimit
