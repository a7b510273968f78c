// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdlib>
#include <string>

namespace sublimit::testing {

/// A Python that has NumPy and SciPy; empty if there is none.
inline std::string python_with_scipy() {
  for (const std::string name : {"/usr/bin/python3", "python3"})
    if (std::system((name + " -c 'import numpy, scipy.interpolate' 2>/dev/null").c_str()) == 0) return name;
  return {};
}

}  // namespace sublimit::testing
