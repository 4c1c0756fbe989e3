#include "bakers/measure/nnao/baselines.h"

namespace nook::measure {
namespace {

// The output of `nook evaluate nnao --tune all`, seed 1.
constexpr BaselineMethod methods[] = {
#include "bakers/measure/nnao/baseline_tuning.inl"
};

}  // namespace

const char* baseline_name(Baseline baseline) {
  switch (baseline) {
    case Baseline::ssao:
      return "ssao";
    case Baseline::ssao_plus:
      return "ssao+";
    case Baseline::hbao:
      return "hbao";
    case Baseline::gtao:
      return "gtao";
    default:
      return "gtao_bitmask";
  }
}

const char* baseline_shader(Baseline baseline) {
  switch (baseline) {
    case Baseline::ssao:
      return "ssao.frag";
    case Baseline::ssao_plus:
      return "ssao_plus.frag";
    case Baseline::hbao:
      return "hbao.frag";
    case Baseline::gtao:
      return "gtao.frag";
    default:
      return "bitmask.frag";
  }
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
    default:
      return {4, 8};
  }
}

std::span<const BaselineMethod> baseline_methods() {
  return methods;
}

int baseline_fetches(const BaselineMethod& method) {
  return 2 + method.taps;
}

}  // namespace nook::measure
