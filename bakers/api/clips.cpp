// The start of jobs of clips; job.cpp has the other functions of jobs.
#include <nook/nook_bake.h>

#include "bakers/api/descriptor_list.h"
#include "bakers/api/handles.h"
#include "bakers/api/starters.h"
#include "bakers/job/character_model.h"
#include "bakers/job/clip_bake.h"
#include "bakers/job/job_progress.h"
#include "bakers/job/worker_arena.h"

using namespace nook;
using namespace nook::bake;

nook_bake_job_s* api::start_clips(const void* desc) {
  const nook_bake_clips_desc d = read_descriptor(static_cast<const nook_bake_clips_desc*>(desc));
  need(d.character, "desc.character");
  need_threads(d.threads);
  if (d.reserved != 0) throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.reserved is %u, need 0", d.reserved);
  need(d.model, "desc.model");
  const ImportedCharacter& imported = *d.character->character;
  ClipTask task = clip_task_of(d);
  const CharacterModel model =
      model_of_character({static_cast<const std::byte*>(d.model), d.model_size}, imported);
  ClipFrames frames = frames_of(imported, task);
  auto bake = [shared = d.character->character, model = std::make_shared<const CharacterModel>(model),
               frames = std::move(frames), task = std::move(task)](const StageReport& report) {
    return bake_clips_file(*shared, *model, frames, task, report);
  };
  return new nook_bake_job_s{BakeJob(std::move(bake), d.threads, listener_of(d.progress, d.progress_user))};
}
