// SPDX-License-Identifier: Apache-2.0
#include "sublimit/stencils/bake/editable_table.h"

#include <atomic>
#include <string>
#include <utility>

#include "sublimit/base/error.h"
#include "sublimit/stencils/bake/detail/pattern_edits.h"

namespace sublimit {

template <class Real>
struct EditableTable<Real>::Parts {
  std::shared_ptr<Patterns> patterns;  // shared by copies; threads may
  PatternEdits<Real> edits;
};

template <class Real>
EditableTable<Real>::EditableTable(Mesh mesh, const AnyScheme& scheme, const EditableTableOptions& options) {
  auto patterns = std::make_shared<Patterns>(*scheme.for_mesh(mesh));
  PatternEdits<Real> edits(*patterns, std::move(mesh), options.levels, {}, options.limit);
  parts_ = std::make_shared<Parts>(Parts{std::move(patterns), std::move(edits)});
}

template <class Real>
MeshChange EditableTable<Real>::edit(const MeshEdit& edit) {
  if (parts_.use_count() > 1) parts_ = std::make_shared<Parts>(*parts_);
  std::atomic_thread_fence(std::memory_order_acquire);  // what threads did with copies that are gone
  return parts_->edits.edit(edit);
}
template <class Real>
std::int32_t EditableTable<Real>::num_control_points() const {
  return parts_->edits.num_control_points();
}
template <class Real>
std::int64_t EditableTable<Real>::num_points() const {
  return parts_->edits.num_points();
}
template <class Real>
void EditableTable<Real>::apply(std::span<const Real> points, int channels, std::span<Real> result) const {
  parts_->edits.apply(points, channels, result);
}
template <class Real>
Index EditableTable<Real>::num_faces() const {
  return parts_->edits.num_faces();
}
template <class Real>
bool EditableTable<Real>::is_removed(Index face) const {
  if (face < 0 || face >= num_faces()) throw InvalidParameter("face " + std::to_string(face) + " does not exist");
  return parts_->edits.is_removed(face);
}
template <class Real>
const Lattice& EditableTable<Real>::lattice() const {
  return parts_->edits.lattice();
}
template <class Real>
std::int64_t EditableTable<Real>::point(Index face, std::int32_t row) const {
  if (is_removed(face)) throw InvalidParameter("face " + std::to_string(face) + " is removed");
  if (row < 0 || row >= lattice().size())
    throw InvalidParameter("row " + std::to_string(row) + " of a face's lattice, which has " +
                           std::to_string(lattice().size()));
  return parts_->edits.point(face, row);
}
template <class Real>
int EditableTable<Real>::turn(Index face) const {
  if (is_removed(face)) throw InvalidParameter("face " + std::to_string(face) + " is removed");
  return parts_->edits.turn(face);
}
template <class Real>
Mesh EditableTable<Real>::mesh() const {
  return parts_->edits.mesh();
}

template class EditableTable<float>;
template class EditableTable<double>;

}  // namespace sublimit
