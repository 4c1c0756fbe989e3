#include "bakers/lab/gpu_cost/shader_cases.h"
#include "bakers/lab/gpu_cost/trip_counts.h"

namespace nook::lab {
namespace {

// Returns a host's shader that evaluates one caster at a point with the function `call`.
std::string caster_host(const char* call) {
  return std::string(
             "#include \"shaders/world/casters.glsl\"\n"
             "in vec3 point;\nin vec3 facing;\nout vec4 colour;\n"
             "void main() { colour = vec4(")
      .append(call)
      .append("(0, point, facing)); }\n");
}

Loop branch(const char* over, double share, std::vector<Loop> inside = {}) {
  return {over, share, std::move(inside), true};
}

// Returns the loops of darken.comp. If `shares` is true, branches are weighted by the share of threads that
// take them.
std::vector<Loop> near_groups(bool shares) {
  std::vector<Loop> part{{"casters of a part", trips::casters_of_group_part, {}}};
  if (shares) part.insert(part.begin(), branch("limbs of one capsule", trips::merged_parts));
  std::vector<Loop> loops{
      {"reads of a list of near bodies",
       1,
       {{"bodies that the group keeps",
         trips::near_bodies_of_group,
         {{"parts of a body", trips::parts_of_group_body, part}}}}},
      {"texels of far bodies round the group", 1, {}},
      {"bodies of a tile, where no texel of far bodies is near", trips::alone * trips::bodies_of_tile, {}}};
  if (!shares) return loops;
  loops.back().inside = {branch("bodies in reach", trips::far_bodies_in_reach,
                                {branch("far bodies", trips::far_bodies_in_reach)})};
  loops.insert(loops.begin(),
               branch("pixels of the viewport", 1,
                      {branch("surfaces", 1, {branch("without a normal", trips::no_normal)})}));
  return loops;
}

std::vector<Loop> far_groups(bool shares) {
  std::vector<Loop> list{{"bodies that the group keeps",
                          trips::far_bodies_of_group * trips::bodies_read / trips::bodies_of_tile,
                          {}}};
  if (shares) {
    list[0].inside = {branch("bodies in reach", trips::far_bodies_in_reach)};
    list.insert(list.begin(), branch("bodies that the list has", 1));
  }
  const Loop readings{"reads of a list of far bodies", trips::bodies_of_tile / trips::bodies_read, list};
  if (!shares) return {readings};
  return {branch("pixels of the viewport", 1,
                 {branch("surfaces", 1, {branch("without a normal", trips::no_normal)})}),
          branch("surfaces round which the box lies", 1), readings};
}

constexpr char coloured_host[] =
    "#define NOOK_COLOURED 1\n"
    "#include \"shaders/world/casters.glsl\"\n"
    "in vec3 point;\nin vec3 facing;\nout vec4 colour;\n"
    "void main() {\n"
    "  float open = nook_world_caster_open(0, point, facing);\n"
    "  colour = vec4(nook_world_open_light(facing, open), open);\n"
    "}\n";

constexpr char cone_host[] =
    "#define NOOK_COLOURED 1\n"
    "#include \"shaders/world/casters.glsl\"\n"
    "in vec4 end_a;\nin vec4 to_b;\nflat in int part;\nout vec4 colour;\n"
    "void main() { colour = vec4(nook_part_coverage(end_a, to_b, nook_world_cone[part])); }\n";

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
  std::vector<Loop> layered_loops{{"steps along x past characters", trips::steps_past_characters, {}},
                                  {"steps along y past characters", trips::steps_past_characters, {}}};
  layered_loops.push_back(loops.front());
  const char* const path = "shaders/world/darken.frag";
  const char* const resolve = "shaders/world/resolve.frag";
  const char* const groups = "shaders/world/darken.comp";
  const std::string full = "#define NOOK_HALF 0\n", half = "#define NOOK_HALF 1\n",
                    near = "#define NOOK_BODIES NOOK_NEAR_BODIES\n",
                    far = "#define NOOK_BODIES NOOK_FAR_BODIES\n";
  return {
      tree_shader(Stage::fragment, path, "darken.frag", full, loops),
      tree_shader(Stage::fragment, path, "darken.frag, layered", full + "#define NOOK_LAYERED 1\n",
                  layered_loops),
      tree_shader(Stage::fragment, path, "darken.frag, half resolution, near bodies", half + near,
                  near_loops),
      tree_shader(Stage::fragment, path, "darken.frag, far bodies", half + far, far_loops),
      tree_shader(Stage::compute, groups, "darken.comp, near bodies", half + near, near_groups(false)),
      tree_shader(Stage::compute, groups, "darken.comp, near bodies, by shares", half + near,
                  near_groups(true)),
      tree_shader(Stage::compute, groups, "darken.comp, far bodies", half + far, far_groups(false)),
      tree_shader(Stage::compute, groups, "darken.comp, far bodies, by shares", half + far, far_groups(true)),
      tree_shader(Stage::fragment, resolve, "resolve.frag of the world pass", half),
      tree_shader(Stage::fragment, resolve, "resolve.frag of the world pass, gathers",
                  half + "#define NOOK_GATHERS 1\n"),
      host_shader(caster_host("nook_world_caster_open"), "one caster of the world pass"),
      host_shader(caster_host("nook_world_whole_open"), "one capsule for a limb or a body"),
      host_shader(coloured_host, "one caster by channel, with the light of its point"),
      host_shader(cone_host, "one caster before one part of a cone of light")};
}

}  // namespace nook::lab
