#include "bakers/measure/nnao/moving_body.h"

#include <algorithm>
#include <cmath>

#include "bakers/import/skinned_mesh.h"
#include "bakers/nnao/solids.h"
#include "sdk/src/core/failure.h"

namespace nook::measure {
namespace {

bool is_walk(std::string name) {
  std::ranges::transform(name, name.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  return name.find("walk") != std::string::npos;
}

}  // namespace

MovingBody walking_body(const bake::ImportedCharacter& character, std::size_t clip,
                        const WalkSettings& settings) {
  MovingBody body{character.mesh.triangle, {}};
  const float whole_s = float(settings.frames - 1) * settings.frame_s;
  const float start_s = settings.phase * std::max(character.clips[clip].duration_s - whole_s, 0.0f);
  for (std::size_t f = 0; f < settings.frames; ++f) {
    const float time_s = float(f) * settings.frame_s;
    const Mat3x4 world = bake::nnao::moved(bake::nnao::standing_frame({}, settings.heading),
                                           {0, 0, settings.speed_mps * (time_s - whole_s)});
    std::vector<Vec3>& position = body.position.emplace_back();
    bake::skin_positions(character.mesh, bake::sample_clip(character, clip, start_s + time_s), position);
    for (Vec3& p : position) p = transform_point(world, p);
  }
  return body;
}

std::size_t walking_clip(const bake::ImportedCharacter& character, const std::string& name) {
  if (character.clips.empty())
    throw Failure(NOOK_ERROR_BAD_FILE, "the file has no clip, need one that walks");
  if (!name.empty()) return bake::find_clip(character, name);
  const auto found =
      std::ranges::find_if(character.clips, [](const bake::Clip& clip) { return is_walk(clip.name); });
  return found == character.clips.end() ? 0 : std::size_t(found - character.clips.begin());
}

}  // namespace nook::measure
