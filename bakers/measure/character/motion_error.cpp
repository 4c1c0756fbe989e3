#include "bakers/measure/character/motion_error.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "bakers/import/clip.h"
#include "bakers/measure/character/character_error.h"
#include "sdk/src/core/failure.h"

namespace nook::measure {
namespace {

using namespace bake;

constexpr std::size_t least_frames = 8;

// Returns `count` frames at 60 Hz around the middle of a clip, or fewer if the clip is shorter.
std::vector<Pose> frames_of(const ImportedCharacter& character, std::size_t clip, std::size_t count) {
  const double duration_s = double(character.clips[clip].duration_s);
  const auto whole = std::size_t(duration_s * motion_frames_per_second) + 1;
  count = std::min(count, whole);
  const double first_s = (duration_s - double(count - 1) / motion_frames_per_second) / 2;
  std::vector<Pose> frames;
  for (std::size_t f = 0; f < count; ++f)
    frames.push_back(sample_clip(character, clip, float(first_s + double(f) / motion_frames_per_second)));
  return frames;
}

struct Rows {
  std::vector<float> model, truth;  // frames x vertices
};

Rows rows_of(const SkinnedMesh& mesh, const CharacterModel& model, std::span<const Pose> frames,
             std::uint32_t rays, std::uint64_t seed, const Progress& progress) {
  const std::size_t vertices = mesh.vertex_count();
  Rows rows{std::vector<float>(frames.size() * vertices), std::vector<float>(frames.size() * vertices)};
  std::mutex reporting;
  std::size_t done = 0;
  tbb::parallel_for(std::size_t(0), frames.size(), [&](std::size_t f) {
    // Each frame is traced by a separate call. All frames thus use the random numbers of pose 0.
    const AoTargets traced = trace_character_ao(mesh, frames.subspan(f, 1), rays, seed);
    const std::vector<float> ao = predict_ao(model, frames[f]);
    std::copy(ao.begin(), ao.end(), &rows.model[f * vertices]);
    for (std::size_t v = 0; v < vertices; ++v)
      rows.truth[f * vertices + v] = float(traced.row(0)[v]) * AoTargets::scale;
    const std::lock_guard lock(reporting);
    if (progress && !progress(++done, frames.size()))
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while ray tracing (%zu of %zu frames done)", done,
                    frames.size());
  });
  return rows;
}

}  // namespace

void add_steps(std::span<const float> model, std::span<const float> truth, std::size_t vertices,
               const std::string& clip, MotionErrors& errors) {
  const std::size_t frames = vertices ? model.size() / vertices : 0;
  double beyond_count = errors.share_beyond * double(errors.vertex_frames);
  for (std::size_t i = 0; i + vertices < model.size(); ++i) {
    const double step = std::abs(double(model[i + vertices]) - double(model[i])),
                 traced = std::abs(double(truth[i + vertices]) - double(truth[i])), beyond = step - traced;
    errors.largest_step = std::max(errors.largest_step, step);
    errors.largest_step_truth = std::max(errors.largest_step_truth, traced);
    if (beyond > visible_step) beyond_count += 1;
    if (beyond > errors.largest_beyond) {
      errors.largest_beyond = beyond;
      errors.worst_clip = clip;
    }
  }
  if (frames < 2) return;
  errors.frames += frames - 1;
  errors.vertex_frames += (frames - 1) * vertices;
  errors.share_beyond = beyond_count / double(errors.vertex_frames);
}

MotionErrors measure_motion(const ImportedCharacter& character, const CharacterModel& model,
                            std::span<const std::size_t> clips, std::size_t most_frames, std::uint32_t rays,
                            std::uint64_t seed, const Progress& progress) {
  if (clips.empty())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "no clip of the file shows motion; give a file with a clip that does");
  const std::size_t each = std::max(least_frames, most_frames / clips.size());
  MotionErrors errors;
  for (std::size_t c = 0; c < clips.size(); ++c) {
    const std::vector<Pose> frames = frames_of(character, clips[c], each);
    const Rows rows =
        rows_of(character.mesh, model, frames, rays, seed, [&](std::size_t done, std::size_t total) {
          return !progress || progress(c * total + done, clips.size() * total);
        });
    add_steps(rows.model, rows.truth, character.mesh.vertex_count(), character.clips[clips[c]].name, errors);
  }
  return errors;
}

}  // namespace nook::measure
