// SPDX-License-Identifier: Apache-2.0
#include "sublimit/files/rule_words.h"

#include <array>

namespace sublimit {
namespace {

// In the order of the enumerators.
constexpr std::array boundaries{"none", "edge-only", "edge-and-corner"};
constexpr std::array creasings{"uniform", "chaikin"};
constexpr std::array interpolations{"none", "corners-only", "corners-plus1", "corners-plus2", "boundaries", "all"};

template <class Rule, size_t N>
std::optional<Rule> find(const std::array<const char*, N>& words, const std::string& word) {
  for (size_t i = 0; i < N; ++i)
    if (word == words[i]) return Rule(i);
  return std::nullopt;
}

}  // namespace

const char* word(Boundary rule) { return boundaries[size_t(rule)]; }
const char* word(Creasing rule) { return creasings[size_t(rule)]; }
const char* word(FaceVaryingInterpolation rule) { return interpolations[size_t(rule)]; }

template <>
std::optional<Boundary> rule_of(const std::string& word) {
  return find<Boundary>(boundaries, word);
}
template <>
std::optional<Creasing> rule_of(const std::string& word) {
  return find<Creasing>(creasings, word);
}
template <>
std::optional<FaceVaryingInterpolation> rule_of(const std::string& word) {
  return find<FaceVaryingInterpolation>(interpolations, word);
}

}  // namespace sublimit
