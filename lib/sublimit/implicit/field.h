// SPDX-License-Identifier: Apache-2.0
#pragma once
// Scalar fields whose level set 0 is a surface: negative inside, so that the gradient points outwards.
#include <Eigen/Geometry>

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "sublimit/implicit/jet.h"

namespace sublimit {

/// One of the smooth pieces that minima and maxima of fields choose from.
struct FieldPiece {
  FieldJet jet;     ///< of the piece, as if it were chosen
  size_t name = 0;  ///< the same piece has the same name everywhere in a field
};

/// A field is constant once made, and may be asked by many threads.
class Field {
 public:
  virtual ~Field() = default;

  virtual double value(const Eigen::Vector3d& x) const = 0;
  /// Value, gradient and Hessian; `order` tells which exist.
  virtual FieldJet jet(const Eigen::Vector3d& x) const = 0;
  Eigen::Vector3d gradient(const Eigen::Vector3d& x) const { return jet(x).gradient; }
  Eigen::Matrix3d hessian(const Eigen::Vector3d& x) const { return jet(x).hessian; }

  /// A box that holds all of {F <= level}; nothing if none is known, an empty box if there is nothing inside.
  virtual std::optional<Eigen::AlignedBox3d> extent(double level = 0) const = 0;

  /// Pieces whose choice is within `width` of the field's value; those of a smooth field are itself.
  virtual void pieces(const Eigen::Vector3d& x, double width, std::vector<FieldPiece>& out) const;
  std::vector<FieldPiece> pieces(const Eigen::Vector3d& x, double width) const;
  /// Whether there can be edges: minima or maxima that choose.
  virtual bool has_edges() const { return false; }

 protected:
  Field() = default;
  Field(const Field&) = default;
  Field(Field&&) = default;
  Field& operator=(const Field&) = default;
  Field& operator=(Field&&) = default;
};

using FieldPointer = std::shared_ptr<const Field>;

/// How the level set through a place is curved there.
struct LevelCurvature {
  Eigen::Vector3d normal;  ///< unit length, along the gradient
  double gauss = 0;        ///< K = g^T adj(H) g / |g|^4
  double mean = 0;         ///< -(|g|^2 tr H - g^T H g) / (2 |g|^3): of a sphere with outward normals -1/r
};
/// Nothing where a derivative does not exist or the gradient is zero.
/// Source: Goldman 2005, "Curvature formulas for implicit curves and surfaces".
std::optional<LevelCurvature> level_curvature(const FieldJet& jet);
/// Unit normal; nothing where the gradient does not exist or is zero.
std::optional<Eigen::Vector3d> level_normal(const FieldJet& jet);

/// What became of a place that was moved to the level set.
struct Projection {
  Eigen::Vector3d point;
  FieldJet jet;            ///< there
  bool converged = false;  ///< |F| / |grad F| is at the level of rounding, within `reach` of the start
};
/// Newton's method along the gradient, x - F g / |g|^2, at most 20 steps.
/// @param reach  how far it may go
Projection project(const Field& field, const Eigen::Vector3d& x, double reach);

/// A formula as a field: `formula(const Triple<T>&)` for T = double and T = FieldJet, from +, -, *, /, sqrt, exp, sin,
/// cos, power, lesser, greater and magnitude. Derivatives follow by themselves.
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

template <class Formula>
FieldPointer formula_field(Formula formula, typename FormulaField<Formula>::Extent extent = {}) {
  return std::make_shared<const FormulaField<Formula>>(std::move(formula), std::move(extent));
}

/// A program's own function with derivatives of its own.
/// @param jet  value, gradient, Hessian; called from many threads
/// @param box  that holds the surface, if known
FieldPointer callback_field(std::function<FieldJet(const Eigen::Vector3d&)> jet,
                            std::optional<Eigen::AlignedBox3d> box = std::nullopt);

}  // namespace sublimit
