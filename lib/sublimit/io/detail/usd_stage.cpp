// SPDX-License-Identifier: Apache-2.0
#include "sublimit/io/detail/usd_stage.h"

#include <algorithm>
#include <array>
#include <unordered_map>

#include "sublimit/base/detail/format_number.h"
#include "sublimit/base/detail/read_file.h"
#include "sublimit/base/error.h"
#include "sublimit/io/detail/gzip.h"
#include "sublimit/io/detail/text_scanner.h"

namespace sublimit {
namespace {

constexpr int deepest_prim = 500;
constexpr std::int64_t most_opinions = 2'000'000;  // references that bring references may grow without end
constexpr std::size_t most_unread = 100;

/// The variant of a set that the strongest opinion selects; empty if none does.
std::string selected_variant(std::string_view set, const std::vector<UsdPrim::Opinion>& opinions) {
  for (const UsdPrim::Opinion& opinion : opinions) {
    const UsdField* const variants = opinion.spec->field("variants");
    if (!variants) continue;
    for (const auto& [name, value] : usd_dictionary(variants->value))
      if (name == set)
        if (const auto texts = usd_texts(*opinion.layer, value, "variants"); !texts.empty()) return texts.front();
  }
  return {};
}

int depth_of(const std::string& path) { return static_cast<int>(std::ranges::count(path, '/')); }

/// A path of a layer in the scene: relative ones are from the prim that has them.
std::string in_scene(const UsdPrim::Opinion& opinion, const std::string& prim, std::string path) {
  if (!path.starts_with('/')) {
    std::string base = prim;
    while (path.starts_with("../")) path.erase(0, 3), base.resize(std::min(base.rfind('/'), base.size()));
    return base + "/" + path;
  }
  if (path == opinion.from || path.starts_with(opinion.from + "/"))
    return opinion.to + path.substr(opinion.from.size());
  return path;
}

}  // namespace

std::string_view UsdPrim::type() const {
  for (const Opinion& opinion : opinions)
    if (!opinion.spec->type.empty()) return opinion.spec->type;
  return {};
}

bool UsdPrim::is_defined() const {
  for (const Opinion& opinion : opinions) {
    // A class that is inherited makes no class of its heir.
    const bool inherited = opinion.arcs.find_first_of("15") != std::string::npos;
    if (opinion.spec->specifier == "over" || (inherited && opinion.spec->specifier == "class")) continue;
    return opinion.spec->specifier == "def";
  }
  return false;
}

const UsdField* UsdPrim::field(std::string_view key) const {
  for (const Opinion& opinion : opinions)
    if (const UsdField* const field = opinion.spec->field(key)) return field;
  return nullptr;
}

std::string UsdPrim::shown_name() const {
  for (const Opinion& opinion : opinions)
    if (const UsdField* const field = opinion.spec->field("displayName"))
      if (const auto texts = usd_texts(*opinion.layer, field->value, "displayName"); !texts.empty()) {
        std::string shown = texts.front();
        std::ranges::replace_if(
            shown, [](char c) { return c == '\n' || c == '\r'; }, ' ');
        while (shown.ends_with('\\') || shown.ends_with(' ')) shown.pop_back();  // no name of an OBJ ends so
        return shown.empty() ? std::string(name()) : shown;
      }
  return std::string(name());
}

UsdPrim::Found UsdPrim::find(std::string_view named) const {
  for (const Opinion& opinion : opinions)
    for (const char* const part : {"timeSamples", ""}) {
      const UsdProperty* const property = opinion.spec->property(named, part);
      if (!property || property->value.empty()) continue;
      return is_blocked(property->value) ? Found{} : Found{opinion.layer, property};
    }
  return {};
}

std::string UsdPrim::text(std::string_view named) const {
  const Found found = find(named);
  if (!found || !found.property->part.empty()) return {};
  const std::vector<std::string> texts = usd_texts(*found.layer, found.property->value, named);
  return texts.empty() ? std::string() : texts.front();
}

std::vector<std::string> UsdPrim::targets(std::string_view named) const {
  for (const Opinion& opinion : opinions)
    if (const UsdProperty* const property = opinion.spec->property(named); property && !property->value.empty()) {
      std::vector<std::string> paths = usd_paths(property->value);
      for (std::string& target : paths) target = in_scene(opinion, path, std::move(target));
      return paths;
    }
  return {};
}

std::string UsdPrim::place() const {
  const Opinion& first = opinions.front();
  return first.layer->place(first.spec->text) + path + ": ";
}

UsdStage::UsdStage(const std::filesystem::path& path) {
  folder_ = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  open(read_inflated(path), path.string());
}

UsdStage::UsdStage(std::string bytes, const std::string& name) { open(std::move(bytes), name); }

void UsdStage::open(std::string bytes, const std::string& name) {
  std::string root = name;
  if (is_zip(bytes)) {
    bytes_ = std::move(bytes);
    package_ = usdz_files(bytes_, name);
    if (package_.empty()) throw FormatError(name + ": the package has no file; the first one should be the scene");
    bytes = std::string(package_.front().bytes);
    root = name + "[" + package_.front().name + "]";
  }
  if (is_usd_crate(bytes))
    throw FormatError(root + ": a binary layer of USD (crate); text is read: `usdcat " +
                      (package_.empty() ? name : package_.front().name) + " -o scene.usda` makes it");
  auto layers = std::make_unique<UsdLayers>();
  root_ = layers.get();
  std::vector<std::string> open;
  read_[package_.empty() ? name : package_.front().name] = std::move(layers);
  add_sublayers(*read_.begin()->second, parse_usda(std::move(bytes), root), open);
}

void UsdStage::leave_out(const UsdLayer& layer, std::string_view place, const std::string& what) {
  std::string message = layer.place(place) + what;
  if (unread_.size() < most_unread && std::ranges::find(unread_, message) == unread_.end())
    unread_.push_back(std::move(message));
}

std::optional<std::string> UsdStage::bytes_of(const std::string& file, const UsdLayer& from, std::string_view place,
                                              std::string& name) {
  const auto bracket = from.name.find('[');
  const std::string base = package_.empty() ? from.name : from.name.substr(bracket + 1, from.name.size() - bracket - 2);
  const std::filesystem::path path = (std::filesystem::path(base).parent_path() / file).lexically_normal();
  name = path.generic_string();
  std::string bytes;
  if (!package_.empty()) {
    const auto found = std::ranges::find(package_, name, &UsdzFile::name);
    if (found == package_.end()) {
      leave_out(from, place, "'" + file + "' is not in the package; what it would bring is missing");
      return std::nullopt;
    }
    bytes = std::string(found->bytes);
  } else {
    std::error_code none;
    if (folder_.empty() || !std::filesystem::is_regular_file(path, none)) {
      leave_out(from, place, "'" + file + "' is not there; what it would bring is missing");
      return std::nullopt;
    }
    bytes = read_inflated(path);
  }
  if (!is_usd_crate(bytes) && !is_zip(bytes) && bytes.find("#usda") < 4) return bytes;
  leave_out(from, place,
            "'" + file + "' is not read: " +
                (is_usd_crate(bytes) ? "a binary layer of USD (crate); `usdcat` makes text of it"
                 : is_zip(bytes)     ? "a package in another scene; its files as they are can be read"
                                     : "not a layer of USD") +
                "; what it would bring is missing");
  return std::nullopt;
}

void UsdStage::add_sublayers(UsdLayers& layers, const std::shared_ptr<const UsdLayer>& layer,
                             std::vector<std::string>& open) {
  if (std::ranges::find(open, layer->name) != open.end())
    throw FormatError(layer->place(layer->text) + "the layer is a sublayer of itself");
  open.push_back(layer->name);
  layers.layers.push_back(layer);
  if (const UsdField* const prim = layer->root.field("defaultPrim"); prim && layers.layers.size() == 1)
    if (const auto texts = usd_texts(*layer, prim->value, "defaultPrim"); !texts.empty())
      layers.default_prim = texts.front();
  if (const UsdField* const sublayers = layer->root.field("subLayers"))
    for (const UsdReference& reference : usd_references(sublayers->value)) {
      std::string name;
      std::optional<std::string> bytes = bytes_of(reference.file, *layer, reference.text, name);
      if (!bytes) continue;
      if (reference.moved_in_time)
        leave_out(*layer, reference.text,
                  "the offset in time of a sublayer is not read; its times are taken as they are");
      add_sublayers(layers, parse_usda(*std::move(bytes), name), open);
    }
  open.pop_back();
}

const UsdLayers* UsdStage::layers_of(const std::string& file, const UsdLayer& from, std::string_view place) {
  std::string name;
  std::optional<std::string> bytes = bytes_of(file, from, place, name);
  if (!bytes) return nullptr;
  std::unique_ptr<UsdLayers>& layers = read_[name];
  if (!layers) {
    layers = std::make_unique<UsdLayers>();
    std::vector<std::string> open;
    const auto bracket = from.name.find('[');
    const std::string shown = package_.empty() ? name : from.name.substr(0, bracket + 1) + name + "]";
    add_sublayers(*layers, parse_usda(*std::move(bytes), shown), open);
  }
  return layers.get();
}

void UsdStage::follow(const std::string& prim, const UsdPrim::Opinion& of, const UsdReference& reference, char arc,
                      std::vector<Site>& active, Opinions& out) {
  const UsdLayers* const layers =
      reference.file.empty() ? of.layers : layers_of(reference.file, *of.layer, reference.text);
  if (!layers) return;
  std::string path = reference.path;
  if (path.empty()) path = "/" + layers->default_prim;
  const Site site{layers, path};
  if (std::ssize(active) > deepest_prim)
    throw FormatError(of.layer->place(reference.text) + "references lead over more than " +
                      format_number(deepest_prim) + " others");
  if (std::ranges::find(active, site) != active.end())
    throw FormatError(of.layer->place(reference.text) + "the prim " + path + " refers to itself");
  Opinions opinions;
  if (path.size() > 1)
    for (const auto& layer : layers->layers)
      if (const UsdSpec* const spec = find_usd_spec(layer->root, path))
        opinions.push_back({layers, layer.get(), spec, path, prim, of.arcs + arc, depth_of(prim)});
  if (opinions.empty()) {
    leave_out(*of.layer, reference.text,
              path.size() > 1 ? "there is no prim " + path + " to refer to; what it would bring is missing"
                              : "the layer has no default prim to refer to; what it would bring is missing");
    return;
  }
  active.push_back(site);
  expand(prim, std::move(opinions), active, out);
  active.pop_back();
}

void UsdStage::expand(const std::string& prim, Opinions site, std::vector<Site>& active, Opinions& out) {
  composed_ += active.empty() ? 0 : std::ssize(site);
  if (composed_ > most_opinions)
    throw ResourceError(root_layer().name + ": more than " + format_number(most_opinions) +
                        " prims are composed by references; a scene with fewer can be read");
  out.insert(out.end(), site.begin(), site.end());
  const auto follow_all = [&](std::string_view key, char arc) {
    for (const UsdPrim::Opinion& opinion : site)
      for (const UsdField& field : opinion.spec->metadata)
        if (field.key == key && field.edit != "delete")
          for (UsdReference& reference : usd_references(field.value)) {
            if (reference.moved_in_time)
              leave_out(*opinion.layer, reference.text,
                        "the offset in time of a reference is not read; its times are taken as they are");
            follow(prim, opinion, reference, arc, active, out);
          }
  };
  follow_all("inherits", '1');
  for (const UsdPrim::Opinion& opinion : site)
    for (const UsdSpec& variant : opinion.spec->variants) {
      if (variant.name != selected_variant(variant.set, out)) continue;
      UsdPrim::Opinion chosen = opinion;
      chosen.spec = &variant;
      chosen.arcs += '2';
      chosen.depth = depth_of(prim);
      expand(prim, {chosen}, active, out);
    }
  follow_all("references", '3');
  follow_all("payload", '4');
  follow_all("specializes", '5');
}

void UsdStage::visit(const UsdPrim& prim, int depth, const std::function<bool(const UsdPrim&)>& each) {
  if (depth > deepest_prim)
    throw FormatError(prim.place() + "prims are in more than " + format_number(deepest_prim) +
                      " others; does one refer to a prim that it is in?");
  std::vector<Opinions> children;  // by name, the strongest opinions first as they are in the parent
  std::unordered_map<std::string_view, std::size_t> numbers;
  for (const UsdPrim::Opinion& opinion : prim.opinions)
    for (const UsdSpec& spec : opinion.spec->children) {
      const auto [at, is_new] = numbers.emplace(spec.name, children.size());
      if (is_new) children.emplace_back();
      UsdPrim::Opinion& below = children[at->second].emplace_back(opinion);
      below.spec = &spec;
    }
  for (Opinions& site : children) {
    UsdPrim child{.path = prim.path + "/" + std::string(site.front().spec->name), .parent = &prim};
    std::vector<Site> active;
    expand(child.path, std::move(site), active, child.opinions);
    std::ranges::stable_sort(child.opinions, [](const UsdPrim::Opinion& a, const UsdPrim::Opinion& b) {
      return a.arcs != b.arcs ? a.arcs < b.arcs : a.depth > b.depth;
    });
    const UsdField* const active_field = child.field("active");
    if (!child.is_defined() || (active_field && active_field->value == "false")) continue;
    if (each(child)) visit(child, depth + 1, each);
  }
}

void UsdStage::visit(const std::function<bool(const UsdPrim&)>& each) {
  UsdPrim root;
  for (const auto& layer : root_->layers) root.opinions.push_back({root_, layer.get(), &layer->root, "", "", "", 0});
  composed_ = 0;
  visit(root, 0, each);
}

}  // namespace sublimit
