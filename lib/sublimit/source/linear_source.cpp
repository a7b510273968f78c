// SPDX-License-Identifier: Apache-2.0
#include "sublimit/source/linear_source.h"

#include <string>

#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

/// Nothing is prepared.
class UnpreparedSource : public BoundSource {
 public:
  UnpreparedSource(const LinearSource& source, Points points) : source_(source), points_(std::move(points)) {}
  void evaluate(std::span<const Place> samples, int order, bool normals, LimitSamples& out) const override {
    out = source_.evaluate(points_, samples, order, normals);
  }

 private:
  const LinearSource& source_;
  Points points_;
};

}  // namespace

std::vector<Place> grid_places(FaceCount face_count, int N) {
  if (N < 2)
    throw InvalidParameter("a grid of " + std::to_string(N) + " samples a side; there are 2 at least, the ends");
  const bool triangles = face_count.triangles;
  const std::int64_t per_face = triangles ? std::int64_t(N) * (N + 1) / 2 : std::int64_t(N) * N;
  const Index faces = face_count.size;
  std::vector<Place> samples;
  check_memory("a grid of " + std::to_string(N) + " samples a side on " + std::to_string(faces) + " faces",
               double(per_face) * faces * sizeof(Place), "ask for a smaller one");
  samples.reserve(per_face * faces);
  for (Index f = 0; f < faces; ++f)
    for (int j = 0; j < N; ++j)
      for (int i = 0; i < (triangles ? N - j : N); ++i) {
        const double u = double(i) / (N - 1), v = double(j) / (N - 1);
        samples.push_back({f, triangles && u + v > 1 ? 1 - v : u, v});  // a rounded sum must not leave the triangle
      }
  return samples;
}

std::unique_ptr<BoundSource> LinearSource::bound(const Points& points) const& {
  return std::make_unique<UnpreparedSource>(*this, points);
}

}  // namespace sublimit
