// Makes the bytes of a .nook file and a report from a material task.
#pragma once

#include "api/baked_file.h"
#include "api/material_task.h"

namespace nook::bake {

// Consumes the task's measured data. Throws Failure: INVALID_ARGUMENT (the data do not allow the ranks, or a
// structure cannot be built), CANCELLED.
BakedFile bake_material(api::MaterialTask& task, const StageReport& progress);

}  // namespace nook::bake
