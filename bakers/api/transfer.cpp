// The start of jobs of radiance transfer; job.cpp has the other functions of jobs.
#include <nook/experimental/nook_bake_materials.h>

#include "bakers/api/descriptor_list.h"
#include "bakers/api/handles.h"
#include "bakers/api/starters.h"
#include "bakers/job/job_progress.h"
#include "bakers/job/transfer_bake.h"
#include "bakers/job/worker_arena.h"

using namespace nook;
using namespace nook::bake;

nook_bake_job_s* api::start_transfer(const void* desc) {
  const nook_bake_transfer_desc d = read_descriptor(static_cast<const nook_bake_transfer_desc*>(desc));
  need_threads(d.threads);
  if (d.reserved != 0) throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.reserved is %u, need 0", d.reserved);
  auto task = std::make_shared<TransferTask>(transfer_task_of(d));
  auto bake = [task](const StageReport& report) { return bake_transfer_file(*task, report); };
  return new nook_bake_job_s{BakeJob(std::move(bake), d.threads, listener_of(d.progress, d.progress_user))};
}
