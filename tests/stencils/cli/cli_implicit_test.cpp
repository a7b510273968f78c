// SPDX-License-Identifier: Apache-2.0
// `sublimit implicit`.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "stencils/cli_program.h"
#include "stencils/recipes/field_samples.h"
#include "sublimit/io/read_mesh.h"

namespace sublimit::testing {
namespace {

constexpr const char* sphere = R"({"kind": "implicit", "field": "sphere", "center": [0, 0, 0], "radius": 1})";

TEST(CliImplicit, OpenVdbIsNotLoadedByTheOtherCommands) {
  // The loader's list of what the program needs at its start.
  const Outcome needed = sublimit({"--version"}, [] { ::setenv("LD_TRACE_LOADED_OBJECTS", "1", 1); });
  expect_parts(needed.out, {"libtbb", "libstdc++"});
  EXPECT_EQ(needed.out.find("openvdb"), std::string::npos) << needed.out;
}

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

TEST(CliImplicit, ReportsHaveTheirKeys) {
  const TemporaryDirectory directory;
  const std::string in = directory.write("f.json", sphere).string(), out = (directory / "cage.obj").string(),
                    path = (directory / "r.json").string();
  expect_done(sublimit({"implicit", in, "--tolerance", "1e-2", "-o", out, "--report", path, "--quiet"}));
  const nlohmann::json report = nlohmann::json::parse(read_file(path));
  const auto keys = [](const nlohmann::json& object) {
    std::set<std::string> all;
    for (const auto& [key, value] : object.items()) all.insert(key);
    return all;
  };
  EXPECT_EQ(keys(report),
            (std::set<std::string>{"field", "kind", "scheme", "output", "tolerance", "met", "diagonal", "cell",
                                   "field_range", "vertices", "faces", "creases", "corners", "topology",
                                   "topology_of_twice_as_many_cells", "result", "attempts", "notes"}));
  EXPECT_EQ(keys(report["topology"]), (std::set<std::string>{"euler_characteristic", "components"}));
  EXPECT_EQ(report["topology"], report["topology_of_twice_as_many_cells"]);
  EXPECT_EQ(keys(report["result"]),
            (std::set<std::string>{"cells", "splits", "faces", "samples", "largest_distance", "mean_distance",
                                   "largest_angle", "mean_angle", "curvature_samples", "mean_gauss_difference",
                                   "mean_mean_curvature_difference"}));
  EXPECT_EQ(report["attempts"].back(), report["result"]);
  EXPECT_EQ(report["faces"], read_mesh(out).num_faces());
  EXPECT_EQ(report["kind"], "sphere");
  EXPECT_LE(report["result"]["largest_distance"], report["tolerance"]);
}

TEST(CliImplicit, InterpolatingSchemesAreFitted) {
  const TemporaryDirectory directory;
  const std::string out = (directory / "cage.obj").string(), ball = directory.write("s.json", sphere).string(),
                    torus = directory.write("t.json", field_documents()[3]).string();
  for (const char* scheme : {"modified-butterfly", "kobbelt"})
    expect_parts(expect_done(sublimit({"implicit", ball, "-s", scheme, "--tolerance", "1e-2", "-o", out})).out,
                 {"Euler characteristic 2, 1 components", ": met"});
  expect_parts(
      expect_done(sublimit({"implicit", torus, "-s", "modified-butterfly", "--tolerance", "5e-2", "-o", out})).out,
      {"Euler characteristic 0, 1 components", ": met"});
}

TEST(CliImplicit, APartHasCreases) {
  const TemporaryDirectory directory;
  const std::string in =
                        directory
                            .write("f.json", R"({"field": "difference", "of": [)"
                                             R"({"field": "box", "center": [0, 0, 0], "half": [1, 1, 0.5]},)"
                                             R"({"field": "distance-line", "point": [0, 0, 0], "direction": [0, 0, 1],)"
                                             R"("radius": 0.5}]})")
                            .string(),
                    out = (directory / "cage.obj").string();
  const Outcome outcome = expect_done(sublimit({"implicit", in, "-o", out}));
  expect_parts(outcome.out, {"8 corners", "Euler characteristic 0, 1 components", ": met"});
  const Mesh cage = read_mesh(out);
  EXPECT_GT(cage.creases.size(), 20u);
  EXPECT_EQ(cage.corners.size(), 8u);
}

/// What any document may lead to: a mesh, or a message of one line that names the file, and no file.
TEST(CliImplicit, SpoiltDocumentsLeaveNoFilesBehind) {
  std::mt19937 random(23);
  int made = 0, refused = 0;
  for (int round = 0; round < 4; ++round)
    for (const std::string& document : field_documents()) {
      const TemporaryDirectory directory;
      const std::string text = spoilt(document, random), in = directory.write("f.json", text).string();
      SCOPED_TRACE(text);
      const Outcome outcome = sublimit({"implicit", in, "--cells", "5", "--tolerance", "1e6", "-o",
                                        (directory / "o.obj").string(), "--mem-limit", "2G", "--quiet"},
                                       [] {
                                         const rlimit most{30, 30};  // seconds: what hangs is killed
                                         ::setrlimit(RLIMIT_CPU, &most);
                                       });
      if (outcome.status == 0 || outcome.status == 1) {
        ++made;
        EXPECT_GT(read_mesh(directory / "o.obj").num_faces(), 0);
        continue;
      }
      ++refused;
      EXPECT_TRUE(outcome.status == 3 || outcome.status == 4) << outcome.status << outcome.err;
      EXPECT_EQ(count_of(outcome.err, "\n"), 1u) << outcome.err;
      EXPECT_NE(outcome.err.find("f.json"), std::string::npos) << outcome.err;
      EXPECT_EQ(directory.num_files(), 1);
    }
  EXPECT_GT(made, 5);
  EXPECT_GT(refused, 20);
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
  refused(R"({"field": "sphere", "center": [0, 0, 0], "radius": 2, "box": [[-1, -1, -1], [1, 1, 1]]})",
          {"f.json: ", "no change of sign", "between -4 and -1", "make the box larger"});
  refused(R"({"field": "sphere", "center": [0.1, 0.1, 0.1], "radius": 0.01, "box": [[-1, -1, -1], [1, 1, 1]]})",
          {"thinner than a cell", "take more cells"});
  refused(R"({"field": "polynomial", "terms": [[1e300, 100, 0, 0], [-1e300, 0, 100, 0]],)"
          R"( "box": [[-1e9, -1e9, -1e9], [1e9, 1e9, 1e9]]})",
          {"f.json: ", "the field is ", " at (", "it should be a number everywhere in the box"});
  refused(R"({"field": "distance-line", "point": [0, 0, 0], "direction": [0, 0, 1], "radius": 1})", {"give a box"});
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
