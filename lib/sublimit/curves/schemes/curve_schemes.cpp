// SPDX-License-Identifier: Apache-2.0
#include "sublimit/curves/schemes/curve_schemes.h"

namespace sublimit {

CurveScheme<double> curve_scheme(const std::string& name, const SchemeOptions& options) {
  return curve_scheme<double>(name, options);
}

}  // namespace sublimit
