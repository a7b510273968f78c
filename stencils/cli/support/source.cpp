// SPDX-License-Identifier: Apache-2.0
#include "support/source.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "sublimit/base/detail/memory.h"
#include "sublimit/base/detail/standard_files.h"
#include "sublimit/base/error.h"
#include "sublimit/curves/schemes/curve_schemes.h"
#include "sublimit/geometric/geometric_schemes.h"
#include "sublimit/stencils/formats/formats.h"

namespace sublimit::cli {
namespace {

/// A kind of sources in words.
struct KindWords {
  SourceKind kind;
  const char* plural;   ///< behind "`sublimit VERB` takes"
  const char* why_not;  ///< behind the name of the scheme or file, where the kind is not taken
  const char* no_rule;  ///< behind that name, where an option is for another kind; of patches it is not named
};

constexpr KindWords kind_words[] = {
    {SourceKind::mesh, "meshes under a scheme with masks", "refines meshes", "refines meshes"},
    {SourceKind::curves, "polygons under a scheme of curves", "refines curves", "refines curves"},
    {SourceKind::normals, "meshes with normals and recipes of nielson or piper",
     "makes surfaces through points with normals and has no matrix; it is for `sublimit sample`, `refine`, `limit` "
     "and `step`",
     "has no such rule"},
    {SourceKind::curvatures, "meshes under torus-pieces",
     "refines points with normals and curvatures; it is for `sublimit fit`", "has no such rule"},
    {SourceKind::patches, "free-form surfaces (.obj) and recipes (.json) without -s",
     "has free-form curves or surfaces, which have no scheme", "free-form surfaces have no such rule"},
};

const KindWords& words_of(SourceKind kind) { return *std::ranges::find(kind_words, kind, &KindWords::kind); }

template <class Registry>
bool has_name(const Registry& registry, const std::string& name) {
  return std::ranges::any_of(registry, [&](const auto& entry) { return name == entry.name; });
}

SourceKind kind_of_scheme(const std::string& name) {
  if (has_name(curve_registry<double>, name) || has_name(geometric_registry<ControlPolygon>, name))
    return SourceKind::curves;
  if (has_name(geometric_registry<NormalMesh>, name)) return SourceKind::normals;
  if (has_name(geometric_registry<CurvatureMesh>, name)) return SourceKind::curvatures;
  return SourceKind::mesh;
}

SourceKind kind_of_recipes(const std::vector<Recipe>& recipes) {
  const auto any = [&](const auto& has) { return std::ranges::any_of(recipes, has); };
  const bool normals = any([](const Recipe& recipe) { return recipe.normal_triangles() != nullptr; });
  return normals && !any([](const Recipe& recipe) { return recipe.surface() != nullptr; }) ? SourceKind::normals
                                                                                           : SourceKind::patches;
}

/// Whether an .obj has free-form curves or surfaces; not of a pipe.
bool has_free_form(const std::string& path) {
  if (!all_formats().reads(path, contents::free_form)) return false;
  // A pipe can be read only once: the reader of meshes does that.
  std::error_code ignored;  // of a name too long, say: its reader tells
  const std::filesystem::path opened = opened_path(path);
  if (const auto status = std::filesystem::status(opened, ignored);
      std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    return false;
  if (const auto size = static_cast<double>(std::filesystem::file_size(opened, ignored)); !ignored)
    check_memory(path + ": " + bytes_in_words(size) + " of text", size, "put it into several files");
  const std::string text = read_inflated(path);
  for (const std::string_view keyword : {"curv", "surf"})
    for (size_t at = text.find(keyword); at != std::string::npos; at = text.find(keyword, at + 1)) {
      const size_t before = text.find_last_not_of(" \t", at == 0 ? std::string::npos : at - 1);
      const bool begins = at == 0 || before == std::string::npos || text[before] == '\n' || text[before] == '\r';
      const char after = at + 4 < text.size() ? text[at + 4] : ' ';
      if (begins && (after == ' ' || after == '\t' || after == '2' || after == '\n')) return true;
    }
  return false;
}

/// "`sublimit closest` takes meshes under a scheme with masks, free-form surfaces ..."
std::string taken_by(const Takes& takes) {
  std::string taken;
  for (size_t i = 0; i < takes.kinds.size(); ++i)
    taken += (i == 0 ? "" : ", ") + std::string(words_of(takes.kinds[i]).plural);
  return fmt::format("`sublimit {}` takes {}", takes.verb, taken);
}

void load_without_scheme(Source& source, const Takes& takes) {
  const std::string& path = source.common.mesh;
  const bool any_shapes = std::ranges::any_of(
      takes.kinds, [](SourceKind kind) { return kind == SourceKind::patches || kind == SourceKind::normals; });
  if (!any_shapes && !takes.scheme_optional)
    throw InvalidOption(fmt::format("-s SCHEME is missing: {} (`sublimit schemes` lists them)", taken_by(takes)));
  if (all_formats().reads(path, contents::recipes)) {
    source.recipes = read_recipes(path);
    source.kind = kind_of_recipes(*source.recipes);
  } else if (std::error_code ignored; takes.scheme_optional && !std::filesystem::exists(opened_path(path), ignored)) {
    return;  // the reader of meshes tells
  } else if (has_free_form(path)) {
    source.shapes = read_free_form(path);
    source.kind = SourceKind::patches;
  } else if (!takes.scheme_optional) {
    throw InvalidOption(fmt::format(
        "-s SCHEME is missing: --scheme is required by `sublimit {}` for meshes (see `sublimit schemes`), but not for "
        "an .obj with free-form curves or surfaces or a .json with recipes; {} is none of these",
        takes.verb, path));
  }
}

[[noreturn]] void refuse_kind(const Source& source, const Takes& takes) {
  std::string taken = "; " + taken_by(takes);
  if (source.kind == SourceKind::curvatures) taken.clear();  // they are for one subcommand, which is named
  if (source.recipes && source.kind == SourceKind::normals)
    throw UnsupportedTopology(
        source.common.mesh +
        ": no recipe is of a surface that is linear in its points: nielson and piper are not, and have no matrix" +
        taken);
  if (source.recipes)
    throw InvalidOption(source.common.mesh + " holds recipes of curves or surfaces, which have no scheme" + taken);
  if (source.kind == SourceKind::curves) taken += " (`sublimit schemes` lists all)";
  const std::string& name = source.has_shapes() ? source.common.mesh : source.common.scheme;
  throw InvalidOption(name + " " + words_of(source.kind).why_not + taken);
}

}  // namespace

bool Source::has_curves_alone() const {
  if (shapes) return !shapes->curves.empty() && shapes->surfaces.empty();
  return recipes && std::ranges::any_of(*recipes, [](const Recipe& recipe) { return recipe.curve() != nullptr; }) &&
         std::ranges::none_of(*recipes,
                              [](const Recipe& recipe) { return recipe.surface() || recipe.normal_triangles(); });
}

void refuse_other_options(const Source& source) {
  const Common& given = source.common;
  const bool is_mesh = source.kind == SourceKind::mesh || source.kind == SourceKind::curvatures;
  const bool faces = is_mesh || (source.kind == SourceKind::normals && !source.recipes);
  const struct {
    const char* option;
    bool is_given, is_right;
    const char* owner;
  } options[] = {
      {"--boundary", !given.boundary.empty(), is_mesh, "meshes"},
      {"--creasing", !given.creasing.empty(), is_mesh, "meshes"},
      {"--triangles", !given.triangles.empty(), is_mesh, "meshes"},
      {"--face-varying", !given.face_varying.empty(), is_mesh, "meshes"},
      {"--attributes", !given.attributes.empty(), is_mesh, "meshes"},
      {"--orient", given.orient, is_mesh, "meshes"},
      {"--crease-angle", given.crease_angle.has_value(), is_mesh, "meshes"},
      {"--crease-smoothing-groups", given.crease_smoothing_groups, is_mesh, "meshes"},
      {"--sidecar", !given.sidecar.empty(), is_mesh, "meshes"},
      {"--triangulate", given.triangulate, faces, "meshes"},
      {"--no-creases", given.no_creases, faces, "meshes"},
      {"--option", !given.options.empty(), !source.has_shapes(), "schemes"},
      {"--closed", given.closed, source.kind == SourceKind::curves, "curves"},
  };
  const std::string name = source.has_shapes() || given.scheme.empty() ? "" : given.scheme + " ";
  for (const auto& row : options)
    if (row.is_given && !row.is_right)
      throw InvalidOption(fmt::format("{} is for {}{}; {}{}", row.option, row.owner,
                                      source.has_shapes() ? ", which need -s SCHEME" : "", name,
                                      words_of(source.has_shapes() ? SourceKind::patches : source.kind).no_rule));
}

Source load_source(const Common& common, const Takes& takes) {
  Source source{common, SourceKind::mesh, {}, {}};
  if (common.scheme.empty())
    load_without_scheme(source, takes);
  else
    source.kind = kind_of_scheme(common.scheme);
  if (std::ranges::find(takes.kinds, source.kind) == takes.kinds.end()) refuse_kind(source, takes);
  if (!takes.scheme_optional || !source.has_shapes()) refuse_other_options(source);
  const SchemeOptions options = given_options(common);
  if (common.scheme.empty()) return source;
  if (source.kind == SourceKind::mesh) (void)scheme_or_throw(common.scheme, options);  // a misspelt name, say
  if (source.kind == SourceKind::normals) (void)geometric_scheme<NormalMesh>(common.scheme, options);
  return source;
}

}  // namespace sublimit::cli
