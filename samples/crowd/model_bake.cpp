#include "samples/crowd/model_bake.h"

namespace crowd {

ModelBake::ModelBake(const Hero& hero, nook_bake_preset preset, float gamma) {
  nook_bake_job_desc desc;
  check_bake(nook_bake_job_desc_init(&desc, sizeof desc, NOOK_VERSION));
  desc.preset = preset;
  desc.gamma = gamma;
  nook_bake_job handle = nullptr;
  check_bake(nook_bake_job_start(hero.handle(), &desc, &handle));
  job_.reset(handle);
}

nook_bake_progress ModelBake::progress() const {
  nook_bake_progress progress{};
  progress.struct_size = sizeof progress;
  check_bake(nook_bake_job_poll(job_.get(), &progress));
  return progress;
}

void ModelBake::cancel() {
  check_bake(nook_bake_job_cancel(job_.get()));
}

std::vector<unsigned char> ModelBake::model() const {
  check_bake(nook_bake_job_wait(job_.get()));
  const void* bytes = nullptr;
  std::size_t size = 0;
  check_bake(nook_bake_job_model(job_.get(), &bytes, &size));
  const auto* const first = static_cast<const unsigned char*>(bytes);
  return {first, first + size};
}

const char* stage_label(nook_bake_stage stage) {
  switch (stage) {
    case NOOK_BAKE_STAGE_RAYTRACE:
      return "ray tracing";
    case NOOK_BAKE_STAGE_INITIALISE:
      return "initialising";
    case NOOK_BAKE_STAGE_FIT:
      return "fitting";
    case NOOK_BAKE_STAGE_CASTERS:
      return "casters";
    default:
      return "waiting";
  }
}

}  // namespace crowd
