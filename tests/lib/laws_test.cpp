// SPDX-License-Identifier: Apache-2.0
// Every law over every scheme with its options, and every mutant of every mask killed by some law.
#include <gtest/gtest.h>

#include <algorithm>

#include "laws/laws.h"
#include "laws/lost_normals.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"
#include "truth/averaging_blocks.h"
#include "truth/published_values.h"

namespace sublimit::testing {
namespace {

TEST(Laws, HoldForEveryScheme) {
  for (const auto& variant : scheme_names_and_options()) {
    const Scheme<double> scheme = *find_scheme(variant.first, variant.second);
    for (const Law& law : laws()) EXPECT_EQ(law.violation(scheme), "") << described(variant) << ": " << law.name;
  }
}

TEST(PublishedValues, OfAveragingAreThoseOfTheTables) {
  // Valences 3 to 12; and B-splines at 4: products of the curves' weights.
  const double of_degree_4[] = {.39659528, .5,        .56823535, .61296197, .64303168,
                                .66392581, .67891708, .68998668, .69836831, .70485452};
  const double of_degree_5[] = {.40165379, .5,        .56024742, .59806870, .62285937,
                                .63981452, .65185251, .66067668, .66732292, .67244594};
  for (int n = 3; n <= 12; ++n) {
    EXPECT_NEAR(averaging_lambda(4, n), of_degree_4[n - 3], eight_decimals);
    EXPECT_NEAR(averaging_lambda(5, n), of_degree_5[n - 3], eight_decimals);
    EXPECT_NEAR(averaging_limit(4, n), 121. / 144 / n, rounding(100));
    EXPECT_NEAR(averaging_limit(5, n), 121. / 400, rounding(100));
  }
  const double curve[] = {1. / 2, 2. / 3, 11. / 24, 11. / 20};
  for (int degree = 2; degree <= 5; ++degree)
    EXPECT_NEAR(averaging_limit(degree, 4), curve[degree - 2] * curve[degree - 2], rounding(100));
}

TEST(PublishedValues, AreOfRegisteredSchemesAlone) {
  for (const auto& [name, options] : scheme_names_and_options()) {
    Scheme<double> scheme = *find_scheme(name, options);
    EXPECT_TRUE(published_values(scheme, 3)) << name;
    scheme.name = "unheard-of";
    EXPECT_NE(published_values_hold(scheme), "") << "a scheme without them passes";
  }
}

// LimitsAgreeBetweenLevels compares the normals of all places that have one.
TEST(NormalPlaces, HaveNormalsButWhereTangentPlanesAreLost) {
  for (const Scheme<double>& scheme : all_schemes()) {
    int defined = 0;
    for (const NormalPlace& place : normal_places(scheme)) {
      defined += place.defined;
      EXPECT_EQ(place.defined, !has_no_normal(scheme, place))
          << scheme.name << ", mesh " << place.mesh << ", level " << place.level << ", vertex " << place.vertex << ": "
          << place.faces << " faces" << (place.one_sided ? ", one side" : "") << (place.corner ? ", a corner" : "");
    }
    EXPECT_GT(defined, 0) << scheme.name;
  }
}

/// Adds `delta` to the weight of one term of every stencil that a mask makes and, if `balanced`, takes it off another,
/// so that rows still sum to one.
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

/// Shifts weight between the first term and all others alike: keeps sums and symmetries, which only known values can
/// see.
std::function<Stencil<double>(const Ring<double>&)> symmetric_mutant(
    std::function<Stencil<double>(const Ring<double>&)> mask) {
  return [=](const Ring<double>& site) { return mask(site) + 1e-6 * (site.center() - site.neighbor_mean()); };
}

/// The same along a border: between the two points that a site has on either side of its middle.
std::function<Stencil<double>(const CreaseSite<double>&)> symmetric_mutant(Mask<double, CreaseSite<double>> mask) {
  return [=](const CreaseSite<double>& site) {
    return mask(site) + 1e-6 * (2 * site.center() - site.before() - site.after());
  };
}
std::function<Stencil<double>(const CreaseEdgeSite<double>&)> symmetric_mutant(
    Mask<double, CreaseEdgeSite<double>> mask) {
  return [=](const CreaseEdgeSite<double>& site) {
    return mask(site) + 1e-6 * (site.tail() + site.head() - site.before() - site.after());
  };
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

/// Most terms that a mask has in any of these neighbourhoods, 0 if it is not there.
template <class Site>
size_t num_terms(const Mask<double, Site>& mask, const std::vector<Site>& sites) {
  size_t most = 0;
  for (const Site& site : sites)
    if (mask) most = std::max(most, mask(site).terms().size());
  return most;
}

/// Whether a step asks the rule of crease edges: not if it makes no points on edges, or continues borders virtually.
bool refines_curves(const Step<double>& step) { return step.split != Split::keep && !step.masks.wide_borders; }

/// Every term of every mask of a step, changed by itself and against the next one. Masks that its split does not make
/// points with are left out.
using Change = std::function<void(Step<double>&)>;
void each_mutant(const Step<double>& step, int face_size, int period,
                 const std::function<void(const std::string&, const Change&)>& check) {
  const Masks<double>& masks = step.masks;
  const auto each = [&](const char* what, auto group, auto mask, size_t terms) {  // (step.*group).*mask
    for (size_t term = 0; term < terms; ++term)
      for (const bool balanced : {false, true}) {
        if (balanced && terms == 1) continue;
        const std::string words =
            std::string(what) + " mask, term " + std::to_string(term) + (balanced ? ", balanced" : "");
        check(words, [=, &step](Step<double>& s) { (s.*group).*mask = mutant((step.*group).*mask, term, balanced); });
      }
  };
  const Index size = face_size == 3 ? 3 : 4, n = face_size == 3 ? 6 : 4;
  const bool points_on_edges = step.split == Split::pqq || step.split == Split::ptq || step.split == Split::mid_edge;
  const std::vector<Index> faces(n, size);
  const FaceSite<double> face(masks, 0, size == 3 ? std::vector<Index>{0, 1, 2} : std::vector<Index>{0, 1, 2, 3});
  using M = Masks<double>;
  using C = CreaseMasks<double>;
  using S = Step<double>;
  each("vertex", &S::masks, &M::vertex, num_terms(masks.vertex, {Ring<double>(masks, 0, faces)}));
  if (points_on_edges)
    each("edge", &S::masks, &M::edge, num_terms(masks.edge, {EdgeSite<double>(masks, 0, size, size)}));
  each("face", &S::masks, &M::face, num_terms(masks.face, {face}));
  each("corner", &S::masks, &M::corner, num_terms(masks.corner, {face}));
  std::vector<WideEdgeSite<double>> edges;
  std::vector<WideFaceSite<double>> wide_faces;
  for (Index valence = 3; valence <= 7; ++valence) {
    edges.emplace_back(masks, 0, size, FanShape{valence, -1}, FanShape{n, -1});
    std::vector<FanShape> shapes(size, FanShape{n, -1});
    shapes[0].faces = valence;
    wide_faces.emplace_back(masks, 0, shapes);
  }
  each("wide edge", &S::masks, &M::wide_edge, num_terms(masks.wide_edge, edges));
  each("wide face", &S::masks, &M::wide_face, num_terms(masks.wide_face, wide_faces));
  std::vector<CreaseSite<double>> crease_vertices;
  std::vector<CreaseEdgeSite<double>> crease_edges;
  for (int level = 0; level < period; ++level) {
    crease_vertices.emplace_back(masks, level);
    crease_edges.emplace_back(masks, level);
  }
  each("crease vertex", &S::creases, &C::vertex, num_terms(step.creases.vertex, crease_vertices));
  if (refines_curves(step)) each("crease edge", &S::creases, &C::edge, num_terms(step.creases.edge, crease_edges));
}

TEST(Mutants, EveryOneIsKilledByALaw) {
  int mutants = 0;
  for (const auto& variant : scheme_names_and_options()) {
    Scheme<double> scheme = *find_scheme(variant.first, variant.second);
    if (scheme.steps.size() > 4) continue;  // degree 9: the steps of degree 5, only more of them, and long to analyse
    for (auto* steps : {&scheme.steps, &scheme.preparation})  // each with border masks of its own
      for (Step<double>& step : *steps)
        if (!step.creases.edge) step.creases = scheme.creases;
    const auto check = [&](const std::string& what, const auto& mutate) {
      Scheme<double> changed = scheme;
      mutate(changed);
      ++mutants;
      EXPECT_NE(killer(changed), "") << described(variant) << ": " << what;
    };
    for (auto steps : {&Scheme<double>::steps, &Scheme<double>::preparation})
      for (size_t i = 0; i < (scheme.*steps).size(); ++i)
        each_mutant((scheme.*steps)[i], scheme.face_size(), scheme.period,
                    [&](const std::string& what, const Change& change) {
                      const char* of = steps == &Scheme<double>::steps ? "step " : "preparation ";
                      check(of + std::to_string(i) + ": " + what, [&](Scheme<double>& s) { change((s.*steps)[i]); });
                    });
    for (size_t i = 0; i < scheme.steps.size(); ++i) {
      const Step<double>& step = scheme.steps[i];
      const std::string at = "step " + std::to_string(i) + ": ";
      if (step.masks.vertex)
        check(at + "vertex mask, centre against neighbours",
              [&](Scheme<double>& s) { s.steps[i].masks.vertex = symmetric_mutant(step.masks.vertex); });
      if (step.creases.vertex)
        check(at + "crease vertex mask, middle against neighbours",
              [&](Scheme<double>& s) { s.steps[i].creases.vertex = symmetric_mutant(step.creases.vertex); });
      if (refines_curves(step))
        check(at + "crease edge mask, ends against neighbours",
              [&](Scheme<double>& s) { s.steps[i].creases.edge = symmetric_mutant(step.creases.edge); });
    }
  }
  RecordProperty("mutants", mutants);
  EXPECT_GT(mutants, 1000);
}

/// The same only where n edges meet, n corners are in a face: what regular places and small valences cannot see.
template <class Site, class Changed>
std::function<Stencil<double>(const Site&)> changed_at(int n, std::function<Stencil<double>(const Site&)> mask,
                                                       const std::function<int(const Site&)>& count,
                                                       const Changed& change) {
  return [=](const Site& site) {
    return count(site) == n ? Stencil<double>(mask(site) + 1e-6 * change(site)) : mask(site);
  };
}

TEST(Mutants, OfOneValenceAreKilledByALaw) {
  for (const auto& variant : scheme_names_and_options()) {
    const Scheme<double> scheme = *find_scheme(variant.first, variant.second);
    for (size_t i = 0; i < scheme.steps.size(); ++i) {
      Scheme<double> changed = scheme;
      Masks<double>& masks = changed.steps[i].masks;
      // Of averages on dual meshes only the middles of faces have other valences: they, the middles of edges, and the
      // faces around have one mean, so that such a change is none.
      if (masks.vertex && scheme.is_dual()) continue;
      if (masks.vertex)
        masks.vertex = changed_at<Ring<double>>(
            5, masks.vertex, [](const Ring<double>& v) { return v.is_closed() ? v.valence() : 0; },
            [](const Ring<double>& v) { return v.center() - v.neighbor_mean(); });
      else if (masks.corner)
        masks.corner = changed_at<FaceSite<double>>(
            5, masks.corner, [](const FaceSite<double>& f) { return f.size(); },
            [](const FaceSite<double>& f) { return f.corner(0) - f.centroid(); });
      else
        continue;
      EXPECT_NE(killer(changed), "") << described(variant) << ": step " << i;
    }
  }
}

}  // namespace
}  // namespace sublimit::testing
