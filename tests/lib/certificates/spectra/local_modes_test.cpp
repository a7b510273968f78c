// SPDX-License-Identifier: Apache-2.0
#include "sublimit/certificates/spectra/local_modes.h"

#include <gtest/gtest.h>

#include <numbers>

#include "sublimit/surface/limit_map.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"

namespace sublimit {
namespace {

LocalType around(const Scheme<double>& scheme, Index n) {
  return {.kind = scheme.is_dual() ? Centre::Kind::face : Centre::Kind::vertex, .faces = n};
}

TEST(LocalModes, OfRegularPointsAreTheLattice) {
  // Linear functions are limits of their own values, so the map of a regular point is the identity.
  for (const Scheme<double>& scheme : all_schemes()) {
    const int n = scheme.face_size() == 3 ? 6 : 4;
    const auto modes = local_modes(scheme, around(scheme, n), 3);
    ASSERT_TRUE(modes) << scheme.name;
    if (modes->leading.block != 1 || scheme.name == "bilinear") continue;
    const double angle = 2 * std::numbers::pi / n, scale = scheme.is_dual() ? std::numbers::sqrt2 : 1;
    for (size_t i = 0; i < modes->net.labels.size(); ++i) {
      const SectorLabel& l = modes->net.labels[i];
      const std::complex<double> at = (l.x() + l.y() * std::polar(1.0, angle)) * std::polar(scale, angle * l.sector);
      EXPECT_NEAR(std::abs(modes->leading.net[static_cast<Eigen::Index>(i)] - at), 0, testing::eigen(1e3))
          << scheme.name << " (" << l.sector << "; " << l.x() << ", " << l.y() << ")";
    }
  }
}

TEST(LocalModes, ShrinkByTheirEigenvalueFromLevelToLevel) {
  // The limit of an eigenvector at a place d times nearer to the centre is lambda times as large, d the dilation of a
  // period.
  for (const Scheme<double>& scheme : all_schemes())
    for (const Index n : {3, 5}) {
      const auto modes = local_modes(scheme, around(scheme, n));
      ASSERT_TRUE(modes) << scheme.name;
      if (modes->leading.block != 1 || (scheme.name == "mid-edge" && n == 3)) continue;  // a Jordan block
      Mesh mesh = modes->net.mesh;
      mesh.positions.col(0) = modes->leading.net.real();
      mesh.positions.col(1) = modes->leading.net.imag();
      const LimitMap surface(scheme, mesh, {.boundary = Boundary::edge_only, .creasing = {}});
      const double d = modes->dilation;
      const auto place = [&](double u, double v) {  // of the first face; (1, 1) is the middle of a polygon
        return scheme.is_dual() ? Place{0, 1 - u, 1 - v} : Place{0, u, v};
      };
      const std::vector<Place> places{place(.5, .25), place(.5 / d, .25 / d)};
      const LimitSamples at = surface.evaluate(mesh.positions, places);
      const Eigen::Vector3d far = at.position.row(0), near = at.position.row(1);
      EXPECT_GT(far.norm(), .01) << scheme.name;
      EXPECT_LE((near - modes->leading.value.real() * far).norm(), testing::eigen(1e3)) << scheme.name << " n=" << n;
    }
}

TEST(LocalModes, OfHighButterfliesWindTwice) {
  const auto modes = local_modes(find_scheme("butterfly").value(), {.faces = 9});
  EXPECT_EQ(modes->leading.block, 2);
}

}  // namespace
}  // namespace sublimit
