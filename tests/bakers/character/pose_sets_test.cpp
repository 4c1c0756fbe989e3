// Which clips are fitted and which are kept for measuring.
#include "bakers/character/pose_sets.h"

#include "bakers/character/recipe.h"
#include "tests/catch.h"

using namespace nook::bake;

namespace {

ImportedCharacter with_clips(std::initializer_list<const char*> names) {
  ImportedCharacter character;
  for (const char* name : names) {
    Clip clip;
    clip.name = name;
    character.clips.push_back(clip);
  }
  return character;
}

std::vector<std::string> names_of(const ImportedCharacter& character, const std::vector<std::size_t>& clips) {
  std::vector<std::string> names;
  for (const std::size_t c : clips) names.push_back(character.clips[c].name);
  return names;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("motion clips come in byte order of their names, without T- and A-poses") {
  const ImportedCharacter character = with_clips({"Walk", "T-Pose", "idle", "A_Pose", "Jump"});
  CHECK(names_of(character, motion_clips(character)) == Names{"Jump", "Walk", "idle"});
}

TEST_CASE("half of the clips are fitted, the first included") {
  const ImportedCharacter character = with_clips({"a", "b", "c", "d", "e"});
  const ClipSplit split = split_clips(motion_clips(character));
  CHECK(names_of(character, split.fitted) == Names{"a", "c", "e"});
  CHECK(names_of(character, split.measured) == Names{"b", "d"});
}

TEST_CASE("a family of clips stays on one side") {
  const ImportedCharacter character = with_clips(
      {"Crouch_Idle", "Crouch_Walk", "Dance", "Jump_Land", "Jump_Start", "Roll", "Sit_Enter", "Sit_Exit"});
  const ClipSplit split = split_families(character, motion_clips(character));
  CHECK(names_of(character, split.fitted) ==
        Names{"Crouch_Idle", "Crouch_Walk", "Jump_Land", "Jump_Start", "Sit_Enter", "Sit_Exit"});
  CHECK(names_of(character, split.measured) == Names{"Dance", "Roll"});
}

TEST_CASE("clips of one family are never on both sides of the split, whatever their names are") {
  const auto split_of = [](std::initializer_list<const char*> names) {
    const ImportedCharacter character = with_clips(names);
    const ClipSplit split = split_families(character, motion_clips(character));
    return std::pair(names_of(character, split.fitted), names_of(character, split.measured));
  };
  using Split = std::pair<Names, Names>;
  // Between Jump and Jump_Start stand others in byte order.
  CHECK(split_of({"Jump", "JumpTwice", "Jump2", "Jump_Start", "Sit"}) ==
        Split({"Jump", "Jump2", "JumpTwice", "Jump_Start"}, {"Sit"}));
  CHECK(split_of({"Death01", "Death02", "Idle"}) == Split({"Death01", "Death02"}, {"Idle"}));
  CHECK(split_of({"walk.001", "walk.002", "walk-end", "run"}) ==
        Split({"run"}, {"walk-end", "walk.001", "walk.002"}));
  CHECK(split_of({"JumpStart", "JumpLand", "Idle"}) == Split({"Idle"}, {"JumpLand", "JumpStart"}));
  CHECK(split_of({"Walk_Loop", "walk_end", "Run"}) == Split({"Run"}, {"Walk_Loop", "walk_end"}));
  CHECK(split_of({"Armature|Sit_Enter", "Armature|Sit_Exit", "Armature|Walk"}) ==
        Split({"Armature|Sit_Enter", "Armature|Sit_Exit"}, {"Armature|Walk"}));
  CHECK(split_of({"hero:Sit Enter", "hero:Sit Exit", "hero:Walk"}) ==
        Split({"hero:Sit Enter", "hero:Sit Exit"}, {"hero:Walk"}));
  CHECK(split_of({"UALWalk", "UAL_Run", "Idle"}) == Split({"Idle"}, {"UALWalk", "UAL_Run"}));
  // A prefix of all names does not count, with and without an armature.
  CHECK(split_of({"Robot_Dance", "Robot_Jump_Land", "Robot_Jump_Start"}) ==
        Split({"Robot_Dance"}, {"Robot_Jump_Land", "Robot_Jump_Start"}));
  CHECK(split_of({"Armature|Robot_Sit", "Armature|Robot_Walk"}) ==
        Split({"Armature|Robot_Sit"}, {"Armature|Robot_Walk"}));
  // A prefix ends at a sign or a digit, not inside of a word.
  CHECK(split_of({"Robot_Walk", "Robot_Wave"}) == Split({"Robot_Walk"}, {"Robot_Wave"}));
  CHECK(split_of({"Walk_Start", "WalkLoop", "Walk2"}) == Split({"Walk2", "WalkLoop", "Walk_Start"}, {}));
  CHECK(split_of({"Walk_Start"}) == Split({"Walk_Start"}, {}));
  // Clips whose names have no word stay together.
  CHECK(split_of({"001", "002", "003"}) == Split({"001", "002", "003"}, {}));
}

TEST_CASE("presets set the poses of all clips together, at most so many of each, and the key points") {
  const PresetValues standard = preset_values(Preset::standard, FitMethod::nook),
                     production = preset_values(Preset::production, FitMethod::nook);
  CHECK(samples_per_clip(standard, 0) == 0);
  CHECK(samples_per_clip(standard, 21) == 52);
  CHECK(samples_per_clip(standard, 1) == 64);
  CHECK(samples_per_clip(standard, 5000) == 4);
  CHECK(samples_per_clip(production, 21) == 190);
  CHECK(samples_per_clip(production, 1) == 256);
  CHECK(standard.settings.key_points == 500);
  CHECK(production.settings.key_points == 800);
  CHECK(preset_values(Preset::production, FitMethod::paper).settings.key_points == 500);
}
