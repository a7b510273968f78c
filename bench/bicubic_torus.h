// SPDX-License-Identifier: Apache-2.0
#pragma once
// Upper bound of the speed of any table: level 3 of a torus of m x n quadrilaterals by a loop that uses the
// grid and the tensor products of its patches, without a table or lists of control points.
#include <tbb/parallel_for.h>

#include <span>
#include <vector>

namespace sublimit::bench {

class BicubicTorus {
 public:
  /// Makes the weights of level 3, with 8 x 8 points on each patch.
  BicubicTorus(int m, int n) : m_(m), n_(n), weights_(4 * N) {
    // Three times two-scale relation of cubic B-splines, on unit vectors of four control points.
    for (int k = 0; k < 4; ++k) {
      std::vector<float> p(8, 0.0f);
      p[size_t(k) + 1] = 1;  // control points -1, 0, 1, 2 at 1, 2, 3, 4; parameter 0 is at 2
      size_t origin = 2;
      for (int level = 0; level < 3; ++level) {
        std::vector<float> q;
        for (size_t i = 1; i + 1 < p.size(); ++i) {
          q.push_back((p[i - 1] + 6 * p[i] + p[i + 1]) / 8);
          q.push_back((p[i] + p[i + 1]) / 2);
        }
        origin = 2 * (origin - 1);
        p = q;
      }
      for (int s = 0; s < N; ++s) weights_[size_t(k * N + s)] = p[origin + size_t(s)];
    }
  }

  /// Sets the points of level 3, patch by patch, 8 x 8 on each; coordinates x y z are interleaved.
  void apply(std::span<const float> points, std::span<float> result) const {
    tbb::parallel_for(tbb::blocked_range<int>(0, m_, 4), [&](const tbb::blocked_range<int>& r) {
      for (int i = r.begin(); i < r.end(); ++i) rows(i, points.data(), result.data());
    });
  }

 private:
  static constexpr int N = 8;
#if defined(__GNUC__) && !defined(__clang__)
  __attribute__((target_clones("avx512f", "avx2", "default")))
#endif
  void
  rows(int i, const float* points, float* result) const {
    for (int j = 0; j < n_; ++j) {
      float* out = result + (std::size_t(i) * std::size_t(n_) + std::size_t(j)) * N * N * 3;
      float along[4][3][N];  // by row of control points, then x y z
      for (int b = 0; b < 4; ++b) {
        const int row = (j + b - 1 + n_) % n_;
        float sum[3][N] = {};
        for (int a = 0; a < 4; ++a) {
          const float* p = points + std::size_t((i + a - 1 + m_) % m_ * n_ + row) * 3;
          for (int s = 0; s < N; ++s) {
            const float w = weights_[size_t(a * N + s)];
            sum[0][s] += w * p[0];
            sum[1][s] += w * p[1];
            sum[2][s] += w * p[2];
          }
        }
        for (int c = 0; c < 3; ++c)
          for (int s = 0; s < N; ++s) along[b][c][s] = sum[c][s];
      }
      for (int t = 0; t < N; ++t) {
        float sum[3][N] = {};
        for (int b = 0; b < 4; ++b) {
          const float w = weights_[size_t(b * N + t)];
          for (int c = 0; c < 3; ++c)
            for (int s = 0; s < N; ++s) sum[c][s] += w * along[b][c][s];
        }
        for (int s = 0; s < N; ++s, out += 3) {
          out[0] = sum[0][s];
          out[1] = sum[1][s];
          out[2] = sum[2][s];
        }
      }
    }
  }

  int m_, n_;
  std::vector<float> weights_;  // 4 x 8
};

}  // namespace sublimit::bench
