// Compares a crowd with ray tracing. It measures the errors of ambient occlusion and light, and draws sheets
// of pictures. Your program owns the crowd. It implements the interfaces below, which evaluate the crowd with
// Nook and draw it.
#pragma once

#include <nook/experimental/nook_trace.h>
#include <nook/nook_probe.h>
#include <optional>
#include <string>

#include "bakers/lab/crowd/selection.h"
#include "bakers/lab/crowd/truth.h"
#include "platform/platform.h"

namespace nook::lab::crowd {

// A crowd in the measured poses, whose ambient occlusion Nook evaluates.
class EvaluatedCrowd {
 public:
  virtual ~EvaluatedCrowd() = default;
  // Evaluates the crowd with these terms (NOOK_TERM_*).
  virtual void update(std::uint32_t terms) = 0;
  // Returns the AO that the last update computed for the vertices of one character.
  virtual std::vector<float> ao(std::uint32_t character) const = 0;
  // Returns the baked AO of the vertices in the rest pose.
  virtual std::vector<float> static_ao() const = 0;
  // Returns the exponent of the norm that combines the shadows of the spheres.
  virtual float gamma() const = 0;
  // Evaluates the occlusion of the given characters under these lobes, with all terms. Returns three floats
  // for each vertex.
  virtual VertexValues directional_ao(std::span<const std::uint32_t> characters,
                                      std::span<const nook_lobe> lobes) = 0;
};

// Says on which surfaces a panel also shows screen-space AO.
enum class ScreenSpace { nowhere, on_floor, everywhere };

// Values at the points of a patch of the floor.
struct FloorValues {
  FloorPatch patch;
  std::vector<float> values;
};

// A panel that shows a group in ambient light.
struct AoPanel {
  VertexValues ao;  // one array per member, with one float per vertex; empty: no occlusion
  ScreenSpace screen_space = ScreenSpace::nowhere;
  std::optional<FloorValues> floor_ao;  // one float per point
};

// A panel that shows a group with given irradiance.
struct IrradiancePanel {
  VertexValues irradiance;  // one array per member, with three floats per vertex
  FloorValues floor;        // three floats per point
  float exposure = 1;
};

class PanelRenderer {
 public:
  virtual ~PanelRenderer() = default;
  virtual platform::Image draw(const Group& group, const AoPanel& panel) = 0;
  virtual platform::Image draw(const Group& group, const IrradiancePanel& panel) = 0;
};

// What to measure: the characters of the crowd at their positions. `seed` is the random seed of the rays.
struct Subject {
  const PosedCrowd& crowd;
  std::span<const Place> places;
  EvaluatedCrowd& evaluated;
  PanelRenderer& renderer;
  std::uint64_t seed = 1;
};

// ---- Ambient occlusion ----

struct FormErrors {
  std::string form;
  Errors errors;
};

struct AoErrors {
  std::uint32_t rays = 0;         // rays per vertex of the reference
  double noise_floor_mse = 0;     // expected error of the reference itself
  std::size_t characters = 0;     // number of measured characters
  bool have_neighbours = false;   // true if each measured character has another character within 1 m
  std::vector<FormErrors> forms;  // errors for each set of terms, and for static AO
  double links_cut_mse_area = 0;  // fraction of the error that the terms of the neighbours remove
};

AoErrors measure_ao(const Subject& subject);

// Settings of the screen-space pass that panels show.
struct ScreenSpaceSettings {
  int taps = 64;
  bool half_resolution = false;
  float radius_m = 0.5f;
};

// Draws the group without AO, with static AO, with several sets of Nook's terms, and with the reference.
// Another panel shows the difference between Nook and the reference. If `screen_space` is not null, there are
// two more panels. One shows only screen-space AO. The other shows screen-space AO on the floor, together
// with Nook's AO on the bodies. In this case, the floor of the reference panel shows AO that is ray traced
// with the same radius.
platform::Image ao_sheet(const Subject& subject, const ScreenSpaceSettings* screen_space);

// Compares two ways to combine the shadows of several bodies with the reference: Nook's default, and one norm
// over the spheres of all bodies. The norm uses the model's gamma in one panel and the paper's gamma 2 in
// another panel. The ground does not darken the bodies, because this would hide the effect of overlapping
// spheres. The crowd in `subject` must use Nook's default.
platform::Image double_shadowing_sheet(const Subject& subject, EvaluatedCrowd& one_norm,
                                       EvaluatedCrowd& one_norm_gamma_2);

// ---- Light, in three forms: AO alone, AO times the probe, and occlusion per lobe ----

// A light, stored both as lobes and as the environment that the lobes represent.
struct Light {
  std::span<const nook_lobe> lobes;
  nook_bake_environment environment;
  float mean_radiance = 0;  // mean of the environment over all directions and channels
};

struct LightErrors {
  // Errors of the irradiance over all channels, in units of the environment's mean irradiance.
  std::vector<FormErrors> forms;
  double noise_floor_mse = 0;  // expected error of the reference itself
};

LightErrors measure_light(const Subject& subject, const Light& light);

// Draws one panel for each of the three forms, and one for the reference. The floor is path traced in all
// four panels.
platform::Image light_sheet(const Subject& subject, const Light& light);

}  // namespace nook::lab::crowd
