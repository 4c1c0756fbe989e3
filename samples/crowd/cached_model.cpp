#include "samples/crowd/cached_model.h"

#include <chrono>
#include <cstdio>
#include <string_view>
#include <thread>

#include "platform/file_bytes.h"
#include "platform/progress_bar.h"
#include "samples/crowd/model_bake.h"

namespace crowd {
namespace {

// Shows a bake's progress until it is done.
void follow(const ModelBake& bake, bool quiet) {
  platform::ProgressBar bar(quiet);
  for (;;) {
    const nook_bake_progress progress = bake.progress();
    if (progress.state == NOOK_BAKE_DONE) return;
    const bool traces = std::string_view(progress.stage) == "ray tracing";
    bar.show(progress.stage, traces ? "poses" : "steps", progress.done, progress.total);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

std::filesystem::path cached_path(const Hero& hero, const ModelRequest& request) {
  // The name has the time of the program, so that a model which another build baked is never taken.
  std::error_code unknown;
  const auto built = std::filesystem::last_write_time("/proc/self/exe", unknown).time_since_epoch().count();
  char name[112];
  std::snprintf(name, sizeof name, "draft_%016llx_gamma%g_%08x_%016llx.nook",
                static_cast<unsigned long long>(hero.source_hash()), double(request.gamma), NOOK_VERSION,
                static_cast<unsigned long long>(built));
  return request.cache / name;
}

}  // namespace

std::vector<unsigned char> cached_model(const Hero& hero, const ModelRequest& request) {
  const std::filesystem::path path = cached_path(hero, request);
  if (std::filesystem::exists(path)) return platform::read_file(path);
  if (!request.quiet) std::fprintf(stderr, "baking %s\n", path.string().c_str());
  const ModelBake bake(hero, NOOK_BAKE_PRESET_DRAFT, request.gamma);
  follow(bake, request.quiet);
  std::vector<unsigned char> model = bake.model();
  platform::write_file(path, model.data(), model.size());
  return model;
}

}  // namespace crowd
