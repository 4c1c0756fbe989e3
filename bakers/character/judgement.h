// Measures the error of a bake on poses that the bake did not fit, and compares it with static bakes, in
// total and per part of the body.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bakers/character/recipe.h"
#include "bakers/import/gltf.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

// The poses that a model is judged on. The bake fitted none of them.
struct JudgedPoses {
  enum class Source : std::uint8_t {
    other_clips,     // clips of the file that the bake did not fit
    between_frames,  // halfway between the fitted frames of the clips
    generated,       // automatic poses with another seed, because the file has no clip
    turned,          // turns of an object with one bone
    recorded,        // every fourth recorded pose that was passed for calibration
  };
  Source source = Source::generated;
  std::vector<Pose> poses;
  std::vector<std::string> clips;  // names
  std::vector<std::size_t> clip;   // for each pose, an index into clips; empty without clips
};
JudgedPoses judged_poses(const ImportedCharacter& character, const Recipe& recipe);
const char* text_of(JudgedPoses::Source source);

// Mean squared errors over all pairs of a vertex and a pose with a traced AO of at least 0.01. Each squared
// error is the product of the errors against two independent halves of the rays, so it does not contain the
// rays' noise.
struct JudgedErrors {
  double model = 0, static_bake = 0;
  double over_static() const { return static_bake > 0 ? model / static_bake : 0; }
};

// A model is poor if its error, divided by a static bake's error, is above this ratio.
inline constexpr double poor_ratio = 0.25;

struct VisibleErrors {
  JudgedErrors by_vertices, by_area;
  // The oracle is the best possible static bake of these poses. Each vertex has its mean AO over the poses in
  // which it is visible.
  double oracle = 0;
};

// Compares the model with two ray traces of the poses that use independent rays.
VisibleErrors visible_errors(const SkinnedMesh& mesh, const CharacterModel& model,
                             std::span<const Pose> poses, const AoTargets& first, const AoTargets& second);

struct JudgedPart {
  std::string name;
  JudgedErrors error;
  double share_of_error = 0, share_of_area = 0;  // shares of the whole body's error and area
};

struct Judgement {
  JudgedPoses::Source source = JudgedPoses::Source::generated;
  std::size_t poses = 0;
  std::uint32_t rays = 0;
  VisibleErrors errors;
  std::vector<JudgedPart> clips, parts, meshes;  // worst first: clips by ratio, the others by share of error
  double torn_edges = 0;     // mean share of edges that an automatic pose tears; 0 without such poses
  double torn_by_clips = 0;  // the same share for the file's own clips
  std::vector<std::string> bones_without_role;  // the joints that move at least 2 % of the body's area

  double over_static() const { return errors.by_vertices.over_static(); }
  double over_oracle() const { return errors.oracle > 0 ? errors.by_vertices.model / errors.oracle : 0; }
  bool is_poor() const;
};

// Traces each pose with two halves of rays. The bits do not depend on the number of threads. Throws
// Failure(NOOK_ERROR_CANCELLED) if progress returns false.
Judgement judge_model(const ImportedCharacter& character, const CharacterModel& model, const Recipe& recipe,
                      const JudgedPoses& judged, std::uint64_t seed, const Progress& progress = {});

// Returns the figures in one or two sentences. For a poor model, also says what is wrong, why, and what to
// do.
std::string summary_of(const Judgement& judgement);

}  // namespace nook::bake
