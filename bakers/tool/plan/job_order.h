// Finds which bakes need the outputs of others, and orders the bakes accordingly.
#pragma once

#include <vector>

#include "bakers/tool/plan/jobs.h"

namespace nook::tool::plan {

// Sets `needs` and `group` of each job, and sorts the jobs. Throws ToolError (bad input) like jobs_of().
std::vector<Job> ordered_jobs(const Manifest& manifest, std::vector<Job> jobs);

}  // namespace nook::tool::plan
