// Lists every shader that Nook ships and every baseline. Each entry has the shader's defines and the loops
// that the compiled shader contains.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bakers/lab/gpu_cost/instruction_count.h"
#include "bakers/lab/gpu_cost/shader_source.h"
#include "bakers/lab/nnao/screen_baselines.h"
#include "sdk/src/gl/material/material_glsl.h"

namespace nook::lab {

struct FamilyLoops {
  std::string family;
  std::vector<Loop> loops;
};

struct ShaderCase {
  std::string name;
  Stage stage = Stage::fragment;
  std::string path;  // path from the repository's root; empty for a host's shader
  std::string host;  // text of a host's shader, which includes the library files that it calls
  std::string defines;
  std::vector<Loop> loops;
  std::vector<FamilyLoops> other_families;  // for GPU families for which the compiler unrolls differently

  const std::vector<Loop>& loops_of(const std::string& family) const {
    for (const FamilyLoops& other : other_families)
      if (other.family == family) return other.loops;
    return loops;
  }
};

// Returns the case of a shader in the source tree.
ShaderCase tree_shader(Stage stage, const std::string& path, const std::string& name,
                       const std::string& defines = "", const std::vector<Loop>& loops = {});

// Returns the case of a host's fragment shader.
ShaderCase host_shader(const std::string& text, const std::string& name, const std::vector<Loop>& loops = {});

// Returns the beginning of the library's shader text for a material, without the last file of this text.
// `host` is the path of this last file relative to shaders/, such as material/host.glsl. The counted shader
// includes `host` from the source tree that is counted.
std::string material_declarations(const material::MaterialTables& tables, std::string_view host);
// Put this text in front of a material shader, so that it fetches each mode at two places along the pixel.
inline constexpr char two_fetches[] = "#define TWO_FETCHES\n";

// A pass: shaders that run one after the other, each for a share of the threads.
struct PassCase {
  std::string name;
  std::vector<std::pair<std::string, double>> shaders;
};

// Parts of names that baselines share. The denoiser computes two pixels per thread, and the depth levels
// four. The names of shaders that also output bent normals end with `bent_normals`.
inline constexpr char bent_normals[] = ", bent normals";
inline constexpr char baseline_blur[] = "blur of the baselines";
inline constexpr char box_mean[] = "mean of 4 x 4 pixels";
inline constexpr char n8ao_disc[] = "N8AO's disc";
inline constexpr char filament_gaussian[] = "Filament's Gaussian";
inline constexpr char edge_denoiser[] = "edge-aware denoiser, two pixels a thread";
inline constexpr char denoiser_edges[] = "edges for the denoiser";
inline constexpr char xegtao_levels[] = "XeGTAO depth levels, four pixels a thread";

// Returns the baselines of the cost table, with their tuning.
std::vector<BaselineMethod> counted_baselines();
std::string counted_name(const BaselineMethod& method);

std::vector<ShaderCase> character_shaders();
std::vector<ShaderCase> nnao_shaders();
std::vector<ShaderCase> baseline_shaders();
std::vector<ShaderCase> probe_shaders();
std::vector<ShaderCase> material_shaders();
std::vector<ShaderCase> neural_shaders();
std::vector<ShaderCase> world_shaders();

std::vector<ShaderCase> all_shaders();
std::vector<PassCase> all_passes();

}  // namespace nook::lab
