// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/fit_jobs/fit_picture.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/stencils/files/level_files.h"
#include "sublimit/stencils/picture/picture_mesh.h"

namespace sublimit {
namespace {

using Eigen::Vector3d;

constexpr Index most_faces = 20'000;
constexpr Index most_dots = 6'000;
constexpr double needle = .08, cross = .018;  // of the targets' diagonal
constexpr double crowd = 60;                  // targets, above which marks become smaller

std::string counted(Index count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

/// The limit, on a level fine enough to look smooth.
PictureMesh limit_picture(const Scheme<double>& scheme, Level level, Points points) {
  while (level.topology().num_faces() * 4 <= most_faces) {
    level = next_level(scheme, level);
    points = apply(level.S, points);
  }
  LimitCache cache(scheme);
  const LimitMatrices limit = limit_matrices(level, cache);
  return surface_picture(limit_mesh(level, limit, limit_points(limit, level.topology(), points), Normals::per_corner));
}

/// Dots with lines from them, all in one layer.
class Marks {
 public:
  Marks(Index targets, double unit)
      : size_(std::clamp(std::sqrt(crowd / static_cast<double>(targets + 1)), .4, 1.)), unit_(unit * size_) {
    picture_.faces = false;
  }
  double unit() const { return unit_; }
  void dot(const Vector3d& p) { picture_.dots.push_back(add(p)); }
  void line(const Vector3d& a, const Vector3d& b, double strength) {
    const Index tail = add(a);
    picture_.creases.push_back({tail, add(b), strength});
  }
  PictureMesh take() {
    picture_.positions = Eigen::Map<const Points>(coordinates_.data(), static_cast<Index>(coordinates_.size() / 3), 3);
    picture_.dot_size = size_;
    return std::move(picture_);
  }

 private:
  Index add(const Vector3d& p) {
    coordinates_.insert(coordinates_.end(), {p.x(), p.y(), p.z()});
    return static_cast<Index>(coordinates_.size() / 3) - 1;
  }
  double size_, unit_;  // marks, smaller where there are many
  PictureMesh picture_;
  std::vector<double> coordinates_;
};

/// Of large clouds only some: they are all over the place.
PictureMesh marks(const FitReport& report) {
  const Points& at = report.expected;
  const Index step = static_cast<Index>(at.rows()) / most_dots + 1;
  Marks marks(static_cast<Index>(at.rows()) / step, report.box);
  for (Index i = 0; i < at.rows(); i += step) {
    const Vector3d p = at.row(i);
    marks.dot(p);
    if (report.normals.rows() > 0 && !report.normals.row(i).isZero(0))
      marks.line(p, p + needle * marks.unit() * report.normals.row(i).transpose(), .5);
  }
  return marks.take();
}

PictureMesh marks(const CurvatureMesh& mesh, double unit) {
  Marks marks(mesh.num_vertices(), unit);
  for (const SurfacePoint& p : mesh.points) {
    const Vector3d lifted = p.position + .004 * unit * p.normal;  // off the faces, which would hide half of it
    const auto arm = [&](const Vector3d& d, double strength) {
      marks.line(lifted - cross * marks.unit() * d, lifted + cross * marks.unit() * d, strength);
    };
    arm(p.direction1, 1);
    arm(p.direction2(), 0);
    marks.line(p.position, p.position + needle * marks.unit() * p.normal, .5);
  }
  return marks.take();
}

/// Triangles with the normals of the data.
PictureMesh triangle_picture(const CurvatureMesh& mesh, bool smooth) {
  const Mesh out = output(mesh);
  PictureMesh picture;
  picture.positions = out.positions;
  picture.face_sizes = out.face_sizes;
  picture.face_vertices = out.face_vertices;
  picture.wireframe = !smooth;
  if (smooth) picture.vertex_normals = out.normals;
  return picture;
}

}  // namespace

std::string fit_picture(const Scheme<double>& scheme, const Level& given, const Points& given_points,
                        const ReportedFit& fit) {
  PictureMesh cage = wire_picture(given, given_points);
  cage.creases.clear();  // needles have their colours
  const PictureMesh dots = marks(fit.report);
  std::string data = counted(static_cast<Index>(fit.report.expected.rows()), "point");
  if (const Index normals = summary(fit.report.normal_error).count; normals > 0)
    data += ", " + counted(normals, "normal");
  return svg_picture({{{cage, dots}, "given", data},
                      {{limit_picture(scheme, given, given_points), dots}, "limit of the given mesh", scheme.name},
                      {{limit_picture(scheme, fit.level, fit.points), dots},
                       "limit of the fit",
                       counted(fit.report.output_vertices, "control point")}});
}

std::string fit_picture(const CurvatureFit& fit) {
  const double unit = fit.report.box;
  return svg_picture(
      {{{triangle_picture(fit.given, false), marks(fit.given, unit)},
        "given",
        counted(fit.given.num_vertices(), "point") + " with normals and curvatures"},
       {{triangle_picture(fit.refined, true), marks(fit.given, unit)},
        fit.report.scheme,
        "level " + std::to_string(fit.report.refinements) + ", " + counted(fit.refined.num_faces(), "triangle")}});
}

}  // namespace sublimit
