// Starts the bake that a descriptor's type selects and computes its key, bakes a character's model, and
// creates and destroys jobs.
#include <nook/experimental/nook_bake_key.h>
#include <nook/nook_bake.h>

#include <cstring>

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
#define NOOK_REFUSE_DESCRIPTOR(name, struct_type)                                                          \
  case NOOK_DESC_##name:                                                                                   \
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc is a " #struct_type                                   \
                                               ", which does not start a bake; pass a descriptor such as " \
                                               "nook_bake_character_desc");
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

// The bake that a descriptor requests.
struct CharacterRequest {
  nook_bake_character_desc settings;
  std::shared_ptr<const ImportedCharacter> character;
  Recipe recipe;
  std::vector<Pose> extra;
  CalibrationPoses calibration;
};

CharacterRequest character_request(const void* desc) {
  using Study = nook_bake_character_study_desc;
  const auto settings =
      read_descriptor<nook_bake_character_desc, Study>(static_cast<const nook_bake_character_desc*>(desc));
  const Study* const given = find_extension<Study>(settings.next);
  const Study study = given ? read_descriptor(given) : default_desc<Study>();
  need(settings.character, "desc.character");
  const std::shared_ptr<const ImportedCharacter>& imported = settings.character->character;
  const std::size_t bones = imported->mesh.bones.size();
  Recipe recipe = recipe_of(settings, study, *imported);
  recipe.meshes = settings.character->meshes;
  return {settings,
          imported,
          std::move(recipe),
          read_poses(settings.extra_poses_3x4, settings.extra_pose_count, bones),
          {read_poses(study.calibration_poses_3x4, study.calibration_pose_count, bones)}};
}

nook_bake_job_s* start_character(const void* desc) {
  CharacterRequest request = character_request(desc);
  const nook_bake_character_desc settings = request.settings;
  return api::start_job(settings, [request = std::move(request)](const StageReport& report) {
    return bake_by_recipe(*request.character, request.recipe, request.extra, report, request.calibration);
  });
}

BakeIdentity identify_character_desc(const void* desc) {
  const CharacterRequest request = character_request(desc);
  return identify_character(*request.character, request.recipe, request.extra, request.calibration);
}

api::Bake need_bake(const void* desc) {
  need(desc, "desc");
  const std::uint32_t type = head_of(desc).type;
  const api::Bake bake = api::bake_of(type);
  if (!bake.start) refuse_type(type);
  return bake;
}

}  // namespace

api::Bake api::character_bake() {
  return {start_character, identify_character_desc};
}

nook_result nook_bake_start(const void* desc, nook_bake_job* out) {
  return api::enter("nook_bake_start", [&] {
    need(out, "out");
    *out = nullptr;
    *out = need_bake(desc).start(desc);
  });
}

nook_result nook_bake_key(const void* desc, char* key, size_t size) {
  return api::enter("nook_bake_key", [&] {
    need(key, "key");
    if (size < NOOK_BAKE_KEY_SIZE)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "size is too small (got %zu, need %d bytes)", size,
                    NOOK_BAKE_KEY_SIZE);
    const std::string text = need_bake(desc).identify(desc).key();
    std::memcpy(key, text.c_str(), text.size() + 1);
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
