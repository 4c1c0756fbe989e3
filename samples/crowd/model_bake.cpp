#include "samples/crowd/model_bake.h"

namespace crowd {

ModelBake::ModelBake(const Hero& hero, nook_bake_preset preset, float gamma) {
  nook_bake_character_desc desc;
  check_bake(nook_bake_character_desc_init(&desc));
  desc.character = hero.handle();
  desc.preset = preset;
  desc.gamma = gamma;
  nook_bake_job handle = nullptr;
  check_bake(nook_bake_start_character(&desc, &handle));
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
  check_bake(nook_bake_job_file(job_.get(), &bytes, &size));
  const auto* const first = static_cast<const unsigned char*>(bytes);
  return {first, first + size};
}

}  // namespace crowd
