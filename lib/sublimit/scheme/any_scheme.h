// SPDX-License-Identifier: Apache-2.0
#pragma once
// A scheme as an argument: `refine(mesh, "loop", 2)`, `refine(mesh, {"kobbelt", {{"tension", "3/4"}}}, 2)`,
// `refine(mesh, my_scheme, 2)`.
#include <memory>
#include <string>

#include "sublimit/mesh/control_mesh.h"
#include "sublimit/scheme/scheme.h"

namespace sublimit {

/// A scheme by its name, with its options, or one of your own. Copies share it.
class AnyScheme {
 public:
  /// @throws InvalidOption  no scheme of surfaces has this name: says which are nearest; an unknown option, or a value
  ///                        outside its range
  AnyScheme(const std::string& name, const SchemeOptions& options = {});
  AnyScheme(const char* name) : AnyScheme(std::string(name ? name : "")) {}
  AnyScheme(Scheme<double> scheme);
  // Moving copies: a moved-from object stays valid.
  AnyScheme(const AnyScheme&) = default;
  AnyScheme& operator=(const AnyScheme&) = default;

  const Scheme<double>& operator*() const { return *scheme_; }
  const Scheme<double>* operator->() const { return scheme_.get(); }

  /// Returns the scheme that refines a mesh: the rule for triangles that the mesh names (`ControlMesh::triangles`) is
  /// taken if the scheme has one by this name, and none was chosen.
  AnyScheme for_mesh(const ControlMesh& mesh) const;

 private:
  std::shared_ptr<const Scheme<double>> scheme_;
};

}  // namespace sublimit
