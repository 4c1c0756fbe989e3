#include "bakers/tool/nnao/views_file.h"

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "bakers/tool/input_file.h"
#include "bakers/tool/nnao/scenes.h"
#include "sdk/src/core/geometry.h"

namespace nook::tool {
namespace {

using namespace measure;
using Json = nlohmann::json;

[[noreturn]] void refuse(const std::string& text) {
  throw ToolError(exit_bad_input, text);
}

Vec3 read_place(const Json& numbers, const std::string& what) {
  const auto v = numbers.get<std::vector<float>>();
  if (v.size() != 3 || !is_place({v[0], v[1], v[2]}))
    refuse(what + ": got " + numbers.dump() + ", need three numbers, metres up to 1e6");
  return {v[0], v[1], v[2]};
}

float read_radius(const Json& json, const std::string& what) {
  const float radius = json.at("radius").get<float>();
  if (!(radius >= smallest_radius && radius <= largest_radius))
    refuse(what + ": got a radius of " + json.at("radius").dump() + ", need 0.001 to 1000 metres");
  return radius;
}

GivenCamera read_camera(const Json& json, const std::string& scene) {
  GivenCamera camera;
  camera.name = json.at("name").get<std::string>();
  const std::string what = scene + ", camera " + camera.name;
  camera.eye = read_place(json.at("eye"), what);
  camera.target = read_place(json.at("target"), what);
  const float fov = json.at("fov").get<float>();
  if (!(fov >= 1 && fov <= 170) || camera.eye == camera.target)
    refuse(what + ": need a target apart from the eye and a fov of 1 to 170 degrees");
  camera.fov = fov * degree;
  if (json.contains("radius")) camera.radius = read_radius(json, what);
  return camera;
}

SceneRequest read_scene(const Json& json, const std::string& source, const std::filesystem::path& folder) {
  SceneRequest scene;
  scene.name = json.at("name").get<std::string>();
  if (scene.name.empty() || scene.name.find_first_of("/\\") != std::string::npos)
    refuse("a scene has a name that is no file's (got " + scene.name + ")");
  scene.file = folder / (scene.name + ".glb");
  scene.source = source;
  scene.radius = read_radius(json, scene.name);
  for (const Json& camera : json.at("cameras")) scene.cameras.push_back(read_camera(camera, scene.name));
  if (scene.cameras.empty()) refuse(scene.name + " has no camera");
  return scene;
}

ViewsFile read_document(const Json& document, const std::filesystem::path& folder) {
  ViewsFile views;
  views.size = document.value("size", "");
  views.rays = document.value("rays", 0u);
  for (const Json& source : document.at("sources"))
    for (const Json& scene : source.at("scenes"))
      views.scenes.push_back(read_scene(scene, source.at("name").get<std::string>(), folder));
  if (views.scenes.empty()) refuse("it has no scene");
  for (const Json& ratio : document.value("ratios", Json::array()))
    views.ratios.push_back(parse_ratio(ratio.get<std::string>()));
  return views;
}

// Splits NAME:TAPS; returns 0 for anything else.
int split_taps(const std::string& text, std::string& name) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0) return 0;
  name = text.substr(0, colon);
  return std::atoi(text.c_str() + colon + 1);
}

}  // namespace

ViewsFile read_views_file(const std::filesystem::path& path, const std::filesystem::path& folder) {
  const std::vector<std::byte> bytes = read_file(path);
  const auto* const text = reinterpret_cast<const char*>(bytes.data());
  try {
    return read_document(Json::parse(text, text + bytes.size()), folder);
  } catch (const nlohmann::json::exception& fault) {
    refuse(path.string() + ": " + fault.what());
  } catch (const ToolError& fault) {
    refuse(path.string() + ": " + fault.what());
  }
}

MethodRatio parse_ratio(const std::string& text) {
  const std::size_t comma = text.find(',');
  MethodRatio ratio;
  if (comma != std::string::npos) {
    ratio.taps = split_taps(text.substr(0, comma), ratio.method);
    ratio.over_taps = split_taps(text.substr(comma + 1), ratio.over);
  }
  if (ratio.taps < 1 || ratio.over_taps < 1)
    throw ToolError(exit_bad_arguments,
                    "evaluate nnao: --ratio: got " + text + ", need METHOD:TAPS,METHOD:TAPS");
  return ratio;
}

}  // namespace nook::tool
