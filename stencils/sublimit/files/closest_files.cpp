// SPDX-License-Identifier: Apache-2.0
#include "sublimit/files/closest_files.h"

#include <string>
#include <vector>

#include "sublimit/base/atomic_file.h"
#include "sublimit/base/error.h"
#include "sublimit/base/format_number.h"
#include "sublimit/base/row_writer.h"
#include "sublimit/files/csv_rows.h"
#include "sublimit/files/npy.h"
#include "sublimit/io/file_extension.h"
#include "sublimit/io/read_mesh.h"

namespace sublimit {
namespace {

Points from_csv(const std::filesystem::path& path) {
  CsvRows rows(path, {"x", "y", "z"});
  std::vector<double> values;
  while (rows.next())
    for (size_t k = 0; k < 3; ++k) values.push_back(rows.finite(k));
  return Eigen::Map<const Points>(values.data(), Eigen::Index(values.size() / 3), 3);
}

Points from_npy(const std::filesystem::path& path) {
  const NpyArray array(path);
  const std::vector<std::int64_t>& shape = array.shape();
  if (shape.size() != 2 || shape[1] != 3) {
    std::string given;
    for (const std::int64_t n : shape) given += (given.empty() ? "" : " x ") + format_number(n);
    throw FormatError(path.string() + ": an array of shape " + (given.empty() ? "()" : given) + "; points are n x 3");
  }
  if (shape[0] > std::numeric_limits<Index>::max())
    throw ResourceError(path.string() + ": " + format_number(shape[0]) +
                        " points, more than 2^31 - 1; divide the file");
  Points points(shape[0], 3);
  array.read(0, std::span(points.data(), size_t(points.size())));
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    if (!points.row(i).allFinite()) throw InvalidMesh(path.string() + ": point " + format_number(i) + " is not finite");
  return points;
}

}  // namespace

Points read_query_points(const std::filesystem::path& path) {
  const std::string extension = file_extension(path);
  if (extension == ".csv") return from_csv(path);
  if (extension == ".npy") return from_npy(path);
  if (extension != ".obj" && extension != ".ply" && extension != ".off")
    throw FormatError(path.string() +
                      ": points come in a .csv with the header x,y,z, an .npy, or a mesh's .obj, .ply or .off");
  return read_mesh(path).positions;
}

void write_closest_points(const std::filesystem::path& path, const ClosestPoints& found) {
  AtomicFile file(path);
  file.write("face,u,v,x,y,z,nx,ny,nz,distance,lower,status\n");
  const auto append = [&](std::string& text, std::int64_t begin, std::int64_t end) {
    const auto number = [&](double x) {
      append_number(text, x);
      text += ',';
    };
    for (std::int64_t i = begin; i < end; ++i) {
      const Sample& s = found.places[size_t(i)];
      append_number(text, s.face);
      text += ',';
      number(s.u), number(s.v);
      for (Eigen::Index k = 0; k < 3; ++k) number(found.points(i, k));
      const bool has_normal = !found.normals.row(i).isZero(0);
      for (Eigen::Index k = 0; k < 3; ++k) has_normal ? number(found.normals(i, k)) : void(text += ',');
      number(found.distances[i]), number(found.lower[i]);
      text += name(found.status[size_t(i)]);
      text += '\n';
    }
  };
  RowWriter(file).rows(std::ssize(found.places), 512, append);
  file.commit();
}

}  // namespace sublimit
