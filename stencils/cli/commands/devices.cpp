// SPDX-License-Identifier: Apache-2.0
// `sublimit devices`: GPUs that `apply --gpu` takes.
#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "support/common.h"
#include "gpu/entry.h"
#include "support/loaded_library.h"
#include "sublimit/base/detail/memory.h"
#include "sublimit/base/error.h"

namespace sublimit::cli {
namespace {

std::vector<DescribedGpu> described_devices(std::string& why_none) {
  std::vector<DescribedGpu> all;
  try {
    auto* const devices = reinterpret_cast<GpuDevicesEntry*>(
        loaded_function(gpu_part, gpu_library, gpu_devices_entry, "results of GPUs"));
    devices(all, why_none);
  } catch (const InvalidOption& error) {  // the part is not here
    why_none = error.what();
  }
  return all;
}

void print_json(const std::vector<DescribedGpu>& all) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const auto& [info, api, kind] : all)
    json.push_back({{"number", json.size()},
                    {"name", info.name},
                    {"api", api},
                    {"kind", kind},
                    {"memory", info.memory},
                    {"halves", info.halves},
                    {"driver", info.driver}});
  fmt::print("{}\n", json.dump(2));
}

void print_table(const std::vector<DescribedGpu>& all) {
  size_t width = 4;
  for (const DescribedGpu& device : all) width = std::max(width, device.info.name.size());
  fmt::print("{:>6}  {:<{}}  {:<6}  {:<10}  {:>8}  {:<6}  {}\n", "number", "name", width, "API", "kind", "memory",
             "halves", "driver");
  for (size_t i = 0; i < all.size(); ++i) {
    const auto& [info, api, kind] = all[i];
    fmt::print("{:>6}  {:<{}}  {:<6}  {:<10}  {:>8}  {:<6}  {}\n", i, info.name, width, api, kind,
               bytes_in_words(double(info.memory)), info.halves ? "yes" : "no", info.driver);
  }
}

int run(bool as_json) {
  std::string why_none;
  const std::vector<DescribedGpu> all = described_devices(why_none);
  const std::string none = "no GPU that tables can be applied on: " + why_none;
  if (as_json) {
    if (all.empty()) fmt::print(stderr, "sublimit: note: {}\n", none);
    print_json(all);
  } else if (all.empty()) {
    fmt::print("{}\n`sublimit apply` without --gpu applies them on the CPU.\n", none);
  } else {
    print_table(all);
  }
  return 0;
}

}  // namespace

Command add_devices(CLI::App& app) {
  auto* command = app.add_subcommand("devices", "List the GPUs that tables can be applied on");
  auto as_json = std::make_shared<bool>(false);
  command->add_flag("--json", *as_json, "As JSON");
  command->footer(
      "Examples:\n"
      "  sublimit devices\n"
      "  sublimit devices --json\n"
      "  sublimit apply level3.safetensors animation.npy --gpu --device 1 -o refined.npy\n"
      "\nNumber, name, API (Vulkan, CUDA), kind, memory, whether results can be half floats (in a program that has its points\n"
      "on the GPU; files have floats) and driver. Discrete GPUs come first, then integrated and virtual ones; of kind cpu\n"
      "are processors that stand in for a GPU, as Mesa's lavapipe. Of Vulkan those of version 1.2 with buffer device\n"
      "addresses. Where there is none it says why, and with --json writes an empty list and says why on stderr; the exit\n"
      "status is 0.");
  return [=] { return run(*as_json); };
}

}  // namespace sublimit::cli
