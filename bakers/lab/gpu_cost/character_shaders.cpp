#include "bakers/lab/gpu_cost/shader_cases.h"
#include "bakers/lab/gpu_cost/trip_counts.h"

namespace nook::lab {
namespace {

const std::string form_names[] = {"paper", "nook", "rational"};

Loop tiles(const char* over, bool runs) {
  return {over, runs ? trips::tiles : 0, {{"spheres of a tile", trips::spheres_in_tile, {}}}};
}

// The shader contains the loops of both ways to add casters. `composed` selects the way that is counted.
std::vector<Loop> shadow_loops(bool composed) {
  return {tiles("tiles of own spheres", true),
          {"casters",
           trips::casters,
           {tiles("tiles of a caster, composed", composed), tiles("tiles of a caster, one norm", !composed)}},
          {"exact spheres", trips::exact_spheres, {}}};
}

Loop lobes(const char* over, bool runs) {
  return {over, runs ? trips::light_lobes : 0, {}};
}

// The only exact sphere is the ground.
std::vector<Loop> colour_loops(bool composed) {
  return {
      tiles("tiles of own spheres", true),
      lobes("lobes on the open surface", true),
      {"casters",
       trips::casters,
       {tiles("tiles of a caster, composed", composed), lobes("lobes behind a caster", composed),
        tiles("tiles of a caster, one norm", !composed)}},
      {"exact spheres",
       trips::exact_spheres,
       {lobes("lobes above and below the ground", composed), lobes("lobes behind an exact sphere", false)}}};
}

std::string define(const char* name, int value) {
  return "#define " + std::string(name) + " " + std::to_string(value) + "\n";
}

constexpr char lit_character[] = R"(#include "shaders/character/host.glsl"
flat in int light;
in vec3 normal;
in vec3 occlusion;
out vec4 colour;
void main() { colour = vec4(nook_scene_irradiance(light, normalize(normal), occlusion), 1.0); }
)";

}  // namespace

std::vector<ShaderCase> character_shaders() {
  std::vector<ShaderCase> shaders;
  const auto add = [&](Stage stage, const char* file, const std::string& variant = "",
                       const std::string& defines = "", const std::vector<Loop>& loops = {}) {
    const std::string path = std::string("shaders/character/") + file;
    shaders.push_back(tree_shader(stage, path, file + variant, defines, loops));
  };
  // Bones without shear or non-uniform scale skip the search for the nearest rotation.
  add(Stage::compute, "pose_convert.comp", "", "",
      {{"bones of a thread", trips::bones_of_thread, {{"turns of an uneven bone", 0, {}}}}});
  add(Stage::compute, "pose_place.comp", "", "",
      {{"rows of a thread", trips::rows_of_bone * trips::bones_of_thread, {}}});
  // A mix of two frames is close to a rotation. The general projection to a rotation is therefore not needed
  // and not counted.
  add(Stage::compute, "clip_bones.comp", "", "",
      {{"weights of a thread", trips::pose_modes / trips::group_size, {}},
       {"bones of a thread",
        trips::bones_of_thread,
        {{"modes", trips::pose_modes, {}},
         {"steps to a rotation", trips::steps_to_rotation, {}},
         {"turns of an uneven bone", 0, {}}}}});
  add(Stage::compute, "spheres.comp");
  for (int form = 0; form < 3; ++form)
    for (const bool composed : {true, false}) {
      const std::string form_define = define("NOOK_KERNEL_FORM", form);
      const std::string variant = ", " + form_names[form] + (composed ? ", composed" : ", one norm");
      add(Stage::compute, "shadows.comp", variant, form_define, shadow_loops(composed));
      add(Stage::compute, "colours.comp", variant, form_define, colour_loops(composed));
    }
  add(Stage::compute, "spread.comp");
  add(Stage::compute, "colours_spread.comp");
  const std::string outputs[] = {"", ", light", ", grey among lit ones"};  // indexed by NOOK_OUTPUT
  for (int output = 0; output < 3; ++output)
    add(Stage::compute, "vertices.comp", outputs[output], define("NOOK_OUTPUT", output),
        {{"pairs of influences", trips::influence_pairs, {}}});
  for (const int light : {0, 1}) {
    const std::string lit = light ? ", light" : "", light_define = define("NOOK_LIGHT", light);
    for (const int quads : {1, 2})
      add(Stage::vertex, "vertices.vert", ", " + std::to_string(4 * quads) + " influences" + lit,
          define("NOOK_QUADS", quads) + light_define);
  }
  for (const int values : {1, 2, 4}) {
    const std::string bits = ", " + std::to_string(32 / values) + " bits";
    add(Stage::vertex, "pack.vert", bits, define("NOOK_VALUES_PER_WORD", values));
    add(Stage::compute, "pack_strided.comp", bits, define("NOOK_VALUES_PER_WORD", values));
  }
  shaders.push_back(host_shader(lit_character, "light of a character", {{"lobes", trips::light_lobes, {}}}));
  return shaders;
}

}  // namespace nook::lab
