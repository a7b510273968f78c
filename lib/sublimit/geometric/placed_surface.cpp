// SPDX-License-Identifier: Apache-2.0
#include "sublimit/geometric/placed_surface.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

class PlacedTogether : public PlacedSurface {
 public:
  explicit PlacedTogether(std::vector<std::shared_ptr<const PlacedSurface>> parts) : parts_(std::move(parts)) {
    for (const auto& part : parts_) {
      const std::int64_t end = std::int64_t{first_.back()} + part->faces().size;
      if (part->faces().triangles != parts_[0]->faces().triangles)
        throw InvalidParameter("surfaces with triangles and with squares; they should all have the same kind of faces");
      if (end > std::numeric_limits<Index>::max())
        throw ResourceError(format_number(parts_.size()) + " surfaces have more faces than 32-bit indices count");
      first_.push_back(static_cast<Index>(end));
    }
  }

  FaceCount faces() const override { return {first_.back(), parts_[0]->faces().triangles}; }

  void evaluate(std::span<const Place> samples, int order, bool normals, LimitSamples& out) const override {
    std::vector<std::vector<Place>> own(parts_.size());
    std::vector<std::vector<Eigen::Index>> rows(parts_.size());
    for (size_t i = 0; i < samples.size(); ++i) {
      Place sample = samples[i];
      // Places that are on no face go to the first or the last part, which says so.
      const auto end = std::upper_bound(first_.begin() + 1, first_.end() - 1, sample.face);
      const auto part = static_cast<size_t>(end - first_.begin()) - 1;
      sample.face -= first_[part];
      own[part].push_back(sample);
      rows[part].push_back(static_cast<Eigen::Index>(i));
    }
    Points* const targets[] = {&out.position, &out.du, &out.dv, &out.duu, &out.duv, &out.dvv, &out.normal};
    out.status.resize(samples.size());
    out.order.resize(samples.size());
    LimitSamples found;
    const Points* const sources[] = {&found.position, &found.du,  &found.dv,    &found.duu,
                                     &found.duv,      &found.dvv, &found.normal};
    for (size_t part = 0; part < parts_.size(); ++part) {
      parts_[part]->evaluate(own[part], order, normals, found);
      for (int k = 0; k < 7; ++k) {
        // Which arrays there are is the same for all parts, but one without places has none.
        if (part == 0 || (targets[k]->rows() == 0 && sources[k]->rows() > 0))
          targets[k]->setZero(sources[k]->rows() > 0 ? std::ssize(samples) : 0, 3);
        for (Eigen::Index i = 0; i < sources[k]->rows(); ++i)
          targets[k]->row(rows[part][size_t(i)]) = sources[k]->row(i);
      }
      for (size_t i = 0; i < own[part].size(); ++i) {
        out.status[size_t(rows[part][i])] = found.status[i];
        out.order[size_t(rows[part][i])] = found.order[i];
      }
    }
  }

 private:
  std::vector<std::shared_ptr<const PlacedSurface>> parts_;
  std::vector<Index> first_{0};  ///< face of each part, and the end
};

}  // namespace

std::shared_ptr<const PlacedSurface> placed_together(std::vector<std::shared_ptr<const PlacedSurface>> parts) {
  if (parts.empty()) throw InvalidParameter("no surfaces; one at least is needed");
  if (parts.size() == 1) return parts[0];
  return std::make_shared<PlacedTogether>(std::move(parts));
}

}  // namespace sublimit
