// SPDX-License-Identifier: Apache-2.0
#pragma once
// One classical patch as a linear source: what LimitMap is for schemes. A kind of patch says which control points
// the rows of a face are over, and what these rows are; stencils, samples with normals and poles, and tables by types
// of faces follow here.
//
//   x(f,u,v) = rows(f,u,v) * (columns of the control points that f is over)
//
// Columns are points, or, of rational patches, homogeneous (w x, w): rows do not know which.
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sublimit/limit/address.h"
#include "sublimit/limit/limit_stencil.h"
#include "sublimit/patches/knots.h"
#include "sublimit/patches/rational.h"

namespace sublimit {

class Patch {
 public:
  virtual ~Patch() = default;

  virtual Index num_points() const = 0;
  virtual FaceCount faces() const = 0;

  /// Control points that the rows of a face are over: its slots. A point may have several, as closed patches have where
  /// they are short; its weights are then summed.
  virtual std::vector<Index> slots(Index face) const = 0;

  /// Weights over the slots of the face: position, then du, dv, then duu, duv, dvv, per unit of the face; of the face's
  /// side where sides differ. Rows of a derivative that does not exist are left out.
  /// @param sample   inside its face
  /// @param weights  gets rows x slots
  /// @return  `regular`; `crease` where rows of another face differ there; `unbounded_second`
  virtual LimitStatus rows(const Sample& sample, int order, WeightRows& weights) const = 0;

  /// What the rows of a face depend on, as bytes: faces of patches of any kind with equal types have equal rows, over
  /// slots in the same order.
  virtual std::string type(Index face) const = 0;
  /// What statuses depend on besides: how smoothly the face meets those beside it.
  virtual std::string ends(Index) const { return {}; }

  /// Whether all control points are points: rows of a position sum to 1 then, those of a derivative to 0. Coefficients
  /// of powers and tangents are vectors.
  virtual bool is_affine() const { return true; }

  /// Parameters of its own, the second way to name a place. At a knot the side says whose piece is meant.
  struct Parameters {
    double u = 0, v = 0;
    KnotSide u_side = KnotSide::right, v_side = KnotSide::right;
  };
  /// @throws InvalidParameter  outside the domain
  virtual Sample place(const Parameters& parameters) const = 0;
  virtual Parameters parameters(const Sample& place) const = 0;
  using Lengths = FaceLengths;
  /// In these parameters.
  virtual Lengths lengths(Index face) const = 0;

  /// A face as one polynomial: its Bernstein coefficients as rows over the slots, u fastest; of triangles in the order
  /// of TrianglePatch, both degrees being that of the whole.
  struct BezierRows {
    int degree_u = 0, degree_v = 0;
    WeightRows rows;
  };
  /// Nothing of faces that are no polynomials.
  virtual std::optional<BezierRows> bezier(Index) const { return std::nullopt; }

  /// Returns the patch with a finer net, and S, #its points x #points: the natural next level. Null of patches that
  /// have no finer net of their kind.
  struct Refined {
    std::shared_ptr<const Patch> patch;
    SparseMatrix S;
  };
  virtual Refined refined() const { return {}; }

  /// The control points as a mesh, and where on the patch each of them tends to as the net is refined. Empty of patches
  /// that have no net.
  struct Net {
    std::vector<Parameters> places;      ///< of each control point
    std::vector<Index> sizes, vertices;  ///< polygons, in the order of u and v
  };
  virtual Net net() const { return {}; }

  /// Rows over the control points, ascending, those without weight left out.
  /// @throws InvalidParameter  a face that does not exist, parameters outside the face or not finite, another order
  LimitStencil stencil(const Sample& sample, int order = 0) const;

  /// Points with derivatives and normals; in parallel. A place where w = 0 has the status `pole`, one outside its face
  /// `outside`, and nothing else.
  ///
  /// Normals are du x dv, by the order of u and v. Where both derivatives are parallel there may be a limit of normals,
  /// see `limit_normal`; elsewhere the status is `undefined-normal`.
  /// @param columns  #points x 3, or x 4 if they are homogeneous
  /// @throws InvalidParameter  an array of another size, another order
  LimitSamples evaluate(const Points& columns, std::span<const Sample> samples, int order = 0,
                        Coordinates coordinates = Coordinates::plain) const;

  /// A row of `evaluate`, into arrays that have it.
  /// @param at  number of the row
  void evaluate(const Points& columns, Coordinates coordinates, const Sample& sample, int order, LimitSamples& out,
                Eigen::Index at) const;

 protected:
  Patch() = default;
  Patch(const Patch&) = default;
  Patch(Patch&&) = default;
  Patch& operator=(const Patch&) = default;
  Patch& operator=(Patch&&) = default;

  /// Where derivatives are parallel: the limit of the normals around, unit, or zero if there is none.
  virtual Eigen::Vector3d limit_normal(const Points&, Coordinates, const Sample&) const {
    return Eigen::Vector3d::Zero();
  }

 private:
  bool is_inside(const Sample& s) const;
};

/// Rows of a tensor product from those of its two directions, the first one's points fastest.
/// @param u, v  (order + 1) x m and x n weights
void product_rows(std::span<const double> u, Eigen::Index m, std::span<const double> v, Eigen::Index n, int order,
                  WeightRows& weights);

/// Blocks of v times the entries of u: columns and rows of u fastest.
WeightRows outer_product(const WeightRows& v, const WeightRows& u);

/// Arrays for so many samples, all of them `outside`; memory that is there is kept.
void set_empty(Eigen::Index count, int order, LimitSamples& out);
LimitSamples empty_samples(Eigen::Index count, int order);

}  // namespace sublimit
