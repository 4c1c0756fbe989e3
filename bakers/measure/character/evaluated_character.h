// An evaluation of a character measures a file and the model that was baked from it, in chosen poses.
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
  bool training = false;           // the poses that the model was fitted to, made again from its recipe
  std::vector<std::string> clips;  // only these, all of the file; empty: see below
  std::size_t samples_per_clip = 20;
  std::size_t most = 0;  // 0: all; otherwise about this many, picked evenly
};

struct EvaluatedPoses {
  std::vector<bake::Pose> poses;
  std::string protocol;            // "unseen clips", "all clips", "named clips", "training poses", "turned"
  std::vector<std::string> clips;  // measured
  std::vector<std::size_t> clip;   // of each pose, an index into clips; empty for training poses
};

// Without names: the motion clips that the recipe did not fit, or all of them if it fitted all. recipe may be
// null when none could be read; then all motion clips are measured. An object of one bone without clips is
// turned about the vertical axis instead. Throws Failure (INVALID_ARGUMENT).
EvaluatedPoses choose_poses(const bake::ImportedCharacter& character, const bake::Recipe* recipe,
                            const PoseChoice& choice);

}  // namespace nook::measure
