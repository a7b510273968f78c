// SPDX-License-Identifier: Apache-2.0
#include <optional>

#include "limit_peers.h"
#include "sublimit/schemes/schemes.h"
#include "sublimit/surface/limit_surface.h"

namespace sublimit::bench {
namespace {

class OurEvaluator : public LimitEvaluator {
 public:
  OurEvaluator(const Case& c, bool normals)
      : mesh_(c.mesh),
        scheme_(find_scheme(c.scheme).value()),
        level_(control_level(scheme_, c.mesh)),
        normals_(normals) {
    forget();
  }

  void forget() override {
    bound_.reset();
    surface_.reset();
    given_ = level_;
  }
  void start() override { surface_.emplace(scheme_, std::move(given_)); }
  void prepare() override { bound_.emplace(*surface_, mesh_.positions); }

  void set_places(std::span<const Place> places) override { places_.assign(places.begin(), places.end()); }

  void evaluate(int order) override {
    if (bound_) {
      bound_->evaluate(places_, order, normals_, made_);
    } else {
      made_ = surface_->evaluate(mesh_.positions, places_, order, normals_);
    }
  }

  Eigen::Vector3d position(size_t place) const override { return made_.position.row(Index(place)); }

 private:
  const Mesh& mesh_;
  Scheme<double> scheme_;
  Level level_, given_;
  bool normals_;
  std::optional<LimitMap> surface_;
  std::optional<LimitSurface> bound_;
  std::vector<Place> places_;
  LimitSamples made_;
};

}  // namespace

std::unique_ptr<LimitEvaluator> our_limits(const Case& mesh) { return std::make_unique<OurEvaluator>(mesh, false); }
std::unique_ptr<LimitEvaluator> our_limits_and_normals(const Case& mesh) {
  return std::make_unique<OurEvaluator>(mesh, true);
}

}  // namespace sublimit::bench
