#include "bakers/measure/gpu_cost/shader_cases.h"
#include "bakers/measure/gpu_cost/trip_counts.h"

namespace nook::measure {

std::vector<ShaderCase> world_shaders() {
  const std::vector<Loop> loops{
      {"bodies", trips::bodies, {{"casters of a body", trips::casters_of_body, {}}}}};
  const char* const path = "shaders/world/darken.frag";
  return {tree_shader(Stage::fragment, path, "darken.frag", "", loops),
          tree_shader(Stage::fragment, path, "darken.frag, layered", "#define NOOK_LAYERED 1\n", loops)};
}

}  // namespace nook::measure
