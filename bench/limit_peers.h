// SPDX-License-Identifier: Apache-2.0
#pragma once
// Points of the limit surface of Catmull-Clark, by us and by others, each as it is best used: places are in the
// evaluator's own form and results have their memory before the clock starts; with several threads, blocks of places
// are evaluated in parallel.
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "bench_meshes.h"
#include "sublimit/source/address.h"

namespace sublimit::bench {

class LimitEvaluator {
 public:
  virtual ~LimitEvaluator() = default;

  /// From connectivity to all that must be there before a point is asked for; what was there before is forgotten.
  virtual void start() = 0;
  /// What would else be found at the first use. The others have nothing.
  virtual void prepare() {}
  /// Back to the connectivity: it is made anew where starting has changed it. Outside the clock.
  virtual void forget() = 0;

  /// Where points are asked for. Outside the clock, once started.
  virtual void set_places(std::span<const Place> places) = 0;
  /// Positions and derivatives up to `order` at all places.
  virtual void evaluate(int order) = 0;

  /// Position at a place after `evaluate`; to see that all evaluators mean the same place.
  virtual Eigen::Vector3d position(size_t place) const = 0;
};

/// Who can be asked.
struct LimitContender {
  std::string name;
  std::unique_ptr<LimitEvaluator> (*make)(const Case&);
};

/// Peers that keep looking at the mesh.
///   Bfr     a Surface per face, initialised by a factory with its cache (plain on one thread, with a lock on several),
///           patch points computed
///   Far     a PatchTable (isolation level 4, sharp patches, Gregory end caps), its PatchMap, refined points
///   Embree  rtcInterpolateN on a subdivision geometry, 1024 places a call, float
std::unique_ptr<LimitEvaluator> bfr_float(const Case& mesh);
std::unique_ptr<LimitEvaluator> bfr_double(const Case& mesh);
std::unique_ptr<LimitEvaluator> far_float(const Case& mesh);
std::unique_ptr<LimitEvaluator> far_double(const Case& mesh);
std::unique_ptr<LimitEvaluator> embree(const Case& mesh);

/// Ours: `LimitMap`, prepared a `LimitSurface`; without normals, as the others, and with them from order 1 on.
std::unique_ptr<LimitEvaluator> our_limits(const Case& mesh);
std::unique_ptr<LimitEvaluator> our_limits_and_normals(const Case& mesh);

}  // namespace sublimit::bench
