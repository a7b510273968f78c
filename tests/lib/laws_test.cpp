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

/// The mask of a vertex that stays.
bool keeps_vertices(const Masks<double>& masks) {
  const std::vector<Index> quads(4, 4);
  return masks.vertex(Ring<double>(masks, 0, quads)).terms().size() == 1;
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
        const auto check = [&](const std::string& what, const auto& mutate) {
          Scheme<double> changed = scheme;
          mutate(changed);
          ++mutants;
          EXPECT_NE(killer(changed), "") << scheme.name << ": " << what << " mask, term " << term
                                         << (balanced ? ", balanced" : "");
        };
        for (size_t i = 0; i < scheme.steps.size(); ++i) {
          const Masks<double>& masks = scheme.steps[i].masks;
          const std::string step = scheme.steps.size() > 1 ? " of step " + std::to_string(i) : "";
          const bool keeps = masks.vertex && keeps_vertices(masks);
          if (masks.vertex && !(keeps && (balanced || term > 0)))
            check("vertex" + step, [&](Scheme<double>& s) { s.steps[i].masks.vertex = mutant(masks.vertex, term, balanced); });
          if (masks.edge && term < (scheme.face_size() == 3 ? 4 : 2))
            check("edge" + step, [&](Scheme<double>& s) { s.steps[i].masks.edge = mutant(masks.edge, term, balanced); });
          if (masks.face && term < 3)
            check("face" + step, [&](Scheme<double>& s) { s.steps[i].masks.face = mutant(masks.face, term, balanced); });
          if (masks.corner && term < 4)
            check("corner" + step, [&](Scheme<double>& s) { s.steps[i].masks.corner = mutant(masks.corner, term, balanced); });
          if (masks.wide_edge && term < 4)
            check("edge" + step, [&](Scheme<double>& s) { s.steps[i].masks.wide_edge = mutant(masks.wide_edge, term, balanced); });
          if (masks.wide_face)
            check("face" + step, [&](Scheme<double>& s) { s.steps[i].masks.wide_face = mutant(masks.wide_face, term, balanced); });
        }
        if (scheme.creases.vertex && term < 3 && !(scheme.claims.interpolates && (balanced || term > 0)) &&
            !(scheme.is_dual() && (balanced || term > 0)))
          check("crease vertex", [&](Scheme<double>& s) {
            s.creases.vertex = mutant(scheme.creases.vertex, term, balanced);
          });
        if (term < 2 && !scheme.steps.back().creases.edge)
          check("crease edge", [&](Scheme<double>& s) { s.creases.edge = mutant(scheme.creases.edge, term, balanced); });
      }
    if (!scheme.steps[0].masks.vertex) continue;
    Scheme<double> changed = scheme;
    changed.steps.back().masks.vertex = symmetric_mutant(scheme.steps.back().masks.vertex);
    ++mutants;
    EXPECT_NE(killer(changed), "") << scheme.name << ": vertex mask, centre against neighbours";
  }
  RecordProperty("mutants", mutants);
  EXPECT_GT(mutants, 100);
}

}  // namespace
}  // namespace sublimit::testing
