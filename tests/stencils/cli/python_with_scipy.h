// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdlib>
#include <string>

#include "support/skip.h"

namespace sublimit::testing {

/// Returns the path of a Python with NumPy and SciPy; empty if there is none.
inline std::string python_with_scipy() {
  for (const std::string name : {"/usr/bin/python3", "python3"})
    if (std::system((name + " -c 'import numpy, scipy.interpolate' 2>/dev/null").c_str()) == 0) return name;
  return {};
}

}  // namespace sublimit::testing

/// Skips a test unless there is one; in CI the test fails.
#define SUBLIMIT_NEEDS_SCIPY \
  SUBLIMIT_NEEDS_PROGRAM(!::sublimit::testing::python_with_scipy().empty(), "python3-numpy python3-scipy")
