// A model file stores the recipe of its model as text. The recipe contains all that is needed to make the
// training poses again.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/character/character_bake.h"
#include "bakers/character/rig_anatomy.h"
#include "bakers/import/gltf.h"

namespace nook::bake {

// The three presets of a bake, from the fastest to the slowest.

enum class Preset : std::uint8_t { draft, standard, production };

struct PresetValues {
  BakeSettings settings;
  std::size_t auto_poses = 0;
  std::size_t clip_poses = 0;  // total over all fitted clips
  std::size_t max_samples_per_clip = 64;
  int single_joint_steps = 5;  // steps per axis of the grid of rotations
};

// draft takes about a minute on two cores; use it for a first look. standard takes at most 5 minutes and 2 GB
// of memory; use it for shipping. production uses nearly four times the poses of standard, three times the
// steps, twice the rays, and 800 key points instead of 500.
PresetValues preset_values(Preset preset, FitMethod fit);

// Returns the number of poses per clip that gives all clips together about values.clip_poses poses. A clip
// gets at least 4 and at most max_samples_per_clip poses.
std::size_t samples_per_clip(const PresetValues& values, std::size_t clips);

enum class PoseMode : std::uint8_t { automatic, single_joint, clips, all, extra };

// Increase this number when a code change gives the same recipe other automatic poses or variants. Generation
// 4 changed bodies that are not people. Generation 5 changed these bodies again if clips are fitted. It also
// changed people whose palms have several bones or whose clavicles carry the arms.
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
  std::size_t extra_poses = 0;  // poses that the host passed in; a recipe cannot make them again
  // The first digits of the hash of the content that the bake read (content_hash.h). The string is empty in
  // recipes of earlier versions, which hashed the bytes of the file instead.
  std::string content;
  MeshSelection meshes;  // the meshes that the user selected for the bake
  RigCorrections rig;    // from a rig file
  BakeSettings settings;
};

inline constexpr float single_joint_range = 0.785398163f;  // radians: +-45 degrees

// Returns the clips of a character, including reference poses, in byte order of their names. The bits in the
// text of a recipe use this order.
std::vector<std::size_t> clips_by_name(const ImportedCharacter& character);

// Returns the share of edges that the character's clips tear (torn_edges.h), or 0 if there are no clips.
double torn_by_clips(const ImportedCharacter& character);

// Makes automatic poses with the corrections of the recipe's rig file. They depend on the mesh and its rig.
// Clips only set how many edges a pose may tear (torn_by_clips).
std::vector<Pose> automatic_poses(const ImportedCharacter& character, const Recipe& recipe, std::size_t count,
                                  std::uint64_t seed);

// Makes the training poses in this order: automatic poses, clips, variants of clips, single joints. Leaves
// out the host's extra poses. Fails with BAD_FILE if this version cannot make the poses of the recipe's
// generation.
std::vector<Pose> recipe_poses(const ImportedCharacter& character, const Recipe& recipe);

// Returns the digits of a character's source_hash that a recipe stores. The key of the bake uses four times
// as many digits.
std::string content_digits(const ImportedCharacter& character);

// Returns true if the character's content has changed since the bake read it. Returns false for recipes of
// earlier versions, which do not store a hash of the content.
bool reads_other_content(const Recipe& recipe, const ImportedCharacter& character);

// Returns the recipe as one line of JSON. To keep the line short, clips are stored as one bit per clip of
// clips_by_name, plus a hash of all names.
std::string recipe_text(const ImportedCharacter& character, const Recipe& recipe);

// Returns the mesh selection in the text of a recipe. It is empty if the recipe contains none, or if the text
// is not a recipe.
MeshSelection stored_meshes(std::string_view recipe_text);

// Fails with BAD_FILE if the text is not a recipe, or was made for a file with other clips.
Recipe read_recipe(const ImportedCharacter& character, std::string_view text);

const char* name_of(Preset preset);
const char* name_of(PoseMode mode);
const char* name_of(KernelForm form);
const char* name_of(FitMethod fit);

}  // namespace nook::bake
