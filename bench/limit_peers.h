// SPDX-License-Identifier: Apache-2.0
#pragma once
// Evaluation of Catmull-Clark limit surfaces by this library and by others, each in its fastest way: before the
// clock starts, places are converted to the evaluator's form and memory for results is allocated. With several
// threads, blocks of places are evaluated in parallel.
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

  /// Prepares everything that is needed before the first evaluation, from the connectivity on. Earlier
  /// preparations are discarded.
  virtual void start() = 0;
  /// Computes data that would otherwise be computed on first use. Only this library has such data.
  virtual void prepare() {}
  /// Goes back to the connectivity, which is rebuilt if `start` changes it. Not timed.
  virtual void forget() = 0;

  /// Sets the places to evaluate. Called after `start`; not timed.
  virtual void set_places(std::span<const Place> places) = 0;
  /// Evaluates positions and derivatives up to `order` at all places.
  virtual void evaluate(int order) = 0;

  /// Returns the position at a place after `evaluate`, to check that all evaluators mean the same place.
  virtual Eigen::Vector3d position(size_t place) const = 0;
};

/// A contender: its name, and the function that makes its evaluator.
struct LimitContender {
  std::string name;
  std::unique_ptr<LimitEvaluator> (*make)(const Case&);
};

/// Evaluators of other libraries, which refer to the mesh.
///   Bfr     a Surface per face, initialised by a factory with its cache (plain on one thread, with a lock on several),
///           patch points computed
///   Far     a PatchTable (isolation level 4, sharp patches, Gregory end caps), its PatchMap, refined points
///   Embree  rtcInterpolateN on a subdivision geometry, 1024 places a call, float
std::unique_ptr<LimitEvaluator> bfr_float(const Case& mesh);
std::unique_ptr<LimitEvaluator> bfr_double(const Case& mesh);
std::unique_ptr<LimitEvaluator> far_float(const Case& mesh);
std::unique_ptr<LimitEvaluator> far_double(const Case& mesh);
std::unique_ptr<LimitEvaluator> embree(const Case& mesh);

/// Evaluators of this library: `LimitMap`, or after `prepare` a `LimitSurface`; without normals, as the others,
/// or with normals from order 1 on.
std::unique_ptr<LimitEvaluator> our_limits(const Case& mesh);
std::unique_ptr<LimitEvaluator> our_limits_and_normals(const Case& mesh);

}  // namespace sublimit::bench
