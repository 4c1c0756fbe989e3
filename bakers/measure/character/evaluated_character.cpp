#include "bakers/measure/character/evaluated_character.h"

#include <algorithm>

#include "bakers/character/pose_sets.h"
#include "sdk/src/character/model_file.h"
#include "sdk/src/core/failure.h"

namespace nook::measure {
namespace {

using namespace bake;

void require_same(const char* what, std::size_t got, std::size_t needed) {
  if (got != needed)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "the model was not baked from this character (%s: got %zu, need %zu); bake the model "
                  "again, or choose the same meshes as in its bake (--mesh, --without)",
                  what, got, needed);
}

std::vector<std::size_t> named_clips(const ImportedCharacter& character,
                                     const std::vector<std::string>& names) {
  std::vector<std::size_t> clips;
  for (const std::string& name : names) clips.push_back(find_clip(character, name));
  return clips;
}

}  // namespace

BakedCharacter read_baked_character(bake::ImportedCharacter character, std::vector<std::byte> model_bytes) {
  BakedCharacter baked;
  baked.character = std::move(character);
  baked.model_bytes = std::move(model_bytes);
  baked.model = read_character_model(baked.model_bytes);
  const bake::SkinnedMesh& mesh = baked.character.mesh;
  require_same("bones", baked.model.bone_count(), mesh.bones.size());
  require_same("vertices", baked.model.vertex_count(), mesh.vertex_count());
  require_same("file vertices", baked.model.file_to_welded.size(), mesh.file_to_welded.size());
  return baked;
}

EvaluatedPoses choose_poses(const ImportedCharacter& character, const Recipe* recipe,
                            const PoseChoice& choice) {
  EvaluatedPoses result;
  if (choice.training) {
    if (!recipe)
      throw Failure(
          NOOK_ERROR_INVALID_ARGUMENT,
          "--poses training needs a model that contains the recipe of its training poses; use --poses clips");
    result.poses = recipe_poses(character, *recipe);
    if (result.poses.empty())
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "--poses training: the model was fitted only to poses that a program passed to the bake, "
                    "and the model does not store these poses; use --poses clips");
    result.protocol = "training poses";
    thin_out(result.poses, choice.most);
    return result;
  }
  if (choice.clips.empty() && character.mesh.bones.size() == 1 && motion_clips(character).empty()) {
    // The offset of 0.5 places these rotations halfway between the rotations that the bake used.
    result.poses = turned_poses(choice.most ? choice.most : choice.samples_per_clip, 0.5f);
    result.protocol = "turned";
    return result;
  }
  std::vector<std::size_t> clips;
  if (!choice.clips.empty()) {
    clips = named_clips(character, choice.clips);
    result.protocol = "named clips";
  } else {
    for (std::size_t clip : motion_clips(character))
      if (!recipe || std::find(recipe->clips.begin(), recipe->clips.end(), clip) == recipe->clips.end())
        clips.push_back(clip);
    result.protocol = "unseen clips";
    if (clips.empty()) {
      clips = motion_clips(character);
      result.protocol = "all clips";
    }
  }
  if (clips.empty())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the file has no clip that shows motion; use --poses training, or --clips");
  result.poses = clip_poses(character, clips, choice.samples_per_clip);
  for (std::size_t i = 0; i < clips.size(); ++i) {
    result.clips.push_back(character.clips[clips[i]].name);
    result.clip.insert(result.clip.end(), choice.samples_per_clip, i);
  }
  thin_out(result.poses, choice.most);
  thin_out(result.clip, choice.most);
  return result;
}

}  // namespace nook::measure
