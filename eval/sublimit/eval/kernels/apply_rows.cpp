// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/kernels/apply_rows.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sublimit/eval/kernels/apply_rows.cpp"
#include <hwy/foreach_target.h>  // NOLINT: must come first
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sublimit::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <bool Contract, class V>
HWY_INLINE V mul_add(V a, V b, V sum) {
  if constexpr (Contract) return hn::MulAdd(a, b, sum);
  return hn::Add(hn::Mul(a, b), sum);
}

/// Three channels, one after the other in points and results, in a register of four.
template <bool Contract, class D, class Real = hn::TFromD<D>>
HWY_INLINE void rows_of_three(D d, const Rows<Real>& r) {
  if (r.num_rows == 0) return;
  // A register reads one number too many, which the last point does not have.
  Real last[4] = {};
  if (r.num_points > 0) std::copy_n(r.points + (r.num_points - 1) * r.in.point, 3, last);
  const auto sum = [&](std::int64_t row) HWY_ATTR {
    auto x = hn::Zero(d);
    for (std::int64_t k = r.offsets[row]; k < r.offsets[row + 1]; ++k) {
      const std::int64_t column = r.columns[k];
      const Real* const point = column == r.num_points - 1 ? last : r.points + column * r.in.point;
      x = mul_add<Contract>(hn::Set(d, r.weights[k]), hn::LoadU(d, point), x);
    }
    return x;
  };
  Real* out = r.result;
  if (r.out.point == 3) {
    for (std::int64_t row = 0; row + 1 < r.num_rows; ++row, out += 3)
      hn::StoreU(sum(row), d, out);  // the fourth number is overwritten by the next row
    HWY_ALIGN Real made[4];
    hn::Store(sum(r.num_rows - 1), d, made);
    std::copy_n(made, 3, out);
    return;
  }
  for (std::int64_t row = 0; row < r.num_rows; ++row, out += r.out.point) {
    HWY_ALIGN Real made[4];
    hn::Store(sum(row), d, made);
    std::copy_n(made, 3, out);
  }
}

/// `Known` channels of any strides, from `channel` on.
template <int Known, bool Contract, class Real>
HWY_INLINE void rows_of_known(const Rows<Real>& r, int channel) {
  const hn::CappedTag<Real, 1> d;
  const Real* const points = r.points + channel * r.in.channel;
  Real* out = r.result + channel * r.out.channel;
  for (std::int64_t row = 0; row < r.num_rows; ++row, out += r.out.point) {
    hn::Vec<decltype(d)> sums[Known];
    for (int c = 0; c < Known; ++c) sums[c] = hn::Zero(d);
    for (std::int64_t k = r.offsets[row]; k < r.offsets[row + 1]; ++k) {
      const Real* const in = points + r.columns[k] * r.in.point;
      const auto w = hn::Set(d, r.weights[k]);
      for (int c = 0; c < Known; ++c) sums[c] = mul_add<Contract>(w, hn::Set(d, in[c * r.in.channel]), sums[c]);
    }
    for (int c = 0; c < Known; ++c) out[c * r.out.channel] = hn::GetLane(sums[c]);
  }
}

template <bool Contract, class Real>
void apply(const Rows<Real>& r) {
  const hn::CappedTag<Real, 4> d;
  if (r.channels == 3 && r.in.channel == 1 && r.out.channel == 1 && hn::Lanes(d) == 4)
    return rows_of_three<Contract>(d, r);
  int channel = 0;
  for (; r.channels - channel >= 4; channel += 4) rows_of_known<4, Contract>(r, channel);
  if (r.channels - channel == 3) rows_of_known<3, Contract>(r, channel);
  if (r.channels - channel == 2) rows_of_known<2, Contract>(r, channel);
  if (r.channels - channel == 1) rows_of_known<1, Contract>(r, channel);
}

void rows_float(const Rows<float>& r, bool contract) { contract ? apply<true>(r) : apply<false>(r); }
void rows_double(const Rows<double>& r, bool contract) { contract ? apply<true>(r) : apply<false>(r); }

}  // namespace sublimit::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sublimit::kernels {

HWY_EXPORT(rows_float);
HWY_EXPORT(rows_double);

void apply_rows(const Rows<float>& rows, bool contract) { HWY_DYNAMIC_DISPATCH(rows_float)(rows, contract); }
void apply_rows(const Rows<double>& rows, bool contract) { HWY_DYNAMIC_DISPATCH(rows_double)(rows, contract); }

}  // namespace sublimit::kernels
#endif
