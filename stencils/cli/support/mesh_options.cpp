// SPDX-License-Identifier: Apache-2.0
#include "support/mesh_options.h"

#include <fmt/core.h>
#include <tbb/global_control.h>

#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "sublimit/base/detail/rule_words.h"
#include "sublimit/base/error.h"

namespace sublimit::cli {

CLI::IsMember one_of(std::span<const char* const> words) {
  return CLI::IsMember(std::vector<std::string>(words.begin(), words.end()));
}

void add_mesh_options(CLI::App& command, const MeshOptions& options, const std::string& kinds, bool scheme_required) {
  command.add_option("MESH", options.mesh, "Control mesh: " + kinds + "; MESH.json beside it overrides tags")
      ->required();
  auto* scheme = command.add_option("-s,--scheme", options.scheme, "Scheme (see `sublimit schemes`)");
  if (scheme_required) scheme->required();
  command
      .add_option("--boundary", options.boundary,
                  "Boundary rule (default: the file's tag, else edge-and-corner); fixed: border vertices stay")
      ->check(one_of(boundary_and_fixed_words));
  command.add_option("--creasing", options.creasing, "How sharpness decays (default: the file's tag, else uniform)")
      ->check(one_of(creasing_words));
  command
      .add_option("--triangles", options.triangles,
                  "Catmull-Clark next to triangles (default: the file's tag, else catmark)")
      ->check(one_of(triangles_words));
  if (options.face_varying)
    command
        .add_option(
            "--face-varying", *options.face_varying,
            "Where texture coordinates are linear, by OpenSubdiv's names (default: the file's tag, else all, which is "
            "OpenSubdiv's default)")
        ->check(one_of(face_varying_words));
  command.add_option("--option", options.options, "An option of the scheme, name=value; may be repeated")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command.add_flag("--triangulate", options.triangulate,
                   "First cut every face into triangles, a fan from its first corner; tags are kept");
  command.add_flag("--no-creases", options.no_creases, "First drop the crease and corner tags");
}

SchemeOptions scheme_options(const std::vector<std::string>& texts) {
  SchemeOptions options;
  for (const std::string& text : texts) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InvalidOption("--option " + text + ": write it as name=value");
    if (!options.emplace(text.substr(0, equals), text.substr(equals + 1)).second)
      throw InvalidOption("--option " + text + ": " + text.substr(0, equals) + " is given twice");
  }
  return options;
}

void limit_threads(int count) {
  static std::unique_ptr<tbb::global_control> threads;
  threads = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, count);
}

std::string in_words_of_the_program(std::string message) {
  constexpr std::pair<std::string_view, std::string_view> options[] = {{"triangulate the mesh", "--triangulate"},
                                                                       {"remove the tag", "--no-creases"},
                                                                       {"turn one of them", "--orient"},
                                                                       {"not a clean manifold", "--strict"},
                                                                       {"refused, since it has warnings", "--strict"}};
  for (const auto& [what, option] : options)
    if (const size_t at = message.find(what); at != std::string::npos)
      message.insert(at + what.size(), fmt::format(" ({})", option));
  for (const std::string_view verb : {"`schemes`", "`info`", "`analyze`"})
    if (const size_t at = message.find(verb); at != std::string::npos) message.insert(at + 1, "sublimit ");
  return message;
}

}  // namespace sublimit::cli
