// SPDX-License-Identifier: Apache-2.0
// A program of many processes by distributed.h alone, under mpirun: its tables have the points, the faces and the
// transpose of the table that one process bakes, and what is wrong on one rank is an error of all.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <initializer_list>
#include <limits>
#include <numeric>
#include <string>
#include <type_traits>
#include <utility>

#include "sublimit/distributed/distributed.h"
#include "sublimit/sublimit.h"

namespace {

using namespace sublimit;

constexpr double rounding = 1e-13;  // sums of some tens of products of numbers of order 1

// What refers to ranks takes no temporary ones.
template <class R>
constexpr bool can_bake = requires(R&& ranks) {
  bake(std::forward<R>(ranks), MeshRun{}, AnyScheme("loop"), DistributedBakeOptions{});
};
template <class R>
constexpr bool can_load = requires(R&& ranks) {
  load(std::forward<R>(ranks), std::filesystem::path(), 1);
};
static_assert(can_bake<const Ranks&> && !can_bake<Ranks> && can_load<const Ranks&> && !can_load<Ranks>);

void require(bool condition, const std::string& what) {
  if (!condition) throw AnalysisError(what);
}

double noise(std::int64_t number) {
  const double x = std::sin(double(number + 1) * 12.9898) * 43758.5453;
  return x - std::floor(x) - 0.5;
}

std::span<const double> numbers_of(const Points& points) { return {points.data(), size_t(points.size())}; }

/// Rows of three numbers on the first rank, each at its number in the whole.
/// @throws AnalysisError  on all ranks: a row is missing or there twice
Points gathered(const Ranks& ranks, const std::vector<std::int64_t>& numbers, std::span<const double> values,
                std::int64_t count) {
  struct Row {
    std::int64_t number;
    double x[3];
  };
  std::vector<std::vector<Row>> to(size_t(ranks.size()));
  for (size_t i = 0; i < numbers.size(); ++i)
    to[0].push_back({numbers[i], {values[3 * i], values[3 * i + 1], values[3 * i + 2]}});
  const auto from = exchange(ranks, std::move(to));
  Points all(ranks.is_first() ? count : 0, 3);
  ranks.together([&] {
    std::vector<char> is_there(size_t(all.rows()), false);
    for (const auto& rows : from)
      for (const Row& row : rows) {
        require(row.number >= 0 && row.number < count && !is_there[size_t(row.number)], "a number of a point is wrong");
        is_there[size_t(row.number)] = true;
        all.row(row.number) << row.x[0], row.x[1], row.x[2];
      }
    require(std::ranges::count(is_there, false) == 0, "a point is of no rank");
  });
  return all;
}

/// Faces of all ranks on the first one.
FaceList gathered(const Ranks& ranks, const FaceList& faces) {
  std::vector<std::int32_t> all[2];
  const SharedArray<std::int32_t>* const own[2] = {&faces.sizes, &faces.corners};
  for (int i = 0; i < 2; ++i) {
    std::vector<std::vector<std::int32_t>> to(size_t(ranks.size()));
    to[0].assign(own[i]->begin(), own[i]->end());
    for (const auto& from : exchange(ranks, std::move(to))) all[i].insert(all[i].end(), from.begin(), from.end());
  }
  return {all[0], all[1]};
}

/// Faces as lists of corners that begin with the least one, sorted.
std::vector<std::vector<Index>> sorted_faces(const FaceList& faces, const std::function<Index(Index)>& renumbered) {
  std::vector<std::vector<Index>> all;
  const Index* corner = faces.corners.begin();
  for (const Index size : faces.sizes) {
    std::vector<Index> face;
    for (Index k = 0; k < size; ++k) face.push_back(renumbered(*corner++));
    std::ranges::rotate(face, std::ranges::min_element(face));
    all.push_back(std::move(face));
  }
  std::ranges::sort(all);
  return all;
}

/// The nearest of some points for each of others: one each, within rounding.
std::vector<Index> matched(const Points& points, const Points& others) {
  require(points.rows() == others.rows(), "the number of points differs from that of one process");
  std::vector<Index> match;
  std::vector<char> is_taken(size_t(points.rows()), false);
  for (Eigen::Index i = 0; i < others.rows(); ++i) {
    Eigen::Index nearest = 0;
    const double distance = (points.rowwise() - others.row(i)).rowwise().norm().minCoeff(&nearest);
    require(distance < rounding && !is_taken[size_t(nearest)], "a point differs from those of one process");
    is_taken[size_t(nearest)] = true;
    match.push_back(Index(nearest));
  }
  return match;
}

/// Numbers of this rank's control points.
std::vector<std::int64_t> own_numbers(const DistributedTable& table) {
  std::vector<std::int64_t> numbers(size_t(table.num_control_points()));
  std::iota(numbers.begin(), numbers.end(), table.first_control_point());
  return numbers;
}

/// Points by number, on the first rank, of a table applied to this rank's part of the mesh.
Points points_of(const Ranks& ranks, const DistributedTable& table, const MeshRun& mesh) {
  std::vector<double> points(table.num_results(3));
  table.apply(numbers_of(mesh.positions), 3, points);
  // A channel at a time the bits are the same.
  std::vector<double> x(size_t(table.num_control_points())), fx(table.num_results(1));
  for (size_t v = 0; v < x.size(); ++v) x[v] = mesh.positions(Eigen::Index(v), 1);
  table.apply(x, 1, fx);
  ranks.together([&] {
    for (size_t p = 0; p < fx.size(); ++p) require(fx[p] == points[3 * p + 1], "channels depend on each other");
  });
  return gathered(ranks, table.point_numbers(), points, table.all_points());
}

/// The same mesh as ranks may have it.
std::vector<MeshRun> runs_of(const Ranks& ranks, const std::filesystem::path& path, const Mesh& whole) {
  std::vector<MeshRun> runs{read_mesh_run(ranks, path), mesh_run(whole, ranks.rank(), ranks.size()),
                            ranks.is_first() ? mesh_run(whole) : MeshRun{}};
  MeshRun apart;  // vertices on the last rank, and tags that count
  const MeshRun all = mesh_run(whole);
  if (ranks.is_first()) {
    apart = all;
    apart.positions.resize(0, 0);
    apart.holes.clear();
    for (MeshRun::Crease& crease : apart.creases) crease.sharpness += 1;
    for (MeshRun::Corner& corner : apart.corners) corner.sharpness += 1;
  }
  if (ranks.rank() + 1 == ranks.size()) {
    apart.positions = all.positions;
    apart.creases.insert(apart.creases.end(), all.creases.begin(), all.creases.end());
    apart.corners.insert(apart.corners.end(), all.corners.begin(), all.corners.end());
    apart.holes = all.holes;
    if (!ranks.is_first()) apart.boundary = Boundary::none;  // of no effect
  }
  runs.push_back(std::move(apart));
  return runs;
}

/// Compares tables of a mesh, however ranks have it and however it is divided, with the one that one process bakes.
/// @return  points by number, on the first rank
Points check_tables(const Ranks& ranks, const std::filesystem::path& path, const std::string& scheme, int levels,
                    bool limit) {
  const Mesh whole = read_mesh(path);
  const Table one = bake(whole, scheme, {.levels = levels, .limit = limit, .in_double = true});
  Points expected(one.num_points(), 3);
  one.apply(numbers_of(whole.positions), 3, {expected.data(), size_t(expected.size())});
  Points first;
  std::vector<Index> match;  // the number of each point of `one`
  const std::vector<MeshRun> runs = runs_of(ranks, path, whole);
  for (size_t i = 0; i < runs.size(); ++i) {
    const MeshRun& run = runs[i];
    const Partition partition = i % 2 == 1 ? Partition::as_given : Partition::few_neighbours;
    const DistributedTable table =
        bake(ranks, run, scheme, {.levels = levels, .limit = limit, .partition = partition, .faces = true});
    const std::vector<std::int64_t> numbers = table.point_numbers();
    const std::int64_t before = ranks.sum_before(table.num_points()), all = ranks.sum(table.num_points()),
                       remote = ranks.sum(table.num_remote_control_points());
    ranks.together([&] {
      require(table.num_control_points() == run.positions.rows() &&
                  table.all_control_points() == whole.num_vertices() && table.all_points() == all &&
                  std::ssize(numbers) == table.num_points() && table.num_results(3) == 3 * numbers.size() &&
                  table.num_results(-1) == 0,
              "counts are wrong");
      require(std::ranges::is_sorted(numbers), "numbers do not ascend");
      require(partition == Partition::few_neighbours || numbers.empty() ||
                  (numbers.front() == before && numbers.back() + 1 == before + table.num_points()),
              "points of given faces do not follow each other");
      require(ranks.size() > 1 || remote == 0, "one rank has all");
    });
    const Points points = points_of(ranks, table, run);
    const FaceList faces = gathered(ranks, table.faces());
    std::vector<double> values, back(size_t(3 * table.num_control_points()), 7);
    for (const std::int64_t p : numbers)
      for (int c = 0; c < 3; ++c) values.push_back(noise(3 * p + c));
    table.apply_transpose(values, 3, back);
    const Points gradient = gathered(ranks, own_numbers(table), back, table.all_control_points());
    ranks.together([&] {
      if (!ranks.is_first()) return;
      if (first.rows() == 0) first = points, match = matched(points, expected);
      require(points == first, "bits depend on how the mesh is divided");
      require(sorted_faces(faces, [](Index p) { return p; }) ==
                  sorted_faces(one.faces(), [&](Index p) { return match[size_t(p)]; }),
              "faces differ from those of one process");
      Points of_one(one.num_points(), 3), expected_gradient(whole.num_vertices(), 3);
      for (Eigen::Index p = 0; p < of_one.rows(); ++p)
        for (int c = 0; c < 3; ++c) of_one(p, c) = noise(3 * match[size_t(p)] + c);
      one.apply_transpose(numbers_of(of_one), 3, {expected_gradient.data(), size_t(expected_gradient.size())});
      const double most = expected_gradient.cwiseAbs().maxCoeff();
      require((gradient - expected_gradient).cwiseAbs().maxCoeff() < rounding * std::max(most, 1.0),
              "the transpose differs from that of one process");
    });
  }
  const MeshRun run = mesh_run(whole, ranks.rank(), ranks.size());
  const DistributedTable plain = bake(ranks, run, scheme, {.levels = levels, .limit = limit});
  const Points again = points_of(ranks, plain, run);
  ranks.together([&] {
    require(plain.faces().sizes.empty(), "faces that were not asked for");
    require(again == first, "bits depend on whether faces are asked for");
  });
  return first;
}

/// Expects an error on all ranks, the same one, whose message has all of these parts.
void expect(const Ranks& ranks, ErrorCode code, std::initializer_list<const char*> parts,
            const std::function<void()>& action) {
  std::string wrong = "nothing is thrown where an error should say";
  for (const char* part : parts) wrong += std::string(" '") + part + "'";
  std::string message;
  try {
    action();
  } catch (const Error& error) {
    message = error.what();
    const auto has = [&](const char* part) { return message.find(part) != std::string::npos; };
    if (error.code() == code && std::ranges::all_of(parts, has)) wrong.clear();
    if (!wrong.empty()) wrong = "another error than expected: " + message;
  }
  ranks.together([&] { require(wrong.empty(), wrong); });
  check_alike(ranks, message, "a message");
}

void check_errors(const Ranks& ranks, const std::filesystem::path& path, const std::filesystem::path& shards) {
  const Mesh whole = read_mesh(path);
  const MeshRun right = mesh_run(whole, ranks.rank(), ranks.size());
  const bool last = ranks.rank() + 1 == ranks.size(), several = ranks.size() > 1;
  const std::string of_last = "mesh: rank " + std::to_string(ranks.size() - 1);
  const auto baked = [&](const MeshRun& mesh, const AnyScheme& scheme, const DistributedBakeOptions& options) {
    return [&ranks, mesh, scheme, options] { (void)bake(ranks, mesh, scheme, options); };
  };
  using enum ErrorCode;

  // Options.
  expect(ranks, invalid_parameter, {"level -1", "1 to 11"}, baked(right, "catmull-clark", {.levels = -1}));
  expect(ranks, invalid_parameter, {"level 0", "1 to 11"}, baked(right, "catmull-clark", {.levels = 0}));
  expect(ranks, invalid_parameter, {"level 12"}, baked(right, "catmull-clark", {.levels = 12}));
  expect(ranks, invalid_parameter, {"level -1"}, baked(right, "catmull-clark", {.levels = -1, .limit = true}));
  expect(ranks, invalid_parameter, {"doo-sabin", "dual"}, baked(right, "doo-sabin", {.levels = 2}));
  expect(ranks, unsupported_topology, {"loop is for triangles"}, baked(right, "loop", {.levels = 2}));
  if (several) {
    expect(ranks, invalid_option, {"scheme or options", "level 1", "level 2"},
           baked(right, "catmull-clark", {.levels = last ? 2 : 1}));
    expect(ranks, invalid_option, {"scheme or options", "loop"}, baked(right, last ? "loop" : "catmull-clark", {}));
    expect(ranks, invalid_option, {"scheme or options"},
           baked(right, "catmull-clark", {.partition = last ? Partition::as_given : Partition::few_neighbours}));
    expect(ranks, invalid_option, {"scheme or options"}, baked(right, "catmull-clark", {.faces = last}));
  }

  // The last rank's part of the mesh is broken.
  const auto broken = [&](ErrorCode code, std::initializer_list<const char*> parts,
                          const std::function<void(MeshRun&)>& breaking, const char* scheme = "catmull-clark") {
    MeshRun mesh = right;
    if (last) breaking(mesh);
    expect(ranks, code, parts, baked(mesh, scheme, {.levels = 2}));
  };
  const std::string last_face = "face " + std::to_string(whole.num_faces() - 1),
                    last_vertex = "vertex " + std::to_string(whole.num_vertices() - 1),
                    faces = std::to_string(whole.num_faces());
  broken(invalid_mesh, {("vertex of " + last_face).c_str(), "1000000 is out of range"},
         [](MeshRun& mesh) { mesh.face_vertices.back() = 1000000; });
  broken(invalid_mesh, {("vertex of " + last_face).c_str(), "-1 is out of range"},
         [](MeshRun& mesh) { mesh.face_vertices.back() = -1; });
  broken(invalid_mesh, {of_last.c_str(), last_face.c_str(), "has 2 corners", "at least 3"},
         [](MeshRun& mesh) { mesh.face_sizes.back() = 2; });
  broken(invalid_mesh, {of_last.c_str(), "face sizes add up to"},
         [](MeshRun& mesh) { mesh.face_vertices.push_back(0); });
  broken(invalid_mesh, {of_last.c_str(), last_vertex.c_str(), "not finite"}, [](MeshRun& mesh) {
    mesh.positions(mesh.positions.rows() - 1, 2) = std::numeric_limits<double>::quiet_NaN();
  });
  broken(invalid_mesh, {of_last.c_str(), "2 columns"},
         [](MeshRun& mesh) { mesh.positions = Points(mesh.positions.leftCols(2)); });
  broken(invalid_mesh, {"crease from vertex 0 to 1000", "out of range"}, [](MeshRun& mesh) {
    mesh.creases = {{0, 1000, 1}};
    mesh.name = "crease from vertex 0 to 1000";
  });
  broken(invalid_mesh, {"crease from vertex 0 to 0", "no face has such an edge"}, [](MeshRun& mesh) {
    mesh.creases = {{0, 0, 1}};
  });
  broken(invalid_mesh, {of_last.c_str(), "crease from vertex 0 to 1 has sharpness -1"}, [](MeshRun& mesh) {
    mesh.creases = {{0, 1, -1}};
  });
  broken(invalid_mesh, {of_last.c_str(), "corner at vertex 2 has sharpness nan"}, [](MeshRun& mesh) {
    mesh.corners = {{2, std::numeric_limits<float>::quiet_NaN()}};
  });
  broken(invalid_mesh, {"hole: face", (faces + " is out of range").c_str()},
         [&](MeshRun& mesh) { mesh.holes = {whole.num_faces()}; });
  expect(ranks, invalid_mesh, {"no vertices"}, baked(MeshRun{}, "catmull-clark", {}));
  MeshRun points_alone = right;
  points_alone.face_sizes.clear(), points_alone.face_vertices.clear();
  expect(ranks, invalid_mesh, {"no faces"}, baked(points_alone, "catmull-clark", {}));
  // Found in a part while it is baked: a rule that the scheme lacks.
  Mesh tetrahedron = make_mesh(std::vector<std::array<double, 3>>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                               std::vector<std::array<int, 3>>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  tetrahedron.creases = {{0, 1, 1.5F}};
  expect(ranks, unsupported_topology, {"mesh: part ", "its own numbers", "infinite sharpness"},
         baked(mesh_run(tetrahedron, ranks.rank(), ranks.size()), "butterfly", {}));

  // Arrays that one rank has wrong, and afterwards all go on.
  const DistributedTable table = bake(ranks, right, "catmull-clark", {.levels = 1});
  const size_t own = size_t(right.positions.size()), made = table.num_results(3);
  std::vector<double> points(made + 1), gradient(own + 1);
  const Points before = points_of(ranks, table, right);
  const auto applied = [&](size_t more, size_t more_points, int channels) {
    const std::string rank = "rank " + std::to_string(ranks.size() - 1) + ": ";
    const std::span<const double> x = numbers_of(right.positions).subspan(last ? more : 0);
    const std::span<double> to = std::span(points).first(made + (last ? more_points : 0));
    const std::span<double> from = std::span(gradient).first(own - (last ? more : 0));
    expect(ranks, invalid_parameter, {rank.c_str(), "are right"}, [&] { table.apply(x, last ? channels : 3, to); });
    expect(ranks, invalid_parameter, {rank.c_str(), "are right"},
           [&] { table.apply_transpose(to, last ? channels : 3, from); });
  };
  applied(1, 0, 3), applied(0, 1, 3), applied(0, 0, 0), applied(0, 0, -3), applied(0, 0, 2);
  if (several)
    expect(ranks, invalid_parameter, {"1 to 3 channels"}, [&] {
      const int channels = last ? 1 : 3;
      table.apply(numbers_of(right.positions).first(own / 3 * size_t(channels)), channels,
                  std::span(points).first(table.num_results(channels)));
    });
  const Points after = points_of(ranks, table, right);
  ranks.together([&] { require(before == after, "an error has changed a table"); });

  // Shards.
  expect(ranks, io_error, {"shards.json", "missing"}, [&] { (void)load(ranks, path.parent_path(), 0); });
  expect(ranks, invalid_parameter, {"control points", "is of a mesh of"},
         [&] { (void)load(ranks, shards, right.positions.rows() + last); });
  expect(ranks, invalid_parameter, {"-1 control points"},
         [&] { (void)load(ranks, shards, last ? -1 : right.positions.rows()); });
  expect(ranks, io_error, {"nowhere.obj"}, [&] { (void)read_mesh_run(ranks, "nowhere.obj"); });

  // Runs of a whole mesh.
  for (const auto& [rank, size] : {std::pair(2, 2), {-1, 2}, {0, 0}})
    expect(ranks, invalid_parameter, {"run ", "are right"}, [&] { (void)mesh_run(whole, rank, size); });
  Mesh odd = whole;
  odd.face_vertices.pop_back();
  expect(ranks, invalid_mesh, {"face sizes add up to"}, [&] { (void)mesh_run(odd); });
  odd = whole;
  odd.knot_intervals = {{0, 1, 2}};
  expect(ranks, invalid_mesh, {"knot intervals"}, [&] { (void)mesh_run(odd); });
}

}  // namespace

/// points MESH SCHEME LEVELS level|limit SHARDS OUT: checks tables, and one of SHARDS, which are of the same; OUT gets
/// the points as bytes.
/// errors MESH SHARDS
/// fails: ends with an error of all ranks; dies: with one of the last rank.
int main(int argc, char** argv) {
  const Ranks ranks(argc, argv);
  return ranks.run([&] {
    const std::string verb = argv[1];
    if (verb == "fails") (void)bake(ranks, MeshRun{}, "catmull-clark", {.levels = -1});
    if (verb == "dies" && ranks.rank() + 1 == ranks.size()) throw std::runtime_error("no reason");
    if (verb == "errors") check_errors(ranks, argv[2], argv[3]);
    if (verb != "points") return;
    const Points points = check_tables(ranks, argv[2], argv[3], std::atoi(argv[4]), argv[5] == std::string("limit"));
    const MeshRun run = read_mesh_run(ranks, argv[2]);
    const Points loaded = points_of(ranks, load(ranks, argv[6], run.positions.rows()), run);
    ranks.together([&] {
      require(loaded == points, "a table of shards has other points");
      if (!ranks.is_first()) return;
      const std::span<const double> numbers = numbers_of(points);
      std::ofstream(argv[7], std::ios::binary)
          .write(reinterpret_cast<const char*>(numbers.data()), std::streamsize(numbers.size_bytes()));
    });
  });
}
