// Starts all bakes and computes their keys, except for characters, which are in job.cpp. Each job owns the
// data that it reads.
#include <nook/experimental/nook_bake_materials.h>
#include <nook/nook_bake.h>

#include "bakers/api/bake_descriptors.h"
#include "bakers/api/bake_handles.h"
#include "bakers/job/clip_bake.h"
#include "bakers/job/material_identity.h"
#include "bakers/job/synthesis_bake.h"
#include "bakers/job/transfer_bake.h"
#include "bakers/job/vertex_bakes.h"
#include "bakers/raytrace/worker_arena.h"

namespace nook::bake::api {
namespace {

std::span<const std::byte> bytes_of(const void* data, std::size_t size) {
  return {static_cast<const std::byte*>(data), size};
}

std::shared_ptr<const CharacterModel> model_of(const void* model, std::size_t size,
                                               const ImportedCharacter& character) {
  return std::make_shared<const CharacterModel>(model_of_character(bytes_of(model, size), character));
}

void need_unreserved(std::uint32_t reserved) {
  if (reserved != 0) throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.reserved is %u, need 0", reserved);
}

struct BentRequest {
  nook_bake_bent_desc settings;
  std::shared_ptr<const ImportedCharacter> character;
  std::shared_ptr<const CharacterModel> model;
  BentTask task;
  BakeIdentity identity;
};

BentRequest bent_request(const void* desc) {
  const nook_bake_bent_desc d = read_descriptor(static_cast<const nook_bake_bent_desc*>(desc));
  need(d.character, "desc.character");
  need_threads(d.threads);
  const BentTask task = bent_task_of(d);
  need(d.model, "desc.model");
  const std::shared_ptr<const ImportedCharacter>& imported = d.character->character;
  auto model = model_of(d.model, d.model_size, *imported);
  return {d, imported, std::move(model), task,
          identify_bent(*imported, bytes_of(d.model, d.model_size), task)};
}

struct ClipsRequest {
  nook_bake_clips_desc settings;
  std::shared_ptr<const ImportedCharacter> character;
  std::shared_ptr<const CharacterModel> model;
  ClipTask task;
  ClipFrames frames;
  BakeIdentity identity;
};

ClipsRequest clips_request(const void* desc) {
  const nook_bake_clips_desc d = read_descriptor(static_cast<const nook_bake_clips_desc*>(desc));
  need(d.character, "desc.character");
  need_threads(d.threads);
  need_unreserved(d.reserved);
  need(d.model, "desc.model");
  const std::shared_ptr<const ImportedCharacter>& imported = d.character->character;
  ClipTask task = clip_task_of(d);
  auto model = model_of(d.model, d.model_size, *imported);
  ClipFrames frames = frames_of(*imported, task);
  BakeIdentity identity = identify_clips(*imported, bytes_of(d.model, d.model_size), task);
  return {d, imported, std::move(model), std::move(task), std::move(frames), std::move(identity)};
}

nook_bake_job_s* start_bent(const void* desc) {
  BentRequest request = bent_request(desc);
  const nook_bake_bent_desc settings = request.settings;
  return start_job(settings, [request = std::move(request)](const StageReport& report) {
    return bake_bent_file(*request.character, *request.model, request.task, report, request.identity);
  });
}

nook_bake_job_s* start_clips(const void* desc) {
  ClipsRequest request = clips_request(desc);
  const nook_bake_clips_desc settings = request.settings;
  return start_job(settings, [request = std::move(request)](const StageReport& report) {
    return bake_clips_file(*request.character, *request.model, request.frames, request.task, report,
                           request.identity);
  });
}

nook_bake_job_s* start_material(const void* desc) {
  const nook_bake_material_desc d = read_descriptor(static_cast<const nook_bake_material_desc*>(desc));
  auto task = std::make_shared<MaterialTask>(material_task_of(d));
  return start_job(d, [task](const StageReport& report) { return bake_material(*task, report); });
}

nook_bake_synthesis_desc synthesis_settings(const void* desc) {
  const auto d = read_descriptor(static_cast<const nook_bake_synthesis_desc*>(desc));
  need_threads(d.threads);
  need_unreserved(d.reserved);
  return d;
}

nook_bake_job_s* start_synthesis(const void* desc) {
  const nook_bake_synthesis_desc d = synthesis_settings(desc);
  auto task = std::make_shared<const SynthesisTask>(synthesis_task_of(d));
  return start_job(d, [task](const StageReport& report) { return bake_synthesis_file(*task, report); });
}

nook_bake_transfer_desc transfer_settings(const void* desc) {
  const auto d = read_descriptor(static_cast<const nook_bake_transfer_desc*>(desc));
  need_threads(d.threads);
  need_unreserved(d.reserved);
  return d;
}

nook_bake_job_s* start_transfer(const void* desc) {
  const nook_bake_transfer_desc d = transfer_settings(desc);
  auto task = std::make_shared<const TransferTask>(transfer_task_of(d));
  return start_job(d, [task](const StageReport& report) { return bake_transfer_file(*task, report); });
}

}  // namespace

Bake bake_of(std::uint32_t type) {
  switch (type) {
    case NOOK_DESC_BAKE_CHARACTER:
      return character_bake();
    case NOOK_DESC_BAKE_BENT:
      return {start_bent, [](const void* desc) { return bent_request(desc).identity; }};
    case NOOK_DESC_BAKE_CLIPS:
      return {start_clips, [](const void* desc) { return clips_request(desc).identity; }};
    case NOOK_DESC_BAKE_MATERIAL:
      return {start_material, [](const void* desc) {
                const auto d = read_descriptor(static_cast<const nook_bake_material_desc*>(desc));
                return identify_material(material_task_of(d));
              }};
    case NOOK_DESC_BAKE_SYNTHESIS:
      return {start_synthesis, [](const void* desc) {
                return identify_synthesis(synthesis_task_of(synthesis_settings(desc)));
              }};
    case NOOK_DESC_BAKE_TRANSFER:
      return {start_transfer,
              [](const void* desc) { return identify_transfer(transfer_task_of(transfer_settings(desc))); }};
    default:
      return {};
  }
}

}  // namespace nook::bake::api
