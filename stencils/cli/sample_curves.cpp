// SPDX-License-Identifier: Apache-2.0
#include "sample.h"
#include "sublimit/base/error.h"

namespace sublimit::cli {

int sample_curves(const SampleJob& job) {
  throw InvalidOption(job.common.scheme + " refines curves; `sample` takes schemes of surfaces (`sublimit schemes` " +
                      "lists all), and `limit` gives the points of a level of curves");
}

}  // namespace sublimit::cli
