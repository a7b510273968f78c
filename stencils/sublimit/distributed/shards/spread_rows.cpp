// SPDX-License-Identifier: Apache-2.0
#include "sublimit/distributed/shards/spread_rows.h"

#include <algorithm>
#include <utility>

#include "sublimit/core/detail/sparse_product.h"

namespace sublimit {
namespace {

const SpreadRows& of(Mat matrix) {
  void* rows = nullptr;
  check_petsc(MatShellGetContext(matrix, &rows));
  return *static_cast<const SpreadRows*>(rows);
}

/// One way or the other, between so many points.
template <class Made>
PetscErrorCode multiply_points(Vec x, Vec y, std::int64_t num_from, std::int64_t num_to, int channels,
                               const Made& made) {
  return multiply(x, y, [&](std::span<const double> from, std::span<double> to) {
    Eigen::Map<Points>(to.data(), num_to, channels) = made(Eigen::Map<const Points>(from.data(), num_from, channels));
  });
}

PetscErrorCode mult(Mat matrix, Vec x, Vec y) {
  const SpreadRows& rows = of(matrix);
  return multiply_points(x, y, rows.halo().num_own(), rows.num_rows(), rows.channels(),
                         [&](const ConstPoints& own) { return rows.apply(own); });
}

PetscErrorCode mult_transpose(Mat matrix, Vec x, Vec y) {
  const SpreadRows& rows = of(matrix);
  return multiply_points(x, y, rows.num_rows(), rows.halo().num_own(), rows.channels(),
                         [&](const ConstPoints& values) { return rows.apply_transpose(values); });
}

}  // namespace

Points fetched(const Halo& halo, const ConstPoints& own) {
  Points inputs(halo.num_inputs(), own.cols());
  halo.fetch({own.data(), size_t(own.size())}, int(own.cols()), {inputs.data(), size_t(inputs.size())});
  return inputs;
}

Points summed(const Halo& halo, const ConstPoints& inputs) {
  Points own(halo.num_own(), inputs.cols());
  halo.add({inputs.data(), size_t(inputs.size())}, int(inputs.cols()), {own.data(), size_t(own.size())});
  return own;
}

SpreadRows::SpreadRows(SparseMatrix rows, const Halo& halo, Eigen::VectorXd scale, int channels)
    : rows_(std::move(rows)),
      transpose_(rows_.transpose()),
      halo_(halo),
      scale_(std::move(scale)),
      channels_(channels) {}

Points SpreadRows::apply(const ConstPoints& own) const {
  Points made = sublimit::apply(rows_, fetched(halo_, own));
  if (scale_.size() > 0) made.array().colwise() *= scale_.array();
  return made;
}

Points SpreadRows::apply_transpose(const ConstPoints& values) const {
  Points scaled = values;
  if (scale_.size() > 0) scaled.array().colwise() *= scale_.array();
  return summed(halo_, sublimit::apply(transpose_, scaled));
}

PetscObjectOf<Mat> matrix(const SpreadRows& rows) {
  PetscObjectOf<Mat> matrix;
  check_petsc(MatCreateShell(PETSC_COMM_WORLD, rows.channels() * rows.num_rows(),
                             rows.channels() * rows.halo().num_own(), PETSC_DETERMINE, PETSC_DETERMINE,
                             const_cast<SpreadRows*>(&rows), &matrix.value));
  check_petsc(MatShellSetOperation(matrix, MATOP_MULT, reinterpret_cast<void (*)()>(mult)));
  check_petsc(MatShellSetOperation(matrix, MATOP_MULT_TRANSPOSE, reinterpret_cast<void (*)()>(mult_transpose)));
  return matrix;
}

PetscObjectOf<Mat> assembled(const Ranks& ranks, const SparseMatrix& own, const Runs& runs,
                             std::span<const std::int64_t> inputs, const Halo& halo) {
  // How many entries a row has at most, in the columns of the rank that has it and in others: room is taken once.
  Points near = Points::Zero(halo.num_inputs(), 1), far = near;
  std::vector<int> rank_of;
  for (const std::int64_t input : inputs) rank_of.push_back(runs.rank_of(input));
  for (Index r = 0; r < own.rows(); ++r)
    for (SparseMatrix::InnerIterator e(own, r); e; ++e)
      (rank_of[size_t(r)] == rank_of[size_t(e.col())] ? near : far)(r, 0) += 1;
  const auto num_own = halo.num_own(), num_others = runs.size() - num_own;
  const Points most_near = summed(halo, near), most_far = summed(halo, far);
  std::vector<PetscInt> room_near, room_far;
  for (Eigen::Index v = 0; v < num_own; ++v) {
    room_near.push_back(std::min(std::max(PetscInt(most_near(v, 0)), PetscInt{1}), num_own));
    room_far.push_back(std::min(PetscInt(most_far(v, 0)), num_others));
  }
  PetscObjectOf<Mat> matrix;
  check_petsc(MatCreate(PETSC_COMM_WORLD, &matrix.value));
  check_petsc(MatSetSizes(matrix, num_own, num_own, runs.size(), runs.size()));
  check_petsc(MatSetType(matrix, MATAIJ));
  check_petsc(MatXAIJSetPreallocation(matrix, 1, room_near.data(), room_far.data(), nullptr, nullptr));
  check_petsc(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE));
  std::vector<PetscInt> columns;
  for (Index r = 0; r < own.rows(); ++r) {
    const std::int64_t begin = own.outerIndexPtr()[r], end = own.outerIndexPtr()[r + 1];
    columns.clear();
    for (std::int64_t k = begin; k < end; ++k) columns.push_back(inputs[size_t(own.innerIndexPtr()[k])]);
    const PetscInt row = inputs[size_t(r)];
    check_petsc(MatSetValues(matrix, 1, &row, end - begin, columns.data(), own.valuePtr() + begin, ADD_VALUES));
  }
  for (PetscInt v = 0; v < num_own; ++v)
    if (most_near(v, 0) == 0)
      check_petsc(MatSetValue(matrix, runs.begin(ranks.rank()) + v, runs.begin(ranks.rank()) + v, 1, ADD_VALUES));
  check_petsc(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY));
  check_petsc(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY));
  return matrix;
}

}  // namespace sublimit
