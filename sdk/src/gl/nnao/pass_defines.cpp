#include "sdk/src/gl/nnao/pass_defines.h"

#include <cstdio>
#include <cstring>

namespace nook::gl {

PassDefines pass_defines(const NnaoSettings& desc, bool horizon, const nnao::TapGrid& grid) {
  PassDefines defines;
  std::snprintf(
      defines.text, sizeof defines.text,
      "#define NOOK_HALF %d\n#define NOOK_HORIZON %d\n#define NOOK_DIRECTIONS %u\n#define NOOK_STEPS %u\n"
      "#define NOOK_BENT_NORMALS %d\n#define NOOK_TEMPORAL %d\n",
      desc.half_resolution != 0, horizon, grid.directions, grid.steps, desc.bent_normals,
      desc.max_history_frames != 0);
  std::size_t used = std::strlen(defines.text);
  if (desc.views > 0)
    used += std::size_t(
        std::snprintf(defines.text + used, sizeof defines.text - used, "#define NOOK_LAYERS 1\n"));
  if (desc.depth_samples > 0)
    used += std::size_t(std::snprintf(defines.text + used, sizeof defines.text - used,
                                      "#define NOOK_SAMPLES %d\n#define NOOK_SAMPLE_RULE %d\n",
                                      desc.depth_samples, desc.depth_sample));
  if (desc.normal_samples > 0)
    std::snprintf(defines.text + used, sizeof defines.text - used, "#define NOOK_NORMAL_SAMPLES 1\n");
  return defines;
}

}  // namespace nook::gl
