// SPDX-License-Identifier: Apache-2.0
#pragma once
// The registry: one line a scheme.
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sublimit/core/detail/unknown_scheme.h"
#include "sublimit/schemes/averaging.h"
#include "sublimit/schemes/bilinear.h"
#include "sublimit/schemes/butterfly.h"
#include "sublimit/schemes/catmull_clark.h"
#include "sublimit/schemes/catmull_clark_intervals.h"
#include "sublimit/schemes/doo_sabin.h"
#include "sublimit/schemes/doo_sabin_intervals.h"
#include "sublimit/schemes/interpolatory_sqrt3.h"
#include "sublimit/schemes/kobbelt.h"
#include "sublimit/schemes/loop.h"
#include "sublimit/schemes/mid_edge.h"
#include "sublimit/schemes/modified_butterfly.h"
#include "sublimit/schemes/sqrt3.h"

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
    {"catmull-clark-intervals", catmull_clark_intervals<T>},
    {"loop", loop<T>},
    {"loop-warren", loop_warren<T>},
    {"doo-sabin", doo_sabin<T>},
    {"doo-sabin-averaging", doo_sabin_averaging<T>},
    {"doo-sabin-intervals", doo_sabin_intervals<T>},
    {"mid-edge", mid_edge<T>},
    {"mid-edge-habib-warren", mid_edge_habib_warren<T>},
    {"averaging", averaging<T>},
    {"butterfly", butterfly<T>},
    {"modified-butterfly", modified_butterfly<T>},
    {"sqrt3", sqrt3<T>},
    {"interpolatory-sqrt3", interpolatory_sqrt3<T>},
    {"kobbelt", kobbelt<T>},
};

/// Every scheme with its default options.
template <class T = double>
[[nodiscard]] std::vector<Scheme<T>> all_schemes() {
  std::vector<Scheme<T>> schemes;
  for (const SchemeEntry<T>& entry : registry<T>) schemes.push_back(entry.make({}));
  return schemes;
}

/// A scheme by name; nothing if there is none (`nearest_scheme_names` offers some). `scheme` below throws instead.
/// @throws InvalidOption  an unknown option, or a value outside its range
template <class T = double>
[[nodiscard]] std::optional<Scheme<T>> find_scheme(const std::string& name, const SchemeOptions& options = {}) {
  for (const SchemeEntry<T>& entry : registry<T>) {
    if (name != entry.name) continue;
    check_options(name, entry.make({}).options, options);
    Scheme<T> scheme = entry.make(options);
    scheme.chosen = options;
    return scheme;
  }
  return std::nullopt;
}

/// A scheme by name: `scheme("catmull-clark")`, `scheme("kobbelt", {{"tension", "3/4"}})`.
/// @throws InvalidOption  no scheme of surfaces has this name: says which are nearest, or what makes it; an unknown
///                        option, or a value outside its range
template <class T = double>
[[nodiscard]] Scheme<T> scheme(const std::string& name, const SchemeOptions& options = {}) {
  if (std::optional<Scheme<T>> found = find_scheme<T>(name, options)) return *std::move(found);
  throw_unknown_scheme(name, SchemeKind::surface);
}

// Made once, in the library: else every file that names a scheme makes all of them.
extern template std::vector<Scheme<double>> all_schemes<double>();
extern template std::optional<Scheme<double>> find_scheme<double>(const std::string&, const SchemeOptions&);

/// Names closest to a misspelt one by edit distance, at most `count`.
std::vector<std::string> nearest_scheme_names(const std::string& name, int count = 3);

}  // namespace sublimit
