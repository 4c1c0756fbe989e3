// The start of jobs of bent normals; job.cpp has the other functions of jobs.
#include <nook/nook_bake.h>

#include "bakers/api/descriptor_list.h"
#include "bakers/api/handles.h"
#include "bakers/api/starters.h"
#include "bakers/job/bent_bake.h"
#include "bakers/job/character_model.h"
#include "bakers/job/job_progress.h"
#include "bakers/job/worker_arena.h"

using namespace nook;
using namespace nook::bake;

nook_bake_job_s* api::start_bent(const void* desc) {
  const nook_bake_bent_desc d = read_descriptor(static_cast<const nook_bake_bent_desc*>(desc));
  need(d.character, "desc.character");
  need_threads(d.threads);
  const BentTask task = bent_task_of(d);
  need(d.model, "desc.model");
  auto model = std::make_shared<const CharacterModel>(
      model_of_character({static_cast<const std::byte*>(d.model), d.model_size}, *d.character->character));
  auto bake = [shared = d.character->character, model = std::move(model), task](const StageReport& report) {
    return bake_bent_file(*shared, *model, task, report);
  };
  return new nook_bake_job_s{BakeJob(std::move(bake), d.threads, listener_of(d.progress, d.progress_user))};
}
