// Recipes in files: what an earlier version wrote is read, and poses that cannot be made again are refused.
#include "bakers/character/recipe.h"

#include <string>

#include "sdk/src/core/failure.h"
#include "tests/bakers/character/bending_tube.h"
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
    CHECK(std::string(failure.what()).find("(got generation 1, need 4); bake it again") != std::string::npos);
  }
  // Single joints have not changed.
  CHECK(recipe_poses(character, read_recipe(character, early_text("0", "3"))).size() == 27);
}
