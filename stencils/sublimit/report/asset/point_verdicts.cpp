// SPDX-License-Identifier: Apache-2.0
#include "sublimit/report/asset/point_verdicts.h"

#include <algorithm>
#include <cmath>

#include "sublimit/base/error.h"
#include "sublimit/limit/detail/eigen_structure.h"
#include "sublimit/limit/detail/limit_rows.h"
#include "sublimit/neighborhood/local_patch.h"
#include "sublimit/neighborhood/vertex_sides.h"

namespace sublimit {

const char* name(PlaneVerdict verdict) {
  static constexpr const char* names[] = {"yes", "slow", "no", "unknown"};
  return names[int(verdict)];
}
const char* name(CurvatureVerdict verdict) {
  static constexpr const char* names[] = {"flat", "bounded", "logarithmic", "divergent", "unknown"};
  return names[int(verdict)];
}

namespace asset {
namespace {

/// Eigenvalues of defective clusters are known to 1e-7 or so.
constexpr double same = 1e-6;

/// In dual schemes a vertex becomes a face, or the middle of a border edge: the type that it has from then on.
std::optional<LocalType> lasting_type(const Scheme<double>& scheme, const LocalType& type) {
  if (!scheme.is_dual() || type.kind != Centre::Kind::vertex) return type;
  if (type.corner) return std::nullopt;
  SubdivisionOptions options;
  options.boundary = Boundary::edge_only;
  Level level = control_level(scheme, isolated_fan(type.faces, 4, type.open), options);
  Centre centre{Centre::Kind::vertex, level.topology().outgoing(Vertex{0})};
  for (int k = 0; k < 2 * scheme.period; ++k) {
    Level next = next_level(scheme, level);
    const Topology* before = &level.topology();
    for (const Refinement& step : next.steps) {
      centre = child(centre, *before, step, level.number);
      before = &step.topology;
    }
    level = std::move(next);
  }
  return local_type(level.topology(), level.sharpness, centre, level.number, scheme.period);
}

/// Behind the tangents' eigenvalues the largest one, mu, decides: heights shrink by it while lengths shrink by lambda.
/// At borders there are two of these: a surface of bounded curvature has heights of the square of the longer length at
/// most, so that more than the larger one's square diverges; up to the square of the smaller one all second derivatives
/// stay.
void find_curvature(const Scheme<double>& scheme, const LocalType& type, double smaller, double larger,
                    PointVerdict& verdict) {
  if (type.faces > most_faces) return;
  const std::optional<LocalPatch<double>> patch = local_patch(scheme, type, 2);
  if (!patch) return;
  EigenStructure structure;
  if (const std::optional<FourierBlocks> blocks =
          patch->orbits.empty() ? std::nullopt : fourier_blocks(patch->A, patch->orbits))
    structure = eigen_structure(*blocks);
  else
    structure = eigen_structure(patch->A.cast<std::complex<double>>().eval());
  int before = 0;  // 1 and the tangents'
  std::optional<double> mu;
  bool jordan = false;
  for (const EigenCluster& cluster : structure.clusters) {
    const double modulus = std::abs(cluster.value);
    if (mu && modulus < *mu * (1 - same)) break;
    const int own = std::min(3 - before, cluster.multiplicity);
    before += own;
    if (own == cluster.multiplicity) continue;
    mu = mu.value_or(modulus);
    jordan |= cluster.is_jordan();
  }
  if (!mu || before < 3) return;
  const double most = *mu / (smaller * smaller), least = *mu / (larger * larger);
  verdict.ratio = least > 1 + same ? least : most;
  verdict.curvature = least > 1 + same  ? CurvatureVerdict::divergent
                      : most > 1 + same ? CurvatureVerdict::unknown
                      : most < 1 - same ? CurvatureVerdict::flat
                      : jordan          ? CurvatureVerdict::logarithmic
                                        : CurvatureVerdict::bounded;
}

PlaneVerdict plane_verdict(LimitMasks::Plane plane) {
  return plane >= LimitMasks::Plane::tied   ? PlaneVerdict::no
         : plane == LimitMasks::Plane::slow ? PlaneVerdict::slow
                                            : PlaneVerdict::yes;
}

}  // namespace

const PointVerdict& PointVerdicts::of(const LocalType& type) {
  const auto [at, is_new] = known_.try_emplace(type);
  if (!is_new) return at->second;
  PointVerdict& verdict = at->second;
  try {
    const std::optional<LocalType> lasting = lasting_type(cache_.scheme(), type);
    const IsolatedLimit* limit = lasting ? cache_.isolated(*lasting) : nullptr;
    if (!limit) return verdict;
    verdict.plane = plane_verdict(limit->masks.sides.at(0).plane);
    // The masks know of no plane at any border of mid-edge, regular ones included, while normals next to it agree in
    // all directions: not decided.
    if (type.open && cache_.scheme().steps[0].split == Split::mid_edge && verdict.plane == PlaneVerdict::no)
      verdict.plane = PlaneVerdict::unknown;
    if (verdict.plane != PlaneVerdict::yes) return verdict;
    const LimitMasks::Side& side = limit->masks.sides[0];
    find_curvature(cache_.scheme(), *lasting, std::min(side.lambda1, side.lambda2),
                   std::max(side.lambda1, side.lambda2), verdict);
  } catch (const Error&) {
    // A fan that the split cannot take, or no limit: unknown.
  }
  return verdict;
}

const PointVerdict& PointVerdicts::dart(Index n) {
  const auto [at, is_new] = darts_.try_emplace(n);
  if (!is_new) return at->second;
  try {
    const Level level = control_level(cache_.scheme(), creased_fan(n, n, cache_.scheme().face_size() == 3 ? 3 : 4));
    const HalfEdge any = level.topology().outgoing(Vertex{0});
    const LimitRows rows = limit_rows(level, cache_, side_of(level, any));
    if (!rows.tangent1().empty()) at->second.plane = plane_verdict(rows.plane);
  } catch (const Error&) {
  }
  return at->second;
}

}  // namespace asset
}  // namespace sublimit
