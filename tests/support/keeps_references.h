// SPDX-License-Identifier: Apache-2.0
#pragma once
// Classes that refer to an argument of their constructor: it has a name, so that it can outlive them.
#include <type_traits>

namespace sublimit::testing {

/// X can be made of a Kept that has a name, and of no temporary one.
template <class X, class Kept, class... Rest>
inline constexpr bool keeps_named_only =
    std::is_constructible_v<X, Kept&, Rest...> && !std::is_constructible_v<X, Kept, Rest...> &&
    !std::is_constructible_v<X, const Kept, Rest...>;

/// The same of the second argument.
template <class X, class First, class Kept, class... Rest>
inline constexpr bool keeps_second_named_only =
    std::is_constructible_v<X, First, Kept&, Rest...> && !std::is_constructible_v<X, First, Kept, Rest...> &&
    !std::is_constructible_v<X, First, const Kept, Rest...>;

}  // namespace sublimit::testing
