// SPDX-License-Identifier: Apache-2.0
#pragma once
// Traits by which Eigen takes number types that are objects with memory of their own, as Ball and Algebraic. For a
// number type `MyNumber` of your program:
//
//   template <>
//   struct Eigen::NumTraits<MyNumber> : sublimit::RingTraits<MyNumber> {};
#include <Eigen/Core>

namespace sublimit {

/// Base of `Eigen::NumTraits` of a number type with +, -, *, / and ==. T stands for its own real type: Eigen conjugates
/// nothing.
template <class T>
struct RingTraits : Eigen::GenericNumTraits<T> {
  using Real = T;
  using NonInteger = T;
  using Nested = T;
  using Literal = T;
  enum {
    IsComplex = 0,  // also for complex T: adjoints are written out by the callers
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 10,
    AddCost = 50,
    MulCost = 100
  };
};

}  // namespace sublimit
