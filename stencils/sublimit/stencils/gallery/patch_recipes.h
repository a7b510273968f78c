// SPDX-License-Identifier: Apache-2.0
#pragma once
// The recipes of the classical surfaces in the gallery, as a user would write them.
#include <string_view>

namespace sublimit::gallery {

/// Returns the text of a file of recipes (recipe.h), one or two of every kind of surface.
std::string_view patch_recipes();

}  // namespace sublimit::gallery
