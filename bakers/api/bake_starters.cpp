// Starts all bakes except the bake of a character, which is in job.cpp. What a job reads lives as long as the
// job.
#include <nook/experimental/nook_bake_materials.h>
#include <nook/nook_bake.h>

#include "bakers/api/bake_descriptors.h"
#include "bakers/api/bake_handles.h"
#include "bakers/job/clip_bake.h"
#include "bakers/job/material_bake.h"
#include "bakers/job/synthesis_bake.h"
#include "bakers/job/transfer_bake.h"
#include "bakers/job/vertex_bakes.h"
#include "bakers/raytrace/worker_arena.h"

namespace nook::bake::api {
namespace {

std::shared_ptr<const CharacterModel> model_of(const void* model, std::size_t size,
                                               const ImportedCharacter& character) {
  const std::span bytes(static_cast<const std::byte*>(model), size);
  return std::make_shared<const CharacterModel>(model_of_character(bytes, character));
}

void need_unreserved(std::uint32_t reserved) {
  if (reserved != 0) throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.reserved is %u, need 0", reserved);
}

}  // namespace

nook_bake_job_s* start_bent(const void* desc) {
  const nook_bake_bent_desc d = read_descriptor(static_cast<const nook_bake_bent_desc*>(desc));
  need(d.character, "desc.character");
  need_threads(d.threads);
  const BentTask task = bent_task_of(d);
  need(d.model, "desc.model");
  auto model = model_of(d.model, d.model_size, *d.character->character);
  return start_job(
      d, [shared = d.character->character, model = std::move(model), task](const StageReport& report) {
        return bake_bent_file(*shared, *model, task, report);
      });
}

nook_bake_job_s* start_clips(const void* desc) {
  const nook_bake_clips_desc d = read_descriptor(static_cast<const nook_bake_clips_desc*>(desc));
  need(d.character, "desc.character");
  need_threads(d.threads);
  need_unreserved(d.reserved);
  need(d.model, "desc.model");
  const ImportedCharacter& imported = *d.character->character;
  ClipTask task = clip_task_of(d);
  auto model = model_of(d.model, d.model_size, imported);
  ClipFrames frames = frames_of(imported, task);
  return start_job(d, [shared = d.character->character, model = std::move(model), frames = std::move(frames),
                       task = std::move(task)](const StageReport& report) {
    return bake_clips_file(*shared, *model, frames, task, report);
  });
}

nook_bake_job_s* start_material(const void* desc) {
  const nook_bake_material_desc d = read_descriptor(static_cast<const nook_bake_material_desc*>(desc));
  auto task = std::make_shared<MaterialTask>(material_task_of(d));
  return start_job(d, [task](const StageReport& report) { return bake_material(*task, report); });
}

nook_bake_job_s* start_synthesis(const void* desc) {
  const nook_bake_synthesis_desc d = read_descriptor(static_cast<const nook_bake_synthesis_desc*>(desc));
  need_threads(d.threads);
  need_unreserved(d.reserved);
  auto task = std::make_shared<const SynthesisTask>(synthesis_task_of(d));
  return start_job(d, [task](const StageReport& report) { return bake_synthesis_file(*task, report); });
}

nook_bake_job_s* start_transfer(const void* desc) {
  const nook_bake_transfer_desc d = read_descriptor(static_cast<const nook_bake_transfer_desc*>(desc));
  need_threads(d.threads);
  need_unreserved(d.reserved);
  auto task = std::make_shared<const TransferTask>(transfer_task_of(d));
  return start_job(d, [task](const StageReport& report) { return bake_transfer_file(*task, report); });
}

Starter starter_of(std::uint32_t type) {
  switch (type) {
    case NOOK_DESC_BAKE_CHARACTER:
      return start_character;
    case NOOK_DESC_BAKE_BENT:
      return start_bent;
    case NOOK_DESC_BAKE_CLIPS:
      return start_clips;
    case NOOK_DESC_BAKE_MATERIAL:
      return start_material;
    case NOOK_DESC_BAKE_SYNTHESIS:
      return start_synthesis;
    case NOOK_DESC_BAKE_TRANSFER:
      return start_transfer;
    default:
      return nullptr;
  }
}

}  // namespace nook::bake::api
