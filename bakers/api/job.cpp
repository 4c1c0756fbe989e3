// Starts a bake by the type of its descriptor, bakes a character's model, and owns the life of a job.
#include <nook/nook_bake.h>

#include "bakers/api/bake_descriptors.h"
#include "bakers/api/bake_entry.h"
#include "bakers/api/bake_handles.h"
#include "bakers/job/bake_job.h"
#include "bakers/job/caller_arrays.h"
#include "bakers/job/character_job.h"

using namespace nook;
using namespace nook::bake;

namespace {

[[noreturn]] void refuse_type(std::uint32_t type) {
  switch (type) {
#define NOOK_REFUSE_DESCRIPTOR(name, struct_type)                                                        \
  case NOOK_DESC_##name:                                                                                 \
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc is a " #struct_type                                 \
                                               ", which starts no bake; pass the descriptor of a bake, " \
                                               "such as nook_bake_character_desc");
    NOOK_BAKE_DESCRIPTORS(NOOK_REFUSE_DESCRIPTOR)
#undef NOOK_REFUSE_DESCRIPTOR
    default:
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "desc.type is unknown (got %u); call the init function of your descriptor, such as "
                    "nook_bake_character_desc_init",
                    type);
  }
}

const BakeJob& get(nook_bake_job job) {
  need(job, "job");
  return job->job;
}

}  // namespace

nook_bake_job_s* api::start_character(const void* desc) {
  using Study = nook_bake_character_study_desc;
  const auto settings =
      read_descriptor<nook_bake_character_desc, Study>(static_cast<const nook_bake_character_desc*>(desc));
  const Study* const given = find_extension<Study>(settings.next);
  const Study study = given ? read_descriptor(given) : default_desc<Study>();
  need(settings.character, "desc.character");
  const ImportedCharacter& imported = *settings.character->character;
  Recipe recipe = recipe_of(settings, study, imported);
  std::vector<Pose> extra =
      read_poses(settings.extra_poses_3x4, settings.extra_pose_count, imported.mesh.bones.size());
  CalibrationPoses calibration{
      read_poses(study.calibration_poses_3x4, study.calibration_pose_count, imported.mesh.bones.size())};
  return api::start_job(
      settings, [shared = settings.character->character, recipe = std::move(recipe), extra = std::move(extra),
                 calibration = std::move(calibration)](const StageReport& report) {
        return bake_by_recipe(*shared, recipe, extra, report, calibration);
      });
}

nook_result nook_bake_start(const void* desc, nook_bake_job* out) {
  return api::enter("nook_bake_start", [&] {
    need(out, "out");
    *out = nullptr;
    need(desc, "desc");
    const std::uint32_t type = head_of(desc).type;
    const api::Starter start = api::starter_of(type);
    if (!start) refuse_type(type);
    *out = start(desc);
  });
}

nook_result nook_bake_job_poll(nook_bake_job job, nook_bake_progress* progress) {
  return api::enter("nook_bake_job_poll",
                    [&] { write_info(progress, public_progress(get(job).progress())); });
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

nook_result nook_bake_job_file(nook_bake_job job, const void** bytes, size_t* size) {
  return api::enter("nook_bake_job_file", [&] {
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
