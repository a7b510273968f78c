// SPDX-License-Identifier: Apache-2.0
#include "sublimit/distributed/jobs/spread_fit.h"

#include <fmt/core.h>
#include <petscksp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/distributed/mesh/points_file.h"
#include "sublimit/distributed/shards/spread_rows.h"
#include "sublimit/fit/scattered_fit.h"
#include "sublimit/stencils/formats/formats.h"
#include "sublimit/stencils/formats/npy.h"
#include "sublimit/stencils/patterns/patterns.h"
#include "sublimit/surface/limit_map.h"

namespace sublimit {
namespace {

using Vector = Eigen::VectorXd;
constexpr double exact_position = 1e-12;  // of the box, as `interpolate` has it

/// The same faces, those of others as holes: each face has its energy once.
SparseMatrix energy_of_owned(const SpreadJob& job, const MeshPart& part, const Fairness& fairness) {
  Mesh mesh = part.mesh;
  std::vector<bool> hole(part.faces.size());
  for (size_t f = 0; f < hole.size(); ++f) hole[f] = !part.is_owned[f];
  for (const Index f : mesh.holes) hole[size_t(f)] = true;
  mesh.holes.clear();
  for (size_t f = 0; f < hole.size(); ++f)
    if (hole[f]) mesh.holes.push_back(static_cast<Index>(f));
  return fairness_energy(LimitMap(job.scheme, mesh, job.rules), fairness);
}

/// What a rank has of the problem: rows of targets and energy of faces, over the control points of its part.
struct Terms {
  bool has_fairness = false;  // of all ranks: one without faces has no rows of either
  SparseMatrix A, H;
  Points b;
  Vector weights, root_weights;
};

Terms own_terms(const SpreadJob& job, const MeshPart& part, const std::vector<Place>& samples,
                const std::vector<SpreadTarget>& targets, const SpreadTargets& file, const Fairness& fairness) {
  const auto n = static_cast<Index>(part.vertices.size());
  Terms terms;
  terms.A = SparseMatrix(0, n);
  terms.b.resize(std::ssize(targets), 3);
  terms.weights.resize(std::ssize(targets));
  for (size_t i = 0; i < targets.size(); ++i) {
    for (size_t c = 0; c < 3; ++c) terms.b(Eigen::Index(i), Eigen::Index(c)) = targets[i].value[c];
    terms.weights[Eigen::Index(i)] = targets[i].weight;
  }
  terms.root_weights = terms.weights.cwiseSqrt();
  terms.has_fairness = !fairness.empty();
  terms.H = SparseMatrix(n, n);
  if (part.faces.empty()) return terms;
  {
    const LimitMap surface(job.scheme, part.mesh, job.rules);
    for (size_t i = 0; i < samples.size(); ++i)
      if (surface.level().holes[size_t(index(surface.addresses().place(samples[i].face).face))])
        throw FormatError(fmt::format("{}face {} is a hole, which is no part of the limit; leave this row out",
                                      file.where(targets[i].line), targets[i].place.address));
    terms.A = place_rows(surface, samples);
    terms.A.prune([](Index, Index, double weight) { return weight != 0; });  // at vertices nearly half of them
  }
  if (terms.has_fairness) terms.H = energy_of_owned(job, part, fairness);
  return terms;
}

/// A^T W A + H of this rank.
SparseMatrix quadratic_form(const Terms& terms) {
  SparseMatrix weighted = terms.root_weights.asDiagonal() * terms.A;
  weighted.prune([](Index, Index, double w) { return w != 0; });  // targets of weight 0 tie nothing
  const SparseMatrix Q = product(SparseMatrix(weighted.transpose()), weighted);
  return SparseMatrix(Q + terms.H);
}

/// Minimises some coordinates at once: all without fairness, one by one with it. Begins again with the true gradient as
/// often as that gains something.
class Solver {
 public:
  Solver(const Ranks& ranks, const Runs& runs, const MeshPart& part, const Halo& halo, const Terms& terms,
         const SpreadFitRequest& request)
      : ranks_(ranks), halo_(halo), terms_(terms), rows_(terms.A, halo, terms.root_weights, channels(terms)) {
    find_size();
    check_petsc(KSPCreate(PETSC_COMM_WORLD, &solver_.value));
    PC preconditioner = nullptr;
    check_petsc(KSPGetPC(solver_, &preconditioner));
    if (terms.has_fairness) {
      matrix_ = assembled(ranks, quadratic_form(terms), runs, part.vertices, halo);
      check_petsc(KSPSetType(solver_, KSPCG));
      check_petsc(KSPSetNormType(solver_, KSP_NORM_UNPRECONDITIONED));
      check_petsc(PCSetType(preconditioner, PCGAMG));
    } else {
      matrix_ = matrix(rows_);
      check_petsc(KSPSetType(solver_, KSPLSQR));
      is_simple_ = true;
      check_petsc(PCSetType(preconditioner, PCNONE));  // any would change which of the best fits is the nearest
    }
    check_petsc(KSPSetOperators(solver_, matrix_, matrix_));
    check_petsc(KSPSetTolerances(solver_, request.tolerance, 0, most_growth, request.max_iterations));
    ranks.together([&] {
      if ((!request.petsc.empty() && request.petsc[0] != '-') ||
          PetscOptionsInsertString(nullptr, request.petsc.c_str()) != 0)
        throw InvalidOption("--petsc " + request.petsc + ": PETSc cannot read this; write it as \"-name value -name\"");
    });
    check_petsc(KSPSetFromOptions(solver_));
    PetscReal tolerance = 0;
    PetscInt most = 0;
    check_petsc(KSPGetTolerances(solver_, &tolerance, nullptr, nullptr, &most));
    tolerance_ = tolerance, max_iterations_ = static_cast<int>(most);
    check_petsc(MatCreateVecs(matrix_, &x_.value, &right_.value));
  }

  static int channels(const Terms& terms) { return terms.has_fairness ? 1 : 3; }
  double tolerance() const { return tolerance_; }

  /// @param x  of the own run: the first guess, and the result
  void solve(const Points& b, Points& x, int coordinate, SpreadFit& fit) {
    KSPType type = nullptr;
    check_petsc(KSPGetType(solver_, &type));
    fit.method = type;
    int& iterations = fit.iterations[size_t(coordinate)];
    Points best = x;
    double least = std::numeric_limits<double>::infinity(), relative = 0;
    while (true) {
      Points residual, gradient;
      const double scale = find_gradient(b, x, residual, gradient);
      const double rest = norm(gradient);
      const bool gained = rest < 0.3 * least;
      if (rest < least) best = x, least = rest, relative = scale > 0 ? rest / scale : 0;
      if (!gained || relative <= 0.5 * tolerance_ || iterations >= max_iterations_) break;
      check_petsc(KSPSetTolerances(solver_, 0, 0.1 * tolerance_ * scale, most_growth, max_iterations_ - iterations));
      set(right_, terms_.has_fairness ? gradient : residual);
      check_petsc(KSPSolve(solver_, right_, x_));
      PetscInt made = 0;
      KSPConvergedReason reason{};
      check_petsc(KSPGetIterationNumber(solver_, &made));
      check_petsc(KSPGetConvergedReason(solver_, &reason));
      fit.reason = KSPConvergedReasons[reason];
      iterations += static_cast<int>(made);
      const Points step = get(x_);
      if (ranks_.all(step.allFinite())) x += step;
      // Where targets and fairness leave something free, factors of a multigrid's coarsest level need not be definite.
      if (reason < 0 && reason != KSP_DIVERGED_ITS && !is_simple_) {
        PC preconditioner = nullptr;
        check_petsc(KSPGetPC(solver_, &preconditioner));
        check_petsc(PCSetType(preconditioner, PCJACOBI));
        is_simple_ = true, x = best, least = std::numeric_limits<double>::infinity();
      }
    }
    x = best;
    fit.gradient = std::max(fit.gradient, relative);
  }

  /// |A x - b| of this rank's targets, without weights.
  Points gap(const Points& b, const Points& x) const { return terms_.A * fetched(halo_, x) - b; }

 private:
  static constexpr double most_growth = 1e50;  // of residuals: they may grow on their way down

  /// What rows of A^T W A + H make of control points, at most.
  void find_size() {
    const Vector ones = Vector::Ones(halo_.num_inputs());
    const SparseMatrix A = terms_.A.cwiseAbs();
    Vector sums = A.transpose() * Vector(terms_.weights.asDiagonal() * (A * ones));
    sums += SparseMatrix(terms_.H.cwiseAbs()) * ones;
    const Points own = summed(halo_, sums);
    size_ = ranks_.largest(own.size() > 0 ? own.maxCoeff() : 0.0);
  }

  /// @return  what it is measured by
  double find_gradient(const Points& b, const Points& x, Points& residual, Points& gradient) const {
    const Points inputs = fetched(halo_, x);
    const auto weighted = [&](const Points& rows) { return Points(terms_.root_weights.asDiagonal() * rows); };
    const auto transposed = [&](const Points& rows) { return Points(terms_.A.transpose() * weighted(rows)); };
    residual = weighted(b - terms_.A * inputs);
    Points sums = transposed(residual);
    sums -= terms_.H * inputs;
    gradient = summed(halo_, sums);
    return norm(summed(halo_, transposed(weighted(b)))) + size_ * norm(x);
  }

  double norm(const Points& own) const { return std::sqrt(ranks_.sum(own.squaredNorm())); }

  static void set(Vec to, const Points& from) {
    PetscScalar* numbers = nullptr;
    check_petsc(VecGetArrayWrite(to, &numbers));
    std::copy_n(from.data(), from.size(), numbers);
    check_petsc(VecRestoreArrayWrite(to, &numbers));
  }
  Points get(Vec from) const {
    const PetscScalar* numbers = nullptr;
    check_petsc(VecGetArrayRead(from, &numbers));
    Points own = Eigen::Map<const Points>(numbers, halo_.num_own(), channels(terms_));
    check_petsc(VecRestoreArrayRead(from, &numbers));
    return own;
  }

  const Ranks& ranks_;
  const Halo& halo_;
  const Terms& terms_;
  SpreadRows rows_;
  double size_ = 0, tolerance_ = 0;
  int max_iterations_ = 0;
  bool is_simple_ = false;  // its preconditioner cannot break down
  PetscObjectOf<Mat> matrix_;
  PetscObjectOf<KSP> solver_;
  PetscObjectOf<Vec> x_, right_;
};

/// Options of PETSc that nobody asked for, as they are given.
std::vector<std::string> unused_options() {
  PetscInt count = 0;
  char **names = nullptr, **values = nullptr;
  check_petsc(PetscOptionsLeftGet(nullptr, &count, &names, &values));
  std::vector<std::string> unused;
  for (PetscInt i = 0; i < count; ++i) unused.push_back("-" + std::string(names[i]));
  check_petsc(PetscOptionsLeftRestore(nullptr, &count, &names, &values));
  return unused;
}

double diagonal(const Ranks& ranks, const Points& points) {
  double square = 0;
  for (Eigen::Index c = 0; c < 3; ++c) {
    constexpr double none = -std::numeric_limits<double>::infinity();
    const double high = ranks.largest(points.rows() > 0 ? points.col(c).maxCoeff() : none);
    const double low = -ranks.largest(points.rows() > 0 ? -points.col(c).minCoeff() : none);
    square += (high - low) * (high - low);
  }
  return std::sqrt(square);
}

void measure(const Ranks& ranks, const Terms& terms, const Vector& squares, const SpreadMesh& mesh, SpreadFit& fit) {
  fit.num_targets = ranks.sum(std::int64_t(squares.size()));
  fit.largest = std::sqrt(ranks.largest(squares.size() > 0 ? squares.maxCoeff() : 0.0));
  fit.rms = std::sqrt(ranks.sum(squares.sum()) / double(fit.num_targets));
  fit.box = diagonal(ranks, terms.b);
  if (!(fit.box > 0)) fit.box = diagonal(ranks, mesh.positions);
  if (!(fit.box > 0)) fit.box = 1;
}

}  // namespace

SpreadFit fit(const Ranks& ranks, const SpreadJob& job, SpreadTargets& file, const SpreadFitRequest& request,
              const std::function<void(const std::string&)>& told) {
  ranks.together([&] {
    if (file.at_vertices() && !request.fairness.empty())
      throw InvalidOption(
          "fairness is for targets at places, which need not be met; give these targets as face,u,v,x,y,z");
  });
  told("dividing");
  int rings = 0;
  ranks.together([&] {
    Patterns patterns(job.scheme);
    rings = shard_rings(patterns, job.creasing);
  });
  const std::vector<int> part_of = divided(ranks, job, {});
  const MeshPart part =
      gather_part(ranks, job.mesh, job.incidence, owned_faces(ranks, job.mesh, part_of, ranks.size())[0], rings, false);
  told("reading targets");
  const PlaceRoutes routes(ranks, job, part_of, part);
  Terms terms;
  {
    const std::vector<SpreadTarget> read = file.read(routes, job.mesh.vertices);
    std::vector<PlaceRoutes::WidePlace> places;
    for (const SpreadTarget& target : read) places.push_back(target.place);
    const PlaceRoutes::Routed routed = routes.route(places);
    const Runs numbers(ranks, std::ssize(read));
    std::vector<std::int64_t> asked;
    for (const auto& [rank, number] : routed.asked_by) asked.push_back(numbers.begin(int(rank)) + number);
    const auto targets = fetch<SpreadTarget>(
        ranks, numbers, asked, [&](std::int64_t number) { return read[size_t(number - numbers.begin(ranks.rank()))]; });
    told("taking stencils");
    ranks.together([&] { terms = own_terms(job, part, routed.samples, targets, file, request.fairness); });
  }
  const Halo halo(ranks, job.mesh.vertices, part.vertices);
  SpreadFit result;
  Points x = job.mesh.positions;
  Vector squares = Vector::Zero(terms.A.rows());
  {
    Solver solver(ranks, job.mesh.vertices, part, halo, terms, request);
    const int channels = Solver::channels(terms);
    for (int c = 0; c < 3; c += channels) {
      told(channels == 3 ? "solving" : fmt::format("solving: coordinate {} of 3", c + 1));
      const Points b = terms.b.middleCols(c, channels);
      Points some = x.middleCols(c, channels);
      solver.solve(b, some, c, result);
      x.middleCols(c, channels) = some;
      squares += solver.gap(b, some).rowwise().squaredNorm();
    }
    result.unused = unused_options();
    result.converged = result.gradient <= solver.tolerance();
  }
  result.points.assign(x.data(), x.data() + x.size());
  measure(ranks, terms, squares, job.mesh, result);
  ranks.together([&] {
    if (request.best_effort) return;
    if (!result.converged)
      throw AnalysisError(fmt::format(
          "{}: the fit did not converge: after {} iterations of {} ({}) its gradient is {:.2g} of the data; allow more "
          "by --max-iterations, another --tolerance, another preconditioner by --petsc, or take what there is by "
          "--best-effort",
          job.name, std::ranges::max(result.iterations), result.method, result.reason, result.gradient));
    if (file.at_vertices() && !(result.largest <= exact_position * result.box))
      throw InvalidMesh(fmt::format(
          "{}: the targets cannot all be met: the limit comes as near as {:.2g} of their box; refine the mesh, leave "
          "targets out, or take what comes nearest by --best-effort",
          job.name, result.largest / result.box));
  });
  return result;
}

void write_control_points(const Ranks& ranks, const SpreadMesh& mesh, std::span<const double> points,
                          const std::filesystem::path& path) {
  const std::int64_t num_points = mesh.vertices.size(), point_size = 3 * std::int64_t{sizeof(double)};
  const bool has_faces = all_formats().writes(path, contents::mesh_parts);
  std::string header, faces;
  ranks.together([&] {
    check_points_output(path);
    header = has_faces ? ply_header(num_points, mesh.faces.size())
                       : npy_header(DType::F64, std::array{num_points, std::int64_t{3}});
    if (!has_faces) return;
    if (num_points > std::numeric_limits<std::int32_t>::max())
      throw InvalidOption(
          fmt::format("{}: {} points are more than a .ply has numbers for; write an .npy", path.string(), num_points));
    const std::int64_t* corner = mesh.face_vertices.data();
    for (size_t f = 0; f < mesh.face_sizes.size(); ++f) {
      const std::int32_t size = mesh.face_sizes[f];
      if (size > 255)
        throw InvalidOption(
            fmt::format("{}: face {} has {} corners, and a .ply written here counts up to 255; write an "
                        ".npy",
                        path.string(), mesh.faces.begin(ranks.rank()) + std::int64_t(f), size));
      faces += static_cast<char>(size);
      for (std::int32_t k = 0; k < size; ++k) {
        const auto v = static_cast<std::int32_t>(*corner++);
        faces.append(reinterpret_cast<const char*>(&v), sizeof v);
      }
    }
  });
  const std::int64_t begin_faces = std::ssize(header) + num_points * point_size,
                     before = ranks.sum_before(std::ssize(faces)), all = ranks.sum(std::ssize(faces));
  SharedFile file(ranks, path, begin_faces + all);
  ranks.together([&] {
    if (ranks.is_first()) file.write(0, header);
    file.write(std::ssize(header) + mesh.vertices.begin(ranks.rank()) * point_size, points);
    file.write(begin_faces + before, faces);
  });
  file.commit();
}

}  // namespace sublimit
