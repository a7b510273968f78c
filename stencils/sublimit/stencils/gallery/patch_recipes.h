// SPDX-License-Identifier: Apache-2.0
#pragma once
// The recipes of the gallery's classical surfaces, as a user would write them.
#include <string_view>

namespace sublimit::gallery {

/// A file of recipes (recipe.h), one or two of every kind of surface.
std::string_view patch_recipes();

}  // namespace sublimit::gallery
