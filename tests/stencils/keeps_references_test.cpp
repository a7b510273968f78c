// SPDX-License-Identifier: Apache-2.0
// What refers to an argument takes no temporary one.
#include "laws/keeps_references.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "sublimit/report/asset/seam_samples.h"
#include "sublimit/stencils/bake/detail/pattern_edits.h"
#include "sublimit/stencils/formats/npy.h"
#include "sublimit/stencils/recipes/detail/net_file.h"
#include "sublimit/stencils/recipes/detail/recipe_object.h"
#include "sublimit/stencils/recipes/detail/recipe_sources.h"

namespace sublimit::testing {
namespace {

using Bytes = std::vector<std::byte>;
static_assert(keeps_named_only<NpyArray, Bytes, const char*>);
static_assert(keeps_named_only<RecipeObject, JsonValue, const char*>);
static_assert(keeps_second_named_only<asset::SeamPlaces, const Scheme<double>&, LimitMap, asset::Inventory&, bool>);
static_assert(!std::is_constructible_v<asset::SeamPlaces, const Scheme<double>&, LimitMap&, asset::Inventory, bool>);
static_assert(!std::is_constructible_v<EditableTable<float>, Patterns, Mesh, int>);

using Recipes = std::vector<Recipe>;
template <class R>
constexpr bool have_nets = requires(R&& recipes) {
  recipe_nets(std::forward<R>(recipes));
};
template <class R>
constexpr bool are_patches = requires(R&& recipes) {
  recipe_patches(std::forward<R>(recipes), "x");
};
template <class R>
constexpr bool are_curves = requires(R&& recipes) {
  recipe_curves(std::forward<R>(recipes), "x");
};
static_assert(have_nets<Recipes&> && !have_nets<Recipes>);
static_assert(are_patches<Recipes&> && !are_patches<Recipes>);
static_assert(are_curves<Recipes&> && !are_curves<Recipes>);

TEST(KeepsReferences, EditableTablesAreValues) {
  static_assert(std::is_nothrow_move_constructible_v<EditableTable<float>>);
  static_assert(std::is_move_assignable_v<EditableTable<double>> && std::is_copy_assignable_v<EditableTable<double>>);
}

}  // namespace
}  // namespace sublimit::testing
