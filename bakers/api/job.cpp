// Bake jobs: the conversion of a descriptor to a recipe, and the life of a job.
#include <nook/nook_bake_character.h>

#include "bakers/api/entry.h"
#include "bakers/api/handles.h"
#include "bakers/job/bake_pipeline.h"
#include "bakers/job/job_progress.h"
#include "bakers/job/job_recipe.h"
#include "bakers/job/pose_arrays.h"
#include "sdk/src/core/descriptors.h"

using namespace nook;
using namespace nook::bake;

namespace {

constexpr std::size_t first_job_desc = offsetof(nook_bake_job_desc, progress_user) + sizeof(void*);
constexpr std::size_t first_progress = offsetof(nook_bake_progress, total) + sizeof(std::uint64_t);

nook_bake_job_desc default_job_desc() {
  nook_bake_job_desc desc{};
  desc.struct_size = sizeof desc;
  desc.header_version = NOOK_VERSION;
  desc.preset = NOOK_BAKE_PRESET_STANDARD;
  desc.pose_mode = NOOK_BAKE_POSES_ALL;
  desc.seed = 1;
  return desc;
}

const BakeJob& get(nook_bake_job job) {
  need(job, "job");
  return job->job;
}

}  // namespace

nook_result nook_bake_job_desc_init(nook_bake_job_desc* desc, size_t size, uint32_t header_version) {
  return api::enter("nook_bake_job_desc_init",
                    [&] { init_descriptor(desc, size, header_version, first_job_desc, default_job_desc()); });
}

nook_result nook_bake_job_start(nook_bake_character character, const nook_bake_job_desc* desc,
                                nook_bake_job* out) {
  return api::enter("nook_bake_job_start", [&] {
    need(out, "out");
    *out = nullptr;
    need(character, "character");
    const nook_bake_job_desc settings =
        read_descriptor(desc, "nook_bake_job_desc_init", first_job_desc, default_job_desc());
    const ImportedCharacter& imported = *character->character;
    Recipe recipe = recipe_of(settings, imported);
    std::vector<Pose> extra =
        read_poses(settings.extra_poses_3x4, settings.extra_pose_count, imported.mesh.bones.size());
    auto bake = [shared = character->character, recipe = std::move(recipe), extra = std::move(extra)](
                    const StageReport& report) { return bake_by_recipe(*shared, recipe, extra, report); };
    *out = new nook_bake_job_s{
        BakeJob(std::move(bake), settings.threads, listener_of(settings.progress, settings.progress_user))};
  });
}

nook_result nook_bake_job_poll(nook_bake_job job, nook_bake_progress* progress) {
  return api::enter("nook_bake_job_poll",
                    [&] { write_info(progress, first_progress, public_progress(get(job).progress())); });
}

nook_result nook_bake_job_cancel(nook_bake_job job) {
  return api::enter("nook_bake_job_cancel", [&] {
    need(job, "job");
    job->job.cancel();
  });
}

nook_result nook_bake_job_wait(nook_bake_job job) {
  return api::enter("nook_bake_job_wait", [&] {
    get(job).wait();
    get(job).file();
  });
}

nook_result nook_bake_job_model(nook_bake_job job, const void** bytes, size_t* size) {
  return api::enter("nook_bake_job_model", [&] {
    need(bytes, "bytes");
    need(size, "size");
    const BakedFile& file = get(job).file();
    *bytes = file.model.data();
    *size = file.model.size();
  });
}

nook_result nook_bake_job_report(nook_bake_job job, const char** json) {
  return api::enter("nook_bake_job_report", [&] {
    need(json, "json");
    *json = get(job).file().report.c_str();
  });
}

void nook_bake_job_destroy(nook_bake_job* job) {
  if (!job) return;
  delete *job;
  *job = nullptr;
}
