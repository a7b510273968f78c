// SPDX-License-Identifier: Apache-2.0
#include "sublimit/scheme/scheme_info.h"

#include "sublimit/curves/schemes/curve_schemes.h"
#include "sublimit/geometric/geometric_schemes.h"
#include "sublimit/schemes/schemes.h"

namespace sublimit {
namespace {

/// What all kinds of schemes have.
template <class Scheme>
SchemeInfo described(const Scheme& scheme, SchemeInfo::Kind kind, bool linear) {
  return {.name = scheme.name,
          .kind = kind,
          .linear = linear,
          .source = scheme.source,
          .limit = scheme.claims.limit,
          .interpolates = scheme.claims.interpolates,
          .options = scheme.options};
}

/// What is claimed of masks.
template <class Claims>
void add_claims(SchemeInfo& info, const Claims& claims) {
  info.continuity = claims.regular;
  info.generates_degree = claims.generates;
  info.reproduces_degree = claims.reproduces;
  info.convex_hull = claims.convex_hull;
}

}  // namespace

std::vector<SchemeInfo> schemes() {
  using enum SchemeInfo::Kind;
  std::vector<SchemeInfo> all;
  for (const Scheme<double>& scheme : all_schemes()) {
    SchemeInfo& info = all.emplace_back(described(scheme, surface, true));
    add_claims(info, scheme.claims);
    info.extraordinary_continuity = scheme.claims.extraordinary;
    info.triangles = scheme.face_size() == 3;
  }
  for (const CurveScheme<double>& scheme : all_curve_schemes())
    add_claims(all.emplace_back(described(scheme, curve, true)), scheme.claims);
  for (const auto& scheme : all_geometric_schemes()) all.push_back(described(scheme, curve, false));
  for (const auto& scheme : all_geometric_schemes<CurvatureMesh>()) all.push_back(described(scheme, surface, false));
  for (const auto& scheme : all_geometric_schemes<NormalMesh>()) all.push_back(described(scheme, surface, false));
  return all;
}

}  // namespace sublimit
