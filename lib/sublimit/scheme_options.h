// SPDX-License-Identifier: Apache-2.0
#pragma once
// Options of schemes: one of several words, a whole number, or an exact number in a range. Numbers stay exact (p/q), so
// that masks are exact in any number type.
#include <map>
#include <string>
#include <vector>

namespace sublimit {

/// Options by name, as on the command line: `triangles=smooth`.
using SchemeOptions = std::map<std::string, std::string>;

/// An option that a scheme understands.
struct OptionInfo {
  std::string name;
  std::vector<std::string> values;  ///< the first is the default; more than one: nothing else is allowed
  std::string meaning = {};         ///< of a number: what it does, and what its range means
};

/// p/q, q > 0.
struct Ratio {
  int p = 0, q = 1;
  double value() const { return static_cast<double>(p) / q; }
};

/// Value of an option, its default if absent.
/// @throws InvalidOption  a value that is not among `info.values`
std::string option(const SchemeOptions& options, const OptionInfo& info);

/// A number written as decimal (`0.75`) or ratio (`3/4`), from `low` to `high`.
/// @throws InvalidOption  anything else; the message has the range and `info.meaning`
Ratio ratio_option(const SchemeOptions& options, const OptionInfo& info, Ratio low, Ratio high);

/// A whole number from `low` to `high`.
/// @throws InvalidOption  anything else
int whole_option(const SchemeOptions& options, const OptionInfo& info, int low, int high);

/// @throws InvalidOption  an option that a scheme of this name does not have
void check_options(const std::string& scheme, const std::vector<OptionInfo>& known, const SchemeOptions& given);

}  // namespace sublimit
