// SPDX-License-Identifier: Apache-2.0
#pragma once
// Checks of classes that refer to an argument of their constructor: temporary arguments must not compile.
#include <type_traits>

namespace sublimit::testing {

/// True if X can be constructed from an lvalue Kept, and not from a temporary one.
template <class X, class Kept, class... Rest>
inline constexpr bool keeps_named_only =
    std::is_constructible_v<X, Kept&, Rest...> && !std::is_constructible_v<X, Kept, Rest...> &&
    !std::is_constructible_v<X, const Kept, Rest...>;

/// True if this holds for the second argument of the constructor.
template <class X, class First, class Kept, class... Rest>
inline constexpr bool keeps_second_named_only =
    std::is_constructible_v<X, First, Kept&, Rest...> && !std::is_constructible_v<X, First, Kept, Rest...> &&
    !std::is_constructible_v<X, First, const Kept, Rest...>;

}  // namespace sublimit::testing
