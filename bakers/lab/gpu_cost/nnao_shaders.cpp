#include "bakers/lab/gpu_cost/shader_cases.h"
#include "bakers/lab/gpu_cost/trip_counts.h"
#include "bakers/lab/nnao/screen_baselines.h"

namespace nook::lab {
namespace {

struct Grid {
  int taps, groups, steps;
};
// The same grids as horizon_grid in sdk/src/nnao/taps.h.
constexpr Grid grids[] = {{9, 3, 3}, {16, 4, 4}, {32, 8, 4}, {64, 8, 8}};

std::string defines(bool half, bool horizon, const Grid& grid, bool bent = false) {
  return "#define NOOK_HALF " + std::to_string(half) + "\n#define NOOK_HORIZON " + std::to_string(horizon) +
         "\n#define NOOK_DIRECTIONS " + std::to_string(grid.groups) + "\n#define NOOK_STEPS " +
         std::to_string(grid.steps) + "\n#define NOOK_BENT_NORMALS " + std::to_string(bent) +
         "\n#define NOOK_TEMPORAL 0\n";
}

std::vector<Loop> grid_loops(const char* groups, const Grid& grid) {
  return {{groups, double(grid.groups), {{"steps", double(grid.steps), {}}}}};
}

// Compilers unroll the steps of a direction. They also unroll the directions if the number of directions is a
// constant.
std::vector<Loop> direction_loops(const Grid& grid) {
  if (grid.groups <= 4) return {};
  return {{"directions", double(grid.groups), {}}};
}

// In the paper's form, compilers unroll four steps.
std::vector<Loop> paper_loops(const Grid& grid) {
  if (grid.steps > 4) return grid_loops("groups of taps", grid);
  return {{"groups of taps", double(grid.groups), {}}};
}

// Returns the loops for the tap grid of a baseline. The number of steps is for one side of a slice.
std::vector<Loop> baseline_loops(const BaselineMethod& method) {
  const BaselineGrid grid = baseline_grid(method.baseline, method.taps);
  const double groups = grid.groups, steps = grid.steps;
  switch (method.baseline) {
    case Baseline::ssao:
    case Baseline::ssao_plus:
    case Baseline::n8ao:
    case Baseline::vtk:
    case Baseline::qgis:
    case Baseline::filament:
      return {{"taps", steps, {}}};
    case Baseline::s4ao:
      // The grid is unrolled.
      return {};
    case Baseline::hbao:
      return {{"directions", groups, {{"steps", steps, {}}}}};
    case Baseline::xegtao:
      // The steps are unrolled, because the number of steps is known at compile time.
      return {{"slices", groups, {}}};
    default:
      return {{"slices", groups, {{"steps behind", steps, {}}, {"steps ahead", steps, {}}}}};
  }
}

bool is_counted(const BaselineMethod& method) {
  // Shipped settings use the same shader as tuned ones.
  if (method.shipped) return false;
  switch (method.baseline) {
    case Baseline::gtao:
    case Baseline::bitmask:
      return method.taps == 16 || method.taps == 18 || method.taps == 64;
    default:
      return true;
  }
}

constexpr char lighting[] = R"(#include "shaders/nnao/host.glsl"
uniform sampler2D screen_ao;
in vec3 normal;
in vec3 view;
in vec2 roughness;
out vec4 colour;
void main() {
  vec4 texel = texelFetch(screen_ao, ivec2(gl_FragCoord.xy), 0);
  colour = vec4(nook_nnao_specular_occlusion(nook_nnao_bent_normal(texel), texel.a, normal, view, roughness.x));
}
)";

const std::string shader_folder = "bakers/lab/nnao/shaders/";

}  // namespace

std::vector<ShaderCase> nnao_shaders() {
  std::vector<ShaderCase> shaders;
  const std::string bent = bent_normals;
  for (const bool half : {false, true}) {
    const std::string size = half ? ", half" : "";
    const auto add = [&](Stage stage, const char* file, const std::string& variant, const std::string& lines,
                         const std::vector<Loop>& loops) {
      shaders.push_back(
          tree_shader(stage, std::string("shaders/nnao/") + file, file + variant + size, lines, loops));
    };
    add(Stage::fragment, "depth.frag", "", defines(half, true, grids[0]), {});
    const std::string samples =
        defines(half, true, grids[0]) + "#define NOOK_SAMPLES 4\n#define NOOK_SAMPLE_RULE 0\n";
    const std::string normal_samples = samples + "#define NOOK_NORMAL_SAMPLES 1\n";
    add(Stage::fragment, "depth.frag", ", 4 samples", samples, {});
    add(Stage::fragment, "depth.frag", ", 4 samples with normals", normal_samples, {});
    add(Stage::fragment, "occlusion.frag", ", 9, 4 samples with normals", normal_samples,
        direction_loops(grids[0]));
    add(Stage::fragment, "depth.frag", ", texture array",
        defines(half, true, grids[0]) + "#define NOOK_LAYERS 1\n", {});
    add(Stage::fragment, "normals.frag", "", defines(half, false, grids[1]), {});
    for (const Grid& grid : grids) {
      const std::string taps = ", " + std::to_string(grid.taps);
      add(Stage::fragment, "occlusion.frag", taps, defines(half, true, grid), direction_loops(grid));
      add(Stage::fragment, "occlusion.frag", taps + bent, defines(half, true, grid, true),
          direction_loops(grid));
      add(Stage::compute, "occlusion.comp", taps, defines(half, true, grid), direction_loops(grid));
      if (grid.taps == 16 || grid.taps == 64)
        add(Stage::fragment, "occlusion.frag", ", paper's form" + taps, defines(half, false, grid),
            paper_loops(grid));
    }
    for (const bool with : {false, true}) {
      const std::string nine = defines(half, true, grids[0], with), outputs = with ? bent : "";
      add(Stage::fragment, "filter.frag", " along x" + outputs, nine, {});
      add(Stage::fragment, "filter.frag", " along x, 16 taps or more" + outputs,
          defines(half, true, grids[1], with), {});
      add(Stage::fragment, "filter.frag", " along y" + outputs, nine + "#define NOOK_FILTER_ALONG_Y 1\n", {});
      add(Stage::fragment, "resolve.frag", outputs, nine, {});
    }
    add(Stage::fragment, "accumulate.frag", "", defines(half, true, grids[0]), {});
    add(Stage::fragment, "resolve.frag", ", layered",
        defines(half, true, grids[0]) + "#define NOOK_LAYERED 1\n", {});
    add(Stage::fragment, "show_normals.frag", "", defines(half, true, grids[0]), {});
  }
  shaders.push_back(host_shader(lighting, "specular occlusion by a bent normal"));
  shaders.push_back(tree_shader(Stage::fragment, "shaders/nnao/texel_bits.frag", "texel_bits.frag", "", {}));
  return shaders;
}

std::vector<BaselineMethod> counted_baselines() {
  std::vector<BaselineMethod> counted;
  for (const BaselineMethod& method : baseline_methods())
    if (is_counted(method)) counted.push_back(method);
  return counted;
}

std::string counted_name(const BaselineMethod& method) {
  constexpr const char* names[] = {"SSAO",  "SSAO+", "HBAO",     "N8AO", "S4AO",
                                   "VTK",   "QGIS",  "Filament", "GTAO", "GTAO with bitmask",
                                   "XeGTAO"};
  const std::string name = std::string(names[int(method.baseline)]) + " ";
  if (method.baseline != Baseline::xegtao) return name + std::to_string(method.taps);
  return name + (method.taps == 8 ? "Medium" : method.taps == 18 ? "High" : "Ultra");
}

std::vector<ShaderCase> baseline_shaders() {
  std::vector<ShaderCase> shaders;
  for (const BaselineMethod& method : counted_baselines()) {
    if (method.baseline == Baseline::xegtao)
      shaders.push_back(tree_shader(Stage::fragment, shader_folder + baseline_shader(method.baseline),
                                    counted_name(method) + bent_normals,
                                    baseline_defines(method) + "#define NOOK_BENT_NORMALS\n",
                                    baseline_loops(method)));
    shaders.push_back(tree_shader(Stage::fragment, shader_folder + baseline_shader(method.baseline),
                                  counted_name(method), baseline_defines(method), baseline_loops(method)));
  }
  const auto add = [&](Stage stage, const char* file, const char* name) {
    shaders.push_back(tree_shader(stage, shader_folder + file, name));
  };
  add(Stage::compute, "depth_levels.comp", xegtao_levels);
  add(Stage::fragment, "depth_level.frag", "depth levels, one by one");
  add(Stage::fragment, "edges.frag", denoiser_edges);
  add(Stage::compute, "denoise.comp", edge_denoiser);
  add(Stage::fragment, "denoise.frag", "edge-aware denoiser, a pixel a thread");
  add(Stage::fragment, "blur.frag", baseline_blur);
  add(Stage::fragment, "box.frag", box_mean);
  add(Stage::fragment, "disc.frag", n8ao_disc);
  add(Stage::fragment, "gaussian.frag", filament_gaussian);
  return shaders;
}

}  // namespace nook::lab
