// SPDX-License-Identifier: Apache-2.0
#include "laws/laws.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <random>

#include "laws/local_types.h"
#include "meshes/meshes.h"
#include "sublimit/base/error.h"
#include "sublimit/core/detail/sparse_product.h"
#include "sublimit/limit/detail/eigen_structure.h"
#include "sublimit/limit/detail/limit_points.h"
#include "sublimit/limit/detail/limit_rows.h"
#include "sublimit/neighborhood/local_patch.h"
#include "sublimit/scheme/refine.h"
#include "sublimit/schemes/schemes.h"
#include "support/tolerance.h"
#include "truth/published_values.h"

namespace sublimit::testing {
namespace {

bool takes_quads(const Scheme<double>& scheme) { return scheme.face_size() != 3; }

/// Closed, open, irregular and tagged meshes that the scheme takes.
std::vector<Mesh> meshes_for(const Scheme<double>& scheme) {
  const bool semi_sharp = scheme.sharpening == Sharpening::semi_sharp;
  if (takes_quads(scheme)) {
    Mesh creased = cube();
    if (semi_sharp) {
      creased.creases = {{0, 1, 1.4f}, {1, 3, 0.7f}, {1, 5, 3}};
      creased.corners = {{6, 0.8f}};
    } else if (scheme.sharpening == Sharpening::sharp) {
      creased.creases = {{0, 1, 10}, {1, 3, 10}, {3, 2, 10}, {2, 0, 10},
                         {4, 5, 10}, {5, 7, 10}, {7, 6, 10}, {6, 4, 10}};
    }
    std::vector<Mesh> meshes{
        jittered(torus(4, 5)), grid(3, 4),       creased, jittered(prism(5)), quads_from_triangles(icosahedron()),
        fan(7, 4, 2),          open_fan(3, 4, 2)};
    if (!scheme.preparation.empty()) meshes.push_back(polygon_ring({3, 5, 4}));
    return meshes;
  }
  Mesh creased = octahedron();
  if (semi_sharp) creased.creases = {{0, 2, 1.4f}, {0, 3, 0.7f}};
  if (scheme.sharpening == Sharpening::sharp) creased.creases = {{0, 2, 10}, {2, 1, 10}, {1, 3, 10}, {3, 0, 10}};
  return {jittered(triangle_torus(4, 5)),
          triangle_grid(3, 4),
          creased,
          tetrahedron(),
          icosahedron(),
          fan(7, 3, 2),
          open_fan(4, 3, 2)};
}

std::optional<FourierBlocks> blocks_of(const Scheme<double>& scheme, int n, int rings = -1) {
  const std::optional<LocalPatch<double>> patch = local_patch(scheme, smooth_type(scheme, n), rings);
  return patch ? fourier_blocks(patch->A, patch->orbits) : std::nullopt;
}

std::string rows_sum_to_one(const Scheme<double>& scheme) {
  for (const Mesh& mesh : meshes_for(scheme)) {
    const std::vector<Level> levels = refine(scheme, mesh, 2);
    for (int k = 1; k <= 2; ++k) {
      const Eigen::VectorXd sums = levels[k].S * Eigen::VectorXd::Ones(levels[k].S.cols());
      if ((sums.array() - 1).abs().maxCoeff() > rounding(64)) return "a row sums to " + std::to_string(sums.maxCoeff());
    }
  }
  return {};
}

/// Renumbers vertices, faces and the corners faces start at, and turns every face over.
Mesh relabelled(const Mesh& mesh, std::vector<Index>& new_vertex) {
  std::mt19937 random(7);
  new_vertex.resize(mesh.num_vertices());
  std::iota(new_vertex.begin(), new_vertex.end(), 0);
  std::shuffle(new_vertex.begin(), new_vertex.end(), random);
  std::vector<std::vector<Index>> faces;
  for (Index f = 0, c = 0; f < mesh.num_faces(); c += mesh.face_sizes[f++]) {
    std::vector<Index> face;
    for (Index k = 0; k < mesh.face_sizes[f]; ++k) face.push_back(new_vertex[mesh.face_vertices[c + k]]);
    std::rotate(face.begin(), face.begin() + Index(random() % face.size()), face.end());
    std::reverse(face.begin(), face.end());
    faces.push_back(face);
  }
  std::shuffle(faces.begin(), faces.end(), random);
  Mesh result;
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

/// Rows of S as they are, whatever the numbering and seen from either side: a row is known by its weights and the old
/// vertices they are on.
std::string relabelling_and_mirroring_permute_rows(const Scheme<double>& scheme) {
  using Rows = std::map<std::vector<Index>, std::vector<std::vector<double>>>;  // weights by ascending columns
  for (const Mesh& mesh : meshes_for(scheme)) {
    std::vector<Index> new_vertex;
    const Mesh other = relabelled(mesh, new_vertex);
    const auto rows = [&](const Mesh& m, bool rename) {
      const SparseMatrix S = refine(scheme, m, 1)[1].S;
      Rows result;
      for (Index r = 0; r < S.rows(); ++r) {
        std::vector<std::pair<Index, double>> row;
        for (SparseMatrix::InnerIterator it(S, r); it; ++it)
          row.push_back({rename ? new_vertex[it.col()] : Index(it.col()), it.value()});
        std::sort(row.begin(), row.end());
        std::vector<Index> columns;
        std::vector<double> weights;
        for (const auto& [column, weight] : row) columns.push_back(column), weights.push_back(weight);
        result[columns].push_back(weights);
      }
      return result;
    };
    const auto same = [](const std::vector<double>& a, const std::vector<double>& b) {
      return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                        [](double x, double y) { return std::abs(x - y) <= rounding(64); });
    };
    const Rows here = rows(mesh, true);
    Rows there = rows(other, false);
    for (const auto& [columns, all] : here)
      for (const std::vector<double>& weights : all) {
        std::vector<std::vector<double>>& left = there[columns];
        const auto match =
            std::find_if(left.begin(), left.end(), [&](const std::vector<double>& w) { return same(weights, w); });
        if (match == left.end())
          return "a row over " + std::to_string(columns.size()) + " vertices is another after relabelling";
        left.erase(match);
      }
  }
  return {};
}

std::string symmetric_rings_give_circulant_blocks(const Scheme<double>& scheme) {
  for (int n = 3; n <= 9; ++n) {
    const auto fourier = blocks_of(scheme, n);
    if (!fourier) return "the local matrix of valence " + std::to_string(n) + " does not commute with the rotation";
    // Mirror images: with an eigenvalue, a block has its conjugate.
    for (int k = 0; k < n; ++k) {
      const EigenStructure structure = eigen_structure(fourier->blocks[k], k);
      for (const EigenCluster& cluster : structure.clusters) {
        const auto is_conjugate = [&](const EigenCluster& other) {
          return std::abs(other.value - std::conj(cluster.value)) <= eigen(10);
        };
        if (std::none_of(structure.clusters.begin(), structure.clusters.end(), is_conjugate))
          return "a mirror-symmetric ring has a complex eigenvalue without its conjugate";
      }
    }
  }
  return {};
}

std::string one_is_the_simple_dominant_eigenvalue(const Scheme<double>& scheme) {
  try {
    for (int n = 3; n <= 9; ++n) {
      const auto limit = isolated_limit(scheme, smooth_type(scheme, n));
      if (!limit || std::abs(limit->masks.position.sum() - 1) > eigen())
        return "no limit at valence " + std::to_string(n);
      int borders = 0;
      for (const LocalType& type : border_types(scheme, n - 2)) borders += isolated_limit(scheme, type).has_value();
      if (borders == 0) return "no limit on the border";
    }
  } catch (const AnalysisError& error) {
    return error.what();
  }
  return {};
}

std::string claims_about_weights_hold(const Scheme<double>& scheme) {
  for (const Mesh& mesh : meshes_for(scheme)) {
    const Level level = refine(scheme, mesh, 1)[1];
    if (level.steps.size() > scheme.steps.size()) continue;  // other faces were cut up first
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

/// Polynomials of the claimed degree on a regular mesh: the points of the next level lie, by their linear coordinates,
/// where the scheme puts them; there the polynomial has the values that the scheme makes (for dual schemes and
/// approximating ones degree 1).
std::string claimed_polynomials_are_reproduced(const Scheme<double>& scheme) {
  const Index m = 14;
  Mesh mesh = takes_quads(scheme) ? grid(m, m) : triangle_grid(m, m);
  Points x(mesh.positions.rows(), 2);
  for (Index j = 0; j <= m; ++j)
    for (Index i = 0; i <= m; ++i) x.row(j * (m + 1) + i) << (i - 7.0) / 2, (j - 7.0) / 2;
  const std::vector<Level> levels = refine(scheme, mesh, 1);
  const Points place = apply(levels[1].S, x);
  const auto monomial = [](const Points& at, int p, int q) {
    Points values(at.rows(), 1);
    for (Index r = 0; r < at.rows(); ++r) values(r, 0) = std::pow(at(r, 0), p) * std::pow(at(r, 1), q);
    return values;
  };
  for (int degree = 0; degree <= scheme.claims.reproduces; ++degree)
    for (int p = 0; p <= degree; ++p) {
      const Points values = apply(levels[1].S, monomial(x, p, degree - p)), expected = monomial(place, p, degree - p);
      for (Index r = 0; r < values.rows(); ++r)
        if (place.row(r).cwiseAbs().maxCoeff() < 1.5 && std::abs(values(r, 0) - expected(r, 0)) > rounding(64, 30))
          return "degree " + std::to_string(degree) + " is not reproduced";
    }
  // Uniform steps: the regular mesh refined is a regular mesh.
  const Topology& t = levels[1].topology();
  std::vector<double> lengths;
  for (Index e = 0; e < t.num_edges(); ++e) {
    const auto tail = place.row(index(t.tail(Edge{e}))), head = place.row(index(t.head(Edge{e})));
    if (tail.cwiseAbs().maxCoeff() < 1.5 && head.cwiseAbs().maxCoeff() < 1.5) lengths.push_back((tail - head).norm());
  }
  std::sort(lengths.begin(), lengths.end());
  if (lengths.empty()) return "nothing left of the regular mesh";
  const size_t kinds = 1 + size_t(std::count_if(lengths.begin() + 1, lengths.end(),
                                                [&](const double& l) { return l - *(&l - 1) > rounding(64, 10); }));
  if (kinds > (takes_quads(scheme) ? 1 : 3)) return "a regular mesh is not refined evenly";
  return {};
}

/// Away from corners, an evenly spaced border stays evenly spaced, in the middle of its curve, and reproduces what the
/// surface does.
std::string borders_are_refined_evenly(const Scheme<double>& scheme) {
  const Index m = 14;
  Mesh mesh = takes_quads(scheme) ? grid(m, m) : triangle_grid(m, m);
  Points x(mesh.positions.rows(), 4);
  for (Index j = 0; j <= m; ++j)
    for (Index i = 0; i <= m; ++i) x.row(j * (m + 1) + i) << i - 7.0, j, std::pow(i - 7.0, 2), std::pow(i - 7.0, 3);
  const std::vector<Level> levels = refine(scheme, mesh, scheme.period);
  for (int k = 1; k <= scheme.period; ++k) x = apply(levels[k].S, x);
  const Topology& t = levels.back().topology();
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (Index e = 0; e < t.num_edges(); ++e) {
    const auto tail = x.row(index(t.tail(Edge{e}))), head = x.row(index(t.head(Edge{e})));
    if (!t.is_boundary(Edge{e}) || std::abs(tail[0]) > 3 || std::abs(head[0]) > 3 || tail[1] > 6) continue;
    if (std::abs(tail[1]) > rounding(16) || std::abs(head[1]) > rounding(16)) return "a straight border bends";
    for (int degree = 2; degree <= scheme.claims.reproduces; ++degree)
      if (std::abs(tail[degree] - std::pow(tail[0], degree)) > rounding(64, 7 * 7 * 7))
        return "the border does not reproduce degree " + std::to_string(degree);
    least = std::min(least, head[0] - tail[0]);
    most = std::max(most, head[0] - tail[0]);
  }
  if (most == 0) return "there is no border left";
  return most - least > rounding(64, 10) ? "an even border is refined unevenly" : "";
}

/// Interpolating schemes refine all lines of a regular mesh by one rule for curves, borders and creases among them:
/// what depends on x alone does so for ever. Not sqrt3's splits, which make no points on lines inside.
std::string lines_are_refined_alike(const Scheme<double>& scheme) {
  if (!scheme.claims.interpolates || scheme.steps[0].split == Split::sqrt3) return {};
  const Index m = 10;
  Mesh mesh = takes_quads(scheme) ? grid(m, m) : triangle_grid(m, m);
  if (scheme.sharpening != Sharpening::boundary)
    for (Index i = 0; i < m; ++i) mesh.creases.push_back({5 * (m + 1) + i, 5 * (m + 1) + i + 1, 10});
  Points x(mesh.positions.rows(), 2);
  for (Index r = 0; r < x.rows(); ++r) x.row(r) << r % (m + 1) - 5.0, std::pow(r % (m + 1) - 5.0, 4);
  x = apply(refine(scheme, mesh, 1)[1].S, x);
  for (Index a = 0; a < x.rows(); ++a)
    for (Index b = 0; b < a; ++b)
      if (std::abs(x(a, 0)) < 2 && std::abs(x(a, 0) - x(b, 0)) < 0.1 &&
          std::abs(x(a, 1) - x(b, 1)) > rounding(64, 5 * 5 * 5 * 5))
        return "two lines have " + std::to_string(x(a, 1)) + " and " + std::to_string(x(b, 1)) + " at the same place";
  return {};
}

/// Two patches that share a border polygon meet without a gap: border points are made of border points, at irregular
/// vertices too. Virtual vertices do not do that, and must be seen not to.
std::string borders_depend_on_borders_alone(const Scheme<double>& scheme) {
  const auto on_border = [](const Topology& t, Index v) {
    return exists(t.outgoing(Vertex{v})) && !exists(t.twin(t.outgoing(Vertex{v})));
  };
  std::vector<Mesh> meshes = meshes_for(scheme);
  for (Index faces = 1; faces <= 5; ++faces) meshes.push_back(open_fan(faces, takes_quads(scheme) ? 4 : 3, 2));
  int border_points = 0, with_inside = 0;
  for (const Mesh& mesh : meshes) {
    const std::vector<Level> levels = refine(scheme, mesh, 2);
    for (int k = 1; k <= 2; ++k)
      for (Index r = 0; r < levels[k].S.rows(); ++r) {
        if (!on_border(levels[k].topology(), r)) continue;
        bool inside = false;
        for (SparseMatrix::InnerIterator it(levels[k].S, r); it; ++it)
          inside |= it.value() != 0 && !on_border(levels[k - 1].topology(), Index(it.col()));
        ++border_points;
        with_inside += inside;
      }
  }
  if (border_points == 0) return "there is no border left";
  if (scheme.steps[0].masks.wide_borders) return with_inside > 0 ? "" : "virtual vertices make a border of its own";
  return with_inside == 0 ? "" : std::to_string(with_inside) + " border points depend on points inside";
}

std::string extraordinary_vertices_do_not_multiply(const Scheme<double>& scheme) {
  for (const Mesh& mesh : meshes_for(scheme)) {
    const std::vector<Level> levels = refine(scheme, mesh, 3);
    const bool open = std::any_of(levels[0].sharpness.edge.begin(), levels[0].sharpness.edge.end(), is_sharp);
    if (open && scheme.period > 1) continue;  // borders take turns
    const auto extraordinary = [&](const Topology& t) {
      int count = 0;
      const Index regular = takes_quads(scheme) ? 4 : 6;
      for (Index v = 0; v < t.num_vertices(); ++v) {
        const HalfEdge h = t.outgoing(Vertex{v});
        if (!exists(h)) continue;
        const bool closed = exists(t.twin(h));
        count +=
            closed ? t.num_faces(Vertex{v}) != regular : !scheme.is_dual() && t.num_faces(Vertex{v}) != regular / 2;
      }
      for (Index f = 0; f < t.num_faces(); ++f) count += t.size(Face{f}) != (takes_quads(scheme) ? 4 : 3);
      return count;
    };
    const auto characteristic = [](const Topology& t) { return t.num_vertices() - t.num_edges() + t.num_faces(); };
    for (int k = 1; k <= 3; ++k) {
      if (k > 1 && extraordinary(levels[k].topology()) != extraordinary(levels[1].topology()))
        return "level " + std::to_string(k) + " has another number of extraordinary places than level 1";
      if (characteristic(levels[k].topology()) != characteristic(levels[0].topology()))
        return "level " + std::to_string(k) + " has another Euler characteristic";
    }
  }
  return {};
}

/// L_k = L_{k+1} S_k: the limit of a vertex is that of its child (vertex, face or border edge), and so are the tangent
/// planes.
std::string limits_agree_between_levels(const Scheme<double>& scheme) {
  const auto same_normal = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return (a - b).norm() <= eigen(10);
  };
  LimitCache cache(scheme);
  for (const Mesh& mesh : meshes_for(scheme)) {
    const std::vector<Level> levels = refine(scheme, mesh, 2);
    Points x = mesh.positions;
    for (int k = 0; k < 2; ++k) {
      const Points next = apply(levels[k + 1].S, x);
      const LimitMatrices coarse = limit_matrices(levels[k], cache);
      const LimitPoints here = limit_points(coarse, levels[k].topology(), x);
      std::vector<Centre> children;
      for (Index s = 0; s < std::ssize(coarse.side_vertex); ++s) {
        // The side's first corner: the one whose clockwise neighbour is of another side, or any.
        HalfEdge start = no_half_edge;
        for (const HalfEdge fan : levels[k].topology().fans(Vertex{coarse.side_vertex[s]})) {
          const Topology& t = levels[k].topology();
          HalfEdge h = fan;
          do {
            const bool first = is_cut(t, levels[k].sharpness, h);
            if (coarse.corner_side[index(h)] == s && (first || !exists(start))) start = h;
            h = t.ccw(h);
          } while (exists(h) && h != fan);
        }
        Centre centre{Centre::Kind::vertex, start};
        const Topology* before = &levels[k].topology();
        for (const Refinement& step : levels[k + 1].steps) {
          centre = child(centre, *before, step, k);
          before = &step.topology;
        }
        children.push_back(centre);
      }
      const std::vector<LimitRows> rows = limit_rows(levels[k + 1], cache, children);
      for (size_t s = 0; s < rows.size(); ++s) {
        const auto value = [&](LimitRows::Row row) {
          Eigen::Vector3d sum = Eigen::Vector3d::Zero();
          for (const auto& [c, w] : row) sum += w * next.row(c).transpose();
          return sum;
        };
        if ((value(rows[s].position()) - here.position.row(coarse.side_vertex[s]).transpose()).norm() > eigen(10))
          return "vertex " + std::to_string(coarse.side_vertex[s]) + " has two limits";
        const Eigen::Vector3d normal = value(rows[s].tangent1()).cross(value(rows[s].tangent2())).normalized();
        if (here.status[s] != LimitStatus::undefined_normal && !same_normal(normal, here.normal.row(Index(s))))
          return "vertex " + std::to_string(coarse.side_vertex[s]) + " has two normals";
      }
      x = next;
    }
  }
  return {};
}

/// What smoothness C^r on regular meshes needs: the eigenvalues of polynomials up to degree r, 1, 1/2 twice, 1/4 three
/// times.
std::string regular_spectrum_fits_the_claim(const Scheme<double>& scheme) {
  const int n = takes_quads(scheme) ? 4 : 6;
  const EigenStructure structure = eigen_structure(*blocks_of(scheme, n, scheme.is_dual() ? 1 : -1));
  // Two steps of sqrt(3) shrink by 3, all others by 2 in a period.
  const double shrinks = scheme.steps[0].split == Split::sqrt3 ? 1.0 / 3 : 0.5;
  std::vector<double> values;
  for (const EigenCluster& cluster : structure.clusters)
    for (int i = 0; i < cluster.multiplicity; ++i) values.push_back(std::abs(cluster.value));
  std::sort(values.rbegin(), values.rend());
  for (int degree = 0, i = 0; degree <= scheme.claims.regular; ++degree)
    for (int m = 0; m <= degree; ++m, ++i)
      if (std::abs(values[i] - std::pow(shrinks, degree)) > eigen(10))
        return "eigenvalue " + std::to_string(i) + " is " + std::to_string(values[i]);
  return {};
}

}  // namespace

const std::vector<Law>& laws() {
  static const std::vector<Law> all{
      // The quick ones first: most mutants get no farther.
      {"RowsSumToOne", rows_sum_to_one},
      {"RelabellingAndMirroringPermuteRows", relabelling_and_mirroring_permute_rows},
      {"ClaimsAboutWeightsHold", claims_about_weights_hold},
      {"ClaimedPolynomialsAreReproduced", claimed_polynomials_are_reproduced},
      {"BordersAreRefinedEvenly", borders_are_refined_evenly},
      {"LinesAreRefinedAlike", lines_are_refined_alike},
      {"BordersDependOnBordersAlone", borders_depend_on_borders_alone},
      {"ExtraordinaryVerticesDoNotMultiply", extraordinary_vertices_do_not_multiply},
      {"PublishedValuesHold", published_values_hold},
      {"SymmetricRingsGiveCirculantBlocks", symmetric_rings_give_circulant_blocks},
      {"OneIsTheSimpleDominantEigenvalue", one_is_the_simple_dominant_eigenvalue},
      {"LimitsAgreeBetweenLevels", limits_agree_between_levels},
      {"RegularSpectrumFitsTheClaim", regular_spectrum_fits_the_claim},
  };
  return all;
}

namespace {

/// Faces of the vertex of level 0 that a vertex of level 1 comes from; mid-edge keeps those of borders.
std::optional<Index> faces_before(const std::vector<Level>& levels, Vertex v) {
  if (levels[1].steps.size() > 1) return std::nullopt;
  const Topology& t = levels[0].topology();
  const Refinement& step = levels[1].steps[0];
  if (step.origin(v) == Refinement::Origin::vertex) return t.num_faces(Vertex{step.parent(v)});
  if (step.split == Split::mid_edge && step.origin(v) == Refinement::Origin::border)
    return t.num_faces(t.tail(HalfEdge{step.parent(v)}));
  return std::nullopt;
}

}  // namespace

std::vector<NormalPlace> normal_places(const Scheme<double>& scheme) {
  std::vector<NormalPlace> places;
  LimitCache cache(scheme);
  Index number = 0;
  for (const Mesh& mesh : meshes_for(scheme)) {
    const std::vector<Level> levels = refine(scheme, mesh, 1);
    Points x = mesh.positions;
    for (int k = 0; k < 2; ++k) {
      if (k == 1) x = apply(levels[1].S, x);
      const Topology& t = levels[k].topology();
      const LimitMatrices limit = limit_matrices(levels[k], cache);
      const LimitPoints points = limit_points(limit, t, x);
      std::vector<Index> faces(limit.side_vertex.size(), 0);
      for (const Index side : limit.corner_side) ++faces[size_t(side)];
      for (size_t s = 0; s < faces.size(); ++s) {
        const Vertex v{limit.side_vertex[s]};
        places.push_back({.mesh = number,
                          .level = k,
                          .vertex = index(v),
                          .faces = faces[s],
                          .from_faces = k == 1 ? faces_before(levels, v).value_or(faces[s]) : faces[s],
                          .one_sided = t.is_boundary(v) || faces[s] < t.num_faces(v),
                          .corner = is_corner(t, levels[k].sharpness, v),
                          .defined = points.status[s] != LimitStatus::undefined_normal});
      }
    }
    ++number;
  }
  return places;
}

std::vector<std::pair<std::string, SchemeOptions>> scheme_names_and_options() {
  std::vector<std::pair<std::string, SchemeOptions>> all;
  for (const Scheme<double>& scheme : all_schemes()) all.push_back({scheme.name, {}});
  const std::pair<const char*, SchemeOptions> others[] = {
      {"catmull-clark", {{"triangles", "smooth"}}},
      {"averaging", {{"degree", "2"}}},
      {"averaging", {{"degree", "4"}}},
      {"averaging", {{"degree", "5"}}},
      {"averaging", {{"degree", "6"}}},
      {"averaging", {{"degree", "9"}}},
      {"butterfly", {{"tension", "0"}}},
      {"butterfly", {{"tension", "1/2"}}},
      {"butterfly", {{"boundary-rule", "virtual-vertex"}}},
      {"modified-butterfly", {{"t", "1/64"}}},
      {"modified-butterfly", {{"t", "-1/64"}}},
      {"modified-butterfly", {{"boundary-rule", "virtual-vertex"}}},
      {"kobbelt", {{"tension", "0"}}},
      {"kobbelt", {{"tension", "1/2"}}},
      {"kobbelt", {{"tension", "3/2"}}},
      {"kobbelt", {{"quads", "edges"}}},
  };
  all.insert(all.end(), std::begin(others), std::end(others));
  return all;
}

std::string described(const std::pair<std::string, SchemeOptions>& variant) {
  std::string words = variant.first;
  for (const auto& [option, value] : variant.second) words += " --option " + option + "=" + value;
  return words;
}

}  // namespace sublimit::testing
