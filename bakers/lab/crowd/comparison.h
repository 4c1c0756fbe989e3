// Compares a crowd with ray tracing: errors of its ambient occlusion and light, and sheets of pictures. The
// program that owns the crowd evaluates it with Nook and draws it, through the interfaces below.
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
  // Evaluates with these terms (NOOK_TERM_*).
  virtual void update(std::uint32_t terms) = 0;
  // The AO of one character's vertices after the last update.
  virtual std::vector<float> ao(std::uint32_t character) const = 0;
  // Returns the baked AO of the vertices in the rest pose.
  virtual std::vector<float> static_ao() const = 0;
  // Returns the exponent of the norm that adds up the spheres' shadows.
  virtual float gamma() const = 0;
  // Evaluates the occlusion of some characters under these lobes with all terms: three floats for each
  // vertex.
  virtual VertexValues directional_ao(std::span<const std::uint32_t> characters,
                                      std::span<const nook_lobe> lobes) = 0;
};

// Where a panel also shows screen-space AO.
enum class ScreenSpace { nowhere, on_floor, everywhere };

// Values at the points of a patch of the floor.
struct FloorValues {
  FloorPatch patch;
  std::vector<float> values;
};

// A picture of a group in ambient light.
struct AoPanel {
  VertexValues ao;  // one float per vertex, one array per member; empty without occlusion
  ScreenSpace screen_space = ScreenSpace::nowhere;
  std::optional<FloorValues> floor_ao;  // one float per point
};

// A picture of a group in a light with known irradiance.
struct IrradiancePanel {
  VertexValues irradiance;  // three floats per vertex, one array per member
  FloorValues floor;        // three floats per point
  float exposure = 1;
};

class PanelRenderer {
 public:
  virtual ~PanelRenderer() = default;
  virtual platform::Image draw(const Group& group, const AoPanel& panel) = 0;
  virtual platform::Image draw(const Group& group, const IrradiancePanel& panel) = 0;
};

// What to measure: the crowd's characters at their places. The seed is for the rays.
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
  std::uint32_t rays = 0;         // for each vertex of the reference
  double noise_floor_mse = 0;     // the reference's own error
  std::size_t characters = 0;     // that were measured
  bool have_neighbours = false;   // each has another character within 1 m
  std::vector<FormErrors> forms;  // with several sets of terms, and the static AO
  double links_cut_mse_area = 0;  // share of the error that the neighbours' terms remove
};

AoErrors measure_ao(const Subject& subject);

// The screen-space pass that panels show.
struct ScreenSpaceSettings {
  int taps = 64;
  bool half_resolution = false;
  float radius_m = 0.5f;
};

// Draws the group with no AO, static AO, Nook's AO by terms, the reference, and the difference of the last
// two. Three more panels show screen-space AO unless the settings are null: alone, on the floor beside Nook's
// AO, and by rays of the same radius on the reference's floor.
platform::Image ao_sheet(const Subject& subject, const ScreenSpaceSettings* screen_space);

// Draws the group by Nook's default form and by one norm over the spheres of all bodies, beside the
// reference. The norm uses the model's gamma in one panel and the paper's gamma 2 in another. The ground is
// left out, because its darkening would hide what overlapping spheres do. The subject's own evaluation is the
// default form.
platform::Image double_shadowing_sheet(const Subject& subject, EvaluatedCrowd& one_norm,
                                       EvaluatedCrowd& one_norm_gamma_2);

// ---- Light: AO alone, AO times the probe, and the occlusion of each lobe ----

// A light as lobes, and as the environment that the lobes represent.
struct Light {
  std::span<const nook_lobe> lobes;
  nook_bake_environment environment;
  float mean_radiance = 0;  // of the environment, over all directions and channels
};

struct LightErrors {
  // Errors of the irradiance of all channels, in units of the environment's mean irradiance.
  std::vector<FormErrors> forms;
  double noise_floor_mse = 0;  // the reference's own error
};

LightErrors measure_light(const Subject& subject, const Light& light);

// Draws the three forms and the reference. The floor is path traced in all four panels.
platform::Image light_sheet(const Subject& subject, const Light& light);

}  // namespace nook::lab::crowd
