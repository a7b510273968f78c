// SPDX-License-Identifier: Apache-2.0
// The limit surface against the truth: brute force in 256-bit floats (support/limit_truth.h).
#include "sublimit/limit/limit_surface.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <random>

#include "support/hard_meshes.h"
#include "support/irregular_meshes.h"
#include "support/limit_truth.h"
#include "support/meshes.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

using Vector = TruePoint::Vector;

/// Largest errors that were seen: positions relative to the bounding box, the rest relative to what they measure.
struct Errors {
  double position = 0, normal = 0, first = 0, second = 0;
  int places = 0, with_first = 0, with_second = 0;
  std::string where;
};

double relative(const Eigen::Vector3d& ours, const Vector& truth) {
  const double size = double(truth.norm()), error = double((ours.cast<Precise>() - truth).norm());
  return size == 0 ? error : error / size;
}

Eigen::Vector3d unit_normal(const Vector& du, const Vector& dv) {
  using Three = Eigen::Matrix<Precise, 3, 1>;
  const Three n = Three(du).cross(Three(dv));
  return (n / n.norm()).cast<double>();
}

class Comparison {
 public:
  Comparison(const std::string& name, const SchemeOptions& options, const ControlMesh& mesh)
      : truth_(*find_scheme<Precise>(name, options)), surface_(*find_scheme(name, options), mesh), points_(mesh.positions) {
    box_ = (points_.colwise().maxCoeff() - points_.colwise().minCoeff()).norm();
  }
  const LimitSurface& surface() const { return surface_; }

  void add(const Sample& s) {
    const LimitStencil ours = surface_.stencil(s, 2);
    if (ours.status == LimitStatus::hole) return;
    const TruePoint truth = true_limit(truth_, surface_.level(), points_, s);
    Points local(ours.vertices.size(), 3);
    for (size_t i = 0; i < ours.vertices.size(); ++i) local.row(i) = points_.row(ours.vertices[i]);
    const Points rows = ours.weights * local;
    const auto record = [&](double& worst, double error, double tolerance, const char* what) {
      if (error > tolerance && !(error <= worst))
        errors.where = std::string(what) + " at face " + std::to_string(s.face) + " (" + std::to_string(s.u) + ", " +
                       std::to_string(s.v) + "), " + name(ours.status);
      worst = std::max(worst, error);
    };
    ++errors.places;
    if (truth.has_position)
      record(errors.position, double((Eigen::Vector3d(rows.row(0)).cast<Precise>() - truth.position).norm()) / box_, 1e-13, "position");
    if (truth.has_first && rows.rows() >= 3) {
      ++errors.with_first;
      record(errors.first, std::max(relative(rows.row(1), truth.du), relative(rows.row(2), truth.dv)), 1e-11, "first");
      const Eigen::Vector3d a = rows.row(1), b = rows.row(2);
      record(errors.normal, (a.cross(b).normalized() - unit_normal(truth.du, truth.dv)).norm(), 1e-9, "normal");
    }
    if (truth.has_second && rows.rows() == 6) {
      ++errors.with_second;
      // Relative to the largest: single ones may vanish.
      const Precise size = std::max({truth.duu.norm(), truth.duv.norm(), truth.dvv.norm()});
      Precise error = 0;
      const Vector* second[] = {&truth.duu, &truth.duv, &truth.dvv};
      for (int k = 0; k < 3; ++k)
        error = std::max<Precise>(error, (Eigen::Vector3d(rows.row(3 + k)).cast<Precise>() - *second[k]).norm());
      record(errors.second, double(size == 0 ? error : Precise(error / size)), 1e-9, "second");
    }
  }

  Errors errors;

 private:
  Scheme<Precise> truth_;
  LimitSurface surface_;
  Points points_;
  double box_;
};

TEST(Explore, All) {
  const char* only = std::getenv("ONLY");
  const int count = std::getenv("COUNT") ? std::atoi(std::getenv("COUNT")) : 40;
  for (const Scheme<double>& scheme : all_schemes()) {
    if (only && scheme.name != only) continue;
    const bool triangles = scheme.face_size() == 3;
    for (int kind = 0; kind < 4; ++kind) {
      Hardness hardness{kind >= 1, kind == 2, kind == 3};
      if (kind >= 2 && scheme.sharpening == Sharpening::boundary) continue;
      if (kind == 3 && scheme.sharpening != Sharpening::semi_sharp) continue;
      const ControlMesh mesh = triangles ? hard_triangles(1, hardness) : hard_polygons(1, hardness);
      try {
        Comparison c(scheme.name, {}, mesh);
        std::mt19937 rng(7);
        std::uniform_real_distribution<double> U(0, 1);
        for (int i = 0; i < count; ++i) {
          Sample s{Index(rng() % c.surface().addresses().size()), U(rng), U(rng)};
          if (i % 2) {
            const double d = std::ldexp(1.0, -1 - int(rng() % 40));
            s.u *= d, s.v *= d;
          }
          if (triangles && s.u + s.v > 1) s.u = 1 - s.u, s.v = 1 - s.v;
          c.add(s);
        }
        const Errors& e = c.errors;
        std::printf("%-22s kind %d faces %d: position %.1e first %.1e normal %.1e second %.1e  (%d %d %d) %s\n", scheme.name.c_str(),
                    kind, int(mesh.num_faces()), e.position, e.first, e.normal, e.second, e.places, e.with_first, e.with_second, e.where.c_str());
      } catch (const std::exception& e) {
        std::printf("%-22s kind %d: %s\n", scheme.name.c_str(), kind, e.what());
      }
      std::fflush(stdout);
    }
  }
}

}  // namespace
}  // namespace sublimit::testing
