// The methods that the screen-space network is compared with, each tuned, as it was published otherwise.
#pragma once

#include <span>
#include <string>

namespace nook::lab {

// From n8ao to filament: what an application or an engine ships.
enum class Baseline { ssao, ssao_plus, hbao, n8ao, s4ao, vtk, qgis, filament, gtao, bitmask, xegtao };
inline constexpr Baseline all_baselines[] = {
    Baseline::ssao, Baseline::ssao_plus, Baseline::hbao, Baseline::n8ao,    Baseline::s4ao,  Baseline::vtk,
    Baseline::qgis, Baseline::filament,  Baseline::gtao, Baseline::bitmask, Baseline::xegtao};

const char* baseline_name(Baseline baseline);    // in tables
const char* baseline_shader(Baseline baseline);  // in shaders/

// A tap beyond the screen meets nothing; or the nearest pixel on the screen, at its own place; or the depth
// of that pixel at the tap's place, which is what a sampler that clamps gives. The values are NOOK_BORDER's.
enum class Border { nothing, pixel, depth };
inline constexpr Border all_borders[] = {Border::nothing, Border::pixel, Border::depth};
const char* border_name(Border border);

// The noise is smoothed by the bilateral blur over 7 x 7 pixels, or by XeGTAO's edge-aware denoiser over 3 x
// 3, run as often as its value says. What is shipped has one of its own: the mean of 4 x 4 pixels (VTK,
// QGIS), N8AO's disc, Filament's bilateral Gaussian, or none (S4AO, VTK).
enum class Denoiser { blur, edges_1, edges_2, edges_3, none, box, disc, gaussian };
inline constexpr Denoiser all_denoisers[] = {Denoiser::blur,    Denoiser::edges_1, Denoiser::edges_2,
                                             Denoiser::edges_3, Denoiser::none,    Denoiser::box,
                                             Denoiser::disc,    Denoiser::gaussian};
const char* denoiser_name(Denoiser denoiser);
// Returns how often the edge-aware denoiser runs.
constexpr int edge_passes(Denoiser denoiser) {
  return denoiser <= Denoiser::edges_3 ? int(denoiser) : 0;
}
// Returns the denoisers that the search tries for a baseline.
std::span<const Denoiser> denoisers_of(Baseline baseline);

// The parameters that the search chooses.
struct BaselineTuning {
  float radius_scale = 1;  // the method's radius over the radius of the request
  float power = 1;         // of its result
  // Bias of SSAO+, VTK and Filament in radii and of HBAO in radians; where GTAO's falloff begins, in radii;
  // thickness of the bitmask in radii; falloff range of XeGTAO and N8AO in radii, of S4AO as a share of the
  // inverse depth; QGIS' threshold. SSAO has none.
  float shape = 0;
  float thin = 0;              // XeGTAO's compensation for thin occluders
  bool equal_weights = false;  // bitmask: sectors of equal cosine-weighted share; else of equal angle
  Border border = Border::nothing;
  Denoiser denoiser = Denoiser::blur;
  // A factor of the darkness, for S4AO and QGIS. The search leaves it at 1: contrast does as well.
  float strength = 1;

  bool operator==(const BaselineTuning&) const = default;
};

struct BaselineMethod {
  Baseline baseline;
  int taps;
  BaselineTuning tuning;
  bool shipped = false;  // with the default settings of what ships it
};
std::string baseline_row(const BaselineMethod& method);  // its name in tables, with "_shipped" where it is

// Taps as directions x steps (HBAO), or 2 halves x slices x steps (GTAO, the bitmask and XeGTAO).
struct BaselineGrid {
  int groups, steps;
};
BaselineGrid baseline_grid(Baseline baseline, int taps);

// Lines in front of the shader's text: what is known when it is compiled.
std::string baseline_defines(const BaselineMethod& method);

// Every row of the comparison, with the tuning that `nook-lab evaluate nnao --tune all` prints, then those
// with the settings that are shipped.
std::span<const BaselineMethod> baseline_methods();

// Texels that are read for each pixel: its depth and normal, and one depth for each tap; XeGTAO's depth
// levels, four neighbours and noise as well. denoised: the denoiser's are included.
int baseline_fetches(const BaselineMethod& method, bool denoised);
// Two axes, each AO, depth and normal of 7 pixels.
inline constexpr int blur_fetches = 2 * 3 * 7;
// N8AO's disc is run so many times.
inline constexpr int disc_passes = 2;

}  // namespace nook::lab
