// SPDX-License-Identifier: Apache-2.0
#include "sublimit/patches/patch_set.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

#include "sublimit/base/detail/memory.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/signature_hash.h"
#include "sublimit/core/detail/sparse_rows.h"
#include "sublimit/patches/detail/bezier_pieces.h"
#include "sublimit/source/detail/derivative_order.h"

namespace sublimit {
namespace {

constexpr std::int64_t most_items = std::numeric_limits<Index>::max();

std::vector<PatchSet::Member> apart(const std::vector<std::shared_ptr<const Patch>>& patches) {
  std::vector<PatchSet::Member> members;
  std::int64_t next = 0;
  for (const auto& patch : patches) {
    if (next + patch->num_points() > most_items)
      throw ResourceError(std::to_string(patches.size()) + " patches: more control points than 32-bit indices count");
    std::vector<Index> points(size_t(patch->num_points()));
    std::iota(points.begin(), points.end(), static_cast<Index>(next));
    next += patch->num_points();
    members.push_back({patch, std::move(points)});
  }
  return members;
}

Index total(const std::vector<std::shared_ptr<const Patch>>& patches) {
  std::int64_t sum = 0;
  for (const auto& patch : patches) sum += patch->num_points();
  return static_cast<Index>(std::min(sum, most_items));
}

}  // namespace

PatchSet::PatchSet(const std::vector<std::shared_ptr<const Patch>>& patches, Coordinates coordinates)
    : PatchSet(apart(patches), total(patches), coordinates) {}

PatchSet::PatchSet(std::vector<Member> members, Index num_points, Coordinates coordinates)
    : members_(std::move(members)), num_points_(num_points), coordinates_(coordinates) {
  std::int64_t faces = 0;
  for (size_t p = 0; p < members_.size(); ++p) {
    const auto& [patch, points] = members_[p];
    const std::string name = "patch " + std::to_string(p) + ": ";
    if (std::ssize(points) != patch->num_points())
      throw InvalidParameter(name + std::to_string(points.size()) + " points for " +
                             std::to_string(patch->num_points()) + " control points");
    for (const Index point : points)
      if (point < 0 || point >= num_points)
        throw InvalidParameter(name + "point " + std::to_string(point) + " of " + std::to_string(num_points));
    const FaceCount own = patch->faces();
    if (p == 0) triangles_ = own.triangles;
    if (own.triangles != triangles_)
      throw UnsupportedTopology(name + "its faces are " + (own.triangles ? "triangles" : "squares") +
                                ", those before are " + (triangles_ ? "triangles" : "squares") +
                                "; put them in files of their own");
    faces += own.size;
    if (faces > most_items)
      throw ResourceError(std::to_string(members_.size()) + " patches: more faces than 32-bit indices count");
    first_face_.push_back(static_cast<Index>(faces));
  }
}

size_t PatchSet::patch_of(Index face) const {
  return static_cast<size_t>(std::upper_bound(first_face_.begin(), first_face_.end(), face) - first_face_.begin()) - 1;
}

Points PatchSet::columns_of(size_t patch, const Points& columns) const {
  return columns(members_[patch].points, Eigen::all);
}

std::vector<Index> PatchSet::slots(Index face) const {
  const size_t p = patch_of(face);
  std::vector<Index> result = members_[p].patch->slots(face - first_face_[p]);
  for (Index& point : result) point = members_[p].points[size_t(point)];
  return result;
}

std::string PatchSet::type(Index face) const {
  const size_t p = patch_of(face);
  return members_[p].patch->type(face - first_face_[p]);
}

std::string PatchSet::ends(Index face) const {
  const size_t p = patch_of(face);
  return members_[p].patch->ends(face - first_face_[p]);
}

FaceLengths PatchSet::lengths(Index face) const {
  const size_t p = patch_of(face);
  return members_[p].patch->lengths(face - first_face_[p]);
}

LimitStencil PatchSet::stencil(const Place& place, int order) const {
  if (place.face < 0 || place.face >= faces().size)
    throw InvalidParameter("face " + std::to_string(place.face) + " does not exist; there are " +
                           std::to_string(faces().size));
  const size_t p = patch_of(place.face);
  const LimitStencil own = members_[p].patch->stencil({place.face - first_face_[p], place.u, place.v}, order);
  // Points of the set ascend in another order, and several of the patch may be one of them.
  LimitStencil result{.status = own.status, .vertices = own.vertices, .weights = {}, .tangents = {}};
  for (Index& v : result.vertices) v = members_[p].points[size_t(v)];
  std::ranges::sort(result.vertices);
  result.vertices.erase(std::unique(result.vertices.begin(), result.vertices.end()), result.vertices.end());
  result.weights = WeightRows::Zero(own.weights.rows(), std::ssize(result.vertices));
  result.tangents = WeightRows::Zero(own.tangents.rows(), std::ssize(result.vertices));
  for (size_t i = 0; i < own.vertices.size(); ++i) {
    const Index point = members_[p].points[size_t(own.vertices[i])];
    const auto at = std::ranges::lower_bound(result.vertices, point) - result.vertices.begin();
    result.weights.col(at) += own.weights.col(Eigen::Index(i));
    if (own.tangents.rows() > 0) result.tangents.col(at) += own.tangents.col(Eigen::Index(i));
  }
  return result;
}

LimitSamples PatchSet::evaluate(const Points& columns, std::span<const Place> samples, int order, bool) const {
  check_order(order);
  check_columns(columns, num_points_, coordinates_);
  std::vector<char> is_used(members_.size());
  for (const Place& place : samples)
    if (place.face >= 0 && place.face < faces().size) is_used[patch_of(place.face)] = 1;
  std::vector<Points> own(members_.size());
  parallel_for(std::ssize(members_), [&](std::int64_t p) {
    if (is_used[size_t(p)]) own[size_t(p)] = columns_of(size_t(p), columns);
  });
  LimitSamples all = empty_samples(std::ssize(samples), order);
  parallel_for_blocks(
      std::ssize(samples),
      [&](std::int64_t, std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) {
          const Place& place = samples[size_t(i)];
          if (place.face < 0 || place.face >= faces().size) continue;
          const size_t p = patch_of(place.face);
          members_[p].patch->evaluate(own[p], coordinates_, {place.face - first_face_[p], place.u, place.v}, order, all,
                                      i);
        }
      },
      256);
  return all;
}

std::unique_ptr<BoundSource> PatchSet::bound(const Points& columns) const& {
  const double most = std::min<double>(1 << 28, memory_limit() / 32);  // two gigabytes, a quarter of what there is
  if (const double numbers = BezierPieces::num_numbers(*this); numbers == 0 || numbers > most)
    return LinearSource::bound(columns);
  return std::make_unique<BezierPieces>(*this, columns);
}

PatchSet::Net PatchSet::net() const {
  Net net;
  net.places.assign(size_t(num_points_), {.face = -1});
  for (size_t p = 0; p < members_.size(); ++p) {
    const auto& [patch, points] = members_[p];
    const Patch::Net own = patch->net();
    if (own.places.empty())
      throw UnsupportedTopology("patch " + std::to_string(p) + ": there are rows for its points, but no net");
    for (size_t i = 0; i < points.size(); ++i) {
      Place at = patch->place(own.places[i]);
      at.face += first_face_[p];
      net.places[size_t(points[i])] = at;
    }
    net.sizes.insert(net.sizes.end(), own.sizes.begin(), own.sizes.end());
    for (const Index v : own.vertices) net.vertices.push_back(points[size_t(v)]);
  }
  for (size_t i = 0; i < net.places.size(); ++i)
    if (net.places[i].face < 0)
      throw UnsupportedTopology("point " + std::to_string(i) + " is of no patch: it has no place on them");
  return net;
}

std::uint64_t PatchSet::hash() const {
  std::vector<std::uint32_t> words{static_cast<std::uint32_t>(num_points_)};
  const auto add_hash = [](std::vector<std::uint32_t>& to, std::uint64_t hash) {
    to.push_back(static_cast<std::uint32_t>(hash));
    to.push_back(static_cast<std::uint32_t>(hash >> 32));
  };
  for (const auto& [patch, points] : members_) {
    std::vector<std::uint32_t> own(points.begin(), points.end());
    for (Index face = 0; face < patch->faces().size; ++face) {
      const std::string type = patch->type(face) + patch->ends(face);
      std::vector<std::uint32_t> of_face(type.begin(), type.end());
      add_hash(own, SignatureHash()(of_face));
    }
    add_hash(words, SignatureHash()(own));
  }
  return std::max<std::uint64_t>(1, SignatureHash()(words));
}

std::pair<PatchSet, SparseMatrix> PatchSet::refined() const {
  std::vector<std::shared_ptr<const Patch>> fine;
  std::vector<SparseMatrix> parts;
  std::int64_t nonzeros = 0;
  for (size_t p = 0; p < members_.size(); ++p) {
    Patch::Refined one = members_[p].patch->refined();
    if (!one.patch)
      throw UnsupportedTopology("patch " + std::to_string(p) + ": there are rows for its points, but no net to refine");
    fine.push_back(std::move(one.patch));
    nonzeros += one.S.nonZeros();
    parts.push_back(std::move(one.S));
  }
  if (nonzeros > most_items) throw ResourceError("refined patches: more nonzeros than 32-bit indices count");
  PatchSet set(fine, coordinates_);
  SparseRows rows;
  rows.reserve(size_t(set.num_points()), size_t(nonzeros));
  std::vector<SparseRows::Term> terms;
  for (size_t p = 0; p < parts.size(); ++p)
    for (Index r = 0; r < parts[p].rows(); ++r) {
      terms.clear();
      for (SparseMatrix::InnerIterator it(parts[p], r); it; ++it)
        terms.push_back({members_[p].points[size_t(it.col())], it.value()});
      std::ranges::stable_sort(terms, {}, &SparseRows::Term::first);
      for (const auto& [point, weight] : terms) rows.add(point, weight);
      rows.end_row();
    }
  std::vector<SparseRows::Row> spans;
  for (size_t r = 0; r < rows.size(); ++r) spans.push_back(rows[r]);
  return {std::move(set), matrix_of(spans, num_points_)};
}

}  // namespace sublimit
