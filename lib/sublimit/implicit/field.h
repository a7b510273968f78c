// SPDX-License-Identifier: Apache-2.0
#pragma once
// Scalar fields whose level set 0 is a surface: negative inside, so that the gradient points outwards.
//
//   const FieldPointer ball = formula_field([](const auto& x) { return squared_norm(x) - 1; });
//   const Projection foot = project(*ball, {2, 0, 0}, 3);  // foot.point is near (1, 0, 0)
//   const std::optional<LevelCurvature> bend = level_curvature(foot.jet);
#include <Eigen/Geometry>

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "sublimit/implicit/field_jet.h"

namespace sublimit {

/// One of the smooth fields that a minimum or maximum selects from.
struct FieldPiece {
  FieldJet jet;     ///< value and derivatives of the piece alone
  size_t name = 0;  ///< identifies the piece: the same everywhere in a field
};

/// A scalar field in space. It never changes: threads may share it.
class Field {
 public:
  virtual ~Field() = default;

  /// Returns the value at `x`.
  virtual double value(const Eigen::Vector3d& x) const = 0;
  /// Returns value, gradient and Hessian at `x`; `order` says which derivatives exist.
  virtual FieldJet jet(const Eigen::Vector3d& x) const = 0;
  Eigen::Vector3d gradient(const Eigen::Vector3d& x) const { return jet(x).gradient; }
  Eigen::Matrix3d hessian(const Eigen::Vector3d& x) const { return jet(x).hessian; }

  /// Returns a box that contains {F <= level}: an empty one if the set is empty, nothing if no box is known.
  virtual std::optional<Eigen::AlignedBox3d> extent(double level = 0) const = 0;

  /// Appends to `out` the pieces whose selection is within `width` of the field's value; a smooth field appends itself.
  virtual void pieces(const Eigen::Vector3d& x, double width, std::vector<FieldPiece>& out) const;
  /// Returns these pieces.
  std::vector<FieldPiece> pieces(const Eigen::Vector3d& x, double width) const;
  /// True if the surface can have edges, where a minimum or maximum changes its selection.
  virtual bool has_edges() const { return false; }

 protected:
  Field() = default;
  Field(const Field&) = default;
  Field(Field&&) = default;
  Field& operator=(const Field&) = default;
  Field& operator=(Field&&) = default;
};

/// A field, shared by the fields that are made of it.
using FieldPointer = std::shared_ptr<const Field>;

/// Curvature of the level set through a point.
struct LevelCurvature {
  Eigen::Vector3d normal;  ///< unit length, along the gradient
  double gauss = 0;        ///< K = g^T adj(H) g / |g|^4
  double mean = 0;         ///< -(|g|^2 tr H - g^T H g) / (2 |g|^3); -1/r for a sphere with outward normals
};
/// Returns the curvature of the level set, or nothing if a derivative does not exist or the gradient is zero.
/// Source: Goldman 2005, "Curvature formulas for implicit curves and surfaces".
std::optional<LevelCurvature> level_curvature(const FieldJet& jet);
/// Returns the unit normal of the level set, or nothing if the gradient does not exist or is zero.
std::optional<Eigen::Vector3d> level_normal(const FieldJet& jet);

/// A point that was moved to the level set.
struct Projection {
  Eigen::Vector3d point;
  FieldJet jet;            ///< of the field at `point`
  bool converged = false;  ///< |F| / |grad F| is at the level of rounding, within `reach` of the start
};
/// Moves a point to the level set 0 by Newton's method along the gradient, x - F g / |g|^2, in at most 20 steps.
/// @param reach  largest distance from `x`
Projection project(const Field& field, const Eigen::Vector3d& x, double reach);

/// A field given by a formula: `formula(const Triple<T>&)` for T = double and T = FieldJet, made of +, -, *, /, sqrt,
/// exp, sin, cos, power, lesser, greater and magnitude. Derivatives are computed by automatic differentiation.
template <class Formula>
class FormulaField final : public Field {
 public:
  using Extent = std::function<std::optional<Eigen::AlignedBox3d>(double)>;
  explicit FormulaField(Formula formula, Extent extent = {})
      : formula_(std::move(formula)), extent_(std::move(extent)) {}
  double value(const Eigen::Vector3d& x) const override { return formula_(plain_place(x)); }
  FieldJet jet(const Eigen::Vector3d& x) const override { return formula_(variables(x)); }
  std::optional<Eigen::AlignedBox3d> extent(double level) const override {
    return extent_ ? extent_(level) : std::nullopt;
  }

 private:
  Formula formula_;
  Extent extent_;
};

/// Returns a formula as a field; see FormulaField.
/// @param extent  returns a box that contains {F <= level}, if given
template <class Formula>
FieldPointer formula_field(Formula formula, typename FormulaField<Formula>::Extent extent = {}) {
  return std::make_shared<const FormulaField<Formula>>(std::move(formula), std::move(extent));
}

/// Returns a field whose value and derivatives a function of the caller computes.
/// @param jet  returns value, gradient and Hessian; called from many threads
/// @param box  contains the surface, if known
FieldPointer callback_field(std::function<FieldJet(const Eigen::Vector3d&)> jet,
                            std::optional<Eigen::AlignedBox3d> box = std::nullopt);

}  // namespace sublimit
