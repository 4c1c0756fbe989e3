// Writes world casters as text for engines that do not link Nook.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "sdk/src/character/model.h"

namespace nook::measure {

enum class CasterFormat {
  unreal,   // bodies of a physics asset, as objects in Unreal's text form; centimetres
  source2,  // capsules of a ModelDoc file; inches
  gltf      // "extras" of a glTF file; metres
};

// Which radii to write. Unreal and Source 2 have one radius for both AO and light.
enum class CasterRadii { ao, light };

// Returns the capsules of such a file, in rest space. In Unreal's and Source 2's formats, a capsule has one
// radius. This radius gives the capsule the same mean projected area as Nook's capsule.
std::vector<Capsule> engine_capsules(const CharacterModel& model, CasterFormat format, CasterRadii radii);

// Compares the AO on the floor below the rest pose from the written capsules with the AO from the model's own
// casters. Both use the exact form. This error remains even if an engine evaluates capsules exactly.
struct ExportError {
  double rms = 0, largest = 0;  // AO
  double over_none = 0;         // mean squared error divided by the mean squared error without darkening
};
ExportError export_error(const CharacterModel& model, CasterFormat format, CasterRadii radii);

// Returns the text. Each capsule is in the space of its joint. Throws Failure (INVALID_ARGUMENT) for a model
// without casters or without its rest pose.
std::string export_casters(const CharacterModel& model, CasterFormat format, CasterRadii radii);

}  // namespace nook::measure
