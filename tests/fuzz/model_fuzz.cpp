// Loads bytes as a character model and plays a script with it through the C ABI: a scene of one instruction
// set, instances, poses, links, lights, ground, occluders, levels of detail, both tiers of the OpenGL half.
// Nothing may crash, and AO lies in [0, 1], whatever the bytes. Built for libFuzzer with clang; elsewhere
// model_fuzz_replay.cpp drives it.
#include <nook/experimental/nook_debug.h>
#include <nook/nook_character.h>

#include <cmath>

#include "tests/fuzz/container_input.h"
#include "tests/fuzz/library.h"
#include "tests/pose_of_rows.h"

namespace {

using namespace nook::test;

constexpr std::size_t max_instances = 6, max_commands = 48;

struct Crowd {
  nook_scene scene = nullptr;
  nook_model model = nullptr;
  nook_model_info info{};
  std::vector<nook_instance_id> instances;
  std::vector<nook_occluder_id> occluders;

  // Now and then an id that the scene does not have.
  nook_instance_id instance(Script& script) const {
    const std::uint32_t i = script.below(std::uint32_t(instances.size()) + 1);
    return i < instances.size() ? instances[i] : i;
  }
  nook_occluder_id occluder(Script& script) const {
    const std::uint32_t i = script.below(std::uint32_t(occluders.size()) + 1);
    return i < occluders.size() ? occluders[i] : i;
  }
};

void fill(Script& script, float* numbers, int count) {
  for (int i = 0; i < count; ++i) numbers[i] = script.number();
}

void add_instance(Crowd& crowd, Script&) {
  nook_instance_id id = 0;
  if (crowd.instances.size() < max_instances && ok(nook_scene_add_instance(crowd.scene, crowd.model, &id)))
    crowd.instances.push_back(id);
}

void remove_instance(Crowd& crowd, Script& script) {
  const nook_instance_id id = crowd.instance(script);
  if (ok(nook_scene_remove_instance(crowd.scene, id))) std::erase(crowd.instances, id);
}

// All bones turn about an axis by one angle, scaled and moved; one of them gets any numbers in one case of
// eight.
void set_pose(Crowd& crowd, Script& script) {
  const nook_instance_id id = crowd.instance(script);
  const std::uint32_t form = script.byte();
  const float angle = script.number(), scale = form & 8 ? script.number() : 1;
  const float c = scale * std::cos(angle), s = scale * std::sin(angle);
  float place[3];
  fill(script, place, 3);
  const float turned[3][12] = {{c, -s, 0, place[0], s, c, 0, place[1], 0, 0, scale, place[2]},
                               {c, 0, s, place[0], 0, scale, 0, place[1], -s, 0, c, place[2]},
                               {scale, 0, 0, place[0], 0, c, -s, place[1], 0, s, c, place[2]}};
  const float* const matrix = turned[form % 3];
  std::vector<float> pose;
  for (std::uint32_t b = 0; b < crowd.info.bone_count; ++b) pose.insert(pose.end(), matrix, matrix + 12);
  if (form >= 224) fill(script, &pose[12 * script.below(crowd.info.bone_count)], 12);
  ok(nook::test::set_rows(crowd.scene, id, pose.data(), crowd.info.bone_count - (form == 223)));
}

// A pose in any kind, layout and order, of numbers that may be anything.
nook_pose_desc any_pose(const Crowd& crowd, Script& script, std::vector<float>& floats,
                        std::vector<std::int32_t>& map) {
  nook_pose_desc desc;
  ok(nook_pose_desc_init(&desc));
  desc.kind = nook_pose_kind(script.below(4));
  desc.layout = nook_transform_layout(script.below(7));
  desc.flags = script.below(5);
  desc.skin = script.below(4);
  desc.transform_count = crowd.info.bone_count;
  floats.assign(16 * std::size_t(crowd.info.bone_count), 0.0f);
  for (std::size_t i = 0; i < floats.size(); i += 5) floats[i] = 1;
  for (std::uint32_t i = script.below(4); i > 0; --i)
    floats[script.below(std::uint32_t(floats.size()))] = script.number();
  desc.transforms = floats.data();
  if (script.below(2)) {
    map.assign(crowd.info.bone_count, -1);
    for (std::int32_t& index : map) index = std::int32_t(script.below(crowd.info.bone_count + 1)) - 1;
    desc.transform_of_bone = map.data();
    desc.bone_count = crowd.info.bone_count;
  }
  return desc;
}

void set_any_pose(Crowd& crowd, Script& script) {
  std::vector<float> floats;
  std::vector<std::int32_t> map;
  const nook_instance_id id = crowd.instance(script);
  const nook_pose_desc desc = any_pose(crowd, script, floats, map);
  ok(nook_scene_set_pose(crowd.scene, id, &desc));
  nook_pose_check_desc check;
  ok(nook_pose_check_desc_init(&check));
  std::vector<float> positions;
  nook_check_vertex_info vertex{};
  vertex.struct_size = sizeof vertex;
  check.vertex_count = crowd.info.check_vertex_count;
  for (std::uint32_t v = 0; v < check.vertex_count; ++v) {
    require(ok(nook_model_describe_check_vertex(crowd.model, v, &vertex)));
    positions.insert(positions.end(), vertex.mesh_position, vertex.mesh_position + 3);
  }
  check.positions = positions.data();
  nook_pose_check_info info{};
  info.struct_size = sizeof info;
  if (ok(nook_model_check_pose(crowd.model, &desc, &check, &info))) require(info.text[0] != 0);
}

void set_model(Crowd& crowd, Script& script) {
  ok(nook_scene_set_model(crowd.scene, crowd.instance(script), crowd.model));
}

// Everything that a model's bind data answers.
void use_bind_data(const Crowd& crowd) {
  std::vector<std::uint32_t> order;
  nook_check_vertex_info vertex{};
  vertex.struct_size = sizeof vertex;
  require(!ok(nook_model_describe_check_vertex(crowd.model, crowd.info.check_vertex_count, &vertex)));
  for (std::uint32_t v = 0; v < crowd.info.check_vertex_count; ++v) {
    require(ok(nook_model_describe_check_vertex(crowd.model, v, &vertex)));
    require(vertex.vertex < crowd.info.file_vertex_count && vertex.bone < crowd.info.bone_count);
    order.push_back(vertex.vertex);
    nook_vertex_match_desc match;
    require(ok(nook_vertex_match_desc_init(&match)));
    match.vertex_count = 1;
    match.positions = vertex.mesh_position;
    const std::uint16_t joint = 0;
    const float weight = 1;
    match.joints = v % 2 ? &joint : nullptr;
    match.weights = v % 2 ? &weight : nullptr;
    match.influences = 1;
    std::uint32_t found = 0;
    if (ok(nook_model_match_vertices(crowd.model, &match, &found, nullptr)))
      require(found == NOOK_NO_VERTEX || found < crowd.info.file_vertex_count);
  }
  nook_skin_info skin{};
  skin.struct_size = sizeof skin;
  require(!ok(nook_model_describe_skin(crowd.model, crowd.info.skin_count, &skin)));
  for (std::uint32_t s = 0; s < crowd.info.skin_count; ++s)
    require(ok(nook_model_describe_skin(crowd.model, s, &skin)));
  nook_model remapped = nullptr;
  if (!order.empty()) {
    require(ok(nook_model_remap(crowd.model, order.data(), std::uint32_t(order.size()), &remapped)));
    nook_model_destroy(&remapped);
  }
}

void link(Crowd& crowd, Script& script) {
  const nook_instance_id receiver = crowd.instance(script), caster = crowd.instance(script);
  ok(nook_scene_link(crowd.scene, receiver, caster));
}

void unlink(Crowd& crowd, Script& script) {
  const nook_instance_id receiver = crowd.instance(script), caster = crowd.instance(script);
  ok(nook_scene_unlink(crowd.scene, receiver, caster));
}

void link_nearest(Crowd& crowd, Script& script) {
  const std::uint32_t count = script.below(18);
  ok(nook_scene_link_nearest(crowd.scene, count, script.number()));
}

void set_ground(Crowd& crowd, Script& script) {
  const nook_instance_id id = crowd.instance(script);
  const std::uint32_t axis = script.below(5);
  float plane[4] = {axis == 0 ? 1.0f : 0, axis == 1 ? 1.0f : 0, axis == 2 ? -1.0f : 0, script.number()};
  if (axis == 3) fill(script, plane, 3);
  ok(nook_scene_set_ground(crowd.scene, id, axis == 4 ? nullptr : plane));
}

nook_occluder occluder_of(Script& script, nook_instance_id receiver) {
  nook_occluder ball{};
  fill(script, ball.centre_ws, 3);
  ball.radius = script.number();
  ball.receiver = receiver;
  return ball;
}

void add_occluder(Crowd& crowd, Script& script) {
  const nook_occluder ball = occluder_of(script, 0);
  nook_occluder_id id = 0;
  if (crowd.occluders.size() < 4 && ok(nook_scene_add_occluder(crowd.scene, &ball, &id)))
    crowd.occluders.push_back(id);
}

void set_occluder(Crowd& crowd, Script& script) {
  const nook_occluder_id id = crowd.occluder(script);
  const nook_occluder ball = occluder_of(script, 0);
  ok(nook_scene_set_occluder(crowd.scene, id, &ball));
}

void limit_occluder(Crowd& crowd, Script& script) {
  const nook_occluder_id id = crowd.occluder(script);
  const nook_occluder ball = occluder_of(script, crowd.instance(script));
  ok(nook_scene_set_occluder(crowd.scene, id, &ball));
}

void remove_occluder(Crowd& crowd, Script& script) {
  const nook_occluder_id id = crowd.occluder(script);
  if (ok(nook_scene_remove_occluder(crowd.scene, id))) std::erase(crowd.occluders, id);
}

void set_light(Crowd& crowd, Script& script) {
  const nook_instance_id id = crowd.instance(script);
  const std::uint32_t given = script.below(16), count = given == 15 ? NOOK_PROBE_MAX_FUNCTIONS + 1 : given;
  std::vector<nook_lobe> lobes(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    nook_lobe& lobe = lobes[i];
    const std::uint32_t axis = i < 15 ? script.below(5) : 0;
    lobe.axis[axis % 3] = axis < 3 ? 1.0f : -1.0f;
    lobe.sharpness = i < 15 ? script.number() : 6;
    fill(script, lobe.amplitude, 3);
    if (axis == 4) fill(script, lobe.axis, 3);
  }
  ok(nook_scene_set_light(crowd.scene, id, lobes.data(), count));
}

void set_camera(Crowd& crowd, Script& script) {
  float place[3];
  fill(script, place, 3);
  ok(nook_scene_set_camera(crowd.scene, script.below(4) == 3 ? nullptr : place));
}

void set_terms(Crowd& crowd, Script& script) {
  ok(nook_scene_set_terms(crowd.scene, script.below(17)));
}

void read(Crowd& crowd, nook_instance_id id) {
  const std::uint32_t count = crowd.info.file_vertex_count;
  std::vector<float> ao(count), rgb(3 * std::size_t(count));
  require(ok(nook_scene_read(crowd.scene, id, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, ao.data(), count, 0)));
  require(ok(nook_scene_read(crowd.scene, id, NOOK_CHANNEL_DIRECTIONAL_AO, NOOK_FORMAT_FLOAT, rgb.data(),
                             count, 0)));
  for (const float value : ao) require(value >= 0 && value <= 1);
  for (const float value : rgb) require(value >= 0 && value <= 1);
}

void update(Crowd& crowd, Script&) {
  require(ok(nook_scene_update(crowd.scene)));
  for (const nook_instance_id id : crowd.instances) read(crowd, id);
  nook_scene_info stats{};
  stats.struct_size = sizeof stats;
  require(ok(nook_scene_describe(crowd.scene, &stats)) && stats.instances == crowd.instances.size());
}

void update_on_gl(Crowd& crowd, Script& script) {
  const nook_gl gl = gl_of_tier(script.below(2) ? 43 : 33);
  if (script.below(2)) ok(nook_gl_scene_prepare(gl, crowd.scene));
  if (!ok(nook_gl_scene_update(gl, crowd.scene))) return;
  const std::uint32_t count = crowd.info.file_vertex_count;
  std::vector<float> values(3 * std::size_t(count));
  for (const nook_instance_id id : crowd.instances) {
    nook_gl_view ao{};
    ao.struct_size = sizeof ao;
    require(ok(nook_gl_scene_view(gl, crowd.scene, id, NOOK_CHANNEL_AO, &ao)) && ao.count == count);
    nook_gl_view light{};
    light.struct_size = sizeof light;
    ok(nook_gl_scene_view(gl, crowd.scene, id, NOOK_CHANNEL_DIRECTIONAL_AO, &light));
    ok(nook_gl_scene_read(gl, crowd.scene, id, NOOK_CHANNEL_AO, values.data(), count));
    ok(nook_gl_scene_read(gl, crowd.scene, id, NOOK_CHANNEL_DIRECTIONAL_AO, values.data(), count));
  }
}

void release_from_gl(Crowd& crowd, Script& script) {
  ok(nook_gl_scene_release(gl_of_tier(script.below(2) ? 43 : 33), crowd.scene));
}

using Command = void (*)(Crowd&, Script&);
constexpr Command commands[] = {add_instance,    update,       set_pose,     link,          set_light,
                                set_ground,      add_occluder, set_camera,   link_nearest,  update_on_gl,
                                remove_instance, unlink,       set_occluder, set_terms,     remove_occluder,
                                release_from_gl, set_any_pose, set_model,    limit_occluder};

nook_scene_desc plain_scene() {
  nook_scene_desc desc;
  ok(nook_scene_desc_init(&desc));
  return desc;
}

// Of the script's settings, or of the defaults where those are refused.
nook_scene make_scene(nook_context context, Script& script) {
  nook_scene_desc desc = plain_scene();
  const std::uint32_t settings = script.byte();
  desc.form = nook_form(settings & 1);
  if (settings & 2) desc.cutoff_error = script.number();
  if (settings & 4) desc.lod_error = script.number();
  if (settings & 8) desc.lod_distance = script.number();
  if (settings & 16) desc.lod_max_interval = script.byte();
  if (settings & 32) desc.ground_radius = script.number();
  nook_scene scene = nullptr;
  if (ok(nook_scene_create(context, &desc, &scene))) return scene;
  desc = plain_scene();
  require(ok(nook_scene_create(context, &desc, &scene)));
  return scene;
}

void ask_about(const Crowd& crowd) {
  for (std::uint32_t b = 0; b < crowd.info.bone_count; ++b)
    require(nook_model_bone_name(crowd.model, b) != nullptr);
  require(nook_model_bone_name(crowd.model, crowd.info.bone_count) == nullptr);
  nook_range range{};
  std::uint32_t next = 0;
  for (std::uint32_t p = 0; p < crowd.info.primitive_count; ++p, next = range.first + range.count)
    require(ok(nook_model_describe_primitive(crowd.model, p, &range)) && range.first == next);
  require(next == crowd.info.file_vertex_count);
  std::vector<float> ao(crowd.info.file_vertex_count);
  ok(nook_model_read(crowd.model, NOOK_MODEL_STATIC_AO, ao.data(), crowd.info.file_vertex_count, 0));
  std::vector<std::int8_t> occluded(std::size_t(8) * crowd.info.file_vertex_count);
  ok(nook_model_read(crowd.model, NOOK_MODEL_OCCLUDED_DIRECTIONS, occluded.data(),
                     crowd.info.file_vertex_count, 0));
  for (const float value : ao) require(value >= 0 && value <= 1);
}

void play(Crowd& crowd, Script& script) {
  add_instance(crowd, script);
  add_instance(crowd, script);
  require(ok(nook_scene_link(crowd.scene, crowd.instances[0], crowd.instances[1])));
  for (std::size_t i = 0; i < max_commands && !script.at_end(); ++i)
    commands[script.below(std::uint32_t(std::size(commands)))](crowd, script);
  update(crowd, script);
}

// The demands of a small file are bounded, but not worth a fuzzer's time beyond this.
bool is_small(const nook_model_info& info) {
  return std::uint64_t(info.sphere_count) * info.key_point_count <= 1 << 12 &&
         info.file_vertex_count <= 1 << 12 && info.bone_count <= 1 << 8;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ContainerInput input = split_input(data, size);
  const bool with_jobs = input.script.below(2) == 1;
  const nook_context context = context_with_jobs(with_jobs);
  Crowd crowd;
  if (!ok(nook_model_load(context, input.file.data(), input.file.size(), &crowd.model))) {
    require(crowd.model == nullptr);
    return 0;
  }
  crowd.info.struct_size = sizeof crowd.info;
  require(ok(nook_model_describe(crowd.model, &crowd.info)));
  if (is_small(crowd.info)) {
    ask_about(crowd);
    use_bind_data(crowd);
    crowd.scene = make_scene(context_with_jobs(with_jobs, input.script.below(6)), input.script);
    play(crowd, input.script);
    for (const int tier : {33, 43}) ok(nook_gl_scene_release(gl_of_tier(tier), crowd.scene));
  }
  nook_model_destroy(&crowd.model);
  nook_scene_destroy(&crowd.scene);
  return 0;
}
