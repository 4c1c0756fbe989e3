// The numbers of nook_scene_specular_occlusion on the CPU, and the header that holds them.
#pragma once

#include <string>

#include "sdk/src/nnao/lighting.h"

namespace nook::measure {

nook::nnao::SpecularNumbers character_specular_numbers();

// Returns shaders/character/specular_numbers.h.
std::string character_specular_header(const nook::nnao::SpecularNumbers& numbers);

}  // namespace nook::measure
