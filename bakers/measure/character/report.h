// Rows of the report on a baked character, as `nook evaluate character` and `nook evaluate casters` print
// them.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "bakers/measure/character/baked_character.h"
#include "bakers/measure/character/casters.h"
#include "bakers/measure/character/evaluate.h"
#include "bakers/measure/character/evaluated_poses.h"

namespace nook::measure {

// The recipe in the model's file; none where the model holds none. Throws Failure (BAD_FILE).
std::optional<bake::Recipe> recipe_of(const BakedCharacter& baked);

struct CharacterReportSettings {
  std::string name;  // in the row
  std::uint32_t rays = 256;
  std::uint64_t seed = 1;
  bool baselines =
      false;  // also fit the linear pose model and the pose clusters, to the model's own training poses
};

// Shows a stage. The function that it returns is called at every step; false stops with Failure (CANCELLED).
using StageProgress = std::function<bake::Progress(const char* stage)>;

struct CharacterReport {
  nlohmann::ordered_json row;
  bake::CharacterEvaluation evaluation;
};

// Throws Failure (INVALID_ARGUMENT) where the baselines lack a recipe.
CharacterReport measure_character(const BakedCharacter& baked, const bake::Recipe* recipe,
                                  const EvaluatedPoses& measured, const CharacterReportSettings& settings,
                                  const StageProgress& progress);

// The seed of the evaluation's rays, which differs from the fit's.
std::uint64_t evaluation_ray_seed(std::uint64_t seed);

// Poses spread over the motion clips; the rest pose where there are none.
std::vector<bake::Pose> caster_poses(const bake::ImportedCharacter& character, std::size_t count);
// Two bodies in the middles of two clips, the caster moved from the receiver's middle by `offset` metres and
// turned about the vertical axis. Throws Failure (INVALID_ARGUMENT) for an unknown clip.
bake::BodyPair contact_pair(const BakedCharacter& baked, const std::string& receiver_clip,
                            const std::string& caster_clip, Vec3 offset, float turn_degrees);
nlohmann::ordered_json caster_rows(const std::vector<bake::CasterRow>& rows);

}  // namespace nook::measure
