// The start of jobs of bent normals; job.cpp has the other functions of jobs.
#include <nook/nook_bake_bent.h>

#include "bakers/api/entry.h"
#include "bakers/api/handles.h"
#include "bakers/job/bent_bake.h"
#include "bakers/job/character_model.h"
#include "bakers/job/job_progress.h"
#include "bakers/job/worker_arena.h"
#include "sdk/src/core/descriptors.h"

using namespace nook;
using namespace nook::bake;

namespace {

constexpr std::size_t first_bent_desc = offsetof(nook_bake_bent_desc, progress_user) + sizeof(void*);

nook_bake_bent_desc default_bent_desc() {
  const BentTask task;
  nook_bake_bent_desc desc{};
  desc.struct_size = sizeof desc;
  desc.header_version = NOOK_VERSION;
  desc.rays = task.rays;
  desc.auto_pose_count = task.auto_poses;
  desc.samples_per_clip = task.samples_per_clip;
  desc.seed = task.seed;
  return desc;
}

}  // namespace

nook_result nook_bake_bent_desc_init(nook_bake_bent_desc* desc, size_t size, uint32_t header_version) {
  return api::enter("nook_bake_bent_desc_init", [&] {
    init_descriptor(desc, size, header_version, first_bent_desc, default_bent_desc());
  });
}

nook_result nook_bake_bent_start(nook_bake_character character, const nook_bake_bent_desc* desc,
                                 nook_bake_job* out) {
  return api::enter("nook_bake_bent_start", [&] {
    need(out, "out");
    *out = nullptr;
    need(character, "character");
    const nook_bake_bent_desc d =
        read_descriptor(desc, "nook_bake_bent_desc_init", first_bent_desc, default_bent_desc());
    need_threads(d.threads);
    const BentTask task = bent_task_of(d);
    need(d.model, "desc.model");
    auto model = std::make_shared<const CharacterModel>(
        model_of_character({static_cast<const std::byte*>(d.model), d.model_size}, *character->character));
    auto bake = [shared = character->character, model = std::move(model), task](const StageReport& report) {
      return bake_bent_file(*shared, *model, task, report);
    };
    *out = new nook_bake_job_s{BakeJob(std::move(bake), d.threads, listener_of(d.progress, d.progress_user))};
  });
}
