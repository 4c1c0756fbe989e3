// The inputs of an evaluation of a character: the character's file, the model that was baked from it, and the
// poses to measure.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/character/recipe.h"
#include "bakers/import/gltf.h"
#include "sdk/src/character/model.h"

namespace nook::measure {

// The imported file and the model that was baked from it.
struct BakedCharacter {
  bake::ImportedCharacter character;
  std::vector<std::byte> model_bytes;
  CharacterModel model;
};

// Throws Failure (BAD_FILE, FILE_VERSION) if the bytes are not a model, or are the model of another
// character.
BakedCharacter read_baked_character(bake::ImportedCharacter character, std::vector<std::byte> model_bytes);

// Which poses to measure.
struct PoseChoice {
  bool training = false;  // true: use the poses that the model was fitted to, reproduced from its recipe
  // Use only these clips of the file; if empty, choose_poses chooses the clips.
  std::vector<std::string> clips;
  std::size_t samples_per_clip = 20;
  std::size_t most = 0;  // approximate number of poses, picked at even intervals; 0: all
};

struct EvaluatedPoses {
  std::vector<bake::Pose> poses;
  std::string protocol;            // "unseen clips", "all clips", "named clips", "training poses", "turned"
  std::vector<std::string> clips;  // names of the measured clips
  std::vector<std::size_t> clip;   // for each pose, an index into `clips`; empty for training poses
};

// If no clips are named, chooses the motion clips that the recipe did not use. If the recipe used all motion
// clips, or if `recipe` is null because the model has none, chooses all motion clips. If the character is an
// object with one bone and no clips, the poses are rotations about the vertical axis. Throws Failure
// (INVALID_ARGUMENT).
EvaluatedPoses choose_poses(const bake::ImportedCharacter& character, const bake::Recipe* recipe,
                            const PoseChoice& choice);

}  // namespace nook::measure
