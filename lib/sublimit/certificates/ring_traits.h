// SPDX-License-Identifier: Apache-2.0
#pragma once
// What Eigen wants to know of numbers that are objects.
#include <Eigen/Core>

namespace sublimit {

template <class T>
struct RingTraits : Eigen::GenericNumTraits<T> {
  using Real = T;
  using NonInteger = T;
  using Nested = T;
  using Literal = T;
  enum {
    IsComplex = 0,  // Eigen has nothing to conjugate: adjoints are written out
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 10,
    AddCost = 50,
    MulCost = 100
  };
};

}  // namespace sublimit
