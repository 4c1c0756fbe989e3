#include "bakers/job/synthesis_bake.h"

#include <nlohmann/json.hpp>

#include "bakers/import/sha256.h"
#include "bakers/material/appearance.h"
#include "bakers/material/raw_material.h"
#include "bakers/synthesis/exemplar.h"
#include "bakers/synthesis/seam_energy.h"
#include "platform/peak_memory.h"
#include "platform/stopwatch.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/material/material_file.h"
#include "sdk/src/synthesis/coordinates.h"

namespace nook::bake {
namespace {

using Json = nlohmann::ordered_json;
using synthesis::Texel;

struct Looks {
  std::uint32_t width = 0, height = 0;
  tensor::Matrix values;
};

Looks looks_of(std::span<const std::byte> bytes, std::uint64_t seed) {
  if (bytes.size() >= 16 && container_kind(bytes) == material::raw_kind.kind) {
    const material::RawMaterial raw = material::read_raw_material(bytes);
    return {raw.width, raw.height, material::appearance_of(raw, seed)};
  }
  const nook::material::Material read = nook::material::read_material(bytes);
  return {read.btf.shape.width, read.btf.shape.height, material::appearance_of(read, seed)};
}

Crop checked(Crop crop, const Looks& looks) {
  const bool is_whole = crop.x == 0 && crop.y == 0 && crop.width == 0 && crop.height == 0;
  if (is_whole) return {0, 0, looks.width, looks.height};
  if (crop.width < 1 || crop.height < 1 || crop.x >= looks.width || crop.y >= looks.height ||
      crop.width > looks.width - crop.x || crop.height > looks.height - crop.y)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "the crop exceeds the material (got %u x %u texels starting at (%u, %u), the material has %u x %u)",
        crop.width, crop.height, crop.x, crop.y, looks.width, looks.height);
  return crop;
}

tensor::Matrix cropped(const Looks& looks, const Crop& crop) {
  tensor::Matrix out(Eigen::Index(crop.width) * crop.height, looks.values.cols());
  for (std::uint32_t y = 0; y < crop.height; ++y)
    out.middleRows(Eigen::Index(y) * crop.width, crop.width) =
        looks.values.middleRows(Eigen::Index(crop.y + y) * looks.width + crop.x, crop.width);
  return out;
}

nook::synthesis::Coordinates coordinates_of(const SynthesisTask& task, const std::vector<Texel>& plane) {
  nook::synthesis::Coordinates out;
  out.side = task.settings.side;
  out.width = task.width;
  out.height = task.height;
  for (const Texel t : plane)
    out.cells.push_back(
        {std::uint16_t(std::uint32_t(t.x) + task.crop.x), std::uint16_t(std::uint32_t(t.y) + task.crop.y)});
  return out;
}

Json synthesis_recipe(const SynthesisTask& task) {
  Json recipe;
  if (!task.source.empty()) recipe["source"] = task.source;
  recipe["tiling"] = task.exemplar.shape.is_tiling;
  recipe["crop"] = {task.crop.x, task.crop.y, task.crop.width, task.crop.height};
  recipe["jitter"] = task.settings.jitter;
  recipe["passes"] = task.settings.passes;
  recipe["seed"] = task.settings.seed;
  return recipe;
}

}  // namespace

SynthesisTask synthesis_task(std::span<const std::byte> material, const Crop& crop, bool is_tiling,
                             const synthesis::SynthesisSettings& settings) {
  const Looks looks = looks_of(material, settings.seed);
  SynthesisTask task;
  task.material_hash = sha256(material);
  task.width = looks.width;
  task.height = looks.height;
  task.settings = settings;
  task.crop = checked(crop, looks);
  const bool is_whole = task.crop.width == looks.width && task.crop.height == looks.height;
  task.exemplar.shape = {std::int32_t(task.crop.width), std::int32_t(task.crop.height),
                         is_tiling && is_whole};
  task.exemplar.values = cropped(looks, task.crop);
  synthesis::check_synthesis(task.exemplar, settings);
  return task;
}

SynthesisTask synthesis_task_of(const nook_bake_synthesis_desc& desc) {
  need(desc.material, "desc.material");
  if (desc.is_tiling > 1)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.is_tiling is neither 0 nor 1 (got %u)", desc.is_tiling);
  const synthesis::SynthesisSettings settings{desc.side, desc.jitter, desc.passes, desc.seed};
  return synthesis_task({static_cast<const std::byte*>(desc.material), desc.material_size},
                        {desc.crop[0], desc.crop[1], desc.crop[2], desc.crop[3]}, desc.is_tiling == 1,
                        settings);
}

BakeIdentity identify_synthesis(const SynthesisTask& task) {
  return identify_bake(BakeKind::synthesis,
                       {{"tiling", task.exemplar.shape.is_tiling},
                        {"crop", {task.crop.x, task.crop.y, task.crop.width, task.crop.height}},
                        {"side", task.settings.side},
                        {"jitter", task.settings.jitter},
                        {"passes", task.settings.passes},
                        {"seed", task.settings.seed}},
                       {{"material", task.material_hash}});
}

BakedFile bake_synthesis_file(const SynthesisTask& task, const StageReport& progress) {
  platform::Stopwatch watch;
  const std::vector<Texel> plane = synthesis::synthesise(
      synthesis::balanced(task.exemplar), task.settings,
      [&](std::size_t done, std::size_t total) { return progress(JobStage::fit, done, total); });
  const double seconds = watch.seconds();
  const synthesis::Seams before = synthesis::measure_tiled(task.exemplar),
                         after =
                             synthesis::measure_seams(task.exemplar, plane, std::int32_t(task.settings.side));
  nook::synthesis::Coordinates coordinates = coordinates_of(task, plane);
  Json recipe = synthesis_recipe(task);
  store_identity(recipe, identify_synthesis(task));
  coordinates.recipe = recipe.dump(-1, ' ', false, Json::error_handler_t::replace).c_str();
  BakedFile file;
  file.model = nook::synthesis::write_coordinates(coordinates);
  Json report;
  report["side"] = task.settings.side;
  report["width"] = task.width;
  report["height"] = task.height;
  report["tiling"] = task.exemplar.shape.is_tiling;
  report["jumps"] = after.jumps;
  report["seam_energy"] = after.energy;
  report["seam_energy_tiled"] = before.energy;
  report["fetches"] = 1;
  report["file_bytes"] = file.model.size();
  report["seconds"] = seconds;
  report["peak_bytes"] = platform::peak_bytes();
  file.report = report.dump(2);
  return file;
}

}  // namespace nook::bake
