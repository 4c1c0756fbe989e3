// Rows of the report on a baked character, as `nook evaluate character` and `nook evaluate casters` print
// them.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>

#include "bakers/measure/character/caster_error.h"
#include "bakers/measure/character/character_error.h"
#include "bakers/measure/character/evaluated_character.h"

namespace nook::measure {

// Returns the recipe that is stored in the model's file, or nothing if the file has none. Throws Failure
// (BAD_FILE).
std::optional<bake::Recipe> stored_recipe(const BakedCharacter& baked);

// Another method that is measured beside the model. It is fitted to the model's training poses. The keys of
// the row contain the method's name: mse_NAME, mse_NAME_visible, mse_area_NAME, bytes_NAME and tuned_NAME.
struct CharacterPeer {
  const char* name;
  std::unique_ptr<PoseRegression> (*fit)(const bake::SkinnedMesh& mesh, std::span<const bake::Pose> training,
                                         const bake::AoTargets& targets, std::uint64_t seed);
};

struct CharacterReportSettings {
  std::string name;  // name of the method in the row
  std::uint32_t rays = 256;
  std::uint64_t seed = 1;
  std::span<const CharacterPeer> peers;
};

// The measurement calls this function at the start of each stage, and calls the returned function at every
// step of the stage. If the returned function returns false, the measurement stops with Failure (CANCELLED).
using StageProgress = std::function<bake::Progress(const char* stage)>;

struct CharacterReport {
  nlohmann::ordered_json row;
  CharacterEvaluation evaluation;
};

// Throws Failure (INVALID_ARGUMENT) if `peers` is not empty and the recipe cannot reproduce the model's
// training poses, which the other methods are fitted to.
CharacterReport measure_character(const BakedCharacter& baked, const bake::Recipe* recipe,
                                  const EvaluatedPoses& measured, const CharacterReportSettings& settings,
                                  const StageProgress& progress);

// Returns the seed for the rays of the evaluation. It differs from the seed of the fit.
std::uint64_t evaluation_ray_seed(std::uint64_t seed);

// Returns poses spread over the motion clips, or the rest pose if there are no clips.
std::vector<bake::Pose> caster_poses(const bake::ImportedCharacter& character, std::size_t count);
// Makes a pair of bodies. Each has the pose in the middle of its clip. Moves the caster from the receiver's
// centre by `offset` (metres) and turns it about the vertical axis. Throws Failure (INVALID_ARGUMENT) for an
// unknown clip.
BodyPair contact_pair(const BakedCharacter& baked, const std::string& receiver_clip,
                      const std::string& caster_clip, Vec3 offset, float turn_degrees);
nlohmann::ordered_json caster_rows(const std::vector<CasterRow>& rows);

}  // namespace nook::measure
