// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/formats/rule_of_word.h"

#include "sublimit/base/detail/rule_words.h"

namespace sublimit {
namespace {

template <class Rule, size_t N>
std::optional<Rule> find(const std::array<const char*, N>& words, const std::string& word) {
  for (size_t i = 0; i < N; ++i)
    if (word == words[i]) return Rule(i);
  return std::nullopt;
}

}  // namespace

const char* word(Boundary rule) { return boundary_words[size_t(rule)]; }
const char* word(Creasing rule) { return creasing_words[size_t(rule)]; }
const char* word(FaceVaryingInterpolation rule) { return face_varying_words[size_t(rule)]; }
const char* word(Triangles rule) { return triangles_words[size_t(rule)]; }
const char* word(Attributes rule) { return attributes_words[size_t(rule)]; }

template <>
std::optional<Boundary> rule_of(const std::string& word) {
  return find<Boundary>(boundary_words, word);
}
template <>
std::optional<Creasing> rule_of(const std::string& word) {
  return find<Creasing>(creasing_words, word);
}
template <>
std::optional<FaceVaryingInterpolation> rule_of(const std::string& word) {
  return find<FaceVaryingInterpolation>(face_varying_words, word);
}
template <>
std::optional<Triangles> rule_of(const std::string& word) {
  return find<Triangles>(triangles_words, word);
}
template <>
std::optional<Attributes> rule_of(const std::string& word) {
  return find<Attributes>(attributes_words, word);
}

}  // namespace sublimit
