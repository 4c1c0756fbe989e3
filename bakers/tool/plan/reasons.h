// Finds out why a bake has to run, and estimates how long it will take.
#pragma once

#include <string>
#include <vector>

#include "bakers/tool/plan/jobs.h"
#include "bakers/tool/plan/memory.h"

namespace nook::tool::plan {

// Returns the reason, by comparing the identity of a bake with the identity in its output.
std::string reason_of(const Job& job, const std::string& identity, const std::string& there, bool exists,
                      bool was_there);

// Returns the estimated seconds on one machine. They come from the report of the last bake. Without a report,
// they are the typical time of the preset, scaled by the size of the files that are read. Only the order of
// tasks depends on the estimate.
double estimate_s(const Job& job, const std::vector<StampedFile>& read);

}  // namespace nook::tool::plan
