// SPDX-License-Identifier: Apache-2.0
#pragma once
// Options of schemes: one of several words, a whole number, or an exact number in a range. Numbers stay exact (p/q), so
// that masks are exact in any number type.
//
//   const SchemeOptions chosen = {{"tension", "3/4"}};
//   const OptionInfo info = {.name = "tension", .values = {"1"}, .range = OptionRange{{0, 1}, {2, 1}}};
//   const Ratio tension = ratio_option(chosen, info);  // 3/4
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sublimit {

/// Options by name, as on the command line: `triangles=smooth`.
using SchemeOptions = std::map<std::string, std::string>;

/// A fraction p/q, q > 0.
struct Ratio {
  int p = 0, q = 1;
  double value() const { return static_cast<double>(p) / q; }
};
/// Returns a fraction as options write it: `3/4`, or `2`.
std::string to_string(Ratio ratio);

/// The numbers that an option takes.
struct OptionRange {
  Ratio low, high;     ///< least and largest number, both allowed
  bool whole = false;  ///< integers only
};

/// An option that a scheme understands.
struct OptionInfo {
  std::string name;
  std::vector<std::string> values;        ///< default first; the only values allowed if there is no range
  std::string meaning = {};               ///< effect of the option, and of its range, in words
  std::optional<OptionRange> range = {};  ///< allowed numbers; absent for words
};

/// Returns the values that an option takes, in words: `one of a, b`, or `a whole number from 2 to 9`.
std::string allowed_values(const OptionInfo& info);

/// Returns the value of an option, its default if absent.
/// @throws InvalidOption  a value that is not among `info.values`
std::string option(const SchemeOptions& options, const OptionInfo& info);

/// Returns the value of an option as an exact number in `info.range`, its default if absent. Values are written as
/// decimal (`0.75`) or ratio (`3/4`), with denominators up to 10^8.
/// @throws InvalidOption  anything else; the message has the range and `info.meaning`
Ratio ratio_option(const SchemeOptions& options, const OptionInfo& info);

/// Returns the value of an option whose range has integers only, its default if absent.
/// @throws InvalidOption  anything else; the message has the range and `info.meaning`
int whole_option(const SchemeOptions& options, const OptionInfo& info);

/// Throws if an option is given that a scheme does not have.
/// @param scheme  name of the scheme, for the message
/// @throws InvalidOption  an unknown option
void check_options(const std::string& scheme, const std::vector<OptionInfo>& known, const SchemeOptions& given);

}  // namespace sublimit
