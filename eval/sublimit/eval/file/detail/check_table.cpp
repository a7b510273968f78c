// SPDX-License-Identifier: Apache-2.0
#include "sublimit/eval/file/detail/check_table.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "sublimit/base/error.h"

namespace sublimit {
namespace {

/// A face has sixteen million points then.
constexpr int last_grid = 4097, last_level = 30;

[[noreturn]] void fail(const std::string& what) { throw InvalidParameter(what); }

void check_size(const char* name, std::int64_t size, std::int64_t right, const char* why) {
  if (size != right)
    fail(std::string(name) + " has " + std::to_string(size) + " entries, not one for each of " + std::to_string(right) +
         " " + why);
}

void check_info(const TableInfo& info, std::int64_t num_points) {
  if (info.level < 0 || info.level > last_level) fail("level " + std::to_string(info.level));
  if (info.statuses.size() > 256) fail(std::to_string(info.statuses.size()) + " statuses; a byte counts 256");
  for (const std::string& status : info.statuses)
    if (status.empty() || status.find(' ') != std::string::npos) fail("the status '" + status + "' is not one word");
  if (!info.orders.empty() && info.orders.size() != info.statuses.size())
    fail("orders has " + std::to_string(info.orders.size()) + " entries, not one for each of " +
         std::to_string(info.statuses.size()) + " statuses");
  for (const int order : info.orders)
    if (order < 0 || order > 2) fail("orders has " + std::to_string(order) + "; 0, 1 and 2 derivatives are right");
  if (info.rows != TableRows::grid) return;
  if (info.grid < 2 || info.grid > last_grid)
    fail("a grid of " + std::to_string(info.grid) + "; 2 to " + std::to_string(last_grid) + " are right");
  const std::int64_t size = Lattice{info.grid - 1, info.triangles}.size();
  if (num_points % size != 0)
    fail(std::to_string(num_points) + " points are no grids of " + std::to_string(size) + " points");
}

void check_statuses(const char* name, const SharedArray<std::uint8_t>& statuses, std::int64_t right, const char* why,
                    size_t count) {
  if (statuses.empty()) return;
  check_size(name, std::int64_t(statuses.size()), right, why);
  if (const std::uint8_t most = *std::max_element(statuses.begin(), statuses.end()); most >= count)
    fail(std::string(name) + " has the status " + std::to_string(most) + "; there are " + std::to_string(count));
}

void check_faces(const FaceList& faces, std::int64_t num_points) {
  std::int64_t corners = 0;
  for (const std::int32_t size : faces.sizes) {
    if (size < 3) fail("faces.sizes has a face of " + std::to_string(size) + " corners");
    corners += size;
  }
  check_size("faces.corners", std::int64_t(faces.corners.size()), corners, "corners of faces.sizes");
  for (const std::int32_t corner : faces.corners)
    if (corner < 0 || corner >= num_points)
      fail("faces.corners names point " + std::to_string(corner) + " of " + std::to_string(num_points));
}

void check_addresses(const SampleAddresses& addresses, std::int64_t num_points) {
  if (addresses.faces.empty() && addresses.parameters.empty()) return;
  check_size("addresses.faces", std::int64_t(addresses.faces.size()), num_points, "points");
  check_size("addresses.parameters", std::int64_t(addresses.parameters.size()),
             2 * std::int64_t(addresses.faces.size()), "numbers u, v");
  for (const std::int32_t face : addresses.faces)
    if (face < 0) fail("addresses.faces names face " + std::to_string(face));
  for (const double parameter : addresses.parameters)
    if (!std::isfinite(parameter)) fail("addresses.parameters has a number that is not finite");
}

}  // namespace

template <class Real>
void check_table(const BakedTable<Real>& table) {
  const typename PatternTable<Real>::Arrays& a = table.table.arrays();
  const std::int64_t num_points = table.table.num_points();
  check_info(table.info, num_points);
  check_statuses("row_status", table.row_status, std::int64_t(a.rows.size()), "entries of rows",
                 table.info.statuses.size());
  check_statuses("rest_status", table.rest_status, a.rest ? a.rest->num_rows() / a.quantities : 0, "points of rest",
                 table.info.statuses.size());
  check_faces(table.faces, num_points);
  check_addresses(table.addresses, num_points);
  const bool is_mesh = table.info.rows == TableRows::level || table.info.rows == TableRows::limit;
  if (!is_mesh && (!table.channels.list.empty() || table.tags))
    fail(std::string("face-varying channels and tags are of tables of a level or its limit, not of ") +
         name(table.info.rows));
  check_channels(table.channels, table.channels.list.empty() ? 0 : num_corners(table));
  if (table.tags) check_tags(*table.tags, num_points);
}

template void check_table(const BakedTable<float>&);
template void check_table(const BakedTable<double>&);

}  // namespace sublimit
