// SPDX-License-Identifier: Apache-2.0
#pragma once
// Interface of classical patches that are linear in their control points, as LimitMap is for schemes. A kind of patch
// defines, for each face, the control points that it depends on (slots) and their weights (rows); stencils, evaluation
// with normals and poles, and tables are here: x(f,u,v) = rows(f,u,v) * (columns of the slots of f).
//
//   const SplineSurface spline(bezier_knots<double>(2), bezier_knots<double>(3));
//   const Patch& patch = spline;
//   const Points control = Points::Random(patch.num_points(), 3);
//   const LimitSamples samples = patch.evaluate(control, std::vector<Place>{{.face = 0, .u = 0.5, .v = 0.5}}, 1);
//
// Columns are points, or homogeneous (w x, w) for rational patches: rows are the same for both.
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sublimit/patches/knots.h"
#include "sublimit/source/address.h"
#include "sublimit/source/limit_stencil.h"
#include "sublimit/source/rational.h"

namespace sublimit {

/// A patch without control points. It never changes: threads may share it.
class Patch {
 public:
  virtual ~Patch() = default;

  /// Returns the number of control points.
  virtual Index num_points() const = 0;
  virtual FaceCount faces() const = 0;

  /// Returns the slots of a face: the control points that its rows have weights for. A point may have several slots, as
  /// in short closed patches; its weights are then summed.
  virtual std::vector<Index> slots(Index face) const = 0;

  /// Computes weights over the slots of the face: position, then du, dv, then duu, duv, dvv, per unit of the face. At a
  /// border with another face they are one-sided. Rows of a derivative that does not exist are left out.
  /// @param place    inside its face
  /// @param weights  gets rows x slots
  /// @return  `regular`; `crease` if rows of another face differ there; `unbounded_second`
  virtual LimitStatus rows(const Place& place, int order, WeightRows& weights) const = 0;

  /// Returns what the rows of a face depend on, as bytes: faces of equal types, in patches of any kind, have equal
  /// rows, over slots in the same order.
  virtual std::string type(Index face) const = 0;
  /// Returns what statuses depend on besides the type: the continuity between the face and its neighbours.
  virtual std::string ends(Index) const { return {}; }

  /// True if all control points are points: weights of a position sum to 1, those of a derivative to 0. False if some
  /// are vectors, as coefficients of powers, or tangents.
  virtual bool is_affine() const { return true; }

  /// A place in the patch's own parameters. At a knot the sides select the piece.
  struct Parameters {
    double u = 0, v = 0;
    KnotSide u_side = KnotSide::right, v_side = KnotSide::right;
  };
  /// Returns the place of parameters.
  /// @throws InvalidParameter  parameters outside the domain
  virtual Place place(const Parameters& parameters) const = 0;
  /// Returns the parameters of a place.
  virtual Parameters parameters(const Place& place) const = 0;
  using Lengths = FaceLengths;
  /// Returns the lengths of a face's sides in the patch's own parameters.
  virtual Lengths lengths(Index face) const = 0;

  /// A face as one polynomial: its Bernstein coefficients as rows over the slots, u fastest. For triangles they are in
  /// the order of TrianglePatch, and both degrees are the total degree.
  struct BezierRows {
    int degree_u = 0, degree_v = 0;
    WeightRows rows;
  };
  /// Returns a face as one polynomial, or nothing if it is not polynomial.
  virtual std::optional<BezierRows> bezier(Index) const { return std::nullopt; }

  /// A patch with a finer net, and the matrix that makes its control points.
  struct Refined {
    std::shared_ptr<const Patch> patch;  ///< null if there is no finer net of this kind
    SparseMatrix S;                      ///< #points of `patch` x #points
  };
  /// Returns the natural next level of the patch.
  virtual Refined refined() const { return {}; }

  /// The control points as a mesh, and the parameters that each of them tends to as the net is refined.
  struct Net {
    std::vector<Parameters> places;      ///< parameters of each control point
    std::vector<Index> sizes, vertices;  ///< polygons, in the order of u and v
  };
  /// Returns the control net, which is empty for patches without one.
  virtual Net net() const { return {}; }

  /// Returns the weights of a place over the control points, ascending, those without weight left out.
  /// @throws InvalidParameter  a face that does not exist, parameters outside the face or not finite, another order
  LimitStencil stencil(const Place& place, int order = 0) const;

  /// Returns points with derivatives and normals; in parallel. A place where w = 0 has the status `pole`, one outside
  /// its face `outside`, and nothing else.
  ///
  /// Normals are du x dv, by the order of u and v. If both derivatives are parallel there may be a limit of normals,
  /// see `limit_normal`; otherwise the status is `undefined-normal`.
  /// @param columns  control points, #points x 3, or x 4 if they are homogeneous
  /// @param order    number of derivatives: 0, 1 or 2
  /// @throws InvalidParameter  an array of another size, another order
  LimitSamples evaluate(const Points& columns, std::span<const Place> places, int order = 0,
                        Coordinates coordinates = Coordinates::plain) const;

  /// Evaluates one place into row `at` of arrays that have room for it.
  void evaluate(const Points& columns, Coordinates coordinates, const Place& place, int order, LimitSamples& out,
                Eigen::Index at) const;

 protected:
  Patch() = default;
  Patch(const Patch&) = default;
  Patch(Patch&&) = default;
  Patch& operator=(const Patch&) = default;
  Patch& operator=(Patch&&) = default;

  /// Returns the limit of the unit normals around a place whose derivatives are parallel; zero if there is none.
  virtual Eigen::Vector3d limit_normal(const Points&, Coordinates, const Place&) const {
    return Eigen::Vector3d::Zero();
  }

 private:
  bool is_inside(const Place& s) const;
};

/// Computes the rows of a tensor product from those of its two directions, points of u fastest.
/// @param u, v     (order + 1) x m and (order + 1) x n weights, row by row
/// @param weights  gets 1, 3 or 6 rows of m * n weights
void product_rows(std::span<const double> u, Eigen::Index m, std::span<const double> v, Eigen::Index n, int order,
                  WeightRows& weights);

/// Returns the Kronecker product of v and u: rows and columns of u fastest.
WeightRows outer_product(const WeightRows& v, const WeightRows& u);

/// Resizes arrays to `count` places, all of status `outside`; their memory is reused.
void set_empty(Eigen::Index count, int order, LimitSamples& out);
/// Returns arrays for `count` places, all of status `outside`.
LimitSamples empty_samples(Eigen::Index count, int order);

}  // namespace sublimit
