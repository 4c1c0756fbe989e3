// The methods that the screen-space network is compared with. We tuned their parameters. Everything else is
// as published.
#pragma once

#include <span>
#include <string>

namespace nook::lab {

// The baselines n8ao, s4ao, vtk, qgis and filament are used in applications and engines.
enum class Baseline { ssao, ssao_plus, hbao, n8ao, s4ao, vtk, qgis, filament, gtao, bitmask, xegtao };
inline constexpr Baseline all_baselines[] = {
    Baseline::ssao, Baseline::ssao_plus, Baseline::hbao, Baseline::n8ao,    Baseline::s4ao,  Baseline::vtk,
    Baseline::qgis, Baseline::filament,  Baseline::gtao, Baseline::bitmask, Baseline::xegtao};

const char* baseline_name(Baseline baseline);    // the name in tables
const char* baseline_shader(Baseline baseline);  // the file in shaders/

// What a tap outside the screen reads. With `nothing`, the tap finds no surface. With `pixel`, the tap moves
// to the nearest pixel on the screen. With `depth`, the tap keeps its position but uses the depth of the
// nearest pixel on the screen, like a clamping sampler. The shader macro NOOK_BORDER has the same values.
enum class Border { nothing, pixel, depth };
inline constexpr Border all_borders[] = {Border::nothing, Border::pixel, Border::depth};
const char* border_name(Border border);

// How the noise is removed. `blur` is a bilateral blur over 7 x 7 pixels. `edges_1` to `edges_3` run XeGTAO's
// edge-aware denoiser over 3 x 3 pixels one to three times. The other denoisers belong to methods with
// shipped settings: `box` is the mean of 4 x 4 pixels, `disc` is from N8AO, `gaussian` is the bilateral
// Gaussian of Filament, and `none` does nothing.
enum class Denoiser { blur, edges_1, edges_2, edges_3, none, box, disc, gaussian };
inline constexpr Denoiser all_denoisers[] = {Denoiser::blur,    Denoiser::edges_1, Denoiser::edges_2,
                                             Denoiser::edges_3, Denoiser::none,    Denoiser::box,
                                             Denoiser::disc,    Denoiser::gaussian};
const char* denoiser_name(Denoiser denoiser);
// Returns the number of passes of the edge-aware denoiser.
constexpr int edge_passes(Denoiser denoiser) {
  return denoiser <= Denoiser::edges_3 ? int(denoiser) : 0;
}
// Returns the denoisers that the search tries for a baseline.
std::span<const Denoiser> denoisers_of(Baseline baseline);

// The parameters that the search chooses.
struct BaselineTuning {
  float radius_scale = 1;  // radius of the method divided by the radius of the request
  float power = 1;         // exponent applied to the AO
  // The method's own parameter:
  //   SSAO+, VTK, Filament  bias in radii
  //   HBAO                  bias in radians
  //   GTAO                  distance at which the falloff begins, in radii
  //   bitmask               thickness in radii
  //   XeGTAO, N8AO          falloff range in radii
  //   S4AO                  falloff range as a share of the inverse depth
  //   QGIS                  threshold
  // SSAO has none.
  float shape = 0;
  float thin = 0;  // the parameter of XeGTAO that compensates for thin occluders
  // Only for bitmask: sectors have equal cosine-weighted shares instead of equal angles.
  bool equal_weights = false;
  Border border = Border::nothing;
  Denoiser denoiser = Denoiser::blur;
  // The occlusion is multiplied by this factor in S4AO and QGIS. The search leaves it at 1, because it can
  // change `power` instead.
  float strength = 1;

  bool operator==(const BaselineTuning&) const = default;
};

struct BaselineMethod {
  Baseline baseline;
  int taps;
  BaselineTuning tuning;
  bool shipped = false;  // true if the method uses the default settings of the program that ships it
};
std::string baseline_row(const BaselineMethod& method);  // name in tables, with "_shipped" for shipped
                                                         // settings

// Taps as directions x steps (HBAO), or 2 halves x slices x steps (GTAO, the bitmask and XeGTAO).
struct BaselineGrid {
  int groups, steps;
};
BaselineGrid baseline_grid(Baseline baseline, int taps);

// Returns the #define lines that go before the shader's text.
std::string baseline_defines(const BaselineMethod& method);

// Returns all rows of the comparison. First come the methods with the tuning that `nook-lab evaluate nnao
// --tune all` prints, then those with shipped settings.
std::span<const BaselineMethod> baseline_methods();

// Returns the number of texture fetches per pixel. Every method reads the depth and the normal of the pixel,
// and one depth per tap. XeGTAO also needs fetches for its depth levels, four neighbours and the noise. If
// `denoised` is true, the fetches of the denoiser are included.
int baseline_fetches(const BaselineMethod& method, bool denoised);
// The blur has two passes, one per axis. Each pass reads AO, depth and normal of 7 pixels.
inline constexpr int blur_fetches = 2 * 3 * 7;
// Number of passes of N8AO's disc.
inline constexpr int disc_passes = 2;

}  // namespace nook::lab
