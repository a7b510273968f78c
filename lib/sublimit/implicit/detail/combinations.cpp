// SPDX-License-Identifier: Apache-2.0
#include "sublimit/implicit/detail/combinations.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"

namespace sublimit {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using Extent = std::optional<AlignedBox3d>;

void check_fields(const std::vector<FieldPointer>& fields) {
  if (fields.empty()) throw InvalidParameter("an operation on no fields; there should be one at least");
  if (std::ranges::any_of(fields, [](const FieldPointer& field) { return !field; }))
    throw InvalidParameter("one of the fields is missing; each should be one");
}

/// Pieces of an argument have names of their own.
size_t name_of(size_t argument, size_t piece) {
  size_t x = piece * 0x9E3779B97F4A7C15u + argument + 1;
  x ^= x >> 29;
  x *= 0xBF58476D1CE4E5B9u;
  return x ^ (x >> 32);
}

/// sign * min over sign_i F_i: signs of the arguments and of the result make minimum, maximum and difference.
class Choice final : public Field {
 public:
  Choice(std::vector<FieldPointer> fields, double sign, bool is_difference)
      : fields_(std::move(fields)), sign_(sign), is_difference_(is_difference) {
    check_fields(fields_);
  }
  double value(const Vector3d& x) const override {
    double least = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < fields_.size(); ++i) {
      const double v = sign_of(i) * fields_[i]->value(x);
      if (!(v >= least)) least = v;  // not a number stays one
    }
    return sign_ * least;
  }
  FieldJet jet(const Vector3d& x) const override {
    FieldJet least = sign_of(0) * fields_[0]->jet(x);
    for (size_t i = 1; i < fields_.size(); ++i) least = lesser(least, sign_of(i) * fields_[i]->jet(x));
    return sign_ * least;
  }
  Extent extent(double level) const override {
    if (is_difference_) return fields_[0]->extent(level);
    AlignedBox3d all;  // empty
    bool known = false;
    for (const FieldPointer& field : fields_) {
      const Extent one = field->extent(level);
      if (sign_ > 0) {  // a union
        if (!one) return std::nullopt;
        all.extend(*one);
      } else if (one) {
        all = known ? all.intersection(*one) : *one;
        known = true;
      }
    }
    if (sign_ < 0 && !known) return std::nullopt;
    return all;
  }
  void pieces(const Vector3d& x, double width, std::vector<FieldPiece>& out) const override {
    const double own = sign_ * value(x);
    for (size_t i = 0; i < fields_.size(); ++i) {
      if (sign_of(i) * fields_[i]->value(x) > own + width) continue;
      const size_t first = out.size();
      fields_[i]->pieces(x, width, out);
      for (size_t k = first; k < out.size(); ++k) {
        out[k].jet = sign_ * sign_of(i) * out[k].jet;
        out[k].name = name_of(i, out[k].name);
      }
    }
  }
  bool has_edges() const override { return fields_.size() > 1 || fields_[0]->has_edges(); }

 private:
  double sign_of(size_t i) const { return is_difference_ && i > 0 ? -sign_ : sign_; }

  std::vector<FieldPointer> fields_;
  double sign_;  // 1: minimum, -1: maximum
  bool is_difference_;
};

/// What a child says, in other units or elsewhere.
class SmoothUnion final : public Field {
 public:
  SmoothUnion(std::vector<FieldPointer> fields, double width) : fields_(std::move(fields)), width_(width) {
    check_fields(fields_);
    if (!(width > 0 && std::isfinite(width)))
      throw InvalidParameter("the width is " + format_number(width) + "; it should be more than 0");
  }
  double value(const Vector3d& x) const override {
    double result = fields_[0]->value(x);
    for (size_t i = 1; i < fields_.size(); ++i) result = joined(result, fields_[i]->value(x));
    return result;
  }
  FieldJet jet(const Vector3d& x) const override {
    FieldJet result = fields_[0]->jet(x);
    for (size_t i = 1; i < fields_.size(); ++i) result = joined(result, fields_[i]->jet(x));
    return result;
  }
  Extent extent(double level) const override {
    AlignedBox3d all;
    for (const FieldPointer& field : fields_) {
      const Extent one = field->extent(level + double(fields_.size() - 1) * width_ / 4);
      if (!one) return std::nullopt;
      all.extend(*one);
    }
    return all;
  }
  bool has_edges() const override {
    return std::ranges::any_of(fields_, [](const FieldPointer& field) { return field->has_edges(); });
  }

 private:
  template <class T>
  T joined(const T& a, const T& b) const {
    const double apart = std::abs(value_of(a) - value_of(b));
    if (!(apart < width_)) return up_to(lesser(a, b), apart > width_ ? 2 : 1);
    return .5 * (a + b) - width_ / 4 - (a - b) * (a - b) / (4 * width_);  // the formula, multiplied out
  }

  std::vector<FieldPointer> fields_;
  double width_;
};

class Offset final : public Field {
 public:
  Offset(FieldPointer field, double by) : field_(std::move(field)), by_(by) {
    check_fields({field_});
    if (!std::isfinite(by)) throw InvalidParameter("the offset is not finite; it should be a number");
  }
  double value(const Vector3d& x) const override { return field_->value(x) - by_; }
  FieldJet jet(const Vector3d& x) const override { return field_->jet(x) - by_; }
  Extent extent(double level) const override { return field_->extent(level + by_); }
  void pieces(const Vector3d& x, double width, std::vector<FieldPiece>& out) const override {
    const size_t first = out.size();
    field_->pieces(x, width, out);
    for (size_t k = first; k < out.size(); ++k) out[k].jet.value -= by_;
  }
  bool has_edges() const override { return field_->has_edges(); }

 private:
  FieldPointer field_;
  double by_;
};

class Transformed final : public Field {
 public:
  Transformed(FieldPointer field, const Eigen::Matrix4d& matrix) : field_(std::move(field)) {
    check_fields({field_});
    constexpr double exact = 1e-9;
    if (!matrix.allFinite()) throw InvalidParameter("the matrix is not finite; it should be 4 x 4 numbers");
    if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
      throw InvalidParameter("the last row of the matrix should be 0, 0, 0, 1");
    const Eigen::Matrix3d linear = matrix.topLeftCorner<3, 3>();
    scale_ = std::cbrt(std::abs(linear.determinant()));
    const Eigen::Matrix3d turn = linear / scale_;
    if (!(scale_ > 0) || !turn.allFinite() || !(turn.transpose() * turn - Eigen::Matrix3d::Identity()).isZero(exact))
      throw InvalidParameter(
          "the matrix is no rotation with one scale in all directions; it should be rigid but for that");
    inverse_ = turn.transpose() / scale_;
    there_ = linear;
    shift_ = matrix.topRightCorner<3, 1>();
  }
  double value(const Vector3d& x) const override { return scale_ * field_->value(inverse_ * (x - shift_)); }
  FieldJet jet(const Vector3d& x) const override { return moved(field_->jet(inverse_ * (x - shift_))); }
  Extent extent(double level) const override {
    const Extent own = field_->extent(level / scale_);
    if (!own || own->isEmpty()) return own;
    AlignedBox3d box;
    for (int i = 0; i < 8; ++i) box.extend(there_ * own->corner(AlignedBox3d::CornerType(i)) + shift_);
    return box;
  }
  void pieces(const Vector3d& x, double width, std::vector<FieldPiece>& out) const override {
    const size_t first = out.size();
    field_->pieces(inverse_ * (x - shift_), width / scale_, out);
    for (size_t k = first; k < out.size(); ++k) out[k].jet = moved(out[k].jet);
  }
  bool has_edges() const override { return field_->has_edges(); }

 private:
  FieldJet moved(FieldJet jet) const {
    jet.value *= scale_;
    jet.gradient = scale_ * (inverse_.transpose() * jet.gradient);
    jet.hessian = scale_ * (inverse_.transpose() * jet.hessian * inverse_);
    return jet;
  }

  FieldPointer field_;
  double scale_ = 1;
  Eigen::Matrix3d inverse_, there_;
  Vector3d shift_;
};

}  // namespace

FieldPointer union_field(std::vector<FieldPointer> fields) {
  return std::make_shared<const Choice>(std::move(fields), 1, false);
}
FieldPointer intersection_field(std::vector<FieldPointer> fields) {
  return std::make_shared<const Choice>(std::move(fields), -1, false);
}
FieldPointer difference_field(std::vector<FieldPointer> fields) {
  return std::make_shared<const Choice>(std::move(fields), -1, true);
}
FieldPointer smooth_union_field(std::vector<FieldPointer> fields, double width) {
  return std::make_shared<const SmoothUnion>(std::move(fields), width);
}
FieldPointer offset_field(FieldPointer field, double by) {
  return std::make_shared<const Offset>(std::move(field), by);
}
FieldPointer transformed_field(FieldPointer field, const Eigen::Matrix4d& matrix) {
  return std::make_shared<const Transformed>(std::move(field), matrix);
}

// Six half-spaces, so that its edges are those of an intersection.
FieldPointer box_field(const Vector3d& center, const Vector3d& half) {
  if (!center.allFinite()) throw InvalidParameter("the center is not finite; it should be three numbers");
  if (!half.allFinite() || !(half.minCoeff() > 0))
    throw InvalidParameter("half of the box is " + format_number(half[0]) + ", " + format_number(half[1]) + ", " +
                           format_number(half[2]) + "; each should be more than 0");
  std::vector<FieldPointer> sides;
  for (int i = 0; i < 3; ++i)
    for (const double sign : {-1., 1.})
      sides.push_back(
          formula_field([=]<class T>(const Triple<T>& x) -> T { return sign * (x[size_t(i)] - center[i]) - half[i]; },
                        [=](double level) -> Extent {
                          if (half[i] + level < 0) return AlignedBox3d();
                          const Vector3d reach = half.array() + level;
                          return AlignedBox3d(center - reach, center + reach);  // of all sides together
                        }));
  return intersection_field(std::move(sides));
}

}  // namespace sublimit
