#include "bakers/lab/crowd/motion_scenes.h"

#include <stdexcept>

#include "samples/crowd/places.h"

namespace crowd::lab {
namespace {

const glm::vec3 brick(0.58f, 0.25f, 0.17f), sand(0.64f, 0.55f, 0.40f), sage(0.36f, 0.47f, 0.33f);

// In the clip Walk of the built-in character, the body walks in place. The floor must move by 0.9 m in each
// cycle of the clip. This is the width of two floor tiles.
constexpr float walk_m = 0.9f;

MotionScene walk() {
  MotionScene scene;
  scene.movers = {{"Walk", -0.31f, 0, 0, 0, 1, brick}, {"Walk", 0.31f, -0.12f, 0, 0.42f, 1, sage}};
  scene.shots = {{"body", {{-1.35f, 1.15f, 3.3f}, {0, 0.93f, 0}, 0.56f}, 1.0f},
                 {"detail", {{-0.95f, 0.62f, 1.55f}, {-0.08f, 0.20f, -0.05f}, 0.42f}, 0.62f}};
  scene.floor_travel_m = {0, walk_m};
  scene.floor = {-2.0f, -2.1f, 2.7f, 200};
  return scene;
}

MotionScene together() {
  MotionScene scene;
  scene.movers = {{"Crouch", 0.05f, 0.25f, -0.5f, 0, 1, brick},
                  {"Dance", -0.50f, -0.35f, 0.3f, 0.25f, 2, sand},
                  {"Wave", 0.52f, -0.30f, -0.2f, 0.5f, 2, sage}};
  scene.shots = {{"body", {{-1.2f, 1.35f, 4.1f}, {0, 1.0f, 0}, 0.52f}, 1.15f}};
  scene.floor = {-2.4f, -2.6f, 3.4f, 290};
  return scene;
}

struct Named {
  const char* name;
  MotionScene (*make)();
};
constexpr Named scenes[] = {{"walk", walk}, {"together", together}};

std::uint32_t clip_named(const Hero& hero, const std::string& name) {
  for (std::uint32_t i = 0; i < hero.clips().size(); ++i)
    if (hero.character().name(NOOK_BAKE_NAME_CLIP, hero.clips()[i].index) == name) return i;
  throw std::runtime_error("motion: the character has no clip " + name +
                           "; leave out the character to use the built-in one");
}

}  // namespace

std::vector<std::string> motion_scene_names() {
  std::vector<std::string> names;
  for (const Named& scene : scenes) names.push_back(scene.name);
  return names;
}

MotionScene motion_scene(std::string_view name) {
  for (const Named& scene : scenes)
    if (name == scene.name) return scene.make();
  throw std::runtime_error("motion: there is no scene " + std::string(name));
}

std::vector<Bones> poses_of(const Hero& hero, const MotionScene& scene, float part) {
  std::vector<Bones> poses;
  for (const Mover& mover : scene.movers) {
    Placement place;
    place.x_m = mover.x_m;
    place.z_m = mover.z_m;
    place.yaw_rad = mover.yaw_rad;
    place.clip = clip_named(hero, mover.clip);
    place.phase = mover.phase + float(mover.cycles) * part;
    poses.push_back(placed_pose(hero, place, 0));
  }
  return poses;
}

}  // namespace crowd::lab
