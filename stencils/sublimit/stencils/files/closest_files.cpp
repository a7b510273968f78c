// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/files/closest_files.h"

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/stencils/files/frames.h"
#include "sublimit/stencils/formats/csv_fields.h"
#include "sublimit/stencils/formats/row_file.h"

namespace sublimit {
Points read_query_points(const std::filesystem::path& path) {
  FrameReader file(path);
  if (file.has_frames())
    throw FormatError(path.string() + ": an array of " + format_number(file.num_frames()) +
                      " frames of points; n x 3 is right");
  if (file.columns() != std::vector<std::string>{"x", "y", "z"})
    throw FormatError(path.string() + ": points have three columns x,y,z, not " + format_number(file.num_channels()) +
                      (file.num_channels() == 3 ? " of other names" : ""));
  if (file.num_points() > std::numeric_limits<Index>::max())
    throw ResourceError(path.string() + ": " + format_number(file.num_points()) +
                        " points, more than 2^31 - 1; divide the file");
  Points points(file.num_points(), 3);
  file.next(std::span(points.data(), size_t(points.size())));
  return points;
}

void write_closest_points(const std::filesystem::path& path, const ClosestPoints& found, bool with_query) {
  const std::vector<std::int64_t> query_of = owners_of_rows(found.first);
  RowFile file(path, std::string(with_query ? "point," : "") + "face,u,v,x,y,z,nx,ny,nz,distance,lower,status\n");
  const auto append = [&](std::string& text, std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      if (with_query) {
        append_number(text, query_of[size_t(i)]);
        text += ',';
      }
      append_place(text, found.places[size_t(i)]);
      append_point(text, found.points, i);
      append_normal(text, found.normals, i);
      append_fields(text, &found.distances[i], 1);
      append_fields(text, &found.lower[i], 1);
      text += ',';
      text += name(found.status[size_t(i)]);
      text += '\n';
    }
  };
  file.rows(std::ssize(found.places), 512, append);
  file.commit();
}

}  // namespace sublimit
