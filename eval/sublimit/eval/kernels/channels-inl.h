// SPDX-License-Identifier: Apache-2.0
// Several channels in registers, and directions of three. Included once for each kind of registers.
#if defined(SUBLIMIT_CHANNELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SUBLIMIT_CHANNELS_INL_H
#undef SUBLIMIT_CHANNELS_INL_H
#else
#define SUBLIMIT_CHANNELS_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sublimit::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <bool Contract, class V>
HWY_INLINE V mul_add(V a, V b, V sum) {
  if constexpr (Contract) return hn::MulAdd(a, b, sum);
  return hn::Add(hn::Mul(a, b), sum);
}

/// Registers of `Channels` channels, with a row in each lane.
template <int Channels, class V>
struct Values {
  V of[Channels];
};

template <class D, class V, class Real>
HWY_INLINE void store_interleaved(D d, const Values<1, V>& x, Real* out) {
  hn::StoreU(x.of[0], d, out);
}
template <class D, class V, class Real>
HWY_INLINE void store_interleaved(D d, const Values<2, V>& x, Real* out) {
  hn::StoreInterleaved2(x.of[0], x.of[1], d, out);
}
template <class D, class V, class Real>
HWY_INLINE void store_interleaved(D d, const Values<3, V>& x, Real* out) {
  hn::StoreInterleaved3(x.of[0], x.of[1], x.of[2], d, out);
}
template <class D, class V, class Real>
HWY_INLINE void store_interleaved(D d, const Values<4, V>& x, Real* out) {
  hn::StoreInterleaved4(x.of[0], x.of[1], x.of[2], x.of[3], d, out);
}

template <bool Contract, class V>
HWY_INLINE V dot(const Values<3, V>& a, const Values<3, V>& b) {
  return mul_add<Contract>(a.of[2], b.of[2], mul_add<Contract>(a.of[1], b.of[1], hn::Mul(a.of[0], b.of[0])));
}

template <class V>
HWY_INLINE Values<3, V> cross(const Values<3, V>& a, const Values<3, V>& b) {
  // Never contracted: u x u is zero then.
  Values<3, V> n;
  for (int c = 0; c < 3; ++c) {
    const int i = (c + 1) % 3, j = (c + 2) % 3;
    n.of[c] = hn::Sub(hn::Mul(a.of[i], b.of[j]), hn::Mul(a.of[j], b.of[i]));
  }
  return n;
}

/// Returns a vector normalised: divided by its largest magnitude, so that squares neither overflow nor vanish, then by
/// its length. Zero stays zero.
template <bool Contract, class D, class V = hn::Vec<D>>
HWY_INLINE Values<3, V> unit(D d, Values<3, V> a) {
  const V zero = hn::Zero(d), one = hn::Set(d, hn::TFromD<D>(1));
  const V largest = hn::Max(hn::Max(hn::Abs(a.of[0]), hn::Abs(a.of[1])), hn::Abs(a.of[2]));
  const V scale = hn::IfThenElse(hn::Gt(largest, zero), largest, one);
  for (int c = 0; c < 3; ++c) a.of[c] = hn::Div(a.of[c], scale);
  const V square = dot<Contract>(a, a), length = hn::Sqrt(hn::IfThenElse(hn::Gt(square, zero), square, one));
  for (int c = 0; c < 3; ++c) a.of[c] = hn::Div(a.of[c], length);
  return a;
}

/// Unit vectors t along u and n along u x v; both are zero where u x v is zero or not finite.
template <class V>
struct Frame {
  Values<3, V> t, n;
};
template <bool Contract, class D, class V = hn::Vec<D>>
HWY_INLINE Frame<V> tangent_frame(D d, const Values<3, V>& u, const Values<3, V>& v) {
  // Directions first: their cross product is not too large or small to be normalised.
  Values<3, V> t = unit<Contract>(d, u), n = unit<Contract>(d, cross(t, unit<Contract>(d, v)));
  const V size = dot<Contract>(n, n);  // one, zero, or no number
  const auto valid = hn::Gt(size, hn::Zero(d));
  for (int c = 0; c < 3; ++c) {
    t.of[c] = hn::IfThenElseZero(valid, t.of[c]);
    n.of[c] = hn::IfThenElseZero(valid, n.of[c]);
  }
  return {t, n};
}

}  // namespace sublimit::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
