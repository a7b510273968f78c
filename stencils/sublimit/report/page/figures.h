// SPDX-License-Identifier: Apache-2.0
#pragma once
// The figures of a page, each {"svg", "legend"} and what its caption has to know; null without the data for one.
#include <string>

#include "sublimit/report/page/json.h"

namespace sublimit::page {

/// Returns a report as its page carries it: with figures instead of the points that they are drawn from.
///
/// Each part that has figures has an object "figures" of them: REGULAR, NEIGHBORHOOD, MESH, FREE-FORM, CURVE, SWEEP,
/// and SCHEME of those over the valence. Pictures of surfaces are large, so only neighbourhoods with "pictured" have
/// some.
Json with_figures(const Json& report);

/// Returns the mask on the regular grid, with weights over a common denominator, "times", if there is one.
Json regular_mask_figure(const Json& regular, const std::string& scheme);
/// Returns the support of the basis function on the control mesh.
Json support_figure(const Json& regular, const std::string& scheme);
/// Returns the basis function as a curve, or as a surface with its "largest" value.
Json basis_figure(const Json& regular, const std::string& scheme);
/// Returns the enclosed exponent between whole numbers.
Json exponent_figure(const Json& smoothness, const std::string& scheme);

/// Returns "spectra" and "ratio" over the valence, of neighbourhoods of a kind ("vertex" or "face").
Json valence_figures(const Json& neighborhoods, const std::string& kind, const std::string& scheme);

/// Returns the characteristic map: its faces coloured by orientation, and the images of parameter "lines".
Json characteristic_map_figure(const Json& neighborhood, const std::string& name);
/// Returns at most four eigenfunctions as shaded height fields over the map.
Json eigenfunction_figure(const Json& neighborhood, const std::string& name);
/// Returns a chart of the shapes of second-order behaviour: on a disc of mixtures of the leading eigenfunctions, the
/// sign of the Gauss curvature of the central surface; with "bowls", "saddles": whether there are such functions.
Json shape_chart_figure(const Json& neighborhood, const std::string& name);
/// Returns the spread of the normals, ring by ring.
Json normals_figure(const Json& neighborhood, const std::string& name);
/// Adds a limit surface: "surface", "reflection", "gauss". Small ones are coarser, but not smaller on the page.
void add_surface_figures(const Json& surface, const std::string& name, bool small, Json& figures);
/// Adds the limit masks: "position", "tangent1", "tangent2".
void add_mask_figures(const Json& neighborhood, const std::string& name, Json& figures);

/// Returns figures of a MESH report: its "surface" in colours of curvature with its worst places numbered; "zebra" and
/// "isophotes" if it has normals; and deviation_figures.
Json mesh_figures(const Json& mesh);
/// Returns how many of the deviations listed are of which size: "g0", "g1", "g2".
Json deviation_figures(const Json& seams);
/// Returns patches with isolines and control nets, if there is a "surface"; curves with their combs of curvature; and
/// seams and joints in the colour of what was measured.
Json free_form_figure(const Json& free_form);
Json curve_figure(const Json& curve);
Json sweep_figure(const Json& sweep);

}  // namespace sublimit::page
