// SPDX-License-Identifier: Apache-2.0
#include "sublimit/files/ray_files.h"

#include <string>

#include "sublimit/base/atomic_file.h"
#include "sublimit/base/error.h"
#include "sublimit/base/format_number.h"
#include "sublimit/base/row_writer.h"
#include "sublimit/files/csv_rows.h"

namespace sublimit {

std::vector<Ray> read_rays(const std::filesystem::path& path) {
  const std::vector<std::string> six{"ox", "oy", "oz", "dx", "dy", "dz"};
  std::vector<std::string> eight = six;
  eight.insert(eight.end(), {"tmin", "tmax"});
  CsvRows rows(path, {six, eight}, "ox,oy,oz,dx,dy,dz or ox,oy,oz,dx,dy,dz,tmin,tmax");
  const bool has_limits = rows.columns().size() == 8;
  std::vector<Ray> rays;
  while (rows.next()) {
    Ray& ray = rays.emplace_back();
    for (int k = 0; k < 3; ++k) {
      ray.origin[k] = rows.finite(size_t(k));
      ray.direction[k] = rows.finite(size_t(3 + k));
    }
    if (ray.direction.isZero(0))
      throw FormatError(rows.place() + "the direction is 0, 0, 0; one of them should not be");
    if (has_limits && !rows.is_empty(6)) ray.tmin = rows.finite(6);
    if (has_limits && !rows.is_empty(7)) ray.tmax = rows.finite(7);
    if (ray.tmin > ray.tmax)
      throw FormatError(rows.place() + "tmin " + format_number(ray.tmin) + " is above tmax " + format_number(ray.tmax));
  }
  return rays;
}

void write_ray_hits(const std::filesystem::path& path, const RayHits& hits) {
  std::vector<std::int64_t> ray_of;
  for (size_t i = 0; i + 1 < hits.first.size(); ++i) ray_of.resize(size_t(hits.first[i + 1]), std::int64_t(i));
  AtomicFile file(path);
  file.write("ray,t,face,u,v,x,y,z,nx,ny,nz,status\n");
  const auto append = [&](std::string& text, std::int64_t begin, std::int64_t end) {
    const auto number = [&](auto x) {
      append_number(text, x);
      text += ',';
    };
    for (std::int64_t i = begin; i < end; ++i) {
      const Sample& s = hits.places[size_t(i)];
      number(ray_of[size_t(i)]), number(hits.t[size_t(i)]), number(s.face), number(s.u), number(s.v);
      for (Eigen::Index k = 0; k < 3; ++k) number(hits.points(i, k));
      const bool has_normal = !hits.normals.row(i).isZero(0);
      for (Eigen::Index k = 0; k < 3; ++k) has_normal ? number(hits.normals(i, k)) : void(text += ',');
      text += name(hits.status[size_t(i)]);
      text += '\n';
    }
  };
  RowWriter(file).rows(std::ssize(hits.t), 512, append);
  file.commit();
}

}  // namespace sublimit
