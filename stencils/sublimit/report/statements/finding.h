// SPDX-License-Identifier: Apache-2.0
#pragma once
// What an experiment finds out about a sentence: whether it is so, the numbers that decide, and what was computed.
#include <string>
#include <vector>

#include "sublimit/files/numbers.h"

namespace sublimit::report {

/// `depends`: so in some of the cases that the sentence speaks of, and not in others.
enum class Fate { confirmed, refuted, depends };

struct Finding {
  Fate fate = Fate::depends;
  std::string computed;  ///< one sentence
  Json numbers = Json::object();
};

inline Fate fate(bool is_so) { return is_so ? Fate::confirmed : Fate::refuted; }
/// Of a sentence about several cases.
Fate fate(const std::vector<bool>& is_so);

/// The finding for the opposite sentence.
Finding denied(Finding finding);
/// For a sentence that says both.
Finding both(Finding a, const Finding& b);

std::string to_string(Fate fate);

}  // namespace sublimit::report
