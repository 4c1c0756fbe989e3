#include "bakers/measure/nnao/baselines.h"

namespace nook::measure {
namespace {

// The output of `nook evaluate nnao --tune all`, seed 1.
constexpr BaselineMethod methods[] = {
#include "bakers/measure/nnao/baseline_tuning.inl"
};

struct Names {
  const char *table, *shader;
};
constexpr Names names[] = {
    {"ssao", "ssao.frag"}, {"ssao+", "ssao_plus.frag"},      {"hbao", "hbao.frag"},
    {"gtao", "gtao.frag"}, {"gtao_bitmask", "bitmask.frag"}, {"xegtao", "xegtao.frag"}};

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
  constexpr const char* denoiser_names[] = {"blur", "edges_1", "edges_2", "edges_3"};
  return denoiser_names[int(denoiser)];
}

BaselineGrid baseline_grid(Baseline baseline, int taps) {
  if (baseline == Baseline::ssao || baseline == Baseline::ssao_plus) return {1, taps};
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
  if (method.baseline != Baseline::xegtao) return defines;
  return defines + define("NOOK_STEPS", baseline_grid(method.baseline, method.taps).steps) +
         define("NOOK_THIN", method.tuning.thin != 0);
}

std::span<const BaselineMethod> baseline_methods() {
  return methods;
}

int baseline_fetches(const BaselineMethod& method, bool denoised) {
  const bool xegtao = method.baseline == Baseline::xegtao;
  // The levels of depth take 1 + 1 + 1/4 + 1/16 + 1/64.
  int fetches = 2 + method.taps + (xegtao ? 3 + 4 + 1 : 0);
  if (!denoised) return fetches;
  if (method.tuning.denoiser == Denoiser::blur) return fetches + blur_fetches;
  if (!xegtao) fetches += 5;  // depths, for the edges
  return fetches + int(method.tuning.denoiser) * (9 + 5);
}

}  // namespace nook::measure
