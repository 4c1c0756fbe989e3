// Why a bake has to run, and how long it will take.
#pragma once

#include <string>
#include <vector>

#include "bakers/tool/plan/jobs.h"
#include "bakers/tool/plan/memory.h"

namespace nook::tool::plan {

// Compares the identity of a bake with the identity in its output.
std::string reason_of(const Job& job, const std::string& identity, const std::string& there, bool exists,
                      bool was_there);

// Returns seconds on one machine. The report of the last bake has them. Without a report they are the time of
// the preset, scaled by the size of the files that are read; only the order of tasks depends on them.
double estimate_s(const Job& job, const std::vector<StampedFile>& read);

}  // namespace nook::tool::plan
