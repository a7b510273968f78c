// SPDX-License-Identifier: Apache-2.0
#include "sublimit/scheme/refined_mesh.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sublimit/base/detail/huge_pages.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/base/detail/parallel_for.h"
#include "sublimit/base/error.h"
#include "sublimit/mesh/detail/attributes.h"
#include "sublimit/scheme/detail/check_levels.h"
#include "sublimit/scheme/detail/refine_impl.h"

namespace sublimit {
namespace {

using assembly::RowMaker;

/// One step of one level: rows of its S, each used where it is made.
struct StepView {
  const Scheme<double>& scheme;
  const Step<double>& step;
  const Topology& parent;
  const Refinement& refinement;  ///< its numbering; of `parent`
  const Sharpness& sharpness;
  const Sharpness& child_sharpness;
  int level;
  const KnotSplit* knots;

  RowMaker<double> maker(const std::vector<std::uint8_t>& plain) const {
    return {scheme, step, parent, refinement, sharpness, child_sharpness, level, knots, plain};
  }
};

/// What a row is the sum of, by columns of the points, into `to`.
/// @param visit  calls term(column, weight) one after the other
template <class Visit>
[[gnu::always_inline]] inline void add_row(const Points& coarse, double* to, const Visit& visit) {
  const Eigen::Index columns = coarse.cols();
  const double* const from = coarse.data();
  if (columns == 3) {
    double x = 0, y = 0, z = 0;
    visit([&](Index column, double weight) __attribute__((always_inline)) {
      const double* const p = from + 3 * std::ptrdiff_t(column);
      x += weight * p[0], y += weight * p[1], z += weight * p[2];
    });
    to[0] = x, to[1] = y, to[2] = z;
  } else {
    std::fill_n(to, columns, 0.0);
    visit([&](Index column, double weight) {
      const double* const p = from + columns * std::ptrdiff_t(column);
      for (Eigen::Index c = 0; c < columns; ++c) to[c] += weight * p[c];
    });
  }
}

/// Children of the elements of one kind, which lie one after the other.
template <class MakeElement>
void make_points(tbb::enumerable_thread_specific<RowMaker<double>>& makers, const Points& coarse, Index first,
                 Index count, const MakeElement& element, Points& fine) {
  parallel_for_blocks(count, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    RowMaker<double>& maker = makers.local();
    for (std::int64_t i = begin; i < end; ++i)
      add_row(
          coarse, fine.data() + (first + i) * coarse.cols(), [&](const auto& term) __attribute__((always_inline)) {
            maker.visit(element(static_cast<Index>(i)), term);
          });
  });
}

Points step_points(const StepView& s, const Points& coarse) {
  const std::vector<std::uint8_t> plain = assembly::plain_vertices(s.parent, s.sharpness);
  tbb::enumerable_thread_specific<RowMaker<double>> makers([&] { return s.maker(plain); });
  const Refinement& r = s.refinement;
  Points fine(r.num_children(), coarse.cols());
  prefer_huge_pages(fine.data(), size_t(fine.size()) * sizeof(double));
  Index first = 0;
  const auto make = [&](Index count, const auto& element) {
    make_points(makers, coarse, first, count, element, fine);
    first += count;
  };
  const auto in = [](const std::vector<Index>& list, Index i) { return list.empty() ? i : list[i]; };
  make(r.from_vertices, [&](Index i) { return Vertex{in(r.vertex_list, i)}; });
  make(r.from_faces, [&](Index i) { return Face{in(r.face_list, i)}; });
  make(r.from_edges, [&](Index i) { return Edge{in(r.edge_list, i)}; });
  make(r.from_corners, [](Index i) { return HalfEdge{i}; });
  make(r.num_children() - first, [&](Index i) {
    return RowMaker<double>::Border{HalfEdge{r.borders[i / r.border_points]}, i % r.border_points, r.border_points};
  });
  return fine;
}

/// Whether the last level can do without its connectivity: what its edges become is told by their parents alone.
bool is_simple(const Scheme<double>& scheme, const Level& before) {
  return scheme.steps.size() == 1 && is_primal(scheme.steps[0].split) && before.intervals.empty() &&
         before.sharpness.creasing == Creasing::uniform &&
         scheme.steps_at(before.number, before.topology()).size() == 1;
}

std::vector<Index> hole_list(const std::vector<bool>& holes) {
  std::vector<Index> list;
  for (auto at = std::find(holes.begin(), holes.end(), true); at != holes.end();
       at = std::find(at + 1, holes.end(), true))
    list.push_back(static_cast<Index>(at - holes.begin()));
  return list;
}

Boundary later_boundary(const Mesh& control, const SubdivisionOptions& options) {
  const Boundary rule = options.boundary.value_or(control.boundary.value_or(Boundary::edge_and_corner));
  return rule == Boundary::none ? Boundary::edge_only : rule;
}

/// The faces and tags of the level after `before`, from its numbering alone.
Mesh simple_mesh(const Level& before, const Refinement& numbering, const Mesh& control,
                 const SubdivisionOptions& options) {
  const Topology& t = before.topology();
  Mesh mesh;
  mesh.face_vertices = child_corners(t, numbering);
  const Index size = numbering.split == Split::ptq ? 3 : 4;
  mesh.face_sizes.assign(mesh.face_vertices.size() / size_t(size), size);
  const Boundary boundary = later_boundary(control, options);
  mesh.boundary = boundary;
  for (const Index f : hole_list(before.holes)) {
    const Index count = numbering.split == Split::ptq ? 4 : t.size(Face{f});
    const Index first = numbering.split == Split::ptq ? 4 * f : index(t.first(Face{f}));
    for (Index k = 0; k < count; ++k) mesh.holes.push_back(first + k);
  }
  const Sharpness& sharpness = before.sharpness;
  if (std::ranges::none_of(sharpness.edge, is_sharp) && std::ranges::none_of(sharpness.vertex, is_sharp)) return mesh;
  const Sharpness implied = initial_sharpness(t, {}, boundary, sharpness.creasing);
  for (Index i = 0; i < t.num_edges(); ++i) {
    if (!is_sharp(sharpness.edge[i])) continue;
    const Index middle = index(numbering.child(Edge{i}));
    const auto [tail, head] = sharpness_of_halves(sharpness, t, Edge{i});
    if (tail > implied.edge[i]) mesh.creases.push_back({index(t.tail(Edge{i})), middle, tail});
    if (head > implied.edge[i]) mesh.creases.push_back({middle, index(t.head(Edge{i})), head});
  }
  for (Index v = 0; v < t.num_vertices(); ++v) {
    const float s = decayed(sharpness.vertex[v]);
    if (s > implied.vertex[v]) mesh.corners.push_back({v, s});
  }
  return mesh;
}

}  // namespace

/// Rows of one step by their weights: there are few kinds of them, and a row is its kind and its columns.
struct Refiner::Stage {
  std::vector<double> weights;                // kind after kind
  std::vector<std::int64_t> first_weight{0};  // of each kind, and the end
  UninitializedVector<std::uint32_t> kinds;   // of the rows
  UninitializedVector<Index> columns;         // row after row
  std::vector<std::int64_t> first_column;     // of each block of rows, and the end

  explicit Stage(const StepView& step);
  Points points(const Points& coarse) const;
};

Refiner::Stage::Stage(const StepView& s) {
  const std::vector<std::uint8_t> plain = assembly::plain_vertices(s.parent, s.sharpness);
  tbb::enumerable_thread_specific<RowMaker<double>> makers([&] { return s.maker(plain); });
  struct Block {
    std::map<std::vector<double>, std::uint32_t> numbers;
    std::vector<const std::vector<double>*> kinds;  // by number
    std::vector<Index> columns;
  };
  const std::int64_t count = s.refinement.num_children();
  std::vector<Block> blocks(size_t(num_blocks(count)));
  kinds.resize(size_t(count));
  parallel_for_blocks(count, [&](std::int64_t number, std::int64_t begin, std::int64_t end) {
    RowMaker<double>& maker = makers.local();
    Block& block = blocks[size_t(number)];
    std::vector<double> row;
    const std::vector<double>* last = nullptr;
    for (std::int64_t r = begin; r < end; ++r) {
      row.clear();
      assembly::with_parent<double>(s.refinement, Vertex{static_cast<Index>(r)}, [&](auto element) {
        maker.visit(element, [&](Index column, double weight) {
          row.push_back(weight);
          block.columns.push_back(column);
        });
      });
      if (last && *last == row) {  // most are like the one before
        kinds[size_t(r)] = kinds[size_t(r) - 1];
        continue;
      }
      const auto [at, is_new] = block.numbers.try_emplace(row, static_cast<std::uint32_t>(block.kinds.size()));
      if (is_new) block.kinds.push_back(&at->first);
      kinds[size_t(r)] = at->second;
      last = &at->first;
    }
  });
  std::map<std::vector<double>, std::uint32_t> numbers;
  std::vector<std::vector<std::uint32_t>> number_of(blocks.size());  // of the kinds of a block
  first_column.assign(1, 0);
  for (size_t b = 0; b < blocks.size(); ++b) {
    for (const std::vector<double>* kind : blocks[b].kinds) {
      const auto [at, is_new] = numbers.try_emplace(*kind, static_cast<std::uint32_t>(numbers.size()));
      if (is_new) {
        weights.insert(weights.end(), kind->begin(), kind->end());
        first_weight.push_back(std::ssize(weights));
      }
      number_of[b].push_back(at->second);
    }
    first_column.push_back(first_column.back() + std::ssize(blocks[b].columns));
  }
  columns.resize(size_t(first_column.back()));
  parallel_for_blocks(count, [&](std::int64_t number, std::int64_t begin, std::int64_t end) {
    const auto b = size_t(number);
    for (std::int64_t r = begin; r < end; ++r) kinds[size_t(r)] = number_of[b][kinds[size_t(r)]];
    std::ranges::copy(blocks[b].columns, columns.begin() + first_column[b]);
    blocks[b] = {};
  });
}

Points Refiner::Stage::points(const Points& coarse) const {
  Points fine(Eigen::Index(kinds.size()), coarse.cols());
  prefer_huge_pages(fine.data(), size_t(fine.size()) * sizeof(double));
  parallel_for_blocks(fine.rows(), [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
    const Index* column = columns.data() + first_column[size_t(block)];
    for (std::int64_t r = begin; r < end; ++r) {
      const std::uint32_t kind = kinds[size_t(r)];
      const double* weight = weights.data() + first_weight[kind];
      const double* const last = weights.data() + first_weight[kind + 1];
      add_row(
          coarse, fine.data() + r * fine.cols(), [&](const auto& term) __attribute__((always_inline)) {
            for (; weight != last; ++weight, ++column) term(*column, *weight);
          });
    }
  });
  return fine;
}

namespace {

/// Values at vertices that are refined as positions are; no columns if they are not.
Points smooth_values(const Mesh& mesh) {
  return mesh.attributes == Attributes::linear ? Points(mesh.num_vertices(), 0) : vertex_values(mesh);
}

/// What faces have, for the children of a primal split.
std::vector<Index> children_of(const std::vector<Index>& faces, const Topology& parent, Split split) {
  std::vector<Index> children;
  for (Index f = 0; f < parent.num_faces(); ++f)
    children.insert(children.end(), size_t(split == Split::ptq ? 4 : parent.size(Face{f})), faces[size_t(f)]);
  return children;
}

/// Levels one after the other; the last one's faces and tags come back, and what keeps level 0 from being a manifold as
/// warnings.
/// Faces have the names and values of their parents.
/// @param on_step  called for each step, with what is there then
template <class OnStep>
Mesh refine_steps(const Scheme<double>& scheme, const Mesh& mesh, int levels, const SubdivisionOptions& options,
                  const std::function<void(int)>& progress, const OnStep& on_step) {
  Level level = control_level(scheme, mesh, options);
  check_levels(scheme, level.topology(), levels, is_simple(scheme, level) ? LevelMemory::mesh : LevelMemory::points);
  std::vector<std::string> warnings;
  for (const Topology::Fault& fault : level.topology().faults()) warnings.push_back(fault.message);
  std::optional<ControlFaces> faces;  // absent if these carry nothing
  if (has_face_attributes(mesh)) faces.emplace(level.topology().num_faces());
  const auto finished = [&](Mesh refined) {
    refined.scheme = scheme.name;
    refined.warnings = std::move(warnings);
    if (faces) carry_faces(mesh, faces->faces(), refined);
    return refined;
  };
  for (int k = 1; k <= levels; ++k) {
    if (progress) progress(k);
    if (k == levels && is_simple(scheme, level)) {
      const Step<double>& step = scheme.steps[0];
      const Refinement numbers = numbering(level.topology(), step.split);
      if (step.masks.wide_edge || step.masks.wide_face)
        check_wide_faces(scheme.name, scheme.corners, level.topology(), level.number);
      const Sharpness none;
      on_step(StepView{scheme, step, level.topology(), numbers, level.sharpness, none, level.number, nullptr});
      Mesh refined = simple_mesh(level, numbers, mesh, options);
      if (faces) carry_faces(mesh, children_of(faces->faces(), level.topology(), step.split), refined);
      faces.reset();
      return finished(std::move(refined));
    }
    level = next_topology(
        scheme, level,
        [&](const Step<double>& step, const Topology& topology, const Refinement& refinement,
            const Sharpness& sharpness, const Sharpness& child_sharpness, const KnotSplit* knots) {
          on_step(StepView{scheme, step, topology, refinement, sharpness, child_sharpness, level.number, knots});
          if (faces) faces->follow(topology, refinement);
        });
  }
  return finished(level_mesh(level, {}, mesh, options));
}

}  // namespace

Mesh refined_mesh(const Scheme<double>& scheme, const Mesh& mesh, int levels, const SubdivisionOptions& options,
                  const std::function<void(int)>& progress) {
  Points points = mesh.positions, values = smooth_values(mesh);
  Mesh refined = refine_steps(scheme, mesh, levels, options, progress, [&](const StepView& step) {
    points = step_points(step, points);
    if (values.cols() > 0) values = step_points(step, values);
  });
  refined.positions.swap(points);
  set_vertex_values(refined, mesh, values);
  return refined;
}

Refiner::Refiner(const Scheme<double>& scheme, const Mesh& mesh, int levels, const SubdivisionOptions& options,
                 const std::function<void(int)>& progress)
    : num_control_points_(mesh.num_vertices()) {
  mesh_ = refine_steps(scheme, mesh, levels, options, progress,
                       [&](const StepView& step) { stages_.push_back(std::make_unique<const Stage>(step)); });
  if (const Points values = smooth_values(mesh); values.cols() > 0) set_vertex_values(mesh_, mesh, points(values));
}

Refiner::~Refiner() = default;
Refiner::Refiner(Refiner&&) noexcept = default;
Refiner& Refiner::operator=(Refiner&&) noexcept = default;

Index Refiner::num_control_points() const { return num_control_points_; }
Index Refiner::num_points() const {
  return stages_.empty() ? num_control_points_ : static_cast<Index>(stages_.back()->kinds.size());
}

Points Refiner::points(const Points& control) const {
  if (control.rows() != num_control_points_)
    throw InvalidParameter("the mesh has " + std::to_string(num_control_points_) + " vertices, but " +
                           std::to_string(control.rows()) + " points are given");
  Points points = control;
  for (const auto& stage : stages_) points = stage->points(points);
  return points;
}

RemainingTags remaining_tags(const Level& level, const Mesh& control, const SubdivisionOptions& options) {
  const Topology& t = level.topology();
  RemainingTags left;
  left.boundary = later_boundary(control, options);
  const Sharpness implied = initial_sharpness(t, {}, left.boundary, level.sharpness.creasing);
  for (Index e = 0; e < t.num_edges(); ++e)
    if (level.sharpness.edge[e] > implied.edge[e]) left.creases.push_back(Edge{e});
  for (Index v = 0; v < t.num_vertices(); ++v)
    if (level.sharpness.vertex[v] > implied.vertex[v]) left.corners.push_back(Vertex{v});
  return left;
}

Mesh level_mesh(const Level& level, Points points, const Mesh& control, const SubdivisionOptions& options) {
  const Topology& t = level.topology();
  Mesh mesh;
  mesh.positions.swap(points);
  mesh.face_sizes.reserve(size_t(t.num_faces()));
  mesh.face_vertices.reserve(size_t(t.num_half_edges()));
  for (Index f = 0; f < t.num_faces(); ++f) {
    const auto corners = t.vertices(Face{f});
    mesh.face_sizes.push_back(t.size(Face{f}));
    mesh.face_vertices.insert(mesh.face_vertices.end(), corners.begin(), corners.end());
  }
  const RemainingTags left = remaining_tags(level, control, options);
  mesh.boundary = left.boundary;
  if (level.sharpness.creasing == Creasing::chaikin) mesh.creasing = Creasing::chaikin;
  mesh.scheme = level.made_by ? level.made_by->name : control.scheme;
  if (level.number == 0) mesh.triangles = control.triangles;
  mesh.holes = hole_list(level.holes);
  for (const Edge e : left.creases)
    mesh.creases.push_back({index(t.tail(e)), index(t.head(e)), level.sharpness.edge[index(e)]});
  for (Index i = 0; i < t.num_edges() && !level.intervals.empty(); ++i) {
    const Index tail = index(t.tail(Edge{i})), head = index(t.head(Edge{i}));
    const size_t entry = knot_entry(level.intervals.owner, t, t.half_edge(Edge{i}));
    mesh.knot_intervals.push_back({tail, head, level.intervals.length[entry]});
    if (level.intervals.owner == KnotOwner::point)
      mesh.knot_intervals.push_back({head, tail, level.intervals.length[other_end(entry)]});
  }
  for (const Vertex v : left.corners) mesh.corners.push_back({index(v), level.sharpness.vertex[index(v)]});
  return mesh;
}

}  // namespace sublimit
