// SPDX-License-Identifier: Apache-2.0
// Every law over every scheme, and every mutant of every mask killed by some law.
#include <gtest/gtest.h>

#include "sublimit/schemes.h"
#include "support/laws.h"

namespace sublimit::testing {
namespace {

TEST(Laws, HoldForEveryScheme) {
  for (const Scheme<double>& scheme : all_schemes())
    for (const Law& law : laws()) EXPECT_EQ(law.violation(scheme), "") << scheme.name << ": " << law.name;
}

/// Adds `delta` to the weight of one term of every stencil that a mask makes and, if `balanced`, takes it off another, so that
/// rows still sum to one.
template <class Site>
std::function<Stencil<double>(const Site&)> mutant(std::function<Stencil<double>(const Site&)> mask, size_t term,
                                                   bool balanced) {
  return [=](const Site& site) {
    constexpr double delta = 1e-6;
    Stencil<double> stencil = mask(site);
    const auto& terms = stencil.terms();
    const Index slot = terms[term % terms.size()].first, other = terms[(term + 1) % terms.size()].first;
    stencil += delta * Stencil<double>(slot);
    if (balanced && slot != other) stencil += -delta * Stencil<double>(other);
    return stencil;
  };
}

/// Shifts weight between the first term and all others alike: keeps sums and symmetries, which only known values can see.
std::function<Stencil<double>(const Ring<double>&)> symmetric_mutant(std::function<Stencil<double>(const Ring<double>&)> mask) {
  return [=](const Ring<double>& site) { return mask(site) + 1e-6 * (site.center() - site.neighbor_mean()); };
}

std::string killer(const Scheme<double>& scheme) {
  for (const Law& law : laws()) {
    try {
      if (!law.violation(scheme).empty()) return law.name;
    } catch (const std::exception& error) {
      return law.name + " (" + error.what() + ")";
    }
  }
  return {};
}

TEST(Mutants, EveryOneIsKilledByALaw) {
  int mutants = 0;
  for (const Scheme<double>& scheme : all_schemes()) {
    for (size_t term = 0; term < 9; ++term)
      for (const bool balanced : {false, true}) {
        const auto check = [&](const char* what, const auto& mutate) {
          Scheme<double> changed = scheme;
          mutate(changed);
          ++mutants;
          EXPECT_NE(killer(changed), "") << scheme.name << ": " << what << " mask, term " << term
                                         << (balanced ? ", balanced" : "");
        };
        auto& masks = scheme.steps[0].masks;
        if (masks.vertex && !(balanced && scheme.claims.interpolates))
          check("vertex", [&](Scheme<double>& s) { s.steps[0].masks.vertex = mutant(masks.vertex, term, balanced); });
        if (masks.edge && term < (scheme.face_size() == 3 ? 4 : 6) && !(scheme.name == "bilinear" && term > 1))
          check("edge", [&](Scheme<double>& s) { s.steps[0].masks.edge = mutant(masks.edge, term, balanced); });
        if (masks.face && term < 4)
          check("face", [&](Scheme<double>& s) { s.steps[0].masks.face = mutant(masks.face, term, balanced); });
        if (term < 3 && !(scheme.claims.interpolates && (balanced || term > 0)))
          check("crease vertex", [&](Scheme<double>& s) {
            s.creases.vertex = mutant(scheme.creases.vertex, term, balanced);
          });
        if (term < 2)
          check("crease edge", [&](Scheme<double>& s) { s.creases.edge = mutant(scheme.creases.edge, term, balanced); });
      }
    Scheme<double> changed = scheme;
    changed.steps[0].masks.vertex = symmetric_mutant(scheme.steps[0].masks.vertex);
    ++mutants;
    EXPECT_NE(killer(changed), "") << scheme.name << ": vertex mask, centre against neighbours";
  }
  RecordProperty("mutants", mutants);
  EXPECT_GT(mutants, 100);
}

}  // namespace
}  // namespace sublimit::testing
