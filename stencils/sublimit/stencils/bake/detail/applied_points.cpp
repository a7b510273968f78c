// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/bake/detail/applied_points.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/detail/row_writer.h"
#include "sublimit/eval/table/detail/point_addresses.h"
#include "sublimit/source/limit_status.h"

namespace sublimit {
namespace {

constexpr std::int64_t rows_per_text = 1024;

}  // namespace

template <class Real>
AppliedPoints::AppliedPoints(const BakedTable<Real>& table)
    : num_points_(table.table.num_points()),
      quantities_(table.table.quantities()),
      addresses_([table] { return addresses_of(table); }),
      status_names_(table.info.statuses),
      orders_(table.info.orders),
      status_(statuses_of(table)) {
  if (status_names_.empty()) status_names_.emplace_back("regular");
  for (const std::string& name : status_names_) has_plane_.push_back(name != "undefined-normal");
  // Positions of a level's limit come without.
  has_status_ = table.info.rows == TableRows::grid || table.info.rows == TableRows::samples ||
                (table.info.rows == TableRows::limit && (quantities_ > 1 || !status_.empty()));
}

template <class Real>
Points AppliedPoints::normals(std::span<const Real> values) const {
  Points normals = Points::Zero(num_points_, 3);
  if (quantities_ == 1) return normals;
  using Row = Eigen::Matrix<Real, 1, 3>;
  double largest = 0;
  for (const Real x : values.first(size_t(3 * num_points_))) largest = std::max(largest, std::abs(double(x)));
  // What a derivative, a sum of points with weights of a few times its size, has of rounding.
  const double noise = 8 * double(std::numeric_limits<Real>::epsilon()) * largest;
  parallel_for(num_points_, [&](std::int64_t i) {
    if (!status_.empty() && !has_plane_[status_[size_t(i)]]) return;
    const Eigen::RowVector3d du = Eigen::Map<const Row>(values.data() + 3 * (num_points_ + i)).template cast<double>();
    const Eigen::RowVector3d dv =
        Eigen::Map<const Row>(values.data() + 3 * (2 * num_points_ + i)).template cast<double>();
    const Eigen::RowVector3d normal = du.cross(dv);
    // Of parallel derivatives rounding is all that is left, and it points anywhere.
    if (const double length = normal.norm(); length > noise * (du.norm() + dv.norm())) normals.row(i) = normal / length;
  });
  return normals;
}

template <class Real>
Mesh AppliedPoints::mesh(const FaceList& faces, std::span<const Real> values) const {
  Mesh out;
  out.positions.resize(num_points_, 3);
  parallel_for_blocks(3 * num_points_, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    std::copy(values.data() + begin, values.data() + end, out.positions.data() + begin);
  });
  out.face_sizes.assign(faces.sizes.begin(), faces.sizes.end());
  out.face_vertices.assign(faces.corners.begin(), faces.corners.end());
  if (quantities_ > 1) out.normals = normals(values);
  return out;
}

template <class Real>
void AppliedPoints::append_row(std::string& out, std::int64_t point, const SampleAddresses& addresses, size_t channels,
                               std::span<const Real> values, const Points& normals) const {
  const auto i = static_cast<size_t>(point);
  bool first = true;
  const bool is_pole = !poles_.empty() && poles_[i] != 0;
  const auto begin = [&] {
    if (!std::exchange(first, false)) out += ',';
  };
  if (!addresses.faces.empty()) {
    const bool exists = addresses.faces[i] >= 0;
    begin();
    if (exists) append_number(out, addresses.faces[i]);
    for (size_t k = 0; k < 2; ++k) {
      begin();
      if (exists) append_number(out, addresses.parameters[2 * i + k]);
    }
  }
  if (has_status_) {
    begin();
    const std::string& status = status_names_[status_.empty() ? 0 : status_[i]];
    const bool is_degenerate = !is_pole && normals.rows() > 0 && normals.row(point).isZero(0) && status != "hole";
    out += is_pole ? name(LimitStatus::pole) : is_degenerate ? name(LimitStatus::undefined_normal) : status;
  }
  const int order = orders_.empty() ? 2 : orders_[status_.empty() ? 0 : status_[i]];
  for (int q = 0; q < quantities_; ++q) {
    const bool exists = !is_pole && (q == 0 || order >= (q < 3 ? 1 : 2));
    for (size_t c = 0; c < channels; ++c) {
      begin();
      if (exists) append_number(out, values[(size_t(q) * size_t(num_points_) + i) * channels + c]);
    }
  }
  for (Eigen::Index k = 0; k < 3 && normals.rows() > 0; ++k) {
    begin();
    if (!normals.row(point).isZero(0)) append_number(out, static_cast<Real>(normals(point, k)));
  }
  out += '\n';
}

template <class Real>
void AppliedPoints::write_csv(const std::filesystem::path& path, const std::vector<std::string>& channels,
                              std::span<const Real> values, const std::function<void(std::int64_t)>& progress) const {
  const SampleAddresses addresses = addresses_();
  std::string header;
  const auto add = [&](const std::string& name) { header += (header.empty() ? "" : ",") + name; };
  if (!addresses.faces.empty())
    for (const char* name : {"face", "u", "v"}) add(name);
  if (has_status_) add("status");
  constexpr const char* quantities[] = {"", "u", "v", "uu", "uv", "vv"};
  for (int q = 0; q < quantities_; ++q)
    for (const std::string& channel : channels) add(channel + quantities[q]);
  Points found;
  if (channels.size() == 3 && quantities_ > 1) {
    found = normals(values);
    for (const char* name : {"nx", "ny", "nz"}) add(name);
  }
  AtomicFile file(path, progress);
  RowWriter out(file);
  out.write(header + "\n");
  out.rows(num_points_, rows_per_text, [&](std::string& text, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) append_row(text, i, addresses, channels.size(), values, found);
  });
  file.commit();
}

template AppliedPoints::AppliedPoints(const BakedTable<float>&);
template AppliedPoints::AppliedPoints(const BakedTable<double>&);
template Points AppliedPoints::normals(std::span<const float>) const;
template Points AppliedPoints::normals(std::span<const double>) const;
template Mesh AppliedPoints::mesh(const FaceList&, std::span<const float>) const;
template Mesh AppliedPoints::mesh(const FaceList&, std::span<const double>) const;
template void AppliedPoints::write_csv(const std::filesystem::path&, const std::vector<std::string>&,
                                       std::span<const float>, const std::function<void(std::int64_t)>&) const;
template void AppliedPoints::write_csv(const std::filesystem::path&, const std::vector<std::string>&,
                                       std::span<const double>, const std::function<void(std::int64_t)>&) const;

}  // namespace sublimit
