// SPDX-License-Identifier: Apache-2.0
// Every law over every curve scheme, and every mutant of every mask killed by some law.
#include <gtest/gtest.h>

#include "laws/curve_laws.h"
#include "sublimit/base/error.h"
#include "sublimit/curves/schemes/curve_schemes.h"

namespace sublimit::testing {
namespace {

std::string described(const CurveScheme<double>& scheme) {
  return scheme.name + " (" + scheme.claims.limit + ", " + std::to_string(scheme.ends.points) + " points at ends)";
}

TEST(CurveLaws, HoldForEveryScheme) {
  for (const CurveScheme<double>& scheme : curve_scheme_variants())
    for (const CurveLaw& law : curve_laws())
      EXPECT_EQ(law.violation(scheme), "") << described(scheme) << ": " << law.name;
}

std::string killer(const CurveScheme<double>& scheme) {
  for (const CurveLaw& law : curve_laws()) {
    try {
      if (!law.violation(scheme).empty()) return law.name;
    } catch (const Error& error) {
      return law.name + " (" + error.what() + ")";
    }
  }
  return {};
}

using Mask = CurveMasks<double>::Mask;

/// Adds 1e-6 to one weight and takes it off the next one (balanced) or off nothing; symmetric: on both sides of the
/// mask.
Mask mutant(const Mask& mask, int unknowns, size_t term, int kind) {
  return [=](const CurveSite<double>& site) {
    constexpr double delta = 1e-6;
    Stencil<double> stencil = mask(site);
    const auto terms = mask(CurveSite<double>(site.level(), unknowns)).terms();
    const auto add = [&](size_t i, double by) {
      const Index slot = terms[i % terms.size()].first;
      stencil += by * (unknowns == 1 ? site.point(slot) : Stencil<double>(slot));
    };
    add(term, delta);
    if (kind >= 1) add(term + 1, -delta);
    if (kind == 2) {
      add(terms.size() - 1 - term, delta);
      add(2 * terms.size() - 2 - term, -delta);
    }
    return stencil;
  };
}

TEST(CurveMutants, EveryOneIsKilledByALaw) {
  int mutants = 0;
  for (const CurveScheme<double>& scheme : curve_scheme_variants()) {
    const auto check = [&](Mask CurveMasks<double>::*which, const char* name) {
      const Mask mask = scheme.masks.*which;
      if (!mask) return;
      const int unknowns = scheme.masks.unknowns();
      const size_t count = mask(CurveSite<double>(0, unknowns)).terms().size();
      for (size_t term = 0; term < count; ++term)
        for (const int kind : {0, 1, 2}) {
          if (kind > 0 && count == 1) continue;
          if (kind == 2 && (term + 1) % count == count - 1 - term) continue;  // adds nothing
          CurveScheme<double> changed = scheme;
          changed.masks.*which = mutant(mask, unknowns, term, kind);
          ++mutants;
          EXPECT_NE(killer(changed), "") << described(scheme) << ": mask " << name << ", term " << term << ", kind "
                                         << kind;
        }
    };
    check(&CurveMasks<double>::point, "point");
    check(&CurveMasks<double>::edge, "edge");
    check(&CurveMasks<double>::point_derivative, "point_derivative");
    check(&CurveMasks<double>::edge_derivative, "edge_derivative");
    check(&CurveMasks<double>::before, "before");
    check(&CurveMasks<double>::after, "after");
    if (!scheme.ends.beyond) continue;
    // Ends matter where a mask reaches beyond them.
    const CurveMasks<double>& masks = scheme.masks;
    const bool used =
        scheme.claims.regular > 0 && (masks.dual() || masks.edge(CurveSite<double>(0)).terms().size() > 2);
    for (int m = 0; used && m < scheme.ends.points; ++m) {
      CurveScheme<double> changed = scheme;
      changed.ends.beyond = [&, m](const CurveEnd<double>& end, int i) {
        return scheme.ends.beyond(end, i) + 1e-6 * (end.point(m) - end.point((m + 1) % scheme.ends.points));
      };
      ++mutants;
      EXPECT_NE(killer(changed), "") << described(scheme) << ": ends, term " << m;
    }
  }
  EXPECT_GT(mutants, 40);
  RecordProperty("mutants", mutants);
}

}  // namespace
}  // namespace sublimit::testing
