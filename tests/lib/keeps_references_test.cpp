// SPDX-License-Identifier: Apache-2.0
// What refers to an argument of its constructor takes no temporary: the mistake is found by the compiler. That no class
// is forgotten is seen by House.WhatKeepsAReferenceTakesNoTemporary.
#include "laws/keeps_references.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "sublimit/cad/cap_fitter.h"
#include "sublimit/curves/curve_scheme.h"
#include "sublimit/fit/detail/fit_terms.h"
#include "sublimit/io/detail/ply_values.h"
#include "sublimit/io/detail/text_scanner.h"
#include "sublimit/limit/detail/limit_cache.h"
#include "sublimit/neighborhood/regular_faces.h"
#include "sublimit/neighborhood/repeated_block.h"
#include "sublimit/parts/parted_patches.h"
#include "sublimit/parts/parted_surface.h"
#include "sublimit/patches/detail/bezier_pieces.h"
#include "sublimit/patches/detail/weighted_source.h"
#include "sublimit/scheme/detail/level_knots.h"
#include "sublimit/scheme/detail/mask_table.h"
#include "sublimit/search/detail/foot_point.h"
#include "sublimit/search/detail/net_distance.h"
#include "sublimit/search/detail/tracer.h"
#include "sublimit/search/intersect.h"
#include "sublimit/splits/detail/sheets.h"
#include "sublimit/surface/detail/corner_limits.h"
#include "sublimit/surface/detail/limit_patches.h"
#include "sublimit/surface/detail/shared_places.h"
#include "sublimit/tessellation/detail/cell_vertices.h"

namespace sublimit::testing {
namespace {

using Parts = LimitMap::Parts;
using P = const Points&;

// What users make.
static_assert(std::is_constructible_v<LimitSurface, LimitMap, Points>);  // which it owns
static_assert(std::is_constructible_v<PartedLimit, LimitSurface> && std::is_constructible_v<RayTracer, LimitMap, P>);
static_assert(keeps_named_only<PartedPatches, PatchSet, P>);
static_assert(std::is_constructible_v<RayTracer, PartedPatches>);  // which it does not keep
static_assert(keeps_named_only<WeightedSource, PatchSet, Eigen::VectorXd>);
static_assert(keeps_named_only<BezierPieces, PatchSet, P>);
static_assert(keeps_named_only<FitTerms, FitProblem>);
static_assert(keeps_named_only<AddressPieces, LimitMap, P>);
static_assert(keeps_named_only<CapFitter, LimitMap, P, int>);
static_assert(keeps_named_only<FootSearch, BezierPieces, bool, double>);
static_assert(keeps_named_only<MaskTable<double>, std::string, const Masks<double>&, int>);
static_assert(keeps_second_named_only<MaskTable<double>, const std::string&, Masks<double>, int>);
static_assert(keeps_named_only<CurveEnd<double>, CurveSite<double>, bool>);
static_assert(keeps_second_named_only<CurveSite<double>, int, CurveEnds<double>, bool, Index, Index>);

// What the library makes.
static_assert(keeps_named_only<Tracer, SurfaceParts>);
static_assert(keeps_named_only<NetDistance, PolynomialBasis, P, const Eigen::Vector3d&, double>);
static_assert(keeps_named_only<SeenNet, PolynomialBasis, Points>);
static_assert(keeps_named_only<CellVertices, Parts>);
static_assert(keeps_named_only<PlaceNumbers, Parts>);
static_assert(keeps_named_only<LimitPatches, Parts, P>);
static_assert(keeps_second_named_only<LimitPatches, Parts&, Points>);
static_assert(keeps_named_only<SharedPlaces, Topology, Addresses&, std::int64_t, bool>);
static_assert(keeps_second_named_only<SharedPlaces, Topology&, Addresses, std::int64_t, bool>);
static_assert(keeps_second_named_only<CornerLimits, LimitCache&, Level>);
static_assert(!std::is_constructible_v<CornerLimits, LimitCache, Level&>);
static_assert(keeps_named_only<RegularFaces, Level, int>);
static_assert(keeps_named_only<RepeatedBlock, PieceBlock>);
static_assert(keeps_named_only<LevelKnots, Topology, KnotSplit&>);
static_assert(keeps_second_named_only<LevelKnots, Topology&, KnotSplit>);
static_assert(keeps_named_only<UniformFaces<4>, Topology>);
static_assert(keeps_named_only<Sheets, Topology>);
static_assert(keeps_named_only<TextScanner, std::string, const char*, TextScanner::Continuation>);
static_assert(std::is_constructible_v<TextScanner, const char (&)[2], const char*, TextScanner::Continuation>);
static_assert(keeps_named_only<PlyTextValues, std::string, const PlyHeader&, const char*>);
static_assert(keeps_named_only<PlyBinaryValues, std::string, const PlyHeader&, const char*>);

/// What binds a source to its points refers to the source.
template <class Source>
constexpr bool binds_named_only = requires(const Source& named, P points) {
  named.bound(points);
}
&&!requires(const Source& named, P points) { std::move(named).bound(points); }
&&!requires(Source && temporary, P points) { std::move(temporary).bound(points); };
static_assert(binds_named_only<LinearSource>);
static_assert(binds_named_only<PatchSet>);
static_assert(binds_named_only<WeightedSource>);

// What refers to members of its own stays where it is, or its moves take them along.
static_assert(!std::is_move_constructible_v<PieceLink>);
static_assert(!std::is_move_constructible_v<LimitCache>);
static_assert(!std::is_copy_constructible_v<MaskTable<double>> && std::is_move_constructible_v<MaskTable<double>>);
static_assert(!std::is_move_constructible_v<PartedLimit> && !std::is_move_constructible_v<PartedPatches>);

TEST(KeepsReferences, SurfacesMoveWithWhatTheyReferTo) {
  static_assert(std::is_nothrow_move_constructible_v<LimitMap> && std::is_nothrow_move_assignable_v<LimitMap>);
}

}  // namespace
}  // namespace sublimit::testing
