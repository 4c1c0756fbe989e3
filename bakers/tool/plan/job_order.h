// Which bake needs which, and an order that respects it.
#pragma once

#include <vector>

#include "bakers/tool/plan/jobs.h"

namespace nook::tool::plan {

// Fills `needs` and `group`, and sorts. Throws ToolError (bad input) as jobs_of() does.
std::vector<Job> ordered_jobs(const Manifest& manifest, std::vector<Job> jobs);

}  // namespace nook::tool::plan
