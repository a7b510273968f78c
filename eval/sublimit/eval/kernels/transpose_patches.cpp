// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/kernels/transpose_patches.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sublimit/eval/kernels/transpose_patches.cpp"
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

/// Columns from `column` on, as many as there are lanes; `Known` channels from `channel` on.
template <int Known, bool Contract, class D, class Real = hn::TFromD<D>>
HWY_INLINE void columns_of(D d, const TransposedPatches<Real>& p, std::int64_t point, std::int32_t column, int channel,
                           Real* out) {
  hn::Vec<D> sums[Known];
  for (int c = 0; c < Known; ++c) sums[c] = hn::Zero(d);
  for (int q = 0; q < p.quantities; ++q) {
    const Real* const weights = p.weights[q] + column;
    const Real* value = p.values[q] + point * p.channels + channel;
    for (const std::int32_t row : p.rows) {
      const auto w = hn::LoadU(d, weights + std::int64_t{row} * p.columns);
      for (int c = 0; c < Known; ++c) sums[c] = mul_add<Contract>(w, hn::Set(d, value[c]), sums[c]);
      value += p.channels;
    }
  }
  HWY_ALIGN Real made[hn::MaxLanes(d)];
  for (int c = 0; c < Known; ++c) {
    hn::Store(sums[c], d, made);
    for (size_t i = 0; i < hn::Lanes(d); ++i) out[(column + std::int64_t(i)) * p.channels + channel + c] = made[i];
  }
}

/// Wide registers first, then ever narrower ones: none reads past the end of a row.
template <int Lanes, bool Contract, class Real>
HWY_INLINE void all_columns(const TransposedPatches<Real>& p, std::int64_t point, std::int32_t column, Real* out) {
  const hn::CappedTag<Real, Lanes> d;
  const auto lanes = static_cast<std::int32_t>(hn::Lanes(d));
  for (; column + lanes <= p.columns; column += lanes) {
    int channel = 0;
    for (; p.channels - channel >= 3; channel += 3) columns_of<3, Contract>(d, p, point, column, channel, out);
    for (; channel < p.channels; ++channel) columns_of<1, Contract>(d, p, point, column, channel, out);
  }
  if constexpr (Lanes > 1) all_columns<Lanes / 2, Contract>(p, point, column, out);
}

template <bool Contract, class Real>
void transpose(const TransposedPatches<Real>& p) {
  Real* out = p.result;
  for (std::int64_t i = 0; i < p.count; ++i, out += std::int64_t{p.columns} * p.channels)
    all_columns<16, Contract>(
        p, p.patch_points ? p.patch_points[i] : p.first_point + i * static_cast<std::int64_t>(p.rows.size()), 0, out);
}

void transpose_float(const TransposedPatches<float>& p, bool contract) {
  contract ? transpose<true>(p) : transpose<false>(p);
}
void transpose_double(const TransposedPatches<double>& p, bool contract) {
  contract ? transpose<true>(p) : transpose<false>(p);
}

}  // namespace sublimit::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sublimit::kernels {

HWY_EXPORT(transpose_float);
HWY_EXPORT(transpose_double);

void transpose_patches(const TransposedPatches<float>& patches, bool contract) {
  HWY_DYNAMIC_DISPATCH(transpose_float)(patches, contract);
}
void transpose_patches(const TransposedPatches<double>& patches, bool contract) {
  HWY_DYNAMIC_DISPATCH(transpose_double)(patches, contract);
}

}  // namespace sublimit::kernels
#endif
