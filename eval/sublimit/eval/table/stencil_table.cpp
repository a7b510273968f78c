// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/table/stencil_table.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"

namespace sublimit {

template <class Real>
StencilTable<Real>::StencilTable(std::int32_t num_control_points, SharedArray<std::int64_t> offsets,
                                 SharedArray<std::int32_t> columns, SharedArray<Real> weights)
    : num_control_points_(num_control_points),
      offsets_(std::move(offsets)),
      columns_(std::move(columns)),
      weights_(std::move(weights)) {
  const auto fail = [](const std::string& what) { throw InvalidParameter("stencil table: " + what); };
  if (offsets_.empty() || offsets_.front() != 0 || !std::is_sorted(offsets_.begin(), offsets_.end()))
    fail("offsets must ascend from 0");
  const auto entries = static_cast<std::int64_t>(columns_.size());
  if (offsets_.back() != entries || weights_.size() != columns_.size())
    fail("the offsets end at " + std::to_string(offsets_.back()) + ", with " + std::to_string(entries) +
         " columns and " + std::to_string(weights_.size()) + " weights; all three must agree");
  for (std::int64_t k = 0; k < entries; ++k) {
    if (columns_[k] < 0 || columns_[k] >= num_control_points_)
      fail("entry " + std::to_string(k) + " names control point " + std::to_string(columns_[k]) + " of " +
           std::to_string(num_control_points_));
    if (!std::isfinite(weights_[k])) fail("the weight of entry " + std::to_string(k) + " is not finite");
  }
}

template <class Real>
void StencilTable<Real>::apply(std::span<const Real> points, int channels, std::span<Real> result) const {
  const auto check = [&](const char* name, size_t size, std::int64_t rows) {
    if (channels < 1 || size != static_cast<size_t>(rows) * static_cast<size_t>(channels))
      throw InvalidParameter(std::string("stencil table: ") + name + " holds " + std::to_string(size) + " numbers; " +
                             std::to_string(rows) + " x " + std::to_string(channels) + " channels are needed");
  };
  check("points", points.size(), num_control_points_);
  check("result", result.size(), num_rows());
  parallel_for_blocks(num_rows(), [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    apply_rows(points.data(), channels, begin, end, result.data() + begin * channels);
  });
}

template <class Real>
void StencilTable<Real>::apply_rows(const Real* points, int channels, std::int64_t begin, std::int64_t end,
                                    Real* out) const {
  // Sums in registers where the number of channels is known.
  const auto apply_known = [&]<int Known>() {
    for (std::int64_t r = begin; r < end; ++r, out += Known) {
      Real sums[Known];
      std::fill_n(sums, Known, Real(0));
      for (std::int64_t k = offsets_[r]; k < offsets_[r + 1]; ++k) {
        const Real* const in = points + std::int64_t{columns_[k]} * Known;
        for (int c = 0; c < Known; ++c) sums[c] += weights_[k] * in[c];
      }
      std::copy_n(sums, Known, out);
    }
  };
  if (channels == 1) return apply_known.template operator()<1>();
  if (channels == 2) return apply_known.template operator()<2>();
  if (channels == 3) return apply_known.template operator()<3>();
  if (channels == 4) return apply_known.template operator()<4>();
  for (std::int64_t r = begin; r < end; ++r, out += channels) {
    std::fill_n(out, channels, Real(0));
    for (std::int64_t k = offsets_[r]; k < offsets_[r + 1]; ++k) {
      const Real* const in = points + std::int64_t{columns_[k]} * channels;
      for (int c = 0; c < channels; ++c) out[c] += weights_[k] * in[c];
    }
  }
}

template class StencilTable<float>;
template class StencilTable<double>;

}  // namespace sublimit
