#include "bakers/tool/nnao/scenes.h"

#include <cmath>
#include <cstdio>

#include "bakers/tool/tool_error.h"
#include "sdk/src/core/geometry.h"

namespace nook::tool {
namespace {

using namespace measure;

[[noreturn]] void refuse(const std::string& text) {
  throw ToolError(exit_bad_arguments, "evaluate nnao: " + text);
}

// The value of an option for one scene, or for all.
struct Word {
  std::string scene, value;
};

Word split(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos) return {"", text};
  return {text.substr(0, colon), text.substr(colon + 1)};
}

GivenCamera parse_camera(const std::string& text) {
  float v[7];
  int used = 0;
  const int count =
      std::sscanf(text.c_str(), "%f,%f,%f,%f,%f,%f,%f%n", v, v + 1, v + 2, v + 3, v + 4, v + 5, v + 6, &used);
  const bool is_whole = count == 7 && std::size_t(used) == text.size();
  const Vec3 eye{v[0], v[1], v[2]}, target{v[3], v[4], v[5]};
  if (!is_whole || !is_place(eye) || !is_place(target) || !(v[6] >= 1 && v[6] <= 170) || eye == target)
    refuse(
        "--camera: got " + text +
        ", need ox,oy,oz,tx,ty,tz,fov: seven numbers, the eye apart from the target, metres up to 1e6, fov 1 "
        "to 170 degrees");
  return {eye, target, v[6] * degree, {}, 0};
}

float parse_radius(const std::string& text) {
  float radius = 0;
  int used = 0;
  if (std::sscanf(text.c_str(), "%f%n", &radius, &used) != 1 || std::size_t(used) != text.size() ||
      !(radius >= smallest_radius && radius <= largest_radius))
    refuse("--radius: got " + text + ", need 0.001 to 1000 metres");
  return radius;
}

// visit(scene, value) for every scene that the word is about.
template <class Visit>
void apply(std::vector<SceneRequest>& scenes, const std::string& option, const std::string& text,
           const Visit& visit) {
  const Word word = split(text);
  bool known = word.scene.empty();
  for (SceneRequest& scene : scenes)
    if (word.scene.empty() || word.scene == scene.name) {
      visit(scene, word.value);
      known = true;
    }
  if (!known) refuse(option + ": there is no scene of this name (got " + word.scene + ")");
}

}  // namespace

std::vector<SceneRequest> parse_scenes(const SceneWords& words) {
  std::vector<SceneRequest> scenes;
  for (const std::filesystem::path& file : words.files)
    scenes.push_back({file.stem().string(), file, 0.5f, {}, words.linked, {}});
  if (words.thin) scenes.push_back({"thin", {}, 0.5f, {}, words.linked, {}});
  for (std::size_t i = 0; i < scenes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (scenes[i].name == scenes[j].name) refuse("two scenes have one name (got " + scenes[i].name + ")");
  for (const std::string& text : words.radii)
    apply(scenes, "--radius", text,
          [](SceneRequest& scene, const std::string& value) { scene.radius = parse_radius(value); });
  for (const std::string& text : words.cameras)
    apply(scenes, "--camera", text, [](SceneRequest& scene, const std::string& value) {
      scene.cameras.push_back(parse_camera(value));
    });
  return scenes;
}

}  // namespace nook::tool
