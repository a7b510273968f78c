// SPDX-License-Identifier: Apache-2.0
// The house as README.md draws it: rooms know those below them and no others, and documents lead to each of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "sublimit/base/detail/read_file.h"

namespace sublimit::testing {
namespace {

namespace fs = std::filesystem;

/// The rooms of a target from the ground up, and the files beside them that users include first: they lead to a room,
/// and what is above it may go through them.
struct Floor {
  const char* folder;
  std::vector<std::string> rooms;
  std::set<std::string> doors;
  const char* door_to;
};
const Floor floors[] = {
    {"lib/sublimit",
     {"core",    "mesh", "splits",    "io",      "scheme",  "source",   "neighborhood", "limit",
      "surface", "nets", "geometric", "curves",  "patches", "parts",    "integrals",    "tessellation",
      "search",  "cad",  "schemes",   "primvar", "fit",     "implicit", "certificates"},
     {"subdivide.h"},
     "schemes"},
    {"stencils/sublimit",
     {"json", "formats", "recipes", "files", "jobs", "patterns", "bake", "shards", "picture", "fit_jobs", "distributed",
      "gallery", "report"},
     {"sublimit.h", "sublimit.cpp", "flatten.cpp"},
     "report"},
};

/// Where a file is, seen from the folder: the room, or the name itself where it is beside the rooms. An include of
/// stencils/ names that library, and then the room.
std::string room_of(const fs::path& file) {
  auto part = file.begin();
  if (*part == "stencils") ++part;
  return part->string();
}

/// The way from the folder to a room.
fs::path way_to(const fs::path& folder, const std::string& room) {
  return fs::exists(folder / room) ? fs::path(room) : fs::path("stencils") / room;
}

TEST(House, RoomsKnowThoseBelowThem) {
  for (const Floor& floor : floors) {
    const fs::path folder = fs::path(SUBLIMIT_SOURCE) / floor.folder;
    const auto level = [&](const std::string& room) {
      const std::string known = floor.doors.contains(room) ? floor.door_to : room;
      return std::find(floor.rooms.begin(), floor.rooms.end(), known) - floor.rooms.begin();
    };
    std::set<std::string> rooms;
    size_t arrows = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      const std::string room = room_of(entry.path().lexically_relative(folder));
      rooms.insert(room);
      EXPECT_LT(level(room), std::ssize(floor.rooms)) << entry.path() << " is in no room";
      std::istringstream text(read_file(entry.path()));
      const std::regex include("#include \"sublimit/([^\"]+)\"");
      for (std::string line; std::getline(text, line);) {
        std::smatch found;
        if (!std::regex_match(line, found, include) || !fs::exists(folder / found[1].str())) continue;
        EXPECT_LE(level(room_of(found[1].str())), level(room)) << entry.path() << ": " << line;
        ++arrows;
      }
    }
    EXPECT_GT(arrows, 100u);
    EXPECT_EQ(rooms.size(), floor.rooms.size() + floor.doors.size()) << floor.folder;
    for (const std::string& room : floor.rooms)
      EXPECT_TRUE(fs::exists(folder / way_to(folder, room) / "README.md")) << room;
  }
}

TEST(House, FoldersKnowThoseBelowThem) {
  const fs::path root = SUBLIMIT_SOURCE;
  const auto folder_of = [](fs::path file) {
    file = file.parent_path();
    return (file.filename() == "detail" ? file.parent_path() : file).string();
  };
  const std::regex include("#include \"(sublimit/[^\"]+)\"");
  std::map<std::string, std::set<std::string>> below;
  for (const char* const part : {"lib", "eval", "stencils"})
    for (const auto& entry : fs::recursive_directory_iterator(root / part / "sublimit")) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      const std::string folder = folder_of(entry.path().lexically_relative(root));
      below[folder];
      std::istringstream text(read_file(entry.path()));
      for (std::string line; std::getline(text, line);) {
        std::smatch found;
        if (!std::regex_match(line, found, include)) continue;
        for (const char* const other : {"lib", "eval", "stencils"})
          if (const fs::path header = fs::path(other) / found[1].str(); fs::exists(root / header))
            if (const std::string known = folder_of(header); known != folder) below[folder].insert(known);
      }
    }
  EXPECT_GT(below.size(), 40u);
  // Removes folders until none of those left satisfies `is_free`. Without the folders that include no other one, and
  // then without those that no other one includes, only circles and the ways between them are left.
  const auto take_away = [&](const auto& is_free) {
    for (bool taken = true; taken;) {
      taken = false;
      for (auto at = below.begin(); at != below.end();)
        if (is_free(at->first)) {
          for (auto& [folder, known] : below) known.erase(at->first);
          at = below.erase(at);
          taken = true;
        } else {
          ++at;
        }
    }
  };
  take_away([&](const std::string& folder) { return below.at(folder).empty(); });
  take_away([&](const std::string& folder) {
    return std::ranges::none_of(below, [&](const auto& other) { return other.second.contains(folder); });
  });
  std::set<std::string> left;
  for (const auto& [folder, known] : below) left.insert(folder);
  EXPECT_EQ(left, std::set<std::string>{}) << "folders include each other";
}

/// Rooms of which nothing is installed: what is there is for us, as what is in a folder `detail`.
bool is_own(const std::string& path) {
  static const std::regex own(
      "/detail/|^lib/sublimit/(cad|curves/schemes|geometric|implicit/polygonize|neighborhood|nets|parts|patches/(constructions|joins)"
      "|primvar|schemes|certificates/(spectra|c1|witness|regularity))/|^eval/sublimit/eval/kernels/"
      "|^stencils/sublimit/(stencils/(files|fit_jobs|formats|gallery|json|patterns|picture|shards)"
      "|report/(analysis|asset|free_form|page)|distributed)/");
  static const std::set<std::string> doors{"lib/sublimit/cad/step.h", "stencils/sublimit/distributed/distributed.h",
                                           "stencils/sublimit/distributed/ranks.h"};
  return !doors.contains(path) && std::regex_search(path, own);
}

/// The library or program that a source belongs to.
std::string product_of(const std::string& path) {
  for (const auto& [folder, name] :
       std::vector<std::pair<std::string, std::string>>{{"lib/sublimit/certificates/", "certificates"},
                                                        {"lib/sublimit/cad/opencascade/", "cad"},
                                                        {"lib/sublimit/implicit/polygonize/", "implicit_mesh"},
                                                        {"lib/", "lib"},
                                                        {"eval/sublimit/base/", "base"},
                                                        {"eval/sublimit/eval/gpu/", "eval_gpu"},
                                                        {"eval/", "eval"},
                                                        {"stencils/sublimit/report/", "report"},
                                                        {"stencils/sublimit/distributed/", "distributed"},
                                                        {"stencils/cli_mpi/", "sublimit-mpi"},
                                                        {"stencils/cli/", "sublimit"},
                                                        {"stencils/python/", "python"}})
    if (path.starts_with(folder)) return name;
  return "stencils";
}

/// How many headers of others, which are for these alone, each library or program includes all the same; but those of
/// base, which is for all of us. May only fall.
const std::map<std::string, size_t> own_headers_of_others{
    {"cad", 3},     {"certificates", 13}, {"distributed", 21}, {"eval_gpu", 2},  {"implicit_mesh", 1}, {"lib", 1},
    {"python", 15}, {"report", 45},       {"stencils", 57},    {"sublimit", 77}, {"sublimit-mpi", 7}};

TEST(House, WhatIsInstalledIncludesNothingElse) {
  const fs::path root = SUBLIMIT_SOURCE;
  const std::regex include("#include \"(sublimit/[^\"]+)\"");
  std::map<std::string, std::set<std::string>> used;
  size_t of_public_headers = 0;
  for (const char* folder : {"lib", "eval", "stencils"})
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      const std::string file = entry.path().lexically_relative(root).string();
      const bool is_public = entry.path().extension() == ".h" && file.find("/sublimit/") != std::string::npos &&
                             !is_own(file) && !file.starts_with("stencils/cli") && !file.starts_with("stencils/python");
      std::istringstream text(read_file(entry.path()));
      for (std::string line; std::getline(text, line);) {
        std::smatch found;
        if (!line.starts_with("#include \"sublimit/") || !std::regex_match(line, found, include)) continue;
        std::string header;
        for (const char* const of : {"lib", "eval", "stencils"})
          if (fs::exists(root / of / found[1].str())) header = std::string(of) + "/" + found[1].str();
        if (is_public) {
          EXPECT_FALSE(is_own(header)) << file << ": " << line;
          ++of_public_headers;
        }
        const std::string product = product_of(file), other = product_of(header);
        if (is_own(header) && other != product && other != "base") used[product].insert(header);
      }
    }
  EXPECT_GT(of_public_headers, 100u);
  for (const auto& [product, headers] : used) {
    const auto allowed = own_headers_of_others.find(product);
    const size_t most = allowed == own_headers_of_others.end() ? 0 : allowed->second;
    EXPECT_LE(headers.size(), most) << product << " includes what is for others alone";
    EXPECT_GE(headers.size(), most) << product << ": lower its number";
  }
}

TEST(House, DocumentsLeadToEveryRoom) {
  const fs::path root = SUBLIMIT_SOURCE;
  const std::string front = read_file(root / "README.md"), house = front.substr(front.find("## The house\n"));
  for (const Floor& floor : floors) {
    const fs::path folder = floor.folder;  // lib/sublimit
    const std::string page = read_file(root / folder.parent_path() / "README.md");
    for (const std::string& room : floor.rooms) {
      EXPECT_NE(house.find(" " + room + "/"), std::string::npos) << "README.md draws no " << room;
      const std::string way = way_to(fs::path(SUBLIMIT_SOURCE) / folder, room).string();
      EXPECT_NE(page.find("(sublimit/" + way + "/README.md)"), std::string::npos)
          << floor.folder << " leads not to " << room;
    }
  }
}

// Claims are for reports and laws: no result rests on them.
TEST(House, NoRoomOfLibReadsClaims) {
  const std::regex read("claims\\.\\w+(?!\\w)(?! *= )");
  EXPECT_TRUE(std::regex_search(std::string("if (scheme.claims.regular == 1)"), read));
  EXPECT_FALSE(std::regex_search(std::string("  linear.claims.limit = \"the faces\";"), read));
  const fs::path folder = fs::path(SUBLIMIT_SOURCE) / "lib/sublimit";
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
    if (entry.path().filename() == "scheme_info.cpp") continue;  // the list of schemes, which shows what is claimed
    std::istringstream text(read_file(entry.path()));
    for (std::string line; std::getline(text, line);)
      EXPECT_FALSE(std::regex_search(line, read)) << entry.path() << ": " << line;
  }
}

/// Where references to arguments are kept though a temporary would do: what is made and used in one place, by us.
const std::set<std::string> made_in_one_place{
    "eval/sublimit/base/detail/parallel_for.h",              // blocks of one loop
    "eval/sublimit/base/detail/thread_sanitizer.h",          // while a block of it runs
    "lib/sublimit/scheme/sites.h",                           // sites live for the call of a mask
    "lib/sublimit/scheme/detail/subdivision_matrix_impl.h",  // makers of rows for the assembly of one matrix
    "stencils/sublimit/stencils/patterns/patterns.h",        // examples for one call
    "stencils/sublimit/stencils/picture/panel.h",            // a panel for the call that draws it
};

/// Where what is kept is a part of the argument, which is refused.
const std::map<std::string, std::string> part_of{
    {"lib/sublimit/neighborhood/regular_faces.h: Topology", "Level"},
    {"lib/sublimit/nets/piece_parts.h: LimitMap::Parts", "LimitMap"},
    {"lib/sublimit/surface/detail/limit_patches.h: LimitMap::Parts::Pieces", "LimitMap::Parts"},
};

// A reference to an argument that a header keeps, as a member or a pointer, has an overload for temporaries, deleted.
TEST(House, WhatKeepsAReferenceTakesNoTemporary) {
  const std::regex member("\\s+const ([\\w:]+(?:<[^;()]*>)?)& \\w+;.*"), address("\\w+_\\(&(\\w+)\\)");
  size_t kept = 0;
  std::set<std::string> excused;
  for (const char* folder : {"lib", "eval", "stencils"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(SUBLIMIT_SOURCE) / folder)) {
      if (entry.path().extension() != ".h") continue;
      const std::string file = entry.path().lexically_relative(SUBLIMIT_SOURCE).string();
      const std::string text = read_file(entry.path());
      std::set<std::string> types;
      std::istringstream lines(text);
      for (std::string line; std::getline(lines, line);) {
        std::smatch found;  // regular expressions are slow: most lines have neither
        if (line.find("& ") != std::string::npos && std::regex_match(line, found, member)) types.insert(found[1].str());
        if (line.find("_(&") == std::string::npos || !std::regex_search(line, found, address)) continue;
        // The parameter's type, if it is const: others take no temporaries anyway.
        const std::regex parameter("const ([\\w:]+(?:<[^;()]*>)?)& " + found[1].str() + "[,)]");
        if (std::smatch declared; std::regex_search(text, declared, parameter)) types.insert(declared[1].str());
      }
      for (const std::string& type : types) {
        if (made_in_one_place.contains(file)) {
          excused.insert(file);
          continue;
        }
        const auto whole = part_of.find(file + ": " + type);
        const std::string refused = "const " + (whole == part_of.end() ? type : whole->second) + "&&";
        EXPECT_NE(text.find(refused), std::string::npos)
            << file << " keeps a reference to a " << type << "; delete the overload for temporaries, (" << refused
            << ", ...) = delete, or let it own what it needs";
        ++kept;
      }
    }
  EXPECT_GT(kept, 30u);
  EXPECT_EQ(excused, made_in_one_place);
}

}  // namespace
}  // namespace sublimit::testing
