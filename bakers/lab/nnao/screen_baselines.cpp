#include "bakers/lab/nnao/screen_baselines.h"

namespace nook::lab {
namespace {

// `nook-lab evaluate nnao --tune all` with seed 1 prints these rows.
constexpr BaselineMethod methods[] = {
#include "bakers/lab/nnao/baseline_tuning.inl"
    // The shipped settings: documented defaults, with lengths divided by the radius.
    //   N8AO      README of 2.0.0, quality Medium, falloff 1 of radius 5, intensity 5
    //   S4AO      Godot's Environment and pull request 109447, quality Medium, intensity 2
    //   VTK       vtkSSAOPass.h, 32 points, no blur; a bias of a hundredth of the radius, as in Kitware's article
    //   QGIS      pull request 49702, intensity and threshold 0.5, 64 points
    //   Filament  quality Low, bias 0.5 mm at radius 0.3 m, power 2; full resolution (its default is half)
    //   XeGTAO    XeGTAO.h, 1.30: radius multiplier 1.457, falloff range 0.615, final power 2.2, denoised once
    {Baseline::n8ao, 16, {1, 5, 0.2f, 0, false, Border::depth, Denoiser::disc}, true},
    {Baseline::s4ao, 12, {1, 1, 0.25f, 0, false, Border::depth, Denoiser::none, 2}, true},
    {Baseline::vtk, 32, {1, 1, 0.01f, 0, false, Border::depth, Denoiser::none}, true},
    {Baseline::qgis, 64, {1, 1, 0.5f, 0, false, Border::depth, Denoiser::box, 0.5f}, true},
    {Baseline::filament, 7, {1, 2, 0.0017f, 0, false, Border::depth, Denoiser::gaussian}, true},
    {Baseline::xegtao, 8, {1.457f, 2.2f, 0.615f, 0, false, Border::depth, Denoiser::edges_1}, true},
    {Baseline::xegtao, 18, {1.457f, 2.2f, 0.615f, 0, false, Border::depth, Denoiser::edges_1}, true},
    {Baseline::xegtao, 54, {1.457f, 2.2f, 0.615f, 0, false, Border::depth, Denoiser::edges_1}, true},
};

struct Names {
  const char *table, *shader;
};
constexpr Names names[] = {{"ssao", "ssao.frag"},    {"ssao+", "ssao_plus.frag"},
                           {"hbao", "hbao.frag"},    {"n8ao", "n8ao.frag"},
                           {"s4ao", "s4ao.frag"},    {"vtk", "vtk.frag"},
                           {"qgis", "qgis.frag"},    {"filament", "filament.frag"},
                           {"gtao", "gtao.frag"},    {"gtao_bitmask", "bitmask.frag"},
                           {"xegtao", "xegtao.frag"}};

std::string define(const char* name, int value) {
  return "#define " + std::string(name) + " " + std::to_string(value) + "\n";
}

}  // namespace

const char* baseline_name(Baseline baseline) {
  return names[int(baseline)].table;
}

const char* baseline_shader(Baseline baseline) {
  return names[int(baseline)].shader;
}

const char* border_name(Border border) {
  constexpr const char* border_names[] = {"nothing", "pixel", "depth"};
  return border_names[int(border)];
}

const char* denoiser_name(Denoiser denoiser) {
  constexpr const char* denoiser_names[] = {"blur", "edges_1", "edges_2", "edges_3",
                                            "none", "box",     "disc",    "gaussian"};
  return denoiser_names[int(denoiser)];
}

std::span<const Denoiser> denoisers_of(Baseline baseline) {
  static constexpr Denoiser common[] = {Denoiser::blur, Denoiser::edges_1, Denoiser::edges_2,
                                        Denoiser::edges_3},
                            n8ao[] = {Denoiser::disc}, s4ao[] = {Denoiser::none},
                            vtk[] = {Denoiser::none, Denoiser::box}, qgis[] = {Denoiser::box},
                            filament[] = {Denoiser::gaussian};
  switch (baseline) {
    case Baseline::n8ao:
      return n8ao;
    case Baseline::s4ao:
      return s4ao;
    case Baseline::vtk:
      return vtk;
    case Baseline::qgis:
      return qgis;
    case Baseline::filament:
      return filament;
    default:
      return common;
  }
}

std::string baseline_row(const BaselineMethod& method) {
  const std::string name = baseline_name(method.baseline);
  return method.shipped ? name + "_shipped" : name;
}

BaselineGrid baseline_grid(Baseline baseline, int taps) {
  if (baseline != Baseline::hbao && baseline < Baseline::gtao) return {1, taps};
  if (baseline == Baseline::hbao) return {taps <= 16 ? 4 : 8, taps <= 32 ? 4 : 8};
  switch (taps) {
    case 4:
      return {1, 2};
    case 8:
      return {2, 2};
    case 16:
      return {2, 4};
    case 18:
      return {3, 3};
    case 32:
      return {4, 4};
    case 54:
      return {9, 3};
    default:
      return {4, 8};
  }
}

std::string baseline_defines(const BaselineMethod& method) {
  std::string defines = define("NOOK_BORDER", int(method.tuning.border));
  // Filament's qualities Low and Ultra have different numbers of spiral turns.
  if (method.baseline == Baseline::filament) return defines + define("NOOK_TURNS", method.taps < 32 ? 3 : 14);
  if (method.baseline != Baseline::xegtao) return defines;
  return defines + define("NOOK_STEPS", baseline_grid(method.baseline, method.taps).steps) +
         define("NOOK_THIN", method.tuning.thin != 0);
}

std::span<const BaselineMethod> baseline_methods() {
  return methods;
}

int baseline_fetches(const BaselineMethod& method, bool denoised) {
  const bool xegtao = method.baseline == Baseline::xegtao;
  // Making XeGTAO's depth levels takes 1 + 1 + 1/4 + 1/16 + 1/64 fetches per pixel. They are counted as 3.
  int fetches = 2 + method.taps + (xegtao ? 3 + 4 + 1 : 0);
  if (!denoised) return fetches;
  switch (method.tuning.denoiser) {
    case Denoiser::none:
      return fetches;
    case Denoiser::blur:
      return fetches + blur_fetches;
    case Denoiser::box:
      return fetches + 16;
    case Denoiser::disc:
      return fetches + disc_passes * (3 + 2 * 8);
    case Denoiser::gaussian:
      return fetches + 2 * (2 + 2 * 10);
    default:
      if (!xegtao) fetches += 5;  // depths for the edge detection
      return fetches + edge_passes(method.tuning.denoiser) * (9 + 5);
  }
}

}  // namespace nook::lab
