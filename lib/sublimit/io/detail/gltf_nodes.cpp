// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/gltf_nodes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "sublimit/base/detail/format_number.h"

namespace sublimit {
namespace {

Eigen::Matrix4d transform_of(const GltfObject& node) {
  Eigen::Matrix4d transform = Eigen::Matrix4d::Identity();
  if (const std::vector<double> matrix = node.numbers("matrix", 16); !matrix.empty()) {
    transform = Eigen::Map<const Eigen::Matrix4d>(matrix.data());  // by columns, as the file has them
    if (transform(3, 0) != 0 || transform(3, 1) != 0 || transform(3, 2) != 0 || transform(3, 3) != 1)
      node.fail("matrix", "its last row should be 0 0 0 1: it is a map of space");
    return transform;
  }
  if (const std::vector<double> q = node.numbers("rotation", 4); !q.empty()) {
    const Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
    if (!(rotation.norm() > 0)) node.fail("rotation", "a quaternion should not be 0");
    transform.topLeftCorner<3, 3>() = rotation.normalized().toRotationMatrix();
  }
  if (const std::vector<double> scale = node.numbers("scale", 3); !scale.empty())
    for (Eigen::Index i = 0; i < 3; ++i) transform.col(i) *= scale[static_cast<std::size_t>(i)];
  if (const std::vector<double> move = node.numbers("translation", 3); !move.empty())
    for (Eigen::Index i = 0; i < 3; ++i) transform(i, 3) = move[static_cast<std::size_t>(i)];
  return transform;
}

/// A walk over the trees of nodes.
class SceneWalk {
 public:
  explicit SceneWalk(const GltfFile& file)
      : root_(file.root()), num_nodes_(root_.size("nodes")), visited_(static_cast<std::size_t>(num_nodes_), false) {}

  std::vector<GltfInstance> walk(std::vector<std::string>& notes) {
    const std::int64_t scenes = root_.size("scenes"), scene = root_.index("scene", scenes, "scenes");
    std::vector<std::int64_t> roots;
    if (scenes > 0) {
      roots = children_of(root_.element("scenes", std::max<std::int64_t>(scene, 0)), "nodes");
    } else if (num_nodes_ > 0) {
      roots = nodes_without_parent();
    } else {
      for (std::int64_t mesh = 0; mesh < root_.size("meshes"); ++mesh) instances_.push_back({.node = -1, .mesh = mesh});
    }
    for (const std::int64_t root : roots) walk_tree(root);
    note_others(notes);
    return std::move(instances_);
  }

 private:
  std::vector<std::int64_t> children_of(const GltfObject& parent, const char* key) const {
    return parent.indices(key, num_nodes_, "nodes");
  }

  std::vector<std::int64_t> nodes_without_parent() const {
    std::vector<bool> is_child(static_cast<std::size_t>(num_nodes_), false);
    for (std::int64_t node = 0; node < num_nodes_; ++node)
      for (const std::int64_t child : children_of(root_.element("nodes", node), "children"))
        is_child[static_cast<std::size_t>(child)] = true;
    std::vector<std::int64_t> roots;
    for (std::int64_t node = 0; node < num_nodes_; ++node)
      if (!is_child[static_cast<std::size_t>(node)]) roots.push_back(node);
    return roots;
  }

  void walk_tree(std::int64_t root) {
    struct Visit {
      std::int64_t node;
      Eigen::Matrix4d parent;
    };
    std::vector<Visit> waiting{{root, Eigen::Matrix4d::Identity()}};
    while (!waiting.empty()) {
      const Visit visit = waiting.back();
      waiting.pop_back();
      const GltfObject node = root_.element("nodes", visit.node);
      if (visited_[static_cast<std::size_t>(visit.node)])
        node.fail("it has two parents, or is below itself; nodes should form trees");
      visited_[static_cast<std::size_t>(visit.node)] = true;
      const Eigen::Matrix4d transform = visit.parent * transform_of(node);
      const std::int64_t mesh = node.index("mesh", root_.size("meshes"), "meshes");
      // A mesh with a skin is where its joints put it, and in the pose in which it was bound where it is in the file.
      if (mesh >= 0)
        instances_.push_back(
            {visit.node, mesh, node.has("skin") ? Eigen::Matrix4d(Eigen::Matrix4d::Identity()) : transform});
      std::vector<std::int64_t> children = children_of(node, "children");
      std::ranges::reverse(children);
      for (const std::int64_t child : children) waiting.push_back({child, transform});
    }
  }

  void note_others(std::vector<std::string>& notes) const {
    std::int64_t others = 0, first = -1;
    for (std::int64_t node = 0; node < num_nodes_; ++node)
      if (!visited_[static_cast<std::size_t>(node)] && root_.element("nodes", node).has("mesh") && others++ == 0)
        first = node;
    if (others > 0)
      notes.push_back(root_.place() + format_number(others) +
                      " nodes with meshes are in other scenes and left out; the first is " +
                      root_.element("nodes", first).in_words());
  }

  const GltfObject& root_;
  std::int64_t num_nodes_;
  std::vector<bool> visited_;
  std::vector<GltfInstance> instances_;
};

}  // namespace

std::vector<GltfInstance> gltf_instances(const GltfFile& file, std::vector<std::string>& notes) {
  return SceneWalk(file).walk(notes);
}

}  // namespace sublimit
