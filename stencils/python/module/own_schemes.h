// SPDX-License-Identifier: Apache-2.0
#pragma once
// Schemes whose masks are methods of a Python object.
#include <pybind11/pybind11.h>

#include <memory>

#include "sublimit/certificates/numbers/algebraic.h"
#include "sublimit/scheme/scheme.h"

namespace sublimit::python {

/// A scheme instantiated for doubles and for exact numbers.
struct OwnScheme {
  std::shared_ptr<const Scheme<double>> scheme;
  std::shared_ptr<const Scheme<Algebraic>> exact;
};

}  // namespace sublimit::python
