// World casters as text for engines that do not link Nook.
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

// The radii of what is written: Unreal and Source 2 have one for AO and light.
enum class CasterRadii { ao, light };

// The capsules of such a file, in rest space. In Unreal's and Source 2's formats a capsule has one radius,
// with which its mean projected area is that of Nook's.
std::vector<Capsule> engine_capsules(const CharacterModel& model, CasterFormat format, CasterRadii radii);

// The AO on the floor below the rest pose by what is written against the model's own casters, both by the
// exact form: what is left where an engine evaluates capsules well.
struct ExportError {
  double rms = 0, largest = 0;  // AO
  double over_none = 0;         // mean squared error over that of no darkening
};
ExportError export_error(const CharacterModel& model, CasterFormat format, CasterRadii radii);

// Capsules lie in the space of their joint, whose name the model has from its file. Throws Failure
// (INVALID_ARGUMENT) for a model without casters or without its rest pose.
std::string export_casters(const CharacterModel& model, CasterFormat format, CasterRadii radii);

}  // namespace nook::measure
