// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/files/ray_files.h"

#include <string>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/stencils/formats/csv_fields.h"
#include "sublimit/stencils/formats/csv_rows.h"
#include "sublimit/stencils/formats/row_file.h"

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
  const std::vector<std::int64_t> ray_of = owners_of_rows(hits.first);
  RowFile file(path, "ray,t,face,u,v,x,y,z,nx,ny,nz,status\n");
  const auto append = [&](std::string& text, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      append_number(text, ray_of[size_t(i)]);
      append_fields(text, &hits.t[size_t(i)], 1);
      text += ',';
      append_place(text, hits.places[size_t(i)]);
      append_point(text, hits.points, i);
      append_normal(text, hits.normals, i);
      text += ',';
      text += hits.word(i);
      text += '\n';
    }
  };
  file.rows(std::ssize(hits.t), 512, append);
  file.commit();
}

}  // namespace sublimit
