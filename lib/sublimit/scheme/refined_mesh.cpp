// SPDX-License-Identifier: Apache-2.0
#include "sublimit/scheme/refined_mesh.h"

#include <algorithm>
#include <string>
#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/base/memory.h"
#include "sublimit/base/parallel_for.h"
#include "sublimit/scheme/check_levels.h"
#include "sublimit/scheme/refine_impl.h"

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
};

/// Children of the elements of one kind, which lie one after the other.
template <class MakeElement>
void make_points(tbb::enumerable_thread_specific<RowMaker<double>>& makers, const Points& coarse, Index first,
                 Index count, const MakeElement& element, Points& fine) {
  const Eigen::Index columns = coarse.cols();
  parallel_for_blocks(count, [&](std::int64_t, std::int64_t begin, std::int64_t end) {
    RowMaker<double>& maker = makers.local();
    for (std::int64_t i = begin; i < end; ++i) {
      double* const to = fine.data() + (first + i) * columns;
      if (columns == 3) {
        double x = 0, y = 0, z = 0;
        maker.visit(
            element(static_cast<Index>(i)), [&](Index column, double weight) __attribute__((always_inline)) {
              const double* const p = coarse.data() + 3 * std::ptrdiff_t(column);
              x += weight * p[0], y += weight * p[1], z += weight * p[2];
            });
        to[0] = x, to[1] = y, to[2] = z;
      } else {
        std::fill_n(to, columns, 0.0);
        maker.visit(
            element(static_cast<Index>(i)), [&](Index column, double weight) __attribute__((always_inline)) {
              const double* const p = coarse.data() + columns * std::ptrdiff_t(column);
              for (Eigen::Index c = 0; c < columns; ++c) to[c] += weight * p[c];
            });
      }
    }
  });
}

Points step_points(const StepView& s, const Points& coarse) {
  const std::vector<std::uint8_t> plain = assembly::plain_vertices(s.parent, s.sharpness);
  tbb::enumerable_thread_specific<RowMaker<double>> makers([&] {
    return RowMaker<double>(s.scheme, s.step, s.parent, s.refinement, s.sharpness, s.child_sharpness, s.level, s.knots,
                            plain);
  });
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

Boundary later_boundary(const ControlMesh& control, const SubdivisionOptions& options) {
  const Boundary rule = options.boundary.value_or(control.boundary.value_or(Boundary::edge_and_corner));
  return rule == Boundary::none ? Boundary::edge_only : rule;
}

/// The faces and tags of the level after `before`, from its numbering alone.
ControlMesh simple_mesh(const Level& before, const Refinement& numbering, const ControlMesh& control,
                        const SubdivisionOptions& options) {
  const Topology& t = before.topology();
  ControlMesh mesh;
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

/// What a step needs, for as long as the refiner is there.
struct MeshRefiner::Stage {
  Step<double> step;
  Sharpness sharpness, child_sharpness;
  std::optional<KnotSplit> knots;
  std::shared_ptr<const Level> before, after;  // after: none where `numbers` are all
  size_t position;                             // of the step in its level
  Refinement numbers;

  StepView view(const Scheme<double>& scheme) const {
    return {scheme,
            step,
            position == 0 ? before->topology() : after->steps[position - 1].topology,
            after ? after->steps[position] : numbers,
            sharpness,
            child_sharpness,
            before->number,
            knots ? &*knots : nullptr};
  }
};

namespace {

/// Levels one after the other; the last one's faces and tags come back.
/// @param on_step   called for each step, with what is there then
/// @param on_level  called after the steps of a level: (level before, level after or null)
template <class OnStep, class OnLevel>
ControlMesh refine_steps(const Scheme<double>& scheme, const ControlMesh& mesh, int levels,
                         const SubdivisionOptions& options, const std::function<void(int)>& progress,
                         const OnStep& on_step, const OnLevel& on_level) {
  auto level = std::make_shared<const Level>(control_level(scheme, mesh, options));
  check_levels(scheme, level->topology(), levels, LevelMemory::points);
  for (int k = 1; k <= levels; ++k) {
    if (progress) progress(k);
    if (k == levels && is_simple(scheme, *level)) {
      const Step<double>& step = scheme.steps[0];
      const Refinement numbers = numbering(level->topology(), step.split);
      if (step.masks.wide_edge || step.masks.wide_face)
        check_wide_faces(scheme.name, scheme.corners, level->topology(), level->number);
      const Sharpness none;
      on_step(StepView{scheme, step, level->topology(), numbers, level->sharpness, none, level->number, nullptr});
      on_level(level, nullptr);
      return simple_mesh(*level, numbers, mesh, options);
    }
    auto next = std::make_shared<const Level>(next_topology(
        scheme, *level,
        [&](const Step<double>& step, const Topology& topology, const Refinement& refinement,
            const Sharpness& sharpness, const Sharpness& child_sharpness, const KnotSplit* knots) {
          on_step(StepView{scheme, step, topology, refinement, sharpness, child_sharpness, level->number, knots});
        }));
    on_level(level, next);
    level = std::move(next);
  }
  return level_mesh(*level, {}, mesh, options);
}

}  // namespace

ControlMesh refined_mesh(const Scheme<double>& scheme, const ControlMesh& mesh, int levels,
                         const SubdivisionOptions& options, const std::function<void(int)>& progress) {
  Points points = mesh.positions;
  ControlMesh refined = refine_steps(
      scheme, mesh, levels, options, progress, [&](const StepView& step) { points = step_points(step, points); },
      [](const auto&...) {});
  refined.positions.swap(points);
  return refined;
}

MeshRefiner::MeshRefiner(const Scheme<double>& scheme, const ControlMesh& mesh, int levels,
                         const SubdivisionOptions& options, const std::function<void(int)>& progress)
    : scheme_(std::make_unique<const Scheme<double>>(scheme)), num_control_points_(mesh.num_vertices()) {
  size_t done = 0;  // stages whose levels are known
  mesh_ = refine_steps(
      *scheme_, mesh, levels, options, progress,
      [&](const StepView& s) {
        auto stage = std::make_unique<Stage>();
        stage->step = s.step;
        stage->sharpness = s.sharpness;
        stage->child_sharpness = s.child_sharpness;
        if (s.knots) stage->knots = *s.knots;
        stage->position = stages_.size() - done;
        if (s.refinement.topology.num_vertices() == 0) stage->numbers = s.refinement;
        stages_.push_back(std::move(stage));
      },
      [&](const std::shared_ptr<const Level>& before, const std::shared_ptr<const Level>& after) {
        for (; done < stages_.size(); ++done) stages_[done]->before = before, stages_[done]->after = after;
      });
}

MeshRefiner::~MeshRefiner() = default;
MeshRefiner::MeshRefiner(MeshRefiner&&) noexcept = default;
MeshRefiner& MeshRefiner::operator=(MeshRefiner&&) noexcept = default;

Index MeshRefiner::num_control_points() const { return num_control_points_; }
Index MeshRefiner::num_points() const {
  return stages_.empty() ? num_control_points_ : stages_.back()->view(*scheme_).refinement.num_children();
}

Points MeshRefiner::points(const Points& control) const {
  if (control.rows() != num_control_points_)
    throw InvalidParameter("the mesh has " + std::to_string(num_control_points_) + " vertices, but " +
                           std::to_string(control.rows()) + " points are given");
  Points points = control;
  for (const auto& stage : stages_) points = step_points(stage->view(*scheme_), points);
  return points;
}

RemainingTags remaining_tags(const Level& level, const ControlMesh& control, const SubdivisionOptions& options) {
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

ControlMesh level_mesh(const Level& level, Points points, const ControlMesh& control,
                       const SubdivisionOptions& options) {
  const Topology& t = level.topology();
  ControlMesh mesh;
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
