// Recipes in files: what an earlier version wrote is read, and poses that cannot be made again are refused.
#include "bakers/character/recipe.h"

#include <algorithm>
#include <iterator>
#include <string>

#include "sdk/src/core/failure.h"
#include "tests/bakers/character/bending_tube.h"
#include "tests/bakers/character/stick_figure.h"
#include "tests/bakers/character/tube_rigs.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;

namespace {

ImportedCharacter tube_character() {
  ImportedCharacter character;
  character.mesh = bending_tube();
  return character;
}

// The text of a file from before generations of poses and variants.
const char* early_text(const char* auto_poses, const char* single_joint_steps) {
  static std::string text;
  text = std::string(R"({"nook":"0.2","source":"00000000000000ff","preset":"draft","poses":"auto",)") +
         R"("auto_poses":)" + auto_poses + R"(,"samples_per_clip":0,"single_joint_steps":)" +
         single_joint_steps +
         R"(,"extra_poses":0,"seed":3,"rays":16,"spheres":8,"key_points":30,"steps":10,"kernel":"nook",)" +
         R"("fit":"nook","time_limit_s":0.0})";
  return text.c_str();
}

}  // namespace

TEST_CASE("a recipe comes back from its text") {
  const ImportedCharacter character = tube_character();
  Recipe recipe;
  recipe.auto_poses = 5;
  recipe.variant_poses = 7;
  recipe.settings.seed = 9;
  recipe.settings.saturation = 0.25f;
  const Recipe read = read_recipe(character, recipe_text(character, recipe));
  CHECK(read.auto_poses == 5);
  CHECK(read.variant_poses == 7);
  CHECK(read.generation == pose_generation);
  CHECK(read.settings.seed == 9);
  CHECK(read.settings.saturation == 0.25f);
  recipe.settings.kernel.gamma = 2;  // with which a bake saturates no shadow
  CHECK(read_recipe(character, recipe_text(character, recipe)).settings.saturation == 0);
  CHECK(recipe_poses(character, read).size() == 5);  // without clips there is nothing to make variants of
}

TEST_CASE("an early recipe is read, and its automatic poses are refused") {
  const ImportedCharacter character = tube_character();
  const Recipe early = read_recipe(character, early_text("5", "0"));
  CHECK(early.generation == 1);
  CHECK(early.variant_poses == 0);
  CHECK(early.settings.saturation == 0);
  try {
    recipe_poses(character, early);
    FAIL("made poses of another generation");
  } catch (const Failure& failure) {
    CHECK(failure.code() == NOOK_ERROR_BAD_FILE);
    CHECK(std::string(failure.what()).find("(got generation 1, need 5); bake the model again") !=
          std::string::npos);
  }
  // Single joints have not changed.
  CHECK(recipe_poses(character, read_recipe(character, early_text("0", "3"))).size() == 27);
}

TEST_CASE("people keep their poses of generation 4, and animals where no clip is fitted") {
  ImportedCharacter person, animal;
  person.mesh = stick_figure();
  animal.mesh = quadruped();
  Recipe recipe;
  recipe.auto_poses = 2;
  recipe.generation = 4;
  CHECK(recipe_poses(person, recipe).size() == 2);
  CHECK(recipe_poses(animal, recipe).size() == 2);
  recipe.generation = 3;
  CHECK(recipe_poses(person, recipe).size() == 2);
  CHECK_THROWS_AS(recipe_poses(animal, recipe), Failure);
}

TEST_CASE("automatic poses follow the rig alone, whichever clip is fitted") {
  ImportedCharacter character;
  character.mesh = quadruped();
  character.clips.emplace_back();
  character.clips.back().name = "T-Pose";  // which says nothing about the tears that clips have
  Recipe without, with;
  with.clips = {0};
  with.samples_per_clip = 3;
  const std::vector<Pose> a = automatic_poses(character, with, 12, 5),
                          b = automatic_poses(character, without, 12, 5);
  REQUIRE(a.size() == 12);
  for (std::size_t p = 0; p < a.size(); ++p)
    for (std::size_t bone = 0; bone < a[p].size(); ++bone)
      CHECK(std::equal(std::begin(a[p][bone].m), std::end(a[p][bone].m), std::begin(b[p][bone].m)));
  // Generation 4 mixed them with the clip.
  with.auto_poses = 12;
  with.generation = 4;
  CHECK_THROWS_AS(recipe_poses(character, with), Failure);
}
