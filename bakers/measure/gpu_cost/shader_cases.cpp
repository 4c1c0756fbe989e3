#include "bakers/measure/gpu_cost/shader_cases.h"

namespace nook::measure {
namespace {

// Both dimensions of the surface are halved.
constexpr double quarter = 0.25;

PassCase nnao(const std::string& name, const std::string& occlusion, bool half, bool paper = false) {
  const std::string size = half ? ", half" : "";
  const double share = half ? quarter : 1;
  PassCase pass{name + size, {{"depth.frag" + size, share}, {occlusion + size, share}, {"resolve.frag" + size, 1}}};
  if (paper) pass.shaders.push_back({"normals.frag" + size, share});
  if (half) pass.shaders.push_back({"filter.frag" + size, share});
  return pass;
}

}  // namespace

ShaderCase tree_shader(Stage stage, const std::string& path, const std::string& name,
                       const std::string& defines, const std::vector<Loop>& loops) {
  return {name, stage, path, "", defines, loops, {}};
}

ShaderCase host_shader(const std::string& text, const std::string& name, const std::vector<Loop>& loops) {
  return {name, Stage::fragment, "", text, "", loops, {}};
}

std::vector<ShaderCase> all_shaders() {
  std::vector<ShaderCase> shaders;
  for (const auto& room :
       {character_shaders(), nnao_shaders(), baseline_shaders(), probe_shaders(), material_shaders()})
    shaders.insert(shaders.end(), room.begin(), room.end());
  return shaders;
}

std::vector<PassCase> all_passes() {
  std::vector<PassCase> passes;
  for (const bool half : {false, true})
    for (const std::string taps : {"9", "16", "32", "64"})
      passes.push_back(nnao("NNAO " + taps, "occlusion.frag, " + taps, half));
  for (const std::string taps : {"16", "64"}) {
    passes.push_back(nnao("NNAO " + taps + ", compute", "occlusion.comp, " + taps, false));
    passes.push_back(nnao("NNAO, paper's form, " + taps, "occlusion.frag, paper's form, " + taps, false, true));
  }
  for (const ShaderCase& shader : baseline_shaders())
    if (shader.name != baseline_blur) passes.push_back({shader.name, {{shader.name, 1}, {baseline_blur, 2}}});
  return passes;
}

}  // namespace nook::measure
