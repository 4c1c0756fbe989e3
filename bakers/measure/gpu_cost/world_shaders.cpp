#include "bakers/measure/gpu_cost/shader_cases.h"
#include "bakers/measure/gpu_cost/trip_counts.h"

namespace nook::measure {
namespace {

// One caster at a point, in the form that `call` names.
std::string caster_host(const char* call) {
  return std::string(
             "#include \"shaders/world/casters.glsl\"\n"
             "in vec3 point;\nin vec3 facing;\nout vec4 colour;\n"
             "void main() { colour = vec4(")
      .append(call)
      .append("(0, point, facing)); }\n");
}

constexpr char cone_host[] =
    "#define NOOK_COLOURED 1\n"
    "#include \"shaders/world/casters.glsl\"\n"
    "in vec4 end_a;\nin vec4 end_b;\nflat in int part;\nout vec4 colour;\n"
    "void main() { colour = vec4(nook_part_coverage(end_a, end_b, nook_world_cone[part])); }\n";

}  // namespace

std::vector<ShaderCase> world_shaders() {
  const std::vector<Loop> loops{
      {"bodies of a tile",
       trips::bodies_of_tile,
       {{"parts of a body", trips::parts_of_body, {{"casters of a part", trips::casters_of_part, {}}}}}}};
  const std::vector<Loop> near_loops{
      {"near bodies of a tile",
       trips::near_bodies_of_tile,
       {{"parts of a body", trips::parts_of_near_body, {{"casters of a part", trips::casters_of_part, {}}}}}},
      {"bodies of a tile, where no texel of far bodies is near", trips::alone * trips::bodies_of_tile, {}}};
  const std::vector<Loop> far_loops{{"bodies of a tile", trips::bodies_of_tile, {}}};
  const char* const path = "shaders/world/darken.frag";
  const char* const resolve = "shaders/world/resolve.frag";
  const std::string full = "#define NOOK_HALF 0\n", half = "#define NOOK_HALF 1\n";
  return {
      tree_shader(Stage::fragment, path, "darken.frag", full, loops),
      tree_shader(Stage::fragment, path, "darken.frag, layered", full + "#define NOOK_LAYERED 1\n", loops),
      tree_shader(Stage::fragment, path, "darken.frag, half resolution, near bodies",
                  half + "#define NOOK_BODIES NOOK_NEAR_BODIES\n", near_loops),
      tree_shader(Stage::fragment, path, "darken.frag, far bodies",
                  half + "#define NOOK_BODIES NOOK_FAR_BODIES\n", far_loops),
      tree_shader(Stage::fragment, resolve, "resolve.frag of the world pass", half),
      host_shader(caster_host("nook_world_caster_open"), "one caster of the world pass"),
      host_shader(caster_host("nook_world_merged_open"), "one capsule for a limb or a body"),
      host_shader(cone_host, "one caster before one part of a cone of light")};
}

}  // namespace nook::measure
