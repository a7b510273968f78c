// SPDX-License-Identifier: Apache-2.0
#pragma once
// The option of schemes that know knot intervals: where new knots go.
#include "sublimit/scheme/scheme.h"

namespace sublimit {

inline OptionInfo levelling_option() {
  return {.name = "levelling",
          .values = {"on", "off"},
          .meaning = "new knots that make intervals around extraordinary points equal"};
}

/// The rule that the option chooses.
inline NewKnots levelling(const SchemeOptions& options) {
  return option(options, levelling_option()) == "on" ? NewKnots::levelling : NewKnots::halving;
}

}  // namespace sublimit
