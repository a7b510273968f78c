// SPDX-License-Identifier: Apache-2.0
#include "sublimit/implicit/detail/level_set_mesh.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/error.h"
#include "sublimit/limit/detail/limit_cache.h"

namespace sublimit {
namespace {

constexpr int tried_cells[] = {5, 6, 8, 12, 16, 24, 32, 48, 64};
constexpr double default_tolerance = 1e-4;
/// A split that does not bring the limit that much nearer is no way to go on.
constexpr double least_gain = 1.5;

struct Polygons {
  int cells = 0;
  Mesh mesh;
  double cell = 0, least = 0, largest = 0;
  Index pinches = 0;
  ClosedMeshCounts counts;
};

class Maker {
 public:
  Maker(const FieldPointer& field, const Scheme<double>& scheme, const Polygonizer& polygonize,
        const LevelSetOptions& options)
      : field_(field), scheme_(scheme), polygonize_(polygonize), options_(options) {
    if (!field) throw InvalidParameter("there is no field; give one");
    if (!(options.tolerance >= 0 && std::isfinite(options.tolerance)))
      throw InvalidParameter("the tolerance is " + format_number(options.tolerance) + "; it should be 0 or more");
  }

  LevelSetMesh make() {
    if (options_.cells != 0) {
      use(options_.cells);
    } else {
      for (const int cells : tried_cells) {
        const bool last = cells == std::end(tried_cells)[-1];
        try {
          use(cells, !last);
        } catch (const InvalidParameter&) {  // thinner than a cell, perhaps
          if (last && !made_) throw;
        } catch (const InvalidMesh&) {
          if (last && !made_) throw;
        }
        if (made_ && (result_.met() || is_full_)) break;
      }
      // A grid that shows less than one of twice as many cells is better than none.
      if (!made_) use(std::end(tried_cells)[-1]);
    }
    return std::move(result_);
  }

 private:
  Polygons polygons(int cells) const {
    const FieldGrid grid = sample_field(*field_, options_.box ? *options_.box : padded_extent(*field_, cells), cells);
    Polygons all{.cells = cells,
                 .mesh = polygonize_(grid),
                 .cell = grid.cell,
                 .least = grid.least,
                 .largest = grid.largest,
                 .counts = {}};
    all.pinches = split_pinches(all.mesh);
    all.counts = closed_mesh_counts(all.mesh);
    return all;
  }

  void tell(const std::string& what) const {
    if (options_.progress) options_.progress(what);
  }

  /// Cages from a grid.
  /// @param only_right  leave it alone if a finer one shows another shape
  void use(int cells, bool only_right = false) {
    tell("polygonising " + format_number(cells) + " cells");
    Polygons coarse = polygons(cells);
    std::optional<ClosedMeshCounts> fine;
    std::vector<std::string> notes;
    try {
      tell("polygonising " + format_number(2 * cells) + " cells");
      fine = polygons(2 * cells).counts;
    } catch (const InvalidParameter&) {  // seen by more places: the surface touches the rim, say
      throw;
    } catch (const Error& error) {
      notes.push_back("with twice as many cells: " + std::string(error.what()));
    }
    if (fine && *fine != coarse.counts) {
      if (only_right) return;
      notes.push_back("with twice as many cells the surface has Euler characteristic " + format_number(fine->euler) +
                      " and " + format_number(fine->components) + " components, with " + format_number(cells) +
                      " cells " + format_number(coarse.counts.euler) + " and " +
                      format_number(coarse.counts.components) + ": it may be thinner than a cell; take more cells");
    }
    if (coarse.pinches > 0)
      notes.push_back(format_number(coarse.pinches) + " vertices where the surface touches itself were split");
    const bool sharp = field_->has_edges() && scheme_.sharpening != Sharpening::boundary;
    if (field_->has_edges() && !sharp)
      notes.push_back("edges of the field are rounded: " + scheme_.name + " has no creases");
    const FieldSides sides(field_, sharp);
    Cage cage = make_cage(coarse.mesh, sides, coarse.cell);
    if (scheme_.face_size() == 3) cage = triangulated(cage, sides);
    const Points& corners = cage.mesh.positions;
    const double diagonal = (corners.colwise().maxCoeff() - corners.colwise().minCoeff()).norm();
    const double size = options_.box ? options_.box->diagonal().norm() : diagonal;
    const double tolerance = options_.tolerance > 0 ? options_.tolerance : default_tolerance * size;
    bool was_folded = false;
    for (double before = -1;; cage = split(cage, sides)) {
      LevelSetAttempt attempt{
          .cells = cells, .splits = splits_of(cage, coarse.cell), .faces = cage.mesh.num_faces(), .error = {}};
      const LimitMap surface(scheme_, cage.mesh, {}, types_);
      LevelSetFit fit = fit_level_set(surface, cage, sides, options_.rounds, [&](int round) {
        tell("fitting " + format_number(attempt.faces) + " faces, round " + format_number(round + 1) + " of " +
             format_number(options_.rounds));
      });
      attempt.error = fit.error;
      attempts_.push_back(attempt);
      if (!made_ || is_nearer(attempt.error, result_.attempt.error)) {
        result_ = LevelSetMesh{.cage = cage.mesh,
                               .attempt = attempt,
                               .attempts = {},
                               .tolerance = tolerance,
                               .diagonal = diagonal,
                               .cell = coarse.cell,
                               .least = coarse.least,
                               .largest = coarse.largest,
                               .counts = coarse.counts,
                               .fine_counts = fine,
                               .notes = notes};
        result_.cage.positions = std::move(fit.points);
        if (cage.rounded > 0)
          result_.notes.push_back(format_number(cage.rounded) +
                                  " edges between parts of the field that meet smoothly are not creases");
        if (attempt.error.is_folded())
          result_.notes.push_back("normals are off by up to " +
                                  format_number(std::round(attempt.error.largest_angle * 100) / 100) +
                                  " rad: faces are folded; take more cells");
        made_ = true;
      }
      result_.attempts = attempts_;
      if (attempt.met(tolerance)) return;
      const bool stuck = before > 0 && attempt.error.largest * least_gain > before;
      if (only_right && (stuck || attempt.error.is_folded())) return;
      if (was_folded && attempt.error.is_folded()) return;  // splits rarely unfold a cage
      was_folded = attempt.error.is_folded();
      before = attempt.error.largest;
      if (4. * cage.mesh.num_faces() > options_.most_faces) {
        is_full_ = true;
        return;
      }
    }
  }

  static int splits_of(const Cage& cage, double cell) { return int(std::lround(std::log2(cell / cage.cell))); }

  const FieldPointer& field_;
  const Scheme<double>& scheme_;
  const Polygonizer& polygonize_;
  const LevelSetOptions& options_;
  std::shared_ptr<LimitCache> types_ = std::make_shared<LimitCache>(scheme_);  // of all cages
  LevelSetMesh result_;
  std::vector<LevelSetAttempt> attempts_;
  bool made_ = false, is_full_ = false;
};

}  // namespace

LevelSetMesh level_set_mesh(const FieldPointer& field, const Scheme<double>& scheme, const Polygonizer& polygonize,
                            const LevelSetOptions& options) {
  return Maker(field, scheme, polygonize, options).make();
}

}  // namespace sublimit
