// SPDX-License-Identifier: Apache-2.0
// `sublimit implicit`.
#include <gtest/gtest.h>

#include "stencils/cli_program.h"
#include "sublimit/io/read_mesh.h"

namespace sublimit::testing {
namespace {

constexpr const char* sphere = R"({"kind": "implicit", "field": "sphere", "center": [0, 0, 0], "radius": 1})";

TEST(CliImplicit, FieldsAtPlaces) {
  const TemporaryDirectory directory;
  const std::string in = directory.write("f.json", sphere).string(),
                    at = directory.write("at.csv", "x,y,z\n1,0,0\n0,0,0\n").string(),
                    out = (directory / "o.csv").string();
  expect_done(sublimit({"implicit", in, "--at", at, "-o", out}));
  EXPECT_EQ(read_file(out),
            "x,y,z,value,gx,gy,gz,hxx,hxy,hxz,hyy,hyz,hzz,nx,ny,nz,gauss,mean\n"
            "1,0,0,0,2,0,0,2,0,0,2,0,2,1,0,0,1,-1\n"
            "0,0,0,-1,0,0,0,2,0,0,2,0,2,,,,,\n");  // no normal where the gradient is 0
}

TEST(CliImplicit, WhatTiesHasNoDerivatives) {
  const TemporaryDirectory directory;
  const std::string in = directory.write("f.json", R"({"field": "box", "center": [0, 0, 0], "half": [1, 1, 1]})")
                             .string(),
                    at = directory.write("at.csv", "x,y,z\n1,1,0\n1,0,0\n").string(),
                    out = (directory / "o.csv").string();
  expect_done(sublimit({"implicit", in, "--at", at, "-o", out, "--quiet"}));
  expect_parts(read_file(out), {"\n1,1,0,0,,,,,,,,,,,,,,\n", "\n1,0,0,0,1,0,0,0,0,0,0,0,0,1,0,0,0,0\n"});
}

TEST(CliImplicit, EveryFieldIsRead) {
  const TemporaryDirectory directory;
  const std::string at = directory.write("at.csv", "x,y,z\n0.5,0.25,0.125\n").string(),
                    out = (directory / "o.csv").string();
  const std::string ball = R"({"field": "distance-point", "point": [0, 0, 0], "radius": "1/2"})";
  const std::pair<std::string, const char*> fields[] = {
      {R"("field": "distance-line", "point": [0, 0, 0], "direction": [0, 0, 1], "radius": 1)", "0"},
      {R"("field": "distance-segment", "from": [0, 0, 0], "to": [1, 0, 0], "radius": 1)", "0"},
      {R"("field": "distance-plane", "point": [0, 0, 0], "normal": [1, 0, 0], "offset": 0.25)", "0.25"},
      {R"("field": "distance-plane", "point": [1, 0, 0], "normal": [1, 0, 0], "offset": 0, "signed": true)", "-0.5"},
      {R"("field": "distance-circle", "center": [0, 0, 0], "normal": [0, 0, 1], "ring": 1, "radius": 0.4)", "0"},
      {R"("field": "distance-polygon", "points": [[0, 0], [1, 0], [1, 1], [0, 1]], "radius": 0)", "0.125"},
      {R"("field": "polynomial", "terms": [[1, 2, 0, 0], [2, 0, 1, 1], [-1, 0, 0, 0]])", "-0.6875"},
      {R"("field": "blinn", "threshold": 1, "blobs": [{"center": [0.5, 0.25, 0.125], "height": 3, "decay": 1}])", "-2"},
      {R"("field": "metaballs", "threshold": 1, "blobs": [{"center": [0.5, 0.25, 0.125], "height": 3, "radius": 1}])",
       "-2"},
      {R"("field": "soft-objects", "threshold": 1, "blobs": [{"center": [0.5, 0.25, 0.125], "height": 3, "radius": 1}])",
       "-2"},
      {R"("field": "union", "of": [)" + ball + "]", "0"},
      {R"("field": "intersection", "of": [)" + ball + "]", "0"},
      {R"("field": "difference", "of": [)" + ball + "]", "0"},
      {R"("field": "smooth-union", "width": 0.1, "of": [)" + ball + "]", "0"},
      {R"("field": "offset", "by": 1, "of": )" + ball, "-"},
      {R"("field": "transformed", "matrix": [[1,0,0,0.5],[0,1,0,0.25],[0,0,1,0.125],[0,0,0,1]], "of": )" + ball,
       "-0.5"},
  };
  for (const auto& [field, value] : fields) {
    SCOPED_TRACE(field);
    const std::string in = directory.write("f.json", R"({"kind": "implicit", )" + field + "}").string();
    expect_done(sublimit({"implicit", in, "--at", at, "-o", out, "--quiet"}));
    if (std::string(value) != "0") expect_parts(read_file(out), {"\n0.5,0.25,0.125," + std::string(value)});
  }
}

TEST(CliImplicit, SphereAsAControlMesh) {
  const TemporaryDirectory directory;
  const std::string in = directory.write("f.json", sphere).string(), out = (directory / "cage.obj").string(),
                    report = (directory / "r.json").string(), picture = (directory / "p.svg").string();
  const Outcome outcome = expect_done(
      sublimit({"implicit", in, "--tolerance", "1e-3", "-o", out, "--report", report, "--picture", picture}));
  expect_parts(outcome.out, {"Euler characteristic 2, 1 components", "tolerance 0.001: met"});
  expect_parts(read_file(report), {"\"met\": true", "\"euler_characteristic\": 2", "mean_gauss_difference"});
  expect_parts(read_file(picture), {"<svg"});
  EXPECT_GT(read_mesh(out).num_faces(), 0);
}

TEST(CliImplicit, RefusesBadInput) {
  const TemporaryDirectory directory;
  const std::string out = (directory / "o.obj").string(), csv = (directory / "o.csv").string();
  const auto refused = [&](const std::string& text, std::initializer_list<std::string_view> parts, int status = 3) {
    SCOPED_TRACE(text);
    expect_failure(sublimit({"implicit", directory.write("f.json", text).string(), "-o", out}), status, parts);
    EXPECT_FALSE(std::filesystem::exists(out));
  };
  refused(R"({"field": "spher"})", {"f.json: field: unknown field \"spher\"; the nearest are sphere"});
  refused(R"({"field": "sphere", "center": [0, 0, 0]})", {"the field radius is missing"});
  refused(R"({"field": "sphere", "center": [0, 0, 0], "radius": -1})", {"the radius is -1"});
  refused(R"({"field": "sphere", "center": [0, 0, 0], "radius": 1, "raduis": 1})", {"unknown field \"raduis\""});
  refused(R"({"field": "union", "of": [{"field": "sphere", "center": [0, 0, 0], "radius": 1, "x": 1}]})",
          {"unknown field \"x\" in of[0]"});
  refused(R"({"field": "polynomial", "terms": [[1, 0.5, 0, 0]]})", {"terms[0][1]", "whole numbers"});
  refused(R"({"kind": "cone"})", {"f.json"});
  refused(R"({"field": "sphere", "center": [0, 0, 0], "radius": 1, "box": [[1, 1, 1], [0, 0, 0]]})",
          {"box: has no inside"});
  refused(R"({"field": "sphere", "center": [9, 0, 0], "radius": 1, "box": [[-1, -1, -1], [1, 1, 1]]})",
          {"no change of sign", "between 63 and 101"});
  refused(R"({"field": "sphere", "center": [0, 0, 0], "radius": 1, "box": [[-1, -1, -1], [1, 1, 1]]})",
          {"touches the rim of the box"});
  refused(R"({"field": "sphere", "center": [0, 0, 0], "radius": 1, "cells": 99999})", {"99999 x 99999 x 99999"}, 4);
  const std::string in = directory.write("f.json", sphere).string();
  const std::string at = directory.write("at.csv", "x,y,z\n1,a,0\n").string();
  expect_failure(sublimit({"implicit", in, "--at", at, "-o", csv}), 3, {"at.csv:2: y"});
  EXPECT_FALSE(std::filesystem::exists(csv));
  expect_failure(sublimit({"implicit", in, "--at", at, "--cells", "8", "-o", csv}), 2, {"--cells is not for --at"});
  expect_failure(sublimit({"implicit", in, "--cells", "2", "-o", out}), 2, {"--cells 2"});
  expect_failure(sublimit({"implicit", in, "--tolerance", "0", "-o", out}), 2, {"--tolerance 0"});
}

}  // namespace
}  // namespace sublimit::testing
