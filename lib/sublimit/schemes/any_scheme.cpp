// SPDX-License-Identifier: Apache-2.0
#include "sublimit/scheme/any_scheme.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "sublimit/base/detail/rule_words.h"
#include "sublimit/schemes/schemes.h"

namespace sublimit {

AnyScheme::AnyScheme(const std::string& name, const SchemeOptions& options)
    : AnyScheme([&] {
        if (std::optional<Scheme<double>> found = find_scheme(name, options)) return *std::move(found);
        throw_no_surface_scheme(name);
      }()) {}
AnyScheme::AnyScheme(Scheme<double> scheme) : scheme_(std::make_shared<const Scheme<double>>(std::move(scheme))) {}

AnyScheme AnyScheme::for_mesh(const Mesh& mesh) const {
  const Scheme<double>& scheme = *scheme_;
  const auto rule = std::find_if(scheme.options.begin(), scheme.options.end(),
                                 [](const OptionInfo& info) { return info.name == "triangles"; });
  if (!mesh.triangles || rule == scheme.options.end() || scheme.chosen.contains(rule->name)) return *this;
  SchemeOptions options = scheme.chosen;
  const std::string& word = options[rule->name] = triangles_words[size_t(*mesh.triangles)];
  if (word == rule->values.front()) return *this;  // the default
  const std::optional<Scheme<double>> known = find_scheme(scheme.name, options);
  return known && known->source == scheme.source ? AnyScheme(*known) : *this;
}

}  // namespace sublimit
