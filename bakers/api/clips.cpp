// The start of jobs of clips; job.cpp has the other functions of jobs.
#include <nook/nook_bake_clips.h>

#include "bakers/api/entry.h"
#include "bakers/api/handles.h"
#include "bakers/job/character_model.h"
#include "bakers/job/clip_bake.h"
#include "bakers/job/job_progress.h"
#include "bakers/job/worker_arena.h"
#include "sdk/src/core/descriptors.h"

using namespace nook;
using namespace nook::bake;

namespace {

constexpr std::size_t first_clips_desc = offsetof(nook_bake_clips_desc, progress_user) + sizeof(void*);

nook_bake_clips_desc default_clips_desc() {
  const ClipTask task;
  nook_bake_clips_desc desc{};
  desc.struct_size = sizeof desc;
  desc.header_version = NOOK_VERSION;
  desc.rays = task.rays;
  desc.frames_per_second = float(task.frames_per_second);
  desc.max_error = float(task.tables.max_error);
  desc.max_bytes = float(task.tables.max_bytes);
  desc.max_modes = task.tables.max_modes;
  desc.seed = task.tables.seed;
  return desc;
}

}  // namespace

nook_result nook_bake_clips_desc_init(nook_bake_clips_desc* desc, size_t size, uint32_t header_version) {
  return api::enter("nook_bake_clips_desc_init", [&] {
    init_descriptor(desc, size, header_version, first_clips_desc, default_clips_desc());
  });
}

nook_result nook_bake_clips_start(nook_bake_character character, const nook_bake_clips_desc* desc,
                                  nook_bake_job* out) {
  return api::enter("nook_bake_clips_start", [&] {
    need(out, "out");
    *out = nullptr;
    need(character, "character");
    const nook_bake_clips_desc d =
        read_descriptor(desc, "nook_bake_clips_desc_init", first_clips_desc, default_clips_desc());
    need_threads(d.threads);
    if (d.reserved != 0)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.reserved is %u, need 0", d.reserved);
    need(d.model, "desc.model");
    const ImportedCharacter& imported = *character->character;
    ClipTask task = clip_task_of(d);
    const CharacterModel model =
        model_of_character({static_cast<const std::byte*>(d.model), d.model_size}, imported);
    ClipFrames frames = frames_of(imported, task);
    auto bake = [shared = character->character, model = std::make_shared<const CharacterModel>(model),
                 frames = std::move(frames), task = std::move(task)](const StageReport& report) {
      return bake_clips_file(*shared, *model, frames, task, report);
    };
    *out = new nook_bake_job_s{BakeJob(std::move(bake), d.threads, listener_of(d.progress, d.progress_user))};
  });
}
