// SPDX-License-Identifier: Apache-2.0
#include "sublimit/gallery/statements.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <optional>

namespace sublimit::gallery {
namespace {

using All = std::span<const Measured>;
using Chosen = std::vector<const Measured*>;
using Value = double Measured::*;

const Measured* find(All all, const std::string& scheme, const std::string& cage) {
  for (const Measured& m : all)
    if (m.scheme == scheme && m.cage == cage) return &m;
  return nullptr;
}

template <class Condition>
Chosen those(All all, const Condition& condition) {
  Chosen chosen;
  for (const Measured& m : all)
    if (condition(m)) chosen.push_back(&m);
  return chosen;
}

bool has(const Chosen& chosen) {
  return !chosen.empty() && std::find(chosen.begin(), chosen.end(), nullptr) == chosen.end();
}

std::string percent(double x) { return fmt::format("{:.3g}\u00a0%", x < 1e-10 ? 0 : 100 * x); }
std::string number(double x) { return fmt::format("{:.3f}", x); }

/// "loop 1.2, sqrt3 3.4 (tetrahedron)": one bracket a run of the same cage.
std::string list(const Chosen& chosen, const std::function<double(const Measured&)>& value,
                 std::string (*text)(double)) {
  std::string result;
  for (size_t i = 0; i < chosen.size(); ++i) {
    const Measured& m = *chosen[i];
    result += m.scheme + " " + text(value(m));
    const bool last = i + 1 == chosen.size();
    if (last || chosen[i + 1]->cage != m.cage) result += " (" + m.cage + ")";
    if (!last) result += chosen[i + 1]->cage != m.cage ? "; " : ", ";
  }
  return result;
}

std::string list(const Chosen& chosen, Value value, std::string (*text)(double)) {
  return list(
      chosen, [=](const Measured& m) { return m.*value; }, text);
}

double bending(const Measured& m) { return m.bending.back().energy; }

std::optional<Statement> doo_sabin_is_near(All all) {
  Chosen chosen;
  for (const char* cage : {"cube", "tetrahedron"})
    for (const char* scheme : {"doo-sabin", "catmull-clark"}) chosen.push_back(find(all, scheme, cage));
  if (!has(chosen)) return std::nullopt;
  const auto half = [](const Measured* near, const Measured* far) {
    return near->mean_distance <= far->mean_distance / 2;
  };
  return Statement{"Doo-Sabin stays much nearer the cage",
                   "at most half of Catmull-Clark's mean distance, from the cube and from the tetrahedron",
                   list(chosen, &Measured::mean_distance, percent),
                   half(chosen[0], chosen[1]) && half(chosen[2], chosen[3])};
}

std::optional<Statement> loop_is_asymmetric(All all) {
  const Chosen chosen{find(all, "loop", "cube-tetrahedral"), find(all, "loop", "cube-irregular"),
                      find(all, "catmull-clark", "cube")};
  if (!has(chosen)) return std::nullopt;
  constexpr double visible = .01;
  return Statement{"Loop of a cube is asymmetric",
                   "symmetry defect above 1 % in both triangulations, Catmull-Clark's of the quads below",
                   list(chosen, &Measured::symmetry_defect, percent),
                   chosen[0]->symmetry_defect > visible && chosen[1]->symmetry_defect > visible &&
                       chosen[2]->symmetry_defect < visible};
}

Statement shrinkage(const std::string& of, const std::string& criterion, const Chosen& chosen) {
  return {"Extreme shrinkage of the tetrahedron, of " + of, criterion, list(chosen, &Measured::volume, percent),
          std::all_of(chosen.begin(), chosen.end(), [](const Measured* m) { return m->volume < .2; })};
}

std::optional<Statement> notes_shrink_the_tetrahedron(All all) {
  const Chosen chosen{find(all, "catmull-clark", "tetrahedron"), find(all, "loop", "tetrahedron")};
  if (!has(chosen)) return std::nullopt;
  return shrinkage("Catmull-Clark and Loop", "both keep less than a fifth of its volume", chosen);
}

std::optional<Statement> all_shrink_the_tetrahedron(All all) {
  const Chosen chosen =
      those(all, [](const Measured& m) { return m.smooth && !m.interpolates && m.cage == "tetrahedron"; });
  if (!has(chosen)) return std::nullopt;
  return shrinkage("all approximating schemes", "each keeps less than a fifth of its volume", chosen);
}

std::optional<Statement> modified_butterfly_is_worst_of_four(All all) {
  const Chosen butterflies{find(all, "modified-butterfly", "cube-tetrahedral"),
                           find(all, "modified-butterfly", "cube-irregular")};
  const Chosen others{find(all, "loop", "cube-tetrahedral"), find(all, "loop", "cube-irregular"),
                      find(all, "catmull-clark", "cube"), find(all, "doo-sabin", "cube")};
  if (!has(butterflies) || !has(others)) return std::nullopt;
  bool worst = true;
  for (const Measured* a : butterflies)
    for (const Measured* b : others) worst = worst && bending(*a) > bending(*b);
  Chosen chosen = butterflies;
  chosen.insert(chosen.end(), others.begin(), others.end());
  std::stable_sort(chosen.begin(), chosen.end(),
                   [](const Measured* a, const Measured* b) { return a->cage > b->cage; });
  return Statement{"Modified butterfly is worst: of a cube, beside Loop, Catmull-Clark and Doo-Sabin",
                   "more bending energy, in either triangulation, than Loop in triangles and the others in quads",
                   list(chosen, bending, number), worst};
}

std::optional<Statement> modified_butterfly_is_worst(All all) {
  const auto by_energy = [&](const std::string& cage) {
    Chosen chosen = those(all, [&](const Measured& m) { return m.smooth && m.cage == cage; });
    std::stable_sort(chosen.begin(), chosen.end(),
                     [](const Measured* a, const Measured* b) { return bending(*a) > bending(*b); });
    return chosen;
  };
  Chosen chosen;
  bool worst = true;
  for (const char* cage : {"cube-tetrahedral", "cube-irregular", "tetrahedron"}) {
    const Measured* butterfly = find(all, "modified-butterfly", cage);
    if (!butterfly) return std::nullopt;
    const Measured* most = by_energy(cage).front();
    worst = worst && most == butterfly;
    if (most != butterfly) chosen.push_back(most);
    chosen.push_back(butterfly);
  }
  return Statement{"Modified butterfly is worst: of all smooth schemes",
                   "the most bending energy of all C^1 schemes on each cage of triangles; the one with most is named",
                   list(chosen, bending, number), worst};
}

std::optional<Statement> volume_tells_approximation(All all) {
  const Chosen smooth = those(all, [](const Measured& m) { return m.smooth; });
  const Chosen against = those(all, [](const Measured& m) { return m.smooth && (m.volume > 1) != m.interpolates; });
  if (!has(smooth)) return std::nullopt;
  return Statement{
      "Approximating schemes shrink, interpolating ones swell",
      "so for every smooth scheme on every cage; exceptions are named",
      against.empty() ? fmt::format("no exception in {}", smooth.size()) : list(against, &Measured::volume, percent),
      against.empty()};
}

std::optional<Statement> cube_becomes_sphere(All all) {
  const Chosen chosen{find(all, "catmull-clark", "cube")};
  if (!has(chosen)) return std::nullopt;
  return Statement{"Catmull-Clark turns a cube into a sphere", "radii within 1 % of each other",
                   "least radius over largest: " + list(chosen, &Measured::roundness, percent),
                   chosen[0]->roundness > .99};
}

std::optional<Statement> interpolation_costs_curvature(All all) {
  const auto splines = [](const Measured& m) { return m.scheme == "catmull-clark" || m.scheme == "loop"; };
  const auto by_growth = [](const Measured* a, const Measured* b) { return a->bending_growth() < b->bending_growth(); };
  const Chosen fair = those(all, splines),
               bent = those(all, [](const Measured&m) { return m.smooth && m.interpolates; });
  if (!has(fair) || !has(bent)) return std::nullopt;
  const Measured* most = *std::max_element(fair.begin(), fair.end(), by_growth);
  const Measured* least = *std::min_element(bent.begin(), bent.end(), by_growth);
  const auto added = [](const Measured& m) { return m.bending_growth() - 1; };
  constexpr double little = .02;
  return Statement{
      "Interpolating surfaces have tangents but no curvature",
      "fourfold refinement adds more than 2 % of bending energy to every smooth interpolating scheme, less "
      "to Catmull-Clark and Loop",
      "the least: " + list({least}, added, percent) + "; the most: " + list({most}, added, percent),
      added(*least) > little && added(*most) < little};
}

}  // namespace

std::vector<Statement> statements(All all) {
  std::vector<Statement> result;
  for (const auto decide :
       {doo_sabin_is_near, loop_is_asymmetric, notes_shrink_the_tetrahedron, all_shrink_the_tetrahedron,
        modified_butterfly_is_worst_of_four, modified_butterfly_is_worst, volume_tells_approximation,
        cube_becomes_sphere, interpolation_costs_curvature})
    if (std::optional<Statement> statement = decide(all)) result.push_back(*std::move(statement));
  return result;
}

}  // namespace sublimit::gallery
