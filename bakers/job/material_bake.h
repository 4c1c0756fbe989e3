// Makes the bytes of a .nook file and a report from a material task.
#pragma once

#include "bakers/job/baked_file.h"
#include "bakers/job/material_task.h"

namespace nook::bake {

// Consumes the task's measured data. Throws Failure: INVALID_ARGUMENT (ranks that the data do not allow, a
// structure that cannot be built), CANCELLED.
BakedFile bake_material(MaterialTask& task, const StageReport& progress);

}  // namespace nook::bake
