// The start of jobs of synthesis; job.cpp has the other functions of jobs.
#include <nook/nook_bake_synthesis.h>

#include "bakers/api/entry.h"
#include "bakers/api/handles.h"
#include "bakers/job/job_progress.h"
#include "bakers/job/synthesis_bake.h"
#include "bakers/job/worker_arena.h"
#include "sdk/src/core/descriptors.h"

using namespace nook;
using namespace nook::bake;

namespace {

constexpr std::size_t first_synthesis_desc =
    offsetof(nook_bake_synthesis_desc, progress_user) + sizeof(void*);

nook_bake_synthesis_desc default_synthesis_desc() {
  const bake::synthesis::SynthesisSettings settings;
  nook_bake_synthesis_desc desc{};
  desc.struct_size = sizeof desc;
  desc.header_version = NOOK_VERSION;
  desc.is_tiling = 1;
  desc.side = settings.side;
  desc.jitter = settings.jitter;
  desc.passes = settings.passes;
  desc.seed = settings.seed;
  return desc;
}

}  // namespace

nook_result nook_bake_synthesis_desc_init(nook_bake_synthesis_desc* desc, size_t size,
                                          uint32_t header_version) {
  return api::enter("nook_bake_synthesis_desc_init", [&] {
    init_descriptor(desc, size, header_version, first_synthesis_desc, default_synthesis_desc());
  });
}

nook_result nook_bake_synthesis_start(const nook_bake_synthesis_desc* desc, nook_bake_job* out) {
  return api::enter("nook_bake_synthesis_start", [&] {
    need(out, "out");
    *out = nullptr;
    const nook_bake_synthesis_desc d = read_descriptor(desc, "nook_bake_synthesis_desc_init",
                                                       first_synthesis_desc, default_synthesis_desc());
    need_threads(d.threads);
    if (d.reserved != 0)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.reserved is %u, need 0", d.reserved);
    auto task = std::make_shared<SynthesisTask>(synthesis_task_of(d));
    auto bake = [task](const StageReport& report) { return bake_synthesis_file(*task, report); };
    *out = new nook_bake_job_s{BakeJob(std::move(bake), d.threads, listener_of(d.progress, d.progress_user))};
  });
}
