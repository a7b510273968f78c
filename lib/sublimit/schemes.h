// SPDX-License-Identifier: Apache-2.0
#pragma once
// The registry: one line a scheme.
#include <optional>

#include "sublimit/schemes/bilinear.h"
#include "sublimit/schemes/catmull_clark.h"
#include "sublimit/schemes/loop.h"

namespace sublimit {

template <class T>
struct SchemeEntry {
  const char* name;
  Scheme<T> (*make)(const SchemeOptions&);
};

template <class T>
inline constexpr SchemeEntry<T> registry[] = {
    {"bilinear", bilinear<T>},
    {"catmull-clark", catmull_clark<T>},
    {"loop", loop<T>},
    {"loop-warren", loop_warren<T>},
};

/// Every scheme with its default options.
template <class T = double>
std::vector<Scheme<T>> all_schemes() {
  std::vector<Scheme<T>> schemes;
  for (const SchemeEntry<T>& entry : registry<T>) schemes.push_back(entry.make({}));
  return schemes;
}

/// @throws InvalidOption  an option that a scheme of this name does not have
void check_options(const std::string& scheme, const std::vector<OptionInfo>& known, const SchemeOptions& given);

/// A scheme by name; nothing if there is none (`nearest_scheme_names` offers some).
/// @throws InvalidOption  an unknown option, or a value outside its range
template <class T = double>
std::optional<Scheme<T>> find_scheme(const std::string& name, const SchemeOptions& options = {}) {
  for (const SchemeEntry<T>& entry : registry<T>) {
    if (name != entry.name) continue;
    check_options(name, entry.make({}).options, options);
    return entry.make(options);
  }
  return std::nullopt;
}

/// Names closest to a misspelt one by edit distance, at most `count`.
std::vector<std::string> nearest_scheme_names(const std::string& name, int count = 3);

}  // namespace sublimit
