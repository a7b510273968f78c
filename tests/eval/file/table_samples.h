// SPDX-License-Identifier: Apache-2.0
#pragma once
// Small hand-made tables, and a comparison of tables.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <string>
#include <vector>

#include "sublimit/eval/file/table_file.h"
#include "sublimit/eval/table/baked_table.h"

namespace sublimit::testing {

/// Returns a table of two adjacent quadrilaterals, (0,1,2,3) and (1,4,5,2), with 3 x 3 points of the bilinear
/// surface on each, and of the isolated vertex 6: 9 + 6 + 1 points from 7 control points.
/// @param quantities  1, or 3 with first derivatives
template <class Real>
BakedTable<Real> two_quads(int quantities = 1) {
  const Lattice lattice{2, false};
  FaceLattices::Arrays l;
  l.lattice = lattice;
  l.side_faces = {0, 0, 0, 0, 1, 1, 1, 0};
  l.side_places = {0, 1, 2, 3, 0, 1, 2, 1 + 8};
  l.corner_faces = {0, 0, 0, 0, 0, 1, 1, 0};
  l.corner_places = {0, 1, 2, 3, 1, 1, 2, 2};
  l.first_points = {0, 9};
  l.addresses = {0, 1};
  l.places = {0, 0};

  typename PatternTable<Real>::Arrays a;
  a.quantities = quantities;
  a.blocks = {{9, 4, 0}};
  std::vector<Real> weights;
  const auto add = [&](std::initializer_list<Real> row) { weights.insert(weights.end(), row); };
  for (int q = 0; q < quantities; ++q)
    lattice.for_each([&](std::int32_t i, std::int32_t j) {
      const Real u = Real(i) / 2, v = Real(j) / 2;
      if (q == 0) add({(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v});
      if (q == 1) add({-(1 - v), 1 - v, v, -v});
      if (q == 2) add({-(1 - u), -u, u, 1 - u});
    });
  a.weights = std::move(weights);
  std::vector<std::int32_t> rows;
  for (std::int32_t face = 0; face < 2; ++face) {
    const std::vector<std::int32_t> own = LatticeRanks::rows(lattice, FaceLattices::share(l, face));
    a.groups.push_back({0, std::int32_t(own.size()), std::int64_t(rows.size()), 1});
    rows.insert(rows.end(), own.begin(), own.end());
  }
  a.rows = std::move(rows);
  a.columns = {0, 1, 2, 3, 1, 4, 5, 2};
  std::vector<Real> rest(size_t(quantities), 0);
  rest[0] = 1;
  std::vector<std::int64_t> offsets;
  for (int q = 0; q <= quantities; ++q) offsets.push_back(q);
  a.rest.emplace(7, offsets, std::vector<std::int32_t>(size_t(quantities), 6), rest);

  BakedTable<Real> baked;
  baked.table = PatternTable<Real>(7, std::move(a));
  baked.lattices.emplace(baked.table.num_points(), std::move(l));
  baked.info = {.scheme = "bilinear",
                .options = {{"boundary", "edge-and-corner"}, {"note", "caf\u00e9 \"quoted\" \\ \n"}},
                .rows = TableRows::level,
                .level = 1,
                .topology_hash = 0x00c0ffee12345678u,
                .tool = "sublimit 0.1.0",
                .statuses = {"regular", "crease"},
                .orders = {1, 0}};
  return baked;
}

/// Returns this table with all optional parts: a first step, places of points, copies, statuses, faces,
/// addresses.
template <class Real>
BakedTable<Real> everything() {
  BakedTable<Real> baked = two_quads<Real>(3);
  typename PatternTable<Real>::Arrays a = baked.table.arrays();
  a.first.emplace(2, std::vector<std::int64_t>{0, 1, 3, 4, 5, 6, 7, 9},
                  std::vector<std::int32_t>{0, 0, 1, 1, 0, 1, 0, 0, 1},
                  std::vector<Real>{1, Real(0.1), Real(0.9), 1, 1, 1, 1, Real(1) / 3, Real(2) / 3});
  a.patch_points = {6, 0};
  a.copies = {3, 15, 4, 14};
  baked.table = PatternTable<Real>(2, std::move(a));
  FaceLattices::Arrays l = baked.lattices->arrays();
  l.first_points = {6, 0};
  l.holes = {0, 1};
  baked.lattices.emplace(16, std::move(l));
  baked.row_status = std::vector<std::uint8_t>{0, 1, 0, 1, 0, 1, 0, 1, 0, 0, 1, 0, 1, 0, 1};
  baked.rest_status = {1};
  baked.faces = {{3, 4}, {0, 1, 2, 15, 14, 13, 12}};
  std::vector<std::int32_t> faces(16, 3);
  std::vector<double> parameters(32);
  for (size_t i = 0; i < 32; ++i) parameters[i] = double(i) / 7;
  baked.addresses = {faces, parameters};
  // Of the first face, which is no hole: four cells.
  baked.channels.interpolation = "corners-plus1";
  baked.channels.list = {
      {.name = "uv",
       .channels = 2,
       .values = {0, 0, 0.1, 1, 1.0 / 3, -2},
       .indices = {0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 2}},
      {.name = "weight", .channels = 1, .values = {-0.0}, .indices = std::vector<std::int32_t>(16, 0)}};
  baked.tags = TableTags{.creases = {6, 7, 7, 15},
                         .crease_sharpness = {0.1f, 10},
                         .corners = {8},
                         .corner_sharpness = {2.5f},
                         .boundary = "edge-only",
                         .creasing = "chaikin"};
  return baked;
}

template <class T>
void expect_equal(const char* name, std::span<const T> a, std::span<const T> b) {
  ASSERT_EQ(a.size(), b.size()) << name;
  const auto bytes_a = std::as_bytes(a), bytes_b = std::as_bytes(b);
  EXPECT_TRUE(std::equal(bytes_a.begin(), bytes_a.end(), bytes_b.begin())) << name;
}
template <class T>
void expect_equal(const char* name, const SharedArray<T>& a, const SharedArray<T>& b) {
  expect_equal(name, a.span(), b.span());
}
template <class Real>
void expect_equal(const char* name, const std::optional<StencilTable<Real>>& a,
                  const std::optional<StencilTable<Real>>& b) {
  ASSERT_EQ(a.has_value(), b.has_value()) << name;
  if (!a) return;
  EXPECT_EQ(a->num_control_points(), b->num_control_points());
  expect_equal(name, a->offsets(), b->offsets());
  expect_equal(name, a->columns(), b->columns());
  expect_equal(name, a->weights(), b->weights());
}

/// Expects that two tables are equal to the bit in all parts.
template <class Real>
void expect_equal(const BakedTable<Real>& x, const BakedTable<Real>& y) {
  const typename PatternTable<Real>::Arrays &a = x.table.arrays(), &b = y.table.arrays();
  EXPECT_EQ(x.table.num_control_points(), y.table.num_control_points());
  EXPECT_EQ(x.table.num_points(), y.table.num_points());
  EXPECT_EQ(a.quantities, b.quantities);
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  for (size_t i = 0; i < a.blocks.size(); ++i) {
    EXPECT_EQ(a.blocks[i].rows, b.blocks[i].rows);
    EXPECT_EQ(a.blocks[i].columns, b.blocks[i].columns);
    EXPECT_EQ(a.blocks[i].weights, b.blocks[i].weights);
  }
  ASSERT_EQ(a.groups.size(), b.groups.size());
  for (size_t i = 0; i < a.groups.size(); ++i) {
    EXPECT_EQ(a.groups[i].block, b.groups[i].block);
    EXPECT_EQ(a.groups[i].num_rows, b.groups[i].num_rows);
    EXPECT_EQ(a.groups[i].rows, b.groups[i].rows);
    EXPECT_EQ(a.groups[i].num_patches, b.groups[i].num_patches);
  }
  expect_equal("weights", a.weights, b.weights);
  expect_equal("rows", a.rows, b.rows);
  expect_equal("columns", a.columns, b.columns);
  expect_equal("patch_points", a.patch_points, b.patch_points);
  expect_equal("copies", a.copies, b.copies);
  expect_equal("first", a.first, b.first);
  expect_equal("rest", a.rest, b.rest);
  ASSERT_EQ(x.lattices.has_value(), y.lattices.has_value());
  if (x.lattices) {
    const FaceLattices::Arrays &l = x.lattices->arrays(), &m = y.lattices->arrays();
    EXPECT_EQ(l.lattice.n, m.lattice.n);
    EXPECT_EQ(l.lattice.triangle, m.lattice.triangle);
    expect_equal("side_faces", l.side_faces, m.side_faces);
    expect_equal("side_places", l.side_places, m.side_places);
    expect_equal("corner_faces", l.corner_faces, m.corner_faces);
    expect_equal("corner_places", l.corner_places, m.corner_places);
    expect_equal("first_points", l.first_points, m.first_points);
    expect_equal("addresses", l.addresses, m.addresses);
    expect_equal("places", l.places, m.places);
    expect_equal("holes", l.holes, m.holes);
  }
  expect_equal("faces.sizes", x.faces.sizes, y.faces.sizes);
  expect_equal("faces.corners", x.faces.corners, y.faces.corners);
  expect_equal("addresses.faces", x.addresses.faces, y.addresses.faces);
  expect_equal("addresses.parameters", x.addresses.parameters, y.addresses.parameters);
  expect_equal("row_status", x.row_status, y.row_status);
  expect_equal("rest_status", x.rest_status, y.rest_status);
  EXPECT_EQ(x.channels.interpolation, y.channels.interpolation);
  ASSERT_EQ(x.channels.list.size(), y.channels.list.size());
  for (size_t c = 0; c < x.channels.list.size(); ++c) {
    EXPECT_EQ(x.channels.list[c].name, y.channels.list[c].name);
    EXPECT_EQ(x.channels.list[c].channels, y.channels.list[c].channels);
    expect_equal("face_varying.values", x.channels.list[c].values, y.channels.list[c].values);
    expect_equal("face_varying.indices", x.channels.list[c].indices, y.channels.list[c].indices);
  }
  ASSERT_EQ(x.tags.has_value(), y.tags.has_value());
  if (x.tags) {
    expect_equal("tags.creases", x.tags->creases, y.tags->creases);
    expect_equal("tags.crease_sharpness", x.tags->crease_sharpness, y.tags->crease_sharpness);
    expect_equal("tags.corners", x.tags->corners, y.tags->corners);
    expect_equal("tags.corner_sharpness", x.tags->corner_sharpness, y.tags->corner_sharpness);
    EXPECT_EQ(x.tags->boundary, y.tags->boundary);
    EXPECT_EQ(x.tags->creasing, y.tags->creasing);
  }
  EXPECT_EQ(x.info.scheme, y.info.scheme);
  EXPECT_EQ(x.info.options, y.info.options);
  EXPECT_EQ(x.info.rows, y.info.rows);
  EXPECT_EQ(x.info.level, y.info.level);
  EXPECT_EQ(x.info.grid, y.info.grid);
  EXPECT_EQ(x.info.triangles, y.info.triangles);
  EXPECT_EQ(x.info.topology_hash, y.info.topology_hash);
  EXPECT_EQ(x.info.tool, y.info.tool);
  EXPECT_EQ(x.info.statuses, y.info.statuses);
  EXPECT_EQ(x.info.orders, y.info.orders);
}

}  // namespace sublimit::testing
