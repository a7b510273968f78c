// SPDX-License-Identifier: Apache-2.0
// The house as README.md draws it: rooms know those below them and no others, and documents lead to each of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "sublimit/base/read_file.h"

namespace sublimit::testing {
namespace {

namespace fs = std::filesystem;

/// The rooms of a target from the ground up, and the headers beside them that users include first.
struct Floor {
  const char* folder;
  std::vector<std::string> rooms;
  std::set<std::string> doors;
};
const Floor floors[] = {
    {"lib/sublimit",
     {"core", "mesh", "splits", "io", "scheme", "neighborhood", "limit", "tessellation", "geometric", "curves",
      "patches", "search", "cad", "schemes", "primvar", "fit", "implicit", "certificates"},
     {"schemes.h", "subdivide.h"}},
    {"stencils/sublimit",
     {"recipes", "files", "jobs", "patterns", "bake", "shards", "picture", "fit_jobs", "distributed", "gallery",
      "report"},
     {}},
};

/// Where a file is, seen from the folder: the room, or the name itself where it is beside the rooms.
std::string room_of(const fs::path& file) { return file.begin()->string(); }

TEST(House, RoomsKnowThoseBelowThem) {
  for (const Floor& floor : floors) {
    const fs::path folder = fs::path(SUBLIMIT_SOURCE) / floor.folder;
    const auto level = [&](const std::string& room) {
      // Doors lead to the registry: what is above schemes may go through them.
      const std::string known = floor.doors.contains(room) ? "schemes" : room;
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
    for (const std::string& room : floor.rooms) EXPECT_TRUE(fs::exists(folder / room / "README.md")) << room;
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
      EXPECT_NE(page.find("(sublimit/" + room + "/README.md)"), std::string::npos)
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
    std::istringstream text(read_file(entry.path()));
    for (std::string line; std::getline(text, line);)
      EXPECT_FALSE(std::regex_search(line, read)) << entry.path() << ": " << line;
  }
}

}  // namespace
}  // namespace sublimit::testing
