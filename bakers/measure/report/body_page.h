// The page of a character model.
#pragma once

#include <cstdint>

#include "bakers/measure/character/character_report.h"
#include "bakers/measure/report/page.h"

namespace nook::report {

struct BodySettings {
  std::uint32_t rays = 128;  // for each vertex and pose
  std::uint64_t seed = 1;
  std::size_t samples_per_clip = 0;      // 0: as many as max_rays allows, 2 to 20
  std::uint64_t max_rays = 400'000'000;  // of all poses together; a minute and a half on two cores
};

// Poses of the clips that the bake has not seen, or of all of them; of a file without clips those of the
// bake. Throws Failure(CANCELLED).
PageParts body_parts(const measure::BakedCharacter& baked, const BodySettings& settings,
                     const measure::StageProgress& progress);

}  // namespace nook::report
