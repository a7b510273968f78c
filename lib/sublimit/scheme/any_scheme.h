// SPDX-License-Identifier: Apache-2.0
#pragma once
// A scheme as the argument of a function: a name, a name with options, or a scheme of your own.
//
//   const LimitSurface by_name(mesh, "loop");
//   const LimitSurface with_options(mesh, {"kobbelt", {{"tension", "3/4"}}});
//   const LimitSurface your_own(mesh, my_scheme);  // a Scheme<double>, see scheme.h
#include <memory>
#include <string>
#include <utility>

#include "sublimit/mesh/mesh.h"
#include "sublimit/scheme/scheme.h"

namespace sublimit {

/// A scheme, given by its name with options, or as an object. It never changes: threads may share it, and copies share
/// the scheme.
class AnyScheme {
 public:
  /// Makes a scheme of the library.
  /// @throws InvalidOption  no scheme of surfaces has this name: says which are nearest; an unknown option, or a value
  ///                        outside its range
  AnyScheme(const std::string& name, const SchemeOptions& options = {});
  AnyScheme(const char* name) : AnyScheme(std::string(name ? name : "")) {}
  /// Takes a scheme of your own. It is checked when it is used.
  AnyScheme(Scheme<double> scheme);
  // Moving copies: a moved-from object stays valid.
  AnyScheme(const AnyScheme&) = default;
  AnyScheme& operator=(const AnyScheme&) = default;

  const Scheme<double>& operator*() const& { return *scheme_; }
  Scheme<double> operator*() && { return *scheme_; }  ///< a copy, from temporaries
  const Scheme<double>* operator->() const { return scheme_.get(); }

  /// Returns the scheme with the rule for triangles that a mesh names (`Mesh::triangles`), if the scheme has such an
  /// option and no value was chosen; else the scheme itself.
  AnyScheme for_mesh(const Mesh& mesh) const;

 private:
  std::shared_ptr<const Scheme<double>> scheme_;
};

}  // namespace sublimit
