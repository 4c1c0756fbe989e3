// From a recipe to the bytes of a .nook file and a report.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "character/recipe.h"

namespace nook::bake {

struct BakedFile {
  std::vector<std::byte> model;
  std::string report;  // JSON
};

// Throws Failure: INVALID_ARGUMENT (no poses, settings out of range), CANCELLED.
BakedFile bake_by_recipe(const ImportedCharacter& character, const Recipe& recipe,
                         std::span<const Pose> extra_poses, const BakeProgress& progress);

}  // namespace nook::bake
