// SPDX-License-Identifier: Apache-2.0
#pragma once
// Laws that every scheme obeys, as functions: the tests run them over the registry, and over mutants, which must break one.
#include <string>
#include <vector>

#include "sublimit/scheme.h"

namespace sublimit::testing {

struct Law {
  std::string name;
  /// Empty if the scheme obeys, else what is wrong.
  std::string (*violation)(const Scheme<double>& scheme);
};

const std::vector<Law>& laws();

}  // namespace sublimit::testing
