// SPDX-License-Identifier: Apache-2.0
#pragma once
// The sections of the page, each from its part of the report.
#include <set>
#include <string>

#include "sublimit/report/page/json.h"

namespace sublimit::page {

/// Returns the summary as a table in the form of textbooks.
std::string summary_section(const Json& report);

/// Returns the section of a scheme: properties, claims, regular part, neighbourhoods.
std::string scheme_section(const Json& scheme, const std::string& id, bool many_schemes);

/// Returns the part on regular meshes: mask, support, basis function, norms, exponent.
std::string regular_part(const Json& regular, const std::string& scheme);

/// Returns spectra, ratios and verdicts over the valence for a kind ("vertex" or "face"), as plots and a table.
std::string over_valences(const Json& neighborhoods, const std::string& kind, const std::string& scheme,
                          const std::string& id);

/// Level of detail of a neighbourhood: tables only; also map and masks; also small or large surfaces.
enum class Detail { numbers, diagrams, small_pictures, pictures };

/// Returns a neighbourhood as a closed section.
std::string neighborhood_details(const Json& neighborhood, const std::string& scheme, const std::string& id,
                                 Detail detail, bool open);

/// Returns borders, creases, corners and darts: a table of their verdicts, and a closed section for each.
std::string edge_neighborhoods(const Json& neighborhoods, const std::string& scheme, const std::string& id,
                               Detail detail);

/// Returns the section of warnings, for meshes and free-form shapes.
std::string warnings_section(const Json& list);
/// Returns a point of the report as text: "(1, 0, 2.5)".
std::string place(const Json& at);

std::string free_form_section(const Json& free_form);
std::string mesh_section(const Json& mesh);
std::string curve_section(const Json& curve);
std::string sweep_section(const Json& sweep);

}  // namespace sublimit::page
