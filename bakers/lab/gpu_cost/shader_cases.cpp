#include "bakers/lab/gpu_cost/shader_cases.h"

namespace nook::lab {
namespace {

// The number of threads divided by the number of pixels, if each thread computes 2 x 2 pixels, or if the
// image has half the width and height.
constexpr double quarter = 0.25;

// With nine taps, the filter along x does not compare AO values.
std::string filter_along_x(const std::string& taps) {
  return taps == "9" ? "filter.frag along x" : "filter.frag along x, 16 taps or more";
}

// `stage` is the name of the network's shader without its number of taps.
PassCase nnao(const std::string& name, const std::string& stage, const std::string& taps, bool half,
              bool paper = false, const std::string& outputs = "") {
  const std::string size = half ? ", half" : "";
  const double share = half ? quarter : 1;
  PassCase pass{name + size,
                {{"depth.frag" + size, share},
                 {stage + taps + outputs + size, share},
                 {filter_along_x(taps) + outputs + size, share},
                 {"resolve.frag" + outputs + size, 1}}};
  if (paper) pass.shaders.push_back({"normals.frag" + size, share});
  if (half) pass.shaders.push_back({"filter.frag along y" + outputs + size, share});
  return pass;
}

std::string passes_text(int passes) {
  return passes == 1 ? "once" : passes == 2 ? "twice" : "three times";
}

// Returns the whole pass of a baseline, from the host's depth and normals to the denoised AO.
PassCase baseline_pass(const BaselineMethod& method, Denoiser denoiser) {
  const bool xegtao = method.baseline == Baseline::xegtao;
  PassCase pass{counted_name(method), {}};
  if (xegtao) pass.shaders.push_back({xegtao_levels, quarter});
  pass.shaders.push_back({counted_name(method), 1});
  switch (denoiser) {
    case Denoiser::none:
      pass.name += ", not denoised";
      break;
    case Denoiser::blur:
      pass.name += ", blurred";
      pass.shaders.push_back({baseline_blur, 2});
      break;
    case Denoiser::box:
      pass.name += ", 4 x 4 mean";
      pass.shaders.push_back({box_mean, 1});
      break;
    case Denoiser::disc:
      pass.name += ", its denoiser";
      pass.shaders.push_back({n8ao_disc, disc_passes});
      break;
    case Denoiser::gaussian:
      pass.name += ", its denoiser";
      pass.shaders.push_back({filament_gaussian, 2});
      break;
    default:
      pass.name += ", denoised " + passes_text(edge_passes(denoiser));
      if (!xegtao) pass.shaders.push_back({denoiser_edges, 1});
      pass.shaders.push_back({edge_denoiser, 0.5 * edge_passes(denoiser)});
  }
  return pass;
}

void add_baselines(std::vector<PassCase>& passes) {
  for (const BaselineMethod& method : counted_baselines()) {
    if (method.baseline != Baseline::xegtao && method.baseline != Baseline::vtk) {
      passes.push_back(baseline_pass(method, method.tuning.denoiser));
      continue;
    }
    for (const Denoiser denoiser : denoisers_of(method.baseline))
      passes.push_back(baseline_pass(method, denoiser));
  }
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
  for (const auto& room : {character_shaders(), nnao_shaders(), baseline_shaders(), probe_shaders(),
                           material_shaders(), neural_shaders(), world_shaders()})
    shaders.insert(shaders.end(), room.begin(), room.end());
  return shaders;
}

std::vector<PassCase> all_passes() {
  std::vector<PassCase> passes;
  for (const bool half : {false, true})
    for (const std::string taps : {"9", "16", "32", "64"})
      passes.push_back(nnao("NNAO " + taps, "occlusion.frag, ", taps, half));
  for (const bool half : {false, true})
    for (const std::string taps : {"9", "16", "32"})
      passes.push_back(
          nnao("NNAO " + taps + bent_normals, "occlusion.frag, ", taps, half, false, bent_normals));
  for (const bool half : {false, true}) {
    PassCase mean = nnao("NNAO 9, mean over frames", "occlusion.frag, ", "9", half);
    mean.shaders.push_back({half ? "accumulate.frag, half" : "accumulate.frag", half ? quarter : 1});
    passes.push_back(mean);
  }
  for (const std::string taps : {"9", "16"}) {
    PassCase twice = nnao("NNAO " + taps + ", filtered twice", "occlusion.frag, ", taps, false);
    twice.shaders.push_back({filter_along_x(taps), 1});
    twice.shaders.push_back({"filter.frag along y", 1});
    passes.push_back(twice);
  }
  for (const std::string taps : {"16", "64"}) {
    passes.push_back(nnao("NNAO " + taps + ", compute", "occlusion.comp, ", taps, false));
    passes.push_back(
        nnao("NNAO, paper's form, " + taps, "occlusion.frag, paper's form, ", taps, false, true));
  }
  constexpr double far = 1.0 / 64;
  passes.push_back({"world, half resolution, draws",
                    {{"depth.frag, half", quarter},
                     {"darken.frag, far bodies", far},
                     {"darken.frag, half resolution, near bodies", quarter},
                     {"resolve.frag of the world pass", 1}}});
  for (const std::string shares : {"", ", by shares"})
    passes.push_back({"world, half resolution, groups" + shares,
                      {{"depth.frag, half", quarter},
                       {"darken.comp, far bodies" + shares, far},
                       {"darken.comp, near bodies" + shares, quarter},
                       {"resolve.frag of the world pass, gathers", 1}}});
  add_baselines(passes);
  return passes;
}

}  // namespace nook::lab
