// SPDX-License-Identifier: Apache-2.0
#include "support/laws.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <numbers>
#include <numeric>
#include <random>

#include "sublimit/analysis/eigen_structure.h"
#include "sublimit/analysis/limit_points.h"
#include "sublimit/analysis/local_matrix.h"
#include "sublimit/base/error.h"
#include "sublimit/refine.h"
#include "sublimit/sparse_product.h"
#include "support/meshes.h"
#include "support/tolerance.h"

namespace sublimit::testing {
namespace {

constexpr double pi = std::numbers::pi;

bool takes_quads(const Scheme<double>& scheme) { return scheme.face_size() != 3; }

/// Closed, open, irregular and tagged meshes that the scheme takes.
std::vector<ControlMesh> meshes_for(const Scheme<double>& scheme) {
  if (takes_quads(scheme)) {
    ControlMesh creased = cube();
    creased.creases = {{0, 1, 1.4f}, {1, 3, 0.7f}, {1, 5, 3}};
    creased.corners = {{6, 0.8f}};
    return {jittered(torus(4, 5)), grid(3, 4), creased, jittered(prism(5)), quads_from_triangles(icosahedron()),
            fan(7, 4, 2), open_fan(3, 4, 2)};
  }
  ControlMesh creased = octahedron();
  creased.creases = {{0, 2, 1.4f}, {0, 3, 0.7f}};
  return {jittered(triangle_torus(4, 5)), triangle_grid(3, 4), creased, tetrahedron(), icosahedron(), fan(7, 3, 2),
          open_fan(4, 3, 2)};
}

CanonicalNeighborhood smooth_type(const Scheme<double>& scheme, int n) {
  const Topology t(view(fan(n, takes_quads(scheme) ? 4 : 3)));
  return neighborhood(t, initial_sharpness(t, {}, Boundary::edge_and_corner, Creasing::uniform), Vertex{0}).type;
}
CanonicalNeighborhood boundary_type(const Scheme<double>& scheme, int m) {
  const Topology t(view(open_fan(m, takes_quads(scheme) ? 4 : 3)));
  return neighborhood(t, initial_sharpness(t, {}, Boundary::edge_only, Creasing::uniform), Vertex{0}).type;
}

std::string rows_sum_to_one(const Scheme<double>& scheme) {
  for (const ControlMesh& mesh : meshes_for(scheme)) {
    const std::vector<Level> levels = refine(scheme, mesh, 2);
    for (int k = 1; k <= 2; ++k) {
      const Eigen::VectorXd sums = levels[k].S * Eigen::VectorXd::Ones(levels[k].S.cols());
      if ((sums.array() - 1).abs().maxCoeff() > rounding(64)) return "a row sums to " + std::to_string(sums.maxCoeff());
    }
  }
  return {};
}

/// Renumbers vertices, faces and the corners faces start at.
ControlMesh relabelled(const ControlMesh& mesh, std::vector<Index>& new_vertex) {
  std::mt19937 random(7);
  new_vertex.resize(mesh.num_vertices());
  std::iota(new_vertex.begin(), new_vertex.end(), 0);
  std::shuffle(new_vertex.begin(), new_vertex.end(), random);
  std::vector<std::vector<Index>> faces;
  for (Index f = 0, c = 0; f < mesh.num_faces(); c += mesh.face_sizes[f++]) {
    std::vector<Index> face;
    for (Index k = 0; k < mesh.face_sizes[f]; ++k) face.push_back(new_vertex[mesh.face_vertices[c + k]]);
    std::rotate(face.begin(), face.begin() + Index(random() % face.size()), face.end());
    faces.push_back(face);
  }
  std::shuffle(faces.begin(), faces.end(), random);
  ControlMesh result;
  result.positions.resize(mesh.num_vertices(), 3);
  for (Index v = 0; v < mesh.num_vertices(); ++v) result.positions.row(new_vertex[v]) = mesh.positions.row(v);
  for (const auto& face : faces) {
    result.face_sizes.push_back(Index(face.size()));
    result.face_vertices.insert(result.face_vertices.end(), face.begin(), face.end());
  }
  for (const auto& c : mesh.creases) result.creases.push_back({new_vertex[c.tail], new_vertex[c.head], c.sharpness});
  for (const auto& c : mesh.corners) result.corners.push_back({new_vertex[c.vertex], c.sharpness});
  return result;
}

/// Rows of S as they are, whatever the numbering: a row is known by its weights and the old vertices they are on.
std::string relabelling_permutes_rows(const Scheme<double>& scheme) {
  using Row = std::vector<std::pair<Index, double>>;
  for (const ControlMesh& mesh : meshes_for(scheme)) {
    std::vector<Index> new_vertex;
    const ControlMesh other = relabelled(mesh, new_vertex);
    const auto rows = [&](const ControlMesh& m, bool rename) {
      const SparseMatrix S = refine(scheme, m, 1)[1].S;
      std::vector<Row> result(S.rows());
      for (Index r = 0; r < S.rows(); ++r) {
        for (SparseMatrix::InnerIterator it(S, r); it; ++it)
          result[r].push_back({rename ? new_vertex[it.col()] : Index(it.col()), it.value()});
        std::sort(result[r].begin(), result[r].end());
      }
      const auto key = [](const Row& row) {  // columns, then weights to nine digits
        std::vector<long long> words;
        for (const auto& term : row) words.push_back(term.first);
        for (const auto& term : row) words.push_back(std::llround(term.second * 1e9));
        return words;
      };
      std::sort(result.begin(), result.end(), [&](const Row& a, const Row& b) { return key(a) < key(b); });
      return result;
    };
    const std::vector<Row> a = rows(mesh, true), b = rows(other, false);
    for (size_t r = 0; r < a.size(); ++r) {
      if (a[r].size() != b[r].size()) return "a row has other entries after relabelling";
      for (size_t i = 0; i < a[r].size(); ++i)
        if (a[r][i].first != b[r][i].first || std::abs(a[r][i].second - b[r][i].second) > rounding(64))
          return "a weight is " + std::to_string(a[r][i].second) + " and after relabelling " +
                 std::to_string(b[r][i].second);
    }
  }
  return {};
}

std::string symmetric_rings_give_circulant_blocks(const Scheme<double>& scheme) {
  for (int n = 3; n <= 9; ++n) {
    const auto fourier = fourier_blocks(local_step(scheme, smooth_type(scheme, n)).matrix, n);
    if (!fourier) return "the local matrix of valence " + std::to_string(n) + " does not commute with the rotation";
    // Mirror images: conjugate blocks have the same eigenvalues, and all of them are real.
    for (int k = 0; k < n; ++k)
      for (const EigenCluster& cluster : eigen_structure(fourier->blocks[k], k).clusters)
        if (std::abs(cluster.value.imag()) > eigen()) return "a mirror-symmetric ring has a complex eigenvalue";
  }
  return {};
}

std::string one_is_the_simple_dominant_eigenvalue(const Scheme<double>& scheme) {
  try {
    for (int n = 3; n <= 9; ++n) {
      limit_masks(scheme, smooth_type(scheme, n));
      limit_masks(scheme, boundary_type(scheme, n));
    }
  } catch (const AnalysisError& error) {
    return error.what();
  }
  return {};
}

std::string claims_about_weights_hold(const Scheme<double>& scheme) {
  for (const ControlMesh& mesh : meshes_for(scheme)) {
    const Level level = refine(scheme, mesh, 1)[1];
    for (Index r = 0; r < level.S.rows(); ++r) {
      for (SparseMatrix::InnerIterator it(level.S, r); it; ++it)
        if (scheme.claims.convex_hull && it.value() < 0) return "a weight is negative";
      const bool from_vertex = level.steps[0].origin(Vertex{r}) == Refinement::Origin::vertex;
      const Index begin = level.S.outerIndexPtr()[r], length = level.S.outerIndexPtr()[r + 1] - begin;
      if (scheme.claims.interpolates && from_vertex &&
          (length != 1 || level.S.valuePtr()[begin] != 1 || level.S.innerIndexPtr()[begin] != r))
        return "an old vertex moves";
    }
  }
  return {};
}

/// Linear functions on regular meshes, boundaries included: midpoints and centroids of the parameters.
std::string linear_functions_are_reproduced(const Scheme<double>& scheme) {
  if (scheme.claims.reproduces < 1) return {};
  ControlMesh mesh = takes_quads(scheme) ? grid(5, 4) : triangle_grid(5, 4);
  for (Index j = 0; j <= 4; ++j)
    for (Index i = 0; i <= 5; ++i) mesh.positions.row(j * 6 + i) << i, j, 2 * i - 3 * j;
  const Level level = refine(scheme, mesh, 1)[1];
  const Topology t(view(mesh));
  const Points x = apply(level.S, mesh.positions);
  for (Index r = 0; r < level.S.rows(); ++r) {
    const Refinement& refinement = level.steps[0];
    const Index parent = refinement.parent(Vertex{r});
    Eigen::RowVector3d expected = Eigen::RowVector3d::Zero();
    switch (refinement.origin(Vertex{r})) {
      case Refinement::Origin::vertex:
        expected = mesh.positions.row(parent);
        break;
      case Refinement::Origin::edge:
        expected = (mesh.positions.row(index(t.tail(Edge{parent}))) + mesh.positions.row(index(t.head(Edge{parent})))) / 2;
        break;
      case Refinement::Origin::face:
        for (const Index v : t.vertices(Face{parent})) expected += mesh.positions.row(v) / double(t.size(Face{parent}));
    }
    // The four corners of the grid are not regular: a smooth boundary rounds them off.
    const bool corner = refinement.origin(Vertex{r}) == Refinement::Origin::vertex &&
                        (parent == 0 || parent == 5 || parent == 24 || parent == 29);
    if (!corner && (x.row(r) - expected).norm() > rounding(16, 10)) return "point " + std::to_string(r) + " is off a linear function";
  }
  return {};
}

std::string extraordinary_vertices_do_not_multiply(const Scheme<double>& scheme) {
  for (const ControlMesh& mesh : meshes_for(scheme)) {
    const std::vector<Level> levels = refine(scheme, mesh, 3);
    const auto extraordinary = [&](const Topology& t) {
      int count = 0;
      const Index regular = takes_quads(scheme) ? 4 : 6;
      for (Index v = 0; v < t.num_vertices(); ++v) {
        const HalfEdge h = t.outgoing(Vertex{v});
        if (!exists(h)) continue;
        count += t.num_faces(Vertex{v}) != (exists(t.twin(h)) ? regular : regular / 2);
      }
      return count;
    };
    for (int k = 2; k <= 3; ++k)
      if (extraordinary(levels[k].topology()) != extraordinary(levels[1].topology()))
        return "level " + std::to_string(k) + " has another number of extraordinary vertices than level 1";
  }
  return {};
}

/// L_k = L_{k+1} S_k on the vertices of level k.
std::string limits_agree_between_levels(const Scheme<double>& scheme) {
  for (const ControlMesh& mesh : meshes_for(scheme)) {
    LimitMaskCache cache(scheme);
    const std::vector<Level> levels = refine(scheme, mesh, 2);
    for (int k = 0; k < 2; ++k) {
      const SparseMatrix coarse = limit_matrices(levels[k], cache).position;
      const SparseMatrix fine = product(limit_matrices(levels[k + 1], cache).position, levels[k + 1].S);
      const Eigen::MatrixXd difference = Eigen::MatrixXd(coarse) - Eigen::MatrixXd(fine).topRows(coarse.rows());
      if (difference.cwiseAbs().maxCoeff() > eigen())
        return "limit masks of levels " + std::to_string(k) + " and " + std::to_string(k + 1) + " differ by " +
               std::to_string(difference.cwiseAbs().maxCoeff());
    }
  }
  return {};
}

/// What smoothness C^r on regular meshes needs: the eigenvalues of polynomials up to degree r, 1, 1/2 twice, 1/4 three times.
std::string regular_spectrum_fits_the_claim(const Scheme<double>& scheme) {
  const int n = takes_quads(scheme) ? 4 : 6;
  const EigenStructure structure =
      eigen_structure(*fourier_blocks(local_step(scheme, smooth_type(scheme, n)).matrix, n));
  std::vector<double> values;
  for (const EigenCluster& cluster : structure.clusters)
    for (int i = 0; i < cluster.multiplicity; ++i) values.push_back(std::abs(cluster.value));
  std::sort(values.rbegin(), values.rend());
  for (int degree = 0, i = 0; degree <= scheme.claims.regular; ++degree)
    for (int m = 0; m <= degree; ++m, ++i)
      if (std::abs(values[i] - std::pow(0.5, degree)) > eigen())
        return "eigenvalue " + std::to_string(i) + " is " + std::to_string(values[i]);
  return {};
}

/// Published values, for the schemes that have them: subdominant eigenvalue and limit mask at several valences (Halstead, Kass,
/// DeRose 1993; Loop 1987; Warren 1995), and (1, 4, 1)/6 along creases.
std::string published_values_hold(const Scheme<double>& scheme) {
  const auto differs = [](double a, double b) { return std::abs(a - b) > 1e-12; };
  for (int n = 3; n <= 12; ++n) {
    const LimitMasks masks = limit_masks(scheme, smooth_type(scheme, n));
    const LimitMasks outline = limit_masks(scheme, boundary_type(scheme, n - 1));
    const double c = std::cos(2 * pi / n), a = 3.0 / 8 + c / 4;
    double centre = 1, lambda = 0.5, crease = 4.0 / 6;
    if (scheme.name == "catmull-clark") {
      centre = n / (n + 5.0);
      lambda = (5 + c + std::sqrt((c + 1) * (c + 9))) / 16;
    } else if (scheme.name.starts_with("loop")) {
      const double beta = scheme.name == "loop" ? 5.0 / 8 - a * a : n == 3 ? 9.0 / 16 : 3.0 / 8;
      centre = 3 / (3 + 8 * beta);
      lambda = a;
    } else if (scheme.name == "bilinear") {
      crease = 1;
    } else {
      return {};
    }
    if (differs(masks.position[0], centre)) return "limit mask of valence " + std::to_string(n);
    if (differs(outline.position[0], crease)) return "limit mask on a boundary";
    if (scheme.name != "bilinear" && differs(masks.sides.at(0).lambda1, lambda))
      return "subdominant eigenvalue of valence " + std::to_string(n);
  }
  if (scheme.name == "catmull-clark" || scheme.name == "bilinear") {
    // The face point is the centroid: a pentagon's first row of weights.
    const Level level = refine(scheme, jittered(prism(5)), 1)[1];
    for (Index r = 0; r < level.S.rows(); ++r) {
      if (level.steps[0].origin(Vertex{r}) != Refinement::Origin::face) continue;
      const Eigen::VectorXd row = level.S.row(r).transpose();
      if (differs(row.maxCoeff(), 1.0 / double(level.S.row(r).nonZeros()))) return "a face point is no centroid";
    }
  }
  return {};
}

}  // namespace

const std::vector<Law>& laws() {
  static const std::vector<Law> all{
      {"RowsSumToOne", rows_sum_to_one},
      {"RelabellingPermutesRows", relabelling_permutes_rows},
      {"SymmetricRingsGiveCirculantBlocks", symmetric_rings_give_circulant_blocks},
      {"OneIsTheSimpleDominantEigenvalue", one_is_the_simple_dominant_eigenvalue},
      {"ClaimsAboutWeightsHold", claims_about_weights_hold},
      {"LinearFunctionsAreReproduced", linear_functions_are_reproduced},
      {"ExtraordinaryVerticesDoNotMultiply", extraordinary_vertices_do_not_multiply},
      {"LimitsAgreeBetweenLevels", limits_agree_between_levels},
      {"RegularSpectrumFitsTheClaim", regular_spectrum_fits_the_claim},
      {"PublishedValuesHold", published_values_hold},
  };
  return all;
}

}  // namespace sublimit::testing
