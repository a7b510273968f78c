// SPDX-License-Identifier: Apache-2.0
#pragma once
// The sections of the page, each from its part of the report.
#include <set>
#include <string>

#include "sublimit/report/page/json.h"

namespace sublimit::page {

/// The summary table as textbooks have it.
std::string summary_section(const Json& report);

/// A scheme: what it is, what it claims, its regular part, its neighbourhoods.
std::string scheme_section(const Json& scheme, const std::string& id, bool many_schemes);

/// The scheme on regular meshes: mask, support, basis function, norms, exponent.
std::string regular_part(const Json& regular, const std::string& scheme);

/// Spectra, ratios and verdicts over the valence of a kind ("vertex" or "face"), as plots and a table.
std::string over_valences(const Json& neighborhoods, const std::string& kind, const std::string& scheme,
                          const std::string& id);

/// Level of detail of a neighbourhood: tables; with map and masks; with small or large surfaces.
enum class Detail { numbers, diagrams, small_pictures, pictures };

/// One neighbourhood, folded.
std::string neighborhood_details(const Json& neighborhood, const std::string& scheme, const std::string& id,
                                 Detail detail, bool open);

/// Borders, creases, corners and darts: a table with their verdicts, and each folded.
std::string edge_neighborhoods(const Json& neighborhoods, const std::string& scheme, const std::string& id,
                               Detail detail);

/// Returns the section of warnings, for meshes and free-form shapes.
std::string warnings_section(const Json& list);
/// A point of the report: "(1, 0, 2.5)".
std::string place(const Json& at);

std::string free_form_section(const Json& free_form);
std::string mesh_section(const Json& mesh);
std::string curve_section(const Json& curve);
std::string sweep_section(const Json& sweep);

}  // namespace sublimit::page
