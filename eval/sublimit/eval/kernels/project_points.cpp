// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/kernels/project_points.h"

#include <algorithm>

// Compiled once for each kind of registers.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sublimit/eval/kernels/project_points.cpp"
#include <hwy/foreach_target.h>  // NOLINT: must come first
#include <hwy/highway.h>

#include "sublimit/eval/kernels/channels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sublimit::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// a - b * c
template <bool Contract, class V>
HWY_INLINE V sub_mul(V a, V b, V c) {
  if constexpr (Contract) return hn::NegMulAdd(b, c, a);
  return hn::Sub(a, hn::Mul(b, c));
}

/// `count` of the points in registers, which begin at `out`.
template <int Channels, class D, class Real = hn::TFromD<D>, class V = hn::Vec<D>>
HWY_INLINE void put(D d, const Values<Channels, V>& x, std::int64_t count, const Strides& strides, Real* out) {
  const auto lanes = static_cast<std::int64_t>(hn::Lanes(d));
  HWY_ALIGN Real made[Channels * hn::MaxLanes(d)];
  if (strides.channel == 1 && strides.point == Channels) {
    if (count >= lanes) return store_interleaved(d, x, out);
    store_interleaved(d, x, made);
    std::copy_n(made, Channels * count, out);
    return;
  }
  for (int c = 0; c < Channels; ++c) {
    Real* to = out + c * strides.channel;
    if (strides.point == 1 && count >= lanes) {
      hn::StoreU(x.of[c], d, to);
      continue;
    }
    hn::Store(x.of[c], d, made);
    for (std::int64_t i = 0; i < std::min(count, lanes); ++i, to += strides.point) *to = made[i];
  }
}

/// A term of the quotient rule: factor * w_row x_lower.
struct Term {
  int row, lower, factor;
};
struct Terms {
  int count;
  Term of[3];
};
constexpr Terms quotient_terms[6] = {{0, {}},
                                     {1, {{1, 0, 1}}},
                                     {1, {{2, 0, 1}}},
                                     {2, {{1, 1, 2}, {3, 0, 1}}},
                                     {3, {{1, 2, 1}, {2, 1, 1}, {4, 0, 1}}},
                                     {2, {{2, 2, 2}, {5, 0, 1}}}};

/// Channels from `channel` on, of quantities up to `Order`.
template <int Channels, int Order, bool Contract, class Real>
HWY_NOINLINE void project(const Projection<Real>& p, int channel) {
  const hn::ScalableTag<Real> d;
  using V = hn::Vec<decltype(d)>;
  constexpr int Quantities = Order == 0 ? 1 : Order == 1 ? 3 : 6;
  const auto lanes = static_cast<std::int64_t>(hn::Lanes(d));
  const V least = hn::Set(d, p.least_weight), one = hn::Set(d, Real(1));
  const auto load = [&](int q, int c, std::int64_t i) {
    return hn::LoadU(d, p.values + (q * (p.channels + 1) + c) * p.plane + i);
  };
  for (std::int64_t i = 0; i < p.count; i += lanes) {
    V w[Quantities];
    for (int q = 0; q < Quantities; ++q) w[q] = load(q, p.channels, i);
    const auto is_point = hn::Gt(hn::Abs(w[0]), least);
    const V divisor = hn::IfThenElse(is_point, w[0], one);
    Values<Channels, V> x[Quantities];
    for (int q = 0; q < Quantities; ++q) {
      const Terms& terms = quotient_terms[q];
      for (int c = 0; c < Channels; ++c) {
        V value = load(q, channel + c, i);
        for (int t = 0; t < terms.count; ++t) {
          const V& lower = x[terms.of[t].lower].of[c];
          value = sub_mul<Contract>(value, w[terms.of[t].row], terms.of[t].factor == 2 ? hn::Add(lower, lower) : lower);
        }
        x[q].of[c] = hn::IfThenElseZero(is_point, hn::Div(value, divisor));
      }
      if (p.results[q])
        put<Channels>(d, x[q], p.count - i, p.out, p.results[q] + i * p.out.point + channel * p.out.channel);
    }
    if constexpr (Channels == 3 && Order >= 1) {
      const TangentFrames<Real>& f = p.frames;
      if (!f.tangents && !f.bitangents && !f.normals) continue;
      const Frame<V> frame = tangent_frame<Contract>(d, x[1], x[2]);
      const std::int64_t at = i * p.out.point, left = p.count - i;
      if (f.tangents) put<3>(d, frame.t, left, p.out, f.tangents + at);
      if (f.bitangents) put<3>(d, cross(frame.n, frame.t), left, p.out, f.bitangents + at);
      if (f.normals) put<3>(d, frame.n, left, p.out, f.normals + at);
    }
  }
}

template <int Order, bool Contract, class Real>
void project_channels(const Projection<Real>& p) {
  int channel = 0;
  for (; p.channels - channel >= 3; channel += 3) project<3, Order, Contract>(p, channel);
  for (; channel < p.channels; ++channel) project<1, Order, Contract>(p, channel);
}

template <bool Contract, class Real>
void project_order(const Projection<Real>& p) {
  const bool framed = p.frames.tangents || p.frames.bitangents || p.frames.normals;
  if (p.results[3] || p.results[4] || p.results[5]) return project_channels<2, Contract>(p);
  if (p.results[1] || p.results[2] || framed) return project_channels<1, Contract>(p);
  project_channels<0, Contract>(p);
}

void project_float(const Projection<float>& p, bool contract) {
  contract ? project_order<true>(p) : project_order<false>(p);
}
void project_double(const Projection<double>& p, bool contract) {
  contract ? project_order<true>(p) : project_order<false>(p);
}

}  // namespace sublimit::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sublimit::kernels {

HWY_EXPORT(project_float);
HWY_EXPORT(project_double);

void project_points(const Projection<float>& projection, bool contract) {
  HWY_DYNAMIC_DISPATCH(project_float)(projection, contract);
}
void project_points(const Projection<double>& projection, bool contract) {
  HWY_DYNAMIC_DISPATCH(project_double)(projection, contract);
}

}  // namespace sublimit::kernels
#endif
