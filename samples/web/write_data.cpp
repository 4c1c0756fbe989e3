// Writes the data that the page needs in addition to a character's .nook file: geometry, clips as matrices,
// ray-traced ambient occlusion of one pose of each clip, and the native library's AO of two linked instances.
//
//   web_data CHARACTER.glb CHARACTER.nook FOLDER
//
// FOLDER/character.json names arrays: type, offset in bytes, length. `arrays` are in FOLDER/character.bin,
// which the first picture needs; `showcase` are in FOLDER/showcase.bin, which the page loads afterwards.
#include <nook/experimental/nook_trace.h>
#include <nook/nook_bake.h>
#include <nook/nook_character.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "platform/standard_streams.h"

namespace {

constexpr float frames_per_second = 30;
constexpr std::uint32_t reference_rays = 512;  // noise of at most 0.02, a tenth of the colour scale's end
constexpr float floor_half_size_m = 40;
// The position of the second instance of the expected values, which is turned by 180 degrees.
constexpr float neighbour_x_m = 0.45f, neighbour_z_m = 0.3f;

[[noreturn]] void fail(const std::string& text) {
  std::fprintf(stderr, "web_data: %s\n", text.c_str());
  std::exit(3);
}

void check_bake(nook_result result) {
  if (result != NOOK_OK) fail(nook_bake_last_message());
}
void check(nook_result result) {
  if (result != NOOK_OK) fail(nook_last_message());
}

std::vector<char> read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(path + " cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

// Stores arrays one after another, and remembers where each of them begins.
class Arrays {
 public:
  template <class T>
  void add(const char* name, const std::vector<T>& values) {
    const char* const type = sizeof(T) == 4   ? (std::is_floating_point_v<T> ? "float32" : "uint32")
                             : sizeof(T) == 2 ? "uint16"
                                              : "uint8";
    places_[name] = {{"type", type}, {"offset", bytes_.size()}, {"length", values.size()}};
    const auto* first = reinterpret_cast<const char*>(values.data());
    bytes_.insert(bytes_.end(), first, first + values.size() * sizeof(T));
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
  }
  const nlohmann::json& places() const { return places_; }
  const std::vector<char>& bytes() const { return bytes_; }

 private:
  nlohmann::json places_ = nlohmann::json::object();
  std::vector<char> bytes_;
};

std::vector<std::uint8_t> as_bytes(const std::vector<float>& values) {
  std::vector<std::uint8_t> bytes;
  for (const float value : values)
    bytes.push_back(static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.f, 1.f))));
  return bytes;
}

struct Character {
  explicit Character(const std::string& path) {
    nook_bake_source_desc desc;
    check_bake(nook_bake_source_desc_init(&desc));
    desc.path = path.c_str();
    check_bake(nook_bake_character_create(&desc, &handle));
    info.struct_size = sizeof info;
    check_bake(nook_bake_character_describe(handle, &info));
  }
  std::vector<float> pose(std::uint32_t clip, float time_s) const {
    std::vector<float> bones(12 * info.bone_count);
    check_bake(nook_bake_character_sample_clip(handle, clip, time_s, bones.data(), info.bone_count));
    return bones;
  }
  nook_bake_character handle = nullptr;
  nook_bake_character_info info{};
};

std::vector<std::uint32_t> triangles_of(const Character& character) {
  std::vector<std::uint32_t> indices(3 * character.info.triangle_count);
  check_bake(nook_bake_character_read(character.handle, NOOK_BAKE_ARRAY_TRIANGLES, indices.data(),
                                      character.info.triangle_count, 0));
  return indices;
}

void add_geometry(const Character& character, Arrays& arrays) {
  const std::uint32_t count = character.info.file_vertex_count;
  std::vector<float> positions(3 * count), normals(3 * count), weights(4 * count);
  std::vector<std::uint16_t> joints(4 * count);
  const auto read = [&](nook_bake_array array, void* out) {
    check_bake(nook_bake_character_read(character.handle, array, out, count, 0));
  };
  read(NOOK_BAKE_ARRAY_POSITIONS, positions.data());
  read(NOOK_BAKE_ARRAY_NORMALS, normals.data());
  read(NOOK_BAKE_ARRAY_JOINTS, joints.data());
  read(NOOK_BAKE_ARRAY_WEIGHTS, weights.data());
  arrays.add("positions", positions);
  arrays.add("normals", normals);
  arrays.add("joints", joints);
  arrays.add("weights", weights);
  arrays.add("indices", triangles_of(character));
}

// Traces rays to compute the AO of the body in a pose, above a floor of two triangles.
std::vector<float> trace(const Character& character, const std::vector<float>& bones) {
  const std::uint32_t count = character.info.file_vertex_count;
  std::vector<float> positions(3 * count), normals(3 * count), ao(count);
  check_bake(nook_bake_character_skin(character.handle, bones.data(), character.info.bone_count,
                                      positions.data(), normals.data(), count));
  const std::vector<std::uint32_t> body = triangles_of(character);
  const float s = floor_half_size_m;
  const float corners[] = {-s, 0, -s, s, 0, -s, s, 0, s, -s, 0, s};
  const std::uint32_t halves[] = {0, 1, 2, 0, 2, 3};
  const nook_bake_occluder_mesh meshes[] = {
      {positions.data(), body.data(), count, static_cast<std::uint32_t>(body.size())},
      {corners, halves, 4, 6}};
  nook_bake_trace_desc desc;
  check_bake(nook_bake_trace_desc_init(&desc));
  desc.meshes = meshes;
  desc.mesh_count = 2;
  desc.positions = positions.data();
  desc.normals = normals.data();
  desc.point_count = count;
  desc.rays = reference_rays;
  check_bake(nook_bake_trace_ao(&desc, ao.data(), count));
  return ao;
}

// The first picture has one frame of each clip: the frame of the reference.
nlohmann::json add_clips(const Character& character, Arrays& arrays, Arrays& showcase) {
  nlohmann::json clips = nlohmann::json::array();
  std::vector<float> frames, stills, references;
  for (std::uint32_t clip = 0; clip < character.info.clip_count; ++clip) {
    float seconds = 0;
    check_bake(nook_bake_character_clip_duration(character.handle, clip, &seconds));
    const auto count = static_cast<std::uint32_t>(std::max(1.f, std::round(seconds * frames_per_second)));
    const std::uint32_t middle = count / 2;
    clips.push_back({{"name", nook_bake_character_name(character.handle, NOOK_BAKE_NAME_CLIP, clip)},
                     {"first_frame", frames.size() / (12 * character.info.bone_count)},
                     {"frames", count},
                     {"seconds", seconds}});
    for (std::uint32_t f = 0; f < count; ++f) {
      const std::vector<float> bones =
          character.pose(clip, seconds * static_cast<float>(f) / static_cast<float>(count));
      frames.insert(frames.end(), bones.begin(), bones.end());
      if (f != middle) continue;
      const std::vector<float> ao = trace(character, bones);
      references.insert(references.end(), ao.begin(), ao.end());
      stills.insert(stills.end(), bones.begin(), bones.end());
    }
  }
  arrays.add("stills", stills);
  showcase.add("frames", frames);
  showcase.add("references", as_bytes(references));
  return clips;
}

// Adds the native library's AO of two linked instances on the ground, in the middle of the first two clips.
void add_expected(const Character& character, const std::string& model_path, Arrays& arrays) {
  const std::vector<char> file = read_file(model_path);
  const std::uint32_t bones = character.info.bone_count;
  const std::vector<float> neighbour = {-1, 0, 0, neighbour_x_m, 0, 1, 0, 0, 0, 0, -1, neighbour_z_m};
  nook_context_desc context_desc;
  nook_scene_desc scene_desc;
  nook_context context = nullptr;
  nook_model model = nullptr;
  nook_scene scene = nullptr;
  nook_instance_id ids[2] = {};
  check(nook_context_desc_init(&context_desc));
  check(nook_context_create(&context_desc, &context));
  check(nook_model_load(context, file.data(), file.size(), &model));
  check(nook_scene_desc_init(&scene_desc));
  check(nook_scene_create(context, &scene_desc, &scene));
  const float ground[4] = {0, 1, 0, 0};
  std::vector<float> poses, ao;
  for (std::uint32_t i = 0; i < 2; ++i) {
    float seconds = 0;
    check(nook_scene_add_instance(scene, model, &ids[i]));
    check(nook_scene_set_ground(scene, ids[i], ground));
    check_bake(nook_bake_character_clip_duration(character.handle, i, &seconds));
    std::vector<float> pose = character.pose(i, 0.5f * seconds);
    if (i == 1)
      for (std::uint32_t b = 0; b < bones; ++b) {
        float* const m = &pose[12 * b];
        for (int c = 0; c < 4; ++c) {
          m[c] = -m[c] + (c == 3 ? neighbour_x_m : 0);
          m[8 + c] = -m[8 + c] + (c == 3 ? neighbour_z_m : 0);
        }
      }
    nook_pose_desc pose_desc;
    check(nook_pose_desc_init(&pose_desc));
    pose_desc.kind = NOOK_POSE_REST_TO_WORLD;
    pose_desc.layout = NOOK_TRANSFORM_ROWS_3X4;
    pose_desc.transforms = pose.data();
    pose_desc.transform_count = bones;
    check(nook_scene_set_pose(scene, ids[i], &pose_desc));
    poses.insert(poses.end(), pose.begin(), pose.end());
  }
  check(nook_scene_link(scene, ids[0], ids[1]));
  check(nook_scene_link(scene, ids[1], ids[0]));
  check(nook_scene_update(scene));
  const std::uint32_t count = character.info.file_vertex_count;
  for (const nook_instance_id id : ids) {
    std::vector<float> values(count);
    check(nook_scene_read(scene, id, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, values.data(), count, 0));
    ao.insert(ao.end(), values.begin(), values.end());
  }
  arrays.add("expected_poses", poses);
  arrays.add("expected_ao", ao);
  nook_scene_destroy(&scene);
  nook_model_destroy(&model);
  nook_context_destroy(&context);
}

void write_file(const std::string& path, const char* bytes, std::size_t size) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes, static_cast<std::streamsize>(size));
  if (!file.flush()) fail(path + " cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  open_closed_streams();
  if (argc != 4) {
    std::fputs("usage: web_data CHARACTER.glb CHARACTER.nook FOLDER\n", stderr);
    return 2;
  }
  const std::string folder = argv[3];
  Character character(argv[1]);
  Arrays arrays, showcase;
  add_geometry(character, arrays);
  nlohmann::json description;
  description["bones"] = character.info.bone_count;
  description["vertices"] = character.info.file_vertex_count;
  description["clips"] = add_clips(character, arrays, showcase);
  add_expected(character, argv[2], showcase);
  description["arrays"] = arrays.places();
  description["showcase"] = showcase.places();
  const std::string text = description.dump(1);
  write_file(folder + "/character.json", text.data(), text.size());
  write_file(folder + "/character.bin", arrays.bytes().data(), arrays.bytes().size());
  write_file(folder + "/showcase.bin", showcase.bytes().data(), showcase.bytes().size());
  nook_bake_character_destroy(&character.handle);
  return 0;
}
