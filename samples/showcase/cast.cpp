#include "samples/showcase/cast.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <stdexcept>

#include "platform/file_bytes.h"
#include "samples/showcase/gltf_meshes.h"

namespace showcase {
namespace {

constexpr float ground_plane[4] = {0, 1, 0, 0};
constexpr float probe_height_m = 1.0f;

bool hits(const Wall& wall, const glm::vec3& from, const glm::vec3& direction) {
  const glm::vec3 a = (wall.low_ws - from) / direction, b = (wall.high_ws - from) / direction;
  const glm::vec3 first = glm::min(a, b), last = glm::max(a, b);
  const float in = std::max({first.x, first.y, first.z}), out = std::min({last.x, last.y, last.z});
  return in < out && out > 0;
}

nook::bake::Character import(const Actor& actor) {
  std::vector<const char*> without;
  for (const std::string& name : actor.without) without.push_back(name.c_str());
  const std::string path = actor.character.string();
  nook_bake_source_desc desc = nook::bake::source_desc();
  desc.path = path.c_str();
  desc.without = without.data();
  desc.without_count = std::uint32_t(without.size());
  return nook::bake::Character(desc);
}

std::uint32_t clip_named(const nook::bake::Character& character, const Actor& actor) {
  std::string names;
  for (std::uint32_t i = 0; i < character.info().clip_count; ++i) {
    const std::string name = character.name(NOOK_BAKE_NAME_CLIP, i);
    if (name == actor.clip) return i;
    names += (names.empty() ? "" : ", ") + name;
  }
  throw std::runtime_error("showcase: " + actor.character.string() + " has no clip " + actor.clip +
                           "; it has " + names);
}

// The matrices of all bones from rest space to world space.
std::vector<float> bones_of(const nook::bake::Character& character, const Actor& actor) {
  std::vector<float> bones = character.sample_clip(clip_named(character, actor), actor.time_s);
  const glm::mat4 place = glm::rotate(glm::translate(glm::mat4(1), actor.place_ws), actor.yaw_rad, {0, 1, 0});
  for (std::size_t b = 0; b < bones.size(); b += 12) {
    glm::mat4 rows(0);
    std::copy_n(&bones[b], 12, glm::value_ptr(rows));
    rows[3] = {0, 0, 0, 1};
    const glm::mat4 moved = glm::transpose(place * glm::transpose(rows));
    std::copy_n(glm::value_ptr(moved), 12, &bones[b]);
  }
  return bones;
}

Mesh posed_mesh(const nook::bake::Character& character, const std::vector<float>& bones, const Actor& actor,
                std::vector<Texture>& textures) {
  const nook_bake_character_info info = character.info();
  Mesh mesh;
  mesh.positions_ws.resize(info.file_vertex_count);
  mesh.normals_ws.resize(info.file_vertex_count);
  nook::bake::check(nook_bake_character_skin(character.get(), bones.data(), info.bone_count,
                                             glm::value_ptr(mesh.positions_ws[0]),
                                             glm::value_ptr(mesh.normals_ws[0]), info.file_vertex_count));
  mesh.triangles.resize(3 * std::size_t(info.triangle_count));
  character.read(NOOK_BAKE_ARRAY_TRIANGLES, mesh.triangles.data(), info.triangle_count);
  CharacterSkin skin = read_skin(actor.character, actor.without, textures);
  if (skin.texture == no_texture) {
    mesh.uvs.assign(info.file_vertex_count, glm::vec2(0));
    std::vector<glm::vec3> rest_m(info.file_vertex_count);
    character.read(NOOK_BAKE_ARRAY_POSITIONS, rest_m.data(), info.file_vertex_count);
    for (const glm::vec3& p : rest_m) mesh.colours.push_back(clothes(p, actor.shirt));
    return mesh;
  }
  if (skin.uvs.size() != info.file_vertex_count)
    throw std::runtime_error("showcase: " + actor.character.string() +
                             " has other meshes than its import; name the meshes that are left out exactly");
  mesh.uvs = std::move(skin.uvs);
  mesh.texture = skin.texture;
  mesh.colours.assign(info.file_vertex_count, glm::vec3(1));
  return mesh;
}

}  // namespace

glm::vec3 clothes(const glm::vec3& rest_m, const glm::vec3& shirt) {
  const glm::vec3 skin(0.56f, 0.37f, 0.28f), hair(0.11f, 0.075f, 0.055f), trousers(0.20f, 0.25f, 0.36f),
      shoe(0.30f, 0.24f, 0.19f);
  const glm::vec2 from_shoulder_m(std::abs(rest_m.x) - 0.187f, rest_m.y - 1.424f);
  const float along_m = (from_shoulder_m.x - from_shoulder_m.y) * 0.7071f,
              outward_m = (from_shoulder_m.x + from_shoulder_m.y) * 0.7071f;
  if (outward_m > -0.10f && rest_m.y < 1.47f && std::abs(rest_m.x) > 0.15f)
    return along_m > 0.235f ? skin : shirt;
  if (rest_m.y < 0.105f) return shoe;
  if (rest_m.y < 0.985f) return trousers;
  if (rest_m.y - 0.75f * rest_m.z > 1.69f) return hair;
  return rest_m.y - 0.35f * rest_m.z > 1.478f ? skin : shirt;
}

glm::vec3 sky_radiance(const Sky& sky, const glm::vec3& direction) {
  if (direction.y < 0) return sky.ground;
  const glm::vec3 base = glm::mix(sky.horizon, sky.zenith, std::sqrt(direction.y));
  return base + sky.glow * std::exp(4 * (glm::dot(direction, sky.to_sun) - 1)) * sky.horizon;
}

std::vector<nook_lobe> probe_of_sky(const nook::Context& context, const Stage& stage,
                                    const glm::vec3& place_ws) {
  constexpr std::uint32_t count = 8192;
  std::vector<glm::vec3> directions, radiance;
  for (std::uint32_t i = 0; i < count; ++i) {
    const float y = 1 - (2 * float(i) + 1) / float(count), r = std::sqrt(1 - y * y),
                turn = float(i) * glm::pi<float>() * (3 - std::sqrt(5.0f));
    const glm::vec3 direction(r * std::cos(turn), y, r * std::sin(turn));
    const bool is_wall =
        std::ranges::any_of(stage.walls, [&](const Wall& wall) { return hits(wall, place_ws, direction); });
    directions.push_back(direction);
    radiance.push_back(is_wall && direction.y >= 0 ? glm::vec3(0) : sky_radiance(stage.sky, direction));
  }
  nook::ProbeFit fit(context);
  fit.add_samples(glm::value_ptr(directions[0]), glm::value_ptr(radiance[0]), nullptr, count);
  return fit.solve().lobes();
}

std::vector<nook_lobe> stage_lobes(const nook::Context& context, const Stage& stage) {
  return probe_of_sky(context, stage, stage.probe_ws);
}

Cast::Cast(Stage& stage) {
  std::vector<nook_instance_id> instances;
  for (const Actor& actor : stage.actors) {
    const nook::bake::Character character = import(actor);
    const std::vector<float> bones = bones_of(character, actor);
    actors_.push_back({posed_mesh(character, bones, actor, stage.textures), {}});
    lobes_.push_back(probe_of_sky(context_, stage, actor.place_ws + glm::vec3(0, probe_height_m, 0)));

    const std::vector<unsigned char> file = platform::read_file(actor.model);
    models_.emplace_back(context_, file.data(), file.size());
    const nook_instance_id id = scene_.add_instance(models_.back());
    if (models_.back().info().file_vertex_count != character.info().file_vertex_count)
      throw std::runtime_error("showcase: " + actor.model.string() + " was not baked from " +
                               actor.character.string() + " without the same meshes; bake it again");
    nook_pose_desc pose = nook::pose_desc();
    pose.kind = NOOK_POSE_REST_TO_WORLD;
    pose.layout = NOOK_TRANSFORM_ROWS_3X4;
    pose.transforms = bones.data();
    pose.transform_count = std::uint32_t(bones.size() / 12);
    scene_.set_pose(id, pose);
    scene_.set_ground(id, ground_plane);
    scene_.set_light(id, lobes_.back().data(), std::uint32_t(lobes_.back().size()));
    instances.push_back(id);
  }
  for (const nook_instance_id a : instances)
    for (const nook_instance_id b : instances)
      if (a != b) scene_.link(a, b);
  scene_.update();
  for (std::size_t i = 0; i < instances.size(); ++i) {
    std::vector<glm::vec3>& ao = actors_[i].directional_ao;
    ao.resize(actors_[i].mesh.positions_ws.size());
    scene_.read_directional_ao(instances[i], glm::value_ptr(ao[0]), std::uint32_t(ao.size()));
  }
}

}  // namespace showcase
