// The page of a recorded frame of the screen-space pass.
#pragma once

#include "bakers/measure/report/page.h"
#include "sdk/src/nnao/recording.h"

namespace nook::report {

PageParts frame_parts(const nook::nnao::Recording& recording);

}  // namespace nook::report
