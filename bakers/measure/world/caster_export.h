// Writes world casters as text for engines that do not link Nook.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "sdk/src/character/model.h"

namespace nook::measure {

enum class CasterFormat {
  unreal,   // bodies of a physics asset, in Unreal's text format for objects; centimetres
  source2,  // capsules of a ModelDoc file; inches
  gltf      // "extras" of a glTF file; metres
};

// Selects the radii to write. In Unreal and Source 2, a capsule has a single radius, which is used for both
// AO and light.
enum class CasterRadii { ao, light };

// Returns the capsules that a file of this format contains, in rest space. A capsule of Nook can have two end
// radii. In the formats of Unreal and Source 2, a capsule has only one. It is chosen so that the capsule has
// the same mean projected area as Nook's capsule.
std::vector<Capsule> engine_capsules(const CharacterModel& model, CasterFormat format, CasterRadii radii);

// The error of the written capsules: their AO on the floor below the rest pose, compared with the AO of the
// model's own casters. Both are evaluated exactly. This error therefore remains even if an engine evaluates
// capsules exactly.
struct ExportError {
  double rms = 0, largest = 0;  // AO
  double over_none = 0;         // mean squared error divided by the mean squared error without darkening
};
ExportError export_error(const CharacterModel& model, CasterFormat format, CasterRadii radii);

// Returns the text. Each capsule is in the space of its joint. Throws Failure (INVALID_ARGUMENT) for a model
// without casters or without its rest pose.
std::string export_casters(const CharacterModel& model, CasterFormat format, CasterRadii radii);

}  // namespace nook::measure
