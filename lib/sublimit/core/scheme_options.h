// SPDX-License-Identifier: Apache-2.0
#pragma once
// Options of schemes: one of several words, a whole number, or an exact number in a range. Numbers stay exact (p/q), so
// that masks are exact in any number type.
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sublimit {

/// Options by name, as on the command line: `triangles=smooth`.
using SchemeOptions = std::map<std::string, std::string>;

/// p/q, q > 0.
struct Ratio {
  int p = 0, q = 1;
  double value() const { return static_cast<double>(p) / q; }
};
/// As a number is written in options: `3/4`, or `2`.
std::string to_string(Ratio ratio);

/// Numbers that an option takes.
struct OptionRange {
  Ratio low, high;
  bool whole = false;  ///< only whole ones
};

/// An option that a scheme understands.
struct OptionInfo {
  std::string name;
  std::vector<std::string> values;        ///< the first is the default; without a range nothing else is allowed
  std::string meaning = {};               ///< what it does; of a number also what its range means
  std::optional<OptionRange> range = {};  ///< of a number
};

/// What `info` takes, in words: `one of a, b`, or `a whole number from 2 to 9`.
std::string allowed_values(const OptionInfo& info);

/// Value of an option, its default if absent.
/// @throws InvalidOption  a value that is not among `info.values`
std::string option(const SchemeOptions& options, const OptionInfo& info);

/// A number in `info.range`, written as decimal (`0.75`) or ratio (`3/4`), denominators up to 10^8.
/// @throws InvalidOption  anything else; the message has the range and `info.meaning`
Ratio ratio_option(const SchemeOptions& options, const OptionInfo& info);

/// Value of an option whose range is of whole numbers.
int whole_option(const SchemeOptions& options, const OptionInfo& info);

/// @throws InvalidOption  an option that a scheme of this name does not have
void check_options(const std::string& scheme, const std::vector<OptionInfo>& known, const SchemeOptions& given);

}  // namespace sublimit
