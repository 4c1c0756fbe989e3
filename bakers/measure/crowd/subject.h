// The functions of a program with a crowd that the measurements call: they evaluate its ambient occlusion
// with Nook, and draw pictures of it.
#pragma once

#include <nook/nook_probe.h>

#include <optional>

#include "bakers/measure/crowd/selection.h"
#include "platform/platform.h"

namespace nook::measure::crowd {

// A crowd whose ambient occlusion Nook evaluates, in the poses that are measured.
class EvaluatedCrowd {
 public:
  virtual ~EvaluatedCrowd() = default;
  // Evaluates with these terms (NOOK_TERM_*).
  virtual void update(std::uint32_t terms) = 0;
  // The AO of one character's vertices after the last update.
  virtual std::vector<float> ao(std::uint32_t character) const = 0;
  // The AO of the vertices in the rest pose, as the model has it baked.
  virtual std::vector<float> static_ao() const = 0;
  // The exponent of the norm that adds up the spheres' shadows.
  virtual float gamma() const = 0;
  // Evaluates the occlusion of some characters under these lobes with all terms: three floats for each
  // vertex.
  virtual VertexValues directional_ao(std::span<const std::uint32_t> characters,
                                      std::span<const nook_lobe> lobes) = 0;
};

// Where a panel also shows screen-space AO.
enum class ScreenSpace { kNowhere, kOnFloor, kEverywhere };

// Values that are known at the points of a patch of the floor.
struct FloorValues {
  FloorPatch patch;
  std::vector<float> values;
};

// A picture of a group in ambient light.
struct AoPanel {
  VertexValues ao;  // one float a vertex, an array for each member; empty if nothing is occluded
  ScreenSpace screen_space = ScreenSpace::kNowhere;
  std::optional<FloorValues> floor_ao;  // one float a point
};

// A picture of a group in a light whose irradiance is known everywhere.
struct IrradiancePanel {
  VertexValues irradiance;  // three floats for each vertex, an array for each member
  FloorValues floor;        // three floats for each point
  float exposure = 1;
};

class PanelRenderer {
 public:
  virtual ~PanelRenderer() = default;
  virtual platform::Image draw(const Group& group, const AoPanel& panel) = 0;
  virtual platform::Image draw(const Group& group, const IrradiancePanel& panel) = 0;
};

// All that is measured. The places are those of the crowd's characters; the seed is that of the rays.
struct Subject {
  const PosedCrowd& crowd;
  std::span<const Place> places;
  EvaluatedCrowd& evaluated;
  PanelRenderer& renderer;
  std::uint64_t seed = 1;
};

}  // namespace nook::measure::crowd
