// The start of jobs of radiance transfer; job.cpp has the other functions of jobs.
#include <nook/nook_bake_transfer.h>

#include "bakers/api/entry.h"
#include "bakers/api/handles.h"
#include "bakers/job/job_progress.h"
#include "bakers/job/transfer_bake.h"
#include "bakers/job/worker_arena.h"
#include "sdk/src/core/descriptors.h"

using namespace nook;
using namespace nook::bake;

namespace {

constexpr std::size_t first_transfer_desc = offsetof(nook_bake_transfer_desc, progress_user) + sizeof(void*);

nook_bake_transfer_desc default_transfer_desc() {
  const bake::transfer::BakeSettings settings;
  nook_bake_transfer_desc desc{};
  desc.struct_size = sizeof desc;
  desc.header_version = NOOK_VERSION;
  desc.lobes = settings.lobes;
  desc.ray_side = settings.side;
  desc.tiles = settings.tiles;
  return desc;
}

}  // namespace

nook_result nook_bake_transfer_desc_init(nook_bake_transfer_desc* desc, size_t size,
                                         uint32_t header_version) {
  return api::enter("nook_bake_transfer_desc_init", [&] {
    init_descriptor(desc, size, header_version, first_transfer_desc, default_transfer_desc());
  });
}

nook_result nook_bake_transfer_start(const nook_bake_transfer_desc* desc, nook_bake_job* out) {
  return api::enter("nook_bake_transfer_start", [&] {
    need(out, "out");
    *out = nullptr;
    const nook_bake_transfer_desc d =
        read_descriptor(desc, "nook_bake_transfer_desc_init", first_transfer_desc, default_transfer_desc());
    need_threads(d.threads);
    if (d.reserved != 0)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.reserved is %u, need 0", d.reserved);
    if (d.reserved_2 != 0)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.reserved_2 is %u, need 0", d.reserved_2);
    auto task = std::make_shared<TransferTask>(transfer_task_of(d));
    auto bake = [task](const StageReport& report) { return bake_transfer_file(*task, report); };
    *out = new nook_bake_job_s{BakeJob(std::move(bake), d.threads, listener_of(d.progress, d.progress_user))};
  });
}
