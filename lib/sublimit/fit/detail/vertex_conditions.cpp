// SPDX-License-Identifier: Apache-2.0
#include "sublimit/fit/detail/vertex_conditions.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"

namespace sublimit {
namespace {

using Eigen::Vector3d;

/// The side has a tangent plane for generic points.
bool has_plane(LimitStatus status) { return status != LimitStatus::hole && status != LimitStatus::undefined_normal; }

double norm(const SparseMatrix& M, Index row) {
  double square = 0;
  for (SparseMatrix::InnerIterator it(M, row); it; ++it) square += it.value() * it.value();
  return std::sqrt(square);
}

/// Rows one after the other.
class Rows {
 public:
  Rows(Index rows, Index columns, Index nonzeros) : matrix_(rows, columns) { matrix_.reserve(nonzeros); }
  Index begin() {
    matrix_.startVec(row_);
    return row_++;
  }
  void add(Index column, double weight) { matrix_.insertBack(row_ - 1, column) = weight; }
  SparseMatrix take() {
    matrix_.finalize();
    return std::move(matrix_);
  }

 private:
  SparseMatrix matrix_;
  Index row_ = 0;
};

}  // namespace

VertexConditions vertex_conditions(const VertexLimits& limits, const std::vector<VertexTarget>& targets,
                                   const std::map<Index, TangentFrame>& frames) {
  VertexConditions result;
  const Index places = static_cast<Index>(limits.position_vertex.size());
  for (const VertexTarget& target : targets) result.coupled |= target.normal.has_value();
  if (!result.coupled) {
    result.C = limits.position;
    result.d.resize(places, 3);
    for (Index p = 0; p < places; ++p) result.d.row(p) = targets[limits.position_vertex[p]].position;
    return result;
  }

  std::vector<Index> sides;
  for (size_t s = 0; s < limits.side_vertex.size(); ++s) {
    const Index i = limits.side_vertex[s];
    if (!targets[i].normal) continue;
    if (has_plane(limits.status[s])) {
      sides.push_back(static_cast<Index>(s));
    } else if (result.without_plane.empty() || result.without_plane.back() != i) {
      result.without_plane.push_back(i);
    }
  }
  const Index rows = 3 * places + 2 * static_cast<Index>(sides.size()) + 4 * static_cast<Index>(frames.size());
  const std::int64_t nonzeros =
      3 * (std::int64_t{limits.position.nonZeros()} + limits.tangent1.nonZeros() + limits.tangent2.nonZeros());
  if (std::max(nonzeros, 3 * std::int64_t{limits.position.cols()}) > std::numeric_limits<Index>::max())
    throw ResourceError("conditions with normals have more entries than 32-bit indices count; use fewer targets");
  Rows C(rows, 3 * static_cast<Index>(limits.position.cols()), static_cast<Index>(nonzeros));
  result.d = Points::Zero(rows, 1);
  const auto add_coordinates = [&](const SparseMatrix& M, Index row, double scale, const Vector3d& values) {
    for (Index c = 0; c < 3; ++c) {
      result.d(C.begin(), 0) = scale * values[c];
      for (SparseMatrix::InnerIterator it(M, row); it; ++it)
        C.add(3 * static_cast<Index>(it.col()) + c, scale * it.value());
    }
  };
  for (Index p = 0; p < places; ++p)
    add_coordinates(limits.position, p, 1, targets[limits.position_vertex[p]].position);
  // Tangents have any length: rows of length 1 are as heavy as those of positions.
  for (const Index s : sides) {
    const auto frame = frames.find(s);
    for (const SparseMatrix* tangent : {&limits.tangent1, &limits.tangent2}) {
      const double scale = 1 / norm(*tangent, s);
      if (frame != frames.end()) {
        add_coordinates(*tangent, s, scale, frame->second.col(tangent == &limits.tangent2));
        continue;
      }
      const Vector3d N = scale * *targets[limits.side_vertex[s]].normal;
      C.begin();
      for (SparseMatrix::InnerIterator it(*tangent, s); it; ++it)
        for (Index c = 0; c < 3; ++c) C.add(3 * static_cast<Index>(it.col()) + c, N[c] * it.value());
    }
  }
  result.C = C.take();
  return result;
}

std::map<Index, TangentFrame> turned_frames(const VertexLimits& limits, const std::vector<VertexTarget>& targets,
                                            const Points& points, const Points& guess) {
  std::map<Index, TangentFrame> frames;
  const Points t1 = apply(limits.tangent1, points), t2 = apply(limits.tangent2, points);
  const Points guess1 = apply(limits.tangent1, guess), guess2 = apply(limits.tangent2, guess);
  const Index sides = static_cast<Index>(limits.side_vertex.size());
  const auto normal = [](const Points& a, const Points& b, Index s) -> Vector3d {
    return Vector3d(a.row(s)).cross(Vector3d(b.row(s)));
  };
  for (Index first = 0, end = 0; first < sides; first = end) {
    while (end < sides && limits.side_vertex[end] == limits.side_vertex[first]) ++end;
    const VertexTarget& target = targets[limits.side_vertex[first]];
    if (!target.normal) continue;
    const Vector3d N = *target.normal;
    const auto turn_to = [&](const Vector3d& n) { return Eigen::Quaterniond::FromTwoVectors(n, N).toRotationMatrix(); };
    std::vector<Index> planes, wrong;
    Vector3d mean = Vector3d::Zero();
    for (Index s = first; s < end; ++s) {
      const Vector3d own = normal(guess1, guess2, s);
      if (!has_plane(limits.status[s]) || own.isZero(0)) continue;  // nothing to turn
      planes.push_back(s);
      mean += own.normalized();
      if (normal(t1, t2, s).dot(N) <= 0) wrong.push_back(s);
    }
    if (wrong.empty()) continue;
    // Sides share tangents along creases, which one linear map for all of them lets agree. Sides that it would turn
    // over are turned on their own, to be met in the sense of least squares.
    const Eigen::Matrix3d flat = (Eigen::Matrix3d::Identity() - N * N.transpose()) * turn_to(mean);
    const bool together = !mean.isZero(0) && std::all_of(planes.begin(), planes.end(), [&](Index s) {
      return (turn_to(mean) * normal(guess1, guess2, s)).dot(N) > 0;
    });
    for (const Index s : together ? planes : wrong) {
      const Eigen::Matrix3d turn = together ? flat : turn_to(normal(guess1, guess2, s));
      frames[s] << turn * guess1.row(s).transpose(), turn * guess2.row(s).transpose();
    }
  }
  return frames;
}

VertexErrors vertex_errors(const VertexLimits& limits, const std::vector<VertexTarget>& targets, const Points& points) {
  VertexErrors errors;
  const Index count = static_cast<Index>(targets.size());
  const Points at = apply(limits.position, points);
  errors.position.setZero(count);
  for (size_t p = 0; p < limits.position_vertex.size(); ++p) {
    const Index i = limits.position_vertex[p];
    errors.position[i] = std::max(errors.position[i], (at.row(Index(p)).transpose() - targets[i].position).norm());
  }
  errors.normal.setConstant(count, std::numeric_limits<double>::quiet_NaN());
  const Points t1 = apply(limits.tangent1, points), t2 = apply(limits.tangent2, points);
  for (size_t s = 0; s < limits.side_vertex.size(); ++s) {
    const VertexTarget& target = targets[limits.side_vertex[s]];
    if (!target.normal || !has_plane(limits.status[s])) continue;
    const Vector3d a = t1.row(s), b = t2.row(s), n = a.cross(b);
    // Tangents that fell together have no normal: as wrong as can be.
    const double angle = n.isZero(0) ? M_PI : std::atan2(n.cross(*target.normal).norm(), n.dot(*target.normal));
    double& error = errors.normal[limits.side_vertex[s]];
    error = std::isnan(error) ? angle : std::max(error, angle);
  }
  return errors;
}

}  // namespace sublimit
