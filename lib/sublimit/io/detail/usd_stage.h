// SPDX-License-Identifier: Apache-2.0
#pragma once
// A scene of USD: prims composed of what its layers say of them, with sublayers, references, payloads, inherited and
// specialised prims, and selected variants, each from the same folder or package.
//
//   const UsdStage stage("scene.usda");
//   stage.visit([&](const UsdPrim& prim) { std::cout << prim.path << "\n"; });
//   for (const std::string& note : stage.unread()) std::cerr << note << "\n";
//
// Source: OpenUSD, "Glossary": composition arcs and the strength of opinions (LIVERPS).
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sublimit/io/detail/usd_values.h"
#include "sublimit/io/detail/usdz.h"

namespace sublimit {

/// Layers that are one: a layer and its sublayers, the strongest first. The root of each is a spec.
struct UsdLayers {
  std::vector<std::shared_ptr<const UsdLayer>> layers;
  std::string default_prim;  ///< empty: none
};

/// A prim of a scene.
struct UsdPrim {
  /// What one layer says of it.
  struct Opinion {
    const UsdLayers* layers;
    const UsdLayer* layer;
    const UsdSpec* spec;
    std::string from, to;  ///< paths below `from` in the layer are paths below `to` in the scene
    /// The kinds of arcs that lead to it, strongest first, as digits: 1 inherits, 2 variants, 3 references, 4 payload,
    /// 5 specializes. The stronger of two is the one whose digits come first.
    std::string arcs = {};
    int depth = 0;  ///< of the prim that has the last arc; of equal arcs the deeper one is stronger
  };
  /// A property with the layer that has it.
  struct Found {
    const UsdLayer* layer = nullptr;
    const UsdProperty* property = nullptr;
    explicit operator bool() const { return property; }
  };

  std::string path;  ///< "/World/Cube"; empty: the root of the scene
  const UsdPrim* parent = nullptr;
  std::vector<Opinion> opinions = {};  ///< the strongest first

  /// Returns the last name of the path.
  std::string_view name() const { return std::string_view(path).substr(path.rfind('/') + 1); }
  /// Returns the name that is shown (`displayName`), or else its own.
  std::string shown_name() const;
  /// Returns the type; empty if none is said.
  std::string_view type() const;
  /// True if it is defined, not only changed or a class of others.
  bool is_defined() const;
  /// Returns the strongest entry of metadata; null if there is none.
  const UsdField* field(std::string_view key) const;
  /// Returns the strongest value of a property, or its samples in time (`part` is then timeSamples).
  Found find(std::string_view named) const;
  /// Returns the text of a token or string; empty if there is none.
  std::string text(std::string_view named) const;
  /// Returns the paths, in the scene, that a relationship leads to.
  std::vector<std::string> targets(std::string_view named) const;
  /// Returns "NAME:LINE: PATH: " of the strongest opinion, for messages.
  std::string place() const;
};

class UsdStage {
 public:
  /// Reads a scene and the layers that it needs.
  /// @throws FormatError  a layer that cannot be read, prims that refer to themselves
  /// @throws IoError      missing, unreadable;  ResourceError  more prims than memory or than any scene has
  explicit UsdStage(const std::filesystem::path& path);
  /// Reads a scene from bytes; what it refers to beside itself is not read.
  UsdStage(std::string bytes, const std::string& name);

  /// Returns the scene's first layer.
  const UsdLayer& root_layer() const { return *root_->layers.front(); }
  UsdStage(const UsdStage&) = delete;
  UsdStage& operator=(const UsdStage&) = delete;

  /// Returns the files of a package, none if the scene is none; the first one is the root layer.
  const std::vector<UsdzFile>& package() const { return package_; }

  /// Calls a function for each active prim that is defined, parents before children, while it returns true for the
  /// parents.
  void visit(const std::function<bool(const UsdPrim&)>& each);
  /// Returns what was referred to but is not there or not read, each with its place; after `visit`.
  const std::vector<std::string>& unread() const { return unread_; }

 private:
  using Opinions = std::vector<UsdPrim::Opinion>;
  struct Site {
    const UsdLayers* layers;
    std::string path;
    friend bool operator==(const Site&, const Site&) = default;
  };

  void open(std::string bytes, const std::string& name);
  const UsdLayers* layers_of(const std::string& file, const UsdLayer& from, std::string_view place);
  void add_sublayers(UsdLayers& layers, const std::shared_ptr<const UsdLayer>& layer, std::vector<std::string>& open);
  std::optional<std::string> bytes_of(const std::string& file, const UsdLayer& from, std::string_view place,
                                      std::string& name);
  void expand(const std::string& prim, Opinions site, std::vector<Site>& active, Opinions& out);
  void follow(const std::string& prim, const UsdPrim::Opinion& of, const UsdReference& reference, char arc,
              std::vector<Site>& active, Opinions& out);
  void visit(const UsdPrim& prim, int depth, const std::function<bool(const UsdPrim&)>& each);
  void leave_out(const UsdLayer& layer, std::string_view place, const std::string& what);

  std::filesystem::path folder_;  // of the scene; empty: nothing beside it is read
  std::string bytes_;             // of the package
  std::vector<UsdzFile> package_;
  std::map<std::string, std::unique_ptr<UsdLayers>> read_;  // by name
  const UsdLayers* root_ = nullptr;
  std::vector<std::string> unread_;
  std::int64_t composed_ = 0;
};

/// Returns true for bytes of a layer that is not text.
inline bool is_usd_crate(std::string_view bytes) { return bytes.starts_with("PXR-USDC"); }

}  // namespace sublimit
