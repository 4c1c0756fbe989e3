#include <algorithm>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "samples/showcase/gltf_meshes.h"
#include "samples/showcase/stage.h"

namespace showcase {
namespace {

using nlohmann::json;

glm::vec3 vec3_of(const json& numbers) {
  return {numbers.at(0).get<float>(), numbers.at(1).get<float>(), numbers.at(2).get<float>()};
}

glm::mat4 placed(const json& prop) {
  const glm::mat4 moved = glm::translate(glm::mat4(1), vec3_of(prop.at("place")));
  const glm::mat4 turned = glm::rotate(moved, glm::radians(prop.value("yaw_degrees", 0.0f)), {0, 1, 0});
  return glm::scale(turned, glm::vec3(prop.value("scale", 1.0f)));
}

Sky sky_of(const json& j) {
  Sky sky;
  sky.zenith = vec3_of(j.at("zenith"));
  sky.horizon = vec3_of(j.at("horizon"));
  sky.ground = vec3_of(j.at("ground"));
  sky.glow = j.at("glow").get<float>();
  sky.to_sun = glm::normalize(vec3_of(j.at("to_sun")));
  sky.sun_degrees = j.at("sun_degrees").get<float>();
  sky.sun = vec3_of(j.at("sun"));
  return sky;
}

Actor actor_of(const json& j, const std::filesystem::path& assets, const std::filesystem::path& models) {
  Actor actor;
  const std::string file = j.at("character").get<std::string>();
  actor.character = assets / file;
  actor.model = models / std::filesystem::path(file).filename().replace_extension(".nook");
  actor.without = j.value("without", std::vector<std::string>());
  actor.clip = j.at("clip").get<std::string>();
  actor.time_s = j.value("time_s", 0.0f);
  actor.place_ws = vec3_of(j.at("place"));
  actor.yaw_rad = glm::radians(j.value("yaw_degrees", 0.0f));
  return actor;
}

Stage stage_of(const json& j, const std::filesystem::path& assets, const std::filesystem::path& models) {
  Stage stage;
  for (const json& prop : j.at("props"))
    for (Mesh& mesh : read_prop(assets / prop.at("file").get<std::string>(), placed(prop), stage.textures))
      stage.props.push_back(std::move(mesh));
  for (const json& wall : j.at("walls"))
    stage.walls.push_back({vec3_of(wall.at("low")), vec3_of(wall.at("high"))});
  for (const json& actor : j.at("actors")) stage.actors.push_back(actor_of(actor, assets, models));
  for (const auto& [name, shot] : j.at("shots").items())
    stage.shots[name] = {vec3_of(shot.at("eye")), vec3_of(shot.at("target")),
                         glm::radians(shot.at("fov_degrees").get<float>())};
  stage.probe_ws = vec3_of(j.at("probe"));
  stage.sky = sky_of(j.at("sky"));
  stage.radius_m = j.at("radius").get<float>();
  stage.exposure = j.at("exposure").get<float>();
  return stage;
}

}  // namespace

Stage read_stage(const std::filesystem::path& file, const std::filesystem::path& assets,
                 const std::filesystem::path& models) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("showcase: cannot open " + file.string());
  try {
    return stage_of(json::parse(in), assets, models);
  } catch (const json::exception& e) {
    throw std::runtime_error("showcase: " + file.string() + ": " + e.what());
  }
}

}  // namespace showcase
