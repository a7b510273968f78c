// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/json/exact_number.h"

#include <bit>
#include <cmath>

#include "sublimit/base/detail/format_number.h"

namespace sublimit {

std::optional<ExactNumber> parse_fraction(std::string_view text) {
  const std::size_t slash = text.find('/');
  const Parsed<std::int64_t> p = parse_number<std::int64_t>(text.substr(0, slash));
  if (!p) return std::nullopt;
  std::int64_t q = 1;
  if (slash != std::string_view::npos) {
    const Parsed<std::int64_t> below = parse_number<std::int64_t>(text.substr(slash + 1));
    if (!below || below.value <= 0) return std::nullopt;
    q = below.value;
  }
  return ExactNumber{nearest_double(p.value, q), std::string(text), p.value, q};
}

double nearest_double(std::int64_t p, std::int64_t q) {
  __extension__ typedef unsigned __int128 Wide;
  if (p == 0) return 0;
  const std::uint64_t size = p < 0 ? std::uint64_t(0) - std::uint64_t(p) : std::uint64_t(p);
  // All bits of a double and more, and in the last one whether anything is left over.
  const int shift = 63 + std::countl_zero(size);
  const Wide above = static_cast<Wide>(size) << shift;
  Wide quotient = above / std::uint64_t(q);
  if (quotient * std::uint64_t(q) != above) quotient |= 1;
  const double magnitude = std::ldexp(static_cast<double>(quotient), -shift);
  return p < 0 ? -magnitude : magnitude;
}

}  // namespace sublimit
