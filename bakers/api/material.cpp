// The start of material jobs; job.cpp has the other functions of jobs.
#include <nook/nook_bake.h>

#include "bakers/api/descriptor_list.h"
#include "bakers/api/handles.h"
#include "bakers/api/starters.h"
#include "bakers/job/job_progress.h"
#include "bakers/job/material_bake.h"
#include "bakers/material/raw_material.h"

using namespace nook;
using namespace nook::bake;

nook_bake_job_s* api::start_material(const void* desc) {
  const nook_bake_material_desc d = read_descriptor(static_cast<const nook_bake_material_desc*>(desc));
  auto task = std::make_shared<MaterialTask>(material_task_of(d));
  auto bake = [task](const StageReport& report) { return bake_material(*task, report); };
  return new nook_bake_job_s{BakeJob(std::move(bake), d.threads, listener_of(d.progress, d.progress_user))};
}
