#include "baked_hero.h"

#include <chrono>
#include <cstdio>
#include <cstring>
#include <string>
#include <thread>

#include "file_bytes.h"
#include "mannequin/mannequin.h"
#include "progress_line.h"

namespace crowd {
namespace {

struct JobRelease {
  void operator()(nook_bake_job job) const { nook_bake_job_destroy(&job); }
};
using Job = std::unique_ptr<nook_bake_job_s, JobRelease>;

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

void follow(nook_bake_job job, bool quiet) {
  ProgressLine line(quiet);
  for (;;) {
    nook_bake_progress progress{};
    progress.struct_size = sizeof progress;
    bake_check(nook_bake_job_poll(job, &progress));
    if (progress.stage == NOOK_BAKE_STAGE_DONE) return;
    line.show(stage_label(progress.stage), progress.stage == NOOK_BAKE_STAGE_RAYTRACE ? "poses" : "steps",
              progress.done, progress.total);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

std::filesystem::path cached_path(const BakeRequest& request) {
  // The time of the program is part of the name, so that another build's model is never taken for this one's.
  std::error_code unknown;
  const auto built = std::filesystem::last_write_time("/proc/self/exe", unknown).time_since_epoch().count();
  char name[112];
  std::snprintf(name, sizeof name, "draft_%016llx_gamma%g_%08x_%016llx.nook",
                static_cast<unsigned long long>(request.source_hash), double(request.gamma),
                nook_bake_version(), static_cast<unsigned long long>(built));
  return request.cache / name;
}

}  // namespace

std::vector<unsigned char> cached_model(const Hero& hero, const BakeRequest& request) {
  const std::filesystem::path path = cached_path(request);
  if (std::filesystem::exists(path)) return read_file(path);
  if (!request.quiet) std::fprintf(stderr, "baking %s\n", path.string().c_str());
  nook_bake_job_desc desc;
  bake_check(nook_bake_job_desc_init(&desc, sizeof desc, NOOK_VERSION));
  desc.preset = NOOK_BAKE_PRESET_DRAFT;
  desc.gamma = request.gamma;
  nook_bake_job handle = nullptr;
  bake_check(nook_bake_job_start(hero.handle(), &desc, &handle));
  const Job job(handle);
  follow(handle, request.quiet);
  bake_check(nook_bake_job_wait(handle));
  const void* bytes = nullptr;
  std::size_t size = 0;
  bake_check(nook_bake_job_model(handle, &bytes, &size));
  write_file(path, bytes, size);
  std::vector<unsigned char> model(size);
  std::memcpy(model.data(), bytes, size);
  return model;
}

std::vector<unsigned char> built_in_glb(const std::filesystem::path& cache) {
  const std::filesystem::path path = cache / "mannequin.glb";
  std::vector<unsigned char> bytes = nook_samples::mannequin::make_mannequin_glb();
  write_file(path, bytes.data(), bytes.size());
  return bytes;
}

}  // namespace crowd
