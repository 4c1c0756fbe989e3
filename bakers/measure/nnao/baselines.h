// The methods that the screen-space network is compared with, each tuned, as it was published otherwise.
#pragma once

#include <span>

namespace nook::measure {

enum class Baseline { ssao, ssao_plus, hbao, gtao, bitmask };
inline constexpr Baseline all_baselines[] = {Baseline::ssao, Baseline::ssao_plus, Baseline::hbao,
                                             Baseline::gtao, Baseline::bitmask};

const char* baseline_name(Baseline baseline);    // in tables
const char* baseline_shader(Baseline baseline);  // in shaders/

// The parameters that the grid search chooses.
struct BaselineTuning {
  float radius_scale = 1;  // the method's radius over the radius of the request
  float power = 1;         // of its result
  // Bias of SSAO+ in radii and of HBAO in radians; where GTAO's falloff begins, in radii; thickness of the
  // bitmask in radii. SSAO has none.
  float shape = 0;
  bool equal_weights = false;  // bitmask: sectors of equal cosine-weighted share; else of equal angle
};

struct BaselineMethod {
  Baseline baseline;
  int taps;
  BaselineTuning tuning;
};

// Taps as directions x steps (HBAO), or 2 halves x slices x steps (GTAO and the bitmask).
struct BaselineGrid {
  int groups, steps;
};
BaselineGrid baseline_grid(Baseline baseline, int taps);

// Every row of the comparison, with the tuning that `nook evaluate nnao --tune all` prints.
std::span<const BaselineMethod> baseline_methods();

// Texture fetches for each pixel: its depth and normal, and one depth for each tap; the blur's are
// blur_fetches more.
int baseline_fetches(const BaselineMethod& method);
// Two axes, each AO, depth and normal of 7 pixels.
inline constexpr int blur_fetches = 2 * 3 * 7;

}  // namespace nook::measure
