// The recipe of a model, as text inside its file. It is enough to make the same training poses again.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/character/character_bake.h"
#include "bakers/character/rig_anatomy.h"
#include "bakers/import/gltf.h"

namespace nook::bake {

// The three presets of a bake, by the time that it spends.

enum class Preset : std::uint8_t { draft, standard, production };

struct PresetValues {
  BakeSettings settings;
  std::size_t auto_poses = 0;
  std::size_t clip_poses = 0;  // of all fitted clips together
  std::size_t max_samples_per_clip = 64;
  int single_joint_steps = 5;  // per side of the grid of rotations
};

// draft: about 20 s on two cores, for a first look. standard: within 5 minutes and 2 GB, for shipping.
// production: nearly four times the poses of standard, three times its steps, twice its rays, and 800 key
// points in place of 500.
PresetValues preset_values(Preset preset, FitMethod fit);

// Returns the number of poses of each clip, so that all clips together come near the preset's number. A clip
// gets at least 4 and at most max_samples_per_clip poses.
std::size_t samples_per_clip(const PresetValues& values, std::size_t clips);

enum class PoseMode : std::uint8_t { automatic, single_joint, clips, all, extra };

// Raise it when the same recipe begins to make other automatic poses or variants.
// Generation 4 changed bodies that are not people. Generation 5 changed them where clips are fitted, and
// people whose palms have several bones or whose clavicles carry the arms.
inline constexpr int pose_generation = 5;

struct Recipe {
  Preset preset = Preset::standard;
  PoseMode poses = PoseMode::all;
  std::size_t auto_poses = 0;      // 0: none
  std::vector<std::size_t> clips;  // indices into the character's clips, in byte order of their names
  std::size_t samples_per_clip = 0;
  std::size_t variant_poses = 0;  // made from the clips' poses
  int generation = pose_generation;
  int single_joint_steps = 0;   // 0: none
  std::size_t extra_poses = 0;  // given by the host; a recipe cannot make them again
  // The first digits of the hash of what the bake read (content_hash.h). Empty: an earlier version, which
  // hashed the bytes of the file.
  std::string content;
  MeshSelection meshes;  // what the bake was asked to read
  RigCorrections rig;    // of a rig file
  BakeSettings settings;
};

inline constexpr float single_joint_range = 0.785398163f;  // radians: +-45 degrees

// Returns the clips of a character in byte order of their names, reference poses included. The recipe's bits
// count in this order.
std::vector<std::size_t> clips_by_name(const ImportedCharacter& character);

// Returns the share of edges that the character's clips tear, 0 without any (torn_edges.h).
double torn_by_clips(const ImportedCharacter& character);

// Makes automatic poses with the recipe's rig file. They follow from the rig alone; pose_variants.h carries
// the ranges of clips over.
std::vector<Pose> automatic_poses(const ImportedCharacter& character, const Recipe& recipe, std::size_t count,
                                  std::uint64_t seed);

// Makes the training poses in this order: automatic ones, clips, their variants, single joints. The host's
// extra poses are not included. Fails with BAD_FILE if an earlier generation made poses that this one cannot
// make again.
std::vector<Pose> recipe_poses(const ImportedCharacter& character, const Recipe& recipe);

// The digits of an imported character's source_hash that a recipe stores; the key of the bake has four times
// as many.
std::string content_digits(const ImportedCharacter& character);

// Returns whether the bake read something else than what the character is now. Recipes of earlier versions do
// not say what the bake read.
bool reads_other_content(const Recipe& recipe, const ImportedCharacter& character);

// Returns one line of JSON. Clips are stored as bits over clips_by_name with a hash of all names, so that the
// line stays short.
std::string recipe_text(const ImportedCharacter& character, const Recipe& recipe);

// Returns the choice of meshes in the text of a recipe; empty if there is none, or the text is not a recipe.
MeshSelection stored_meshes(std::string_view recipe_text);

// Fails with BAD_FILE if the text is not a recipe, or was made for a file with other clips.
Recipe read_recipe(const ImportedCharacter& character, std::string_view text);

const char* name_of(Preset preset);
const char* name_of(PoseMode mode);
const char* name_of(KernelForm form);
const char* name_of(FitMethod fit);

}  // namespace nook::bake
