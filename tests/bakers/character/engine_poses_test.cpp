// Poses as an engine has them, on real characters: the AO that they give against the baker's own matrices,
// and the check that names what is wrong with them.
#include <nook/nook_character.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <random>
#include <string>

#include "bakers/character/export_model.h"
#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/model_file.h"
#include "tests/bakers/character/engine.h"
#include "tests/bakers/character/unfitted_model.h"
#include "tests/catch.h"
#include "tests/pose_of_rows.h"

using namespace nook;
using namespace nook::bake;
using nook::test::Engine;

namespace {

const char* const files[] = {"ual_mannequin_CC0.glb",
                             "m2m_female_CC0.glb",
                             "rocketbox_Female_Adult_01_MIT.glb",
                             "rocketbox_Male_Adult_04_MIT.glb",
                             "robot_expressive_CC0.glb",
                             "cesium_man_CC-BY.glb",
                             "fox_CC-BY.glb"};

std::filesystem::path character_path(const char* file) {
  const char* assets = std::getenv("NOOK_ASSETS");
  return std::filesystem::path(assets ? assets : NOOK_ASSETS_DIR) / "characters" / file;
}

// The engine's character, the model and a scene of one instance, through the C interface.
struct Host {
  Engine engine;
  nook_context context = nullptr;
  nook_model model = nullptr;
  nook_scene scene = nullptr;
  nook_instance_id instance = 0;
  nook_model_info info{};
  std::uint32_t bones = 0, vertices = 0;

  explicit Host(const std::filesystem::path& path) : Host(path, {}) {}
  // Without bytes of a model, an unfitted one is made.
  Host(const std::filesystem::path& path, std::vector<std::byte> bytes) : engine(path) {
    if (bytes.empty()) bytes = write_character_model(test::unfitted_model(engine.imported));
    nook_context_desc desc;
    nook_context_desc_init(&desc);
    desc.isa = NOOK_ISA_SCALAR;
    REQUIRE(nook_context_create(&desc, &context) == NOOK_OK);
    REQUIRE(nook_model_load(context, bytes.data(), bytes.size(), &model) == NOOK_OK);
    nook_scene_desc scene_desc;
    nook_scene_desc_init(&scene_desc);
    scene_desc.cutoff_error = 0;
    REQUIRE(nook_scene_create(context, &scene_desc, &scene) == NOOK_OK);
    REQUIRE(nook_scene_add_instance(scene, model, &instance) == NOOK_OK);
    info.struct_size = sizeof info;
    REQUIRE(nook_model_describe(model, &info) == NOOK_OK);
    bones = info.bone_count;
    vertices = info.file_vertex_count;
  }
  ~Host() {
    nook_scene_destroy(&scene);
    nook_model_destroy(&model);
    nook_context_destroy(&context);
  }
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  std::vector<float> ao() {
    std::vector<float> out(vertices);
    REQUIRE(nook_scene_update(scene) == NOOK_OK);
    REQUIRE(nook_scene_read(scene, instance, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, out.data(), vertices, 0) ==
            NOOK_OK);
    return out;
  }
};

std::vector<float> columns_4x4(const std::vector<Affine>& matrices) {
  std::vector<float> out;
  for (const Affine& m : matrices)
    for (std::size_t column = 0; column < 4; ++column) {
      for (std::size_t row = 0; row < 3; ++row) out.push_back(static_cast<float>(m.m[4 * row + column]));
      out.push_back(column == 3 ? 1.0f : 0.0f);
    }
  return out;
}

nook_pose_desc pose_desc(nook_pose_kind kind, const std::vector<float>& columns) {
  nook_pose_desc desc;
  REQUIRE(nook_pose_desc_init(&desc) == NOOK_OK);
  desc.kind = kind;
  desc.layout = NOOK_TRANSFORM_COLUMNS_4X4;
  desc.transforms = columns.data();
  desc.transform_count = static_cast<std::uint32_t>(columns.size() / 16);
  return desc;
}

std::vector<Affine> bone_globals(const Host& host, const std::vector<Affine>& globals) {
  std::vector<Affine> out;
  for (const BoneBinding& binding : host.engine.imported.bindings) out.push_back(globals[binding.node]);
  return out;
}

// Poses the instance by the skinning matrices of every skin, and by joint matrices where bones have no skin.
void set_engine_pose(Host& host, const std::vector<Affine>& globals, const float* place) {
  const std::vector<float> joints = columns_4x4(bone_globals(host, globals));
  nook_pose_desc desc = pose_desc(NOOK_POSE_JOINT_TO_WORLD, joints);
  desc.place_3x4 = place;
  REQUIRE(nook_scene_set_pose(host.scene, host.instance, &desc) == NOOK_OK);
  nook_skin_info skin{};
  skin.struct_size = sizeof skin;
  for (std::uint32_t s = 0; s < host.info.skin_count; ++s) {
    REQUIRE(nook_model_describe_skin(host.model, s, &skin) == NOOK_OK);
    const std::vector<float> matrices = columns_4x4(host.engine.skinning_matrices(skin.file_index, globals));
    desc = pose_desc(NOOK_POSE_SKINNING, matrices);
    desc.skin = skin.file_index;
    desc.flags = NOOK_POSE_FLAG_PARTIAL;
    desc.place_3x4 = place;
    const nook_result result = nook_scene_set_pose(host.scene, host.instance, &desc);
    INFO(nook_last_message());
    REQUIRE(result == NOOK_OK);
  }
}

std::vector<float> rows_3x4(const Pose& pose, const Affine& place) {
  std::vector<float> out;
  for (const Mat3x4& bone : pose) {
    Affine matrix;
    std::copy_n(bone.m, 12, matrix.m.begin());
    const Mat3x4 placed = to_float(place * matrix);
    out.insert(out.end(), placed.m, placed.m + 12);
  }
  return out;
}

// Where the engine's own skinning puts the rest vertices, in its model space.
std::vector<float> engine_vertices(const Host& host, const std::vector<Affine>& globals) {
  std::vector<float> out;
  nook_check_vertex_info rest{};
  rest.struct_size = sizeof rest;
  for (std::uint32_t v = 0; v < host.info.check_vertex_count; ++v) {
    REQUIRE(nook_model_describe_check_vertex(host.model, v, &rest) == NOOK_OK);
    for (const double coordinate : host.engine.skinned(host.engine.vertices[rest.vertex], globals))
      out.push_back(static_cast<float>(coordinate));
  }
  return out;
}

nook_pose_check_info check_pose(const Host& host, const nook_pose_desc& desc,
                                const std::vector<float>& vertices, const float* place = nullptr) {
  nook_pose_check_desc check;
  REQUIRE(nook_pose_check_desc_init(&check) == NOOK_OK);
  check.vertex_count = static_cast<std::uint32_t>(vertices.size() / 3);
  check.positions = vertices.data();
  check.place_3x4 = place;
  nook_pose_check_info info{};
  info.struct_size = sizeof info;
  const nook_result result = nook_model_check_pose(host.model, &desc, &check, &info);
  INFO(nook_last_message());
  REQUIRE(result == NOOK_OK);
  return info;
}

template <class Body>
void for_each_character(Body&& body) {
  for (const char* file : files) {
    const std::filesystem::path path = character_path(file);
    if (!std::filesystem::exists(path)) {
      WARN("SKIPPED: " << path << " is not there; set NOOK_ASSETS to the folder that holds characters/");
      continue;
    }
    INFO(file);
    Host host(path);
    const auto& clips = host.engine.imported.clips;
    // Three clips, away from their first frames.
    for (std::size_t c = 0; c < clips.size(); c += std::max<std::size_t>(1, clips.size() / 3)) {
      INFO(clips[c].name);
      body(host, c, 0.4f * clips[c].duration_s);
    }
  }
}

bool is_identity(const nook_skin_info& skin) {
  float worst = 0;
  for (int i = 0; i < 12; ++i)
    worst = std::max(worst, std::abs(skin.rest_from_mesh_3x4[i] - (i % 5 == 0 ? 1.0f : 0.0f)));
  return worst < 1e-4f;
}

constexpr float at_home[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
constexpr float far_away[12] = {0, 0, 1, 700, 0, 1, 0, 3, -1, 0, 0, -700};  // 1 km, a quarter turn
constexpr float in_centimetres[12] = {100, 0, 0, 20, 0, 100, 0, 0, 0, 0, 100, -30};
constexpr float mirrored[12] = {-1, 0, 0, 0.2f, 0, 1, 0, 0, 0, 0, 1, 0};
constexpr float z_up[12] = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0};

}  // namespace

namespace {

struct Difference {
  float max = 0;
  double rms = 0;
};

Difference difference(const std::vector<float>& a, const std::vector<float>& b) {
  Difference out;
  for (std::size_t v = 0; v < a.size(); ++v) {
    const float d = std::abs(a[v] - b[v]);
    out.max = std::max(out.max, d);
    out.rms += double(d) * double(d) / double(a.size());
  }
  out.rms = std::sqrt(out.rms);
  return out;
}

// The AO by the engine's matrices against the AO by the baker's.
Difference difference_of_ao(Host& host, std::size_t clip, float time_s, const float* place) {
  Affine placed;
  std::copy_n(place, 12, placed.m.begin());
  const std::vector<float> own = rows_3x4(sample_clip(host.engine.imported, clip, time_s), placed);
  REQUIRE(nook::test::set_rows(host.scene, host.instance, own.data(), host.bones) == NOOK_OK);
  const std::vector<float> expected = host.ao();
  CHECK(*std::ranges::min_element(expected) < 0.8f);  // the poses darken something
  set_engine_pose(host, host.engine.globals(clip, time_s), place);
  const std::vector<float> ao = host.ao();
  return difference(ao, expected);
}

// The change of AO by the rounding of the matrices alone.
Difference difference_of_one_step(Host& host, std::size_t clip, float time_s) {
  std::vector<float> bones = rows_3x4(sample_clip(host.engine.imported, clip, time_s), Affine{});
  REQUIRE(nook::test::set_rows(host.scene, host.instance, bones.data(), host.bones) == NOOK_OK);
  const std::vector<float> expected = host.ao();
  std::mt19937 random(3);
  for (float& number : bones) number = std::nextafter(number, random() % 2 ? 4.0f : -4.0f);
  REQUIRE(nook::test::set_rows(host.scene, host.instance, bones.data(), host.bones) == NOOK_OK);
  return difference(host.ao(), expected);
}

}  // namespace

TEST_CASE("an engine's skinning matrices give the AO of the baker's matrices") {
  // Rounding of the matrices changes shadows by 2e-5, 1 um of the spheres' radii of 5 cm, and that may give a
  // shadow the next code: a step is 1/8192 of the largest shadow, which is below 4, and a vertex has weights
  // of up to 1. At 1 km the translations of both sets of matrices are multiples of 6e-5 m, which is 1e-3 of
  // the radii; the root mean square stays below a tenth of that.
  constexpr float near_tolerance = 2e-5f + 4.0f / 8192, far_tolerance = 2e-3f, far_rms = 1e-4f;
  for_each_character([&](Host& host, std::size_t clip, float time_s) {
    for (const float* place : {at_home, far_away, in_centimetres, mirrored, z_up}) {
      const Difference difference = difference_of_ao(host, clip, time_s, place);
      CHECK(difference.max <= (place == far_away ? far_tolerance : near_tolerance));
      CHECK(difference.rms <= far_rms);
    }
  });
}

// Of a baked model: NOOK_CHARACTER and NOOK_MODEL name its source and its file.
TEST_CASE("the AO of a baked model by an engine's matrices", "[.baked]") {
  const char* source = std::getenv("NOOK_CHARACTER");
  const char* file = std::getenv("NOOK_MODEL");
  REQUIRE((source && file));
  std::ifstream stream(file, std::ios::binary);
  const std::vector<char> text((std::istreambuf_iterator<char>(stream)), {});
  const auto bytes = std::as_bytes(std::span(text));
  Host host(source, {bytes.begin(), bytes.end()});
  Difference near_origin, far, one_step;
  for (std::size_t c = 0; c < host.engine.imported.clips.size(); ++c) {
    const float time_s = 0.4f * host.engine.imported.clips[c].duration_s;
    for (const bool is_far : {false, true}) {
      const Difference d = difference_of_ao(host, c, time_s, is_far ? far_away : at_home);
      Difference& worst = is_far ? far : near_origin;
      worst = {std::max(worst.max, d.max), std::max(worst.rms, d.rms)};
    }
    const Difference d = difference_of_one_step(host, c, time_s);
    one_step = {std::max(one_step.max, d.max), std::max(one_step.rms, d.rms)};
  }
  WARN("near the origin: max " << near_origin.max << ", rms " << near_origin.rms);
  WARN("at 1 km: max " << far.max << ", rms " << far.rms);
  WARN("the baker's own matrices, each number moved by one float: max " << one_step.max << ", rms "
                                                                        << one_step.rms);
}

TEST_CASE("the check of a pose passes what is right, in any unit and place") {
  for_each_character([&](Host& host, std::size_t clip, float time_s) {
    const std::vector<Affine> globals = host.engine.globals(clip, time_s);
    const std::vector<float> vertices = engine_vertices(host, globals);
    for (const float* place : {at_home, far_away, in_centimetres, mirrored, z_up}) {
      const std::vector<float> joints = columns_4x4(bone_globals(host, globals));
      nook_pose_desc desc = pose_desc(NOOK_POSE_JOINT_TO_WORLD, joints);
      desc.place_3x4 = place;
      const nook_pose_check_info check = check_pose(host, desc, vertices, place);
      INFO(check.text);
      CHECK(check.fault == NOOK_POSE_FAULT_NONE);
      CHECK(check.max_error < 0.002f);
    }
    nook_skin_info skin{};
    skin.struct_size = sizeof skin;
    for (std::uint32_t s = 0; s < host.info.skin_count; ++s) {
      REQUIRE(nook_model_describe_skin(host.model, s, &skin) == NOOK_OK);
      const std::vector<float> matrices =
          columns_4x4(host.engine.skinning_matrices(skin.file_index, globals));
      nook_pose_desc desc = pose_desc(NOOK_POSE_SKINNING, matrices);
      desc.skin = skin.file_index;
      desc.flags = NOOK_POSE_FLAG_PARTIAL;
      const nook_pose_check_info check = check_pose(host, desc, vertices);
      INFO(check.text);
      CHECK(check.fault == NOOK_POSE_FAULT_NONE);
    }
  });
}

TEST_CASE("the check of a pose names what is wrong") {
  for_each_character([&](Host& host, std::size_t clip, float time_s) {
    const std::vector<Affine> globals = host.engine.globals(clip, time_s);
    const std::vector<float> vertices = engine_vertices(host, globals);
    const BindData bind = bind_data_of(host.engine.imported);
    std::vector<nook_skin_info> skins;
    nook_skin_info skin{};
    skin.struct_size = sizeof skin;
    for (std::uint32_t s = 0; s < host.info.skin_count; ++s) {
      REQUIRE(nook_model_describe_skin(host.model, s, &skin) == NOOK_OK);
      skins.push_back(skin);
    }
    for (std::size_t s = 0; s < skins.size(); ++s) {
      std::vector<float> matrices = columns_4x4(host.engine.skinning_matrices(skins[s].file_index, globals));
      nook_pose_desc right = pose_desc(NOOK_POSE_SKINNING, matrices);
      right.skin = skins[s].file_index;
      right.flags = NOOK_POSE_FLAG_PARTIAL;

      nook_pose_desc desc = right;
      desc.layout = NOOK_TRANSFORM_ROWS_4X4;
      nook_pose_check_info check = check_pose(host, desc, vertices);
      INFO("transposed: " << check.text);
      CHECK(check.fault == NOOK_POSE_FAULT_TRANSPOSED);

      // A host that maps the joints to bones and takes skinning matrices for rest-to-world matrices.
      std::vector<std::int32_t> map(host.bones, -1);
      for (std::uint32_t j = 0; j < skins[s].joint_count; ++j)
        map[bind.bone_of_joint[bind.skins[s].first_joint + j]] = static_cast<std::int32_t>(j);
      desc = right;
      desc.kind = NOOK_POSE_REST_TO_WORLD;
      desc.transform_of_bone = map.data();
      desc.bone_count = host.bones;
      check = check_pose(host, desc, vertices);
      INFO("no S: " << check.text);
      CHECK(check.fault == (is_identity(skins[s]) ? NOOK_POSE_FAULT_NONE : NOOK_POSE_FAULT_NO_BIND));

      // All joints one on, and two of them exchanged.
      std::vector<std::int32_t> shifted = map;
      for (std::int32_t& index : shifted)
        if (index >= 0) index = (index + 1) % static_cast<std::int32_t>(skins[s].joint_count);
      desc.kind = NOOK_POSE_SKINNING;
      desc.transform_of_bone = shifted.data();
      check = check_pose(host, desc, vertices);
      INFO("shifted: " << check.text);
      CHECK(check.fault == NOOK_POSE_FAULT_ORDER);

      for (std::size_t other = 0; other < skins.size(); ++other) {
        if (std::equal(std::begin(skins[other].rest_from_mesh_3x4), std::end(skins[other].rest_from_mesh_3x4),
                       skins[s].rest_from_mesh_3x4))
          continue;
        desc = right;
        desc.skin = skins[other].file_index;
        desc.transform_of_bone = map.data();
        desc.bone_count = host.bones;
        check = check_pose(host, desc, vertices);
        INFO("wrong skin: " << check.text);
        CHECK(check.fault == NOOK_POSE_FAULT_SKIN);
        CHECK(check.fitting_skin == skins[s].file_index);
      }

      std::vector<float> larger = vertices;
      for (float& coordinate : larger) coordinate *= 100;
      check = check_pose(host, right, larger);
      INFO("vertices in centimetres: " << check.text);
      CHECK(check.fault == NOOK_POSE_FAULT_UNIT);
      CHECK(std::abs(check.scale / 100 - 1) < 0.02f);

      std::vector<float> turned = vertices;
      for (std::size_t v = 0; v < turned.size(); v += 3) {
        const float y = turned[v + 1];
        turned[v + 1] = turned[v + 2];
        turned[v + 2] = -y;
      }
      check = check_pose(host, right, turned);
      INFO("z up: " << check.text);
      CHECK(check.fault == NOOK_POSE_FAULT_PLACE);
    }
  });
}

TEST_CASE("a mesh that was shuffled, split and stored in 16 bits finds its vertices and their AO") {
  for (const char* file : files) {
    const std::filesystem::path path = character_path(file);
    if (!std::filesystem::exists(path)) continue;
    INFO(file);
    Host host(path);
    const SkinnedMesh& mesh = host.engine.imported.mesh;
    const std::size_t clip = host.engine.imported.clips.size() / 2;
    set_engine_pose(host, host.engine.globals(clip, 0.3f), nullptr);
    const std::vector<float> own = host.ao();
    // For each primitive, as an optimiser leaves it: another order, and some vertices twice.
    std::vector<std::uint32_t> found;
    std::vector<std::uint32_t> expected;
    std::size_t ambiguous = 0;
    std::vector<Vec3> normal;
    vertex_normals(mesh.triangle, mesh.position, normal);
    std::mt19937 random(11);
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
      std::vector<std::uint32_t> order;
      for (std::uint32_t v = 0; v < mesh.primitives[p].vertex_count; ++v)
        order.insert(order.end(), 1 + random() % 2, mesh.primitives[p].first_vertex + v);
      std::shuffle(order.begin(), order.end(), random);
      // 16 bits over the box of the primitive, in the space of the file.
      std::array<double, 3> low{1e30, 1e30, 1e30}, high{-1e30, -1e30, -1e30};
      for (const std::uint32_t v : order)
        for (std::size_t i = 0; i < 3; ++i) {
          low[i] = std::min(low[i], host.engine.vertices[v].position[i]);
          high[i] = std::max(high[i], host.engine.vertices[v].position[i]);
        }
      std::vector<float> positions, normals;
      const Affine& rest_from_mesh = host.engine.imported.rest_from_primitive[p];
      for (const std::uint32_t v : order) {
        for (std::size_t i = 0; i < 3; ++i) {
          const double step = std::max(high[i] - low[i], 1e-30) / 65535;
          const double code = std::round((host.engine.vertices[v].position[i] - low[i]) / step);
          positions.push_back(static_cast<float>(low[i] + code * step));
        }
        const Vec3 n = normal[mesh.file_to_welded[v]];
        for (std::size_t i = 0; i < 3; ++i)
          normals.push_back(static_cast<float>(rest_from_mesh.m[i] * n.x + rest_from_mesh.m[4 + i] * n.y +
                                               rest_from_mesh.m[8 + i] * n.z));
      }
      nook_vertex_match_desc match;
      REQUIRE(nook_vertex_match_desc_init(&match) == NOOK_OK);
      match.vertex_count = static_cast<std::uint32_t>(order.size());
      match.positions = positions.data();
      match.normals = normals.data();
      match.primitive = static_cast<std::int32_t>(p);
      std::vector<std::uint32_t> part(order.size());
      nook_vertex_match_info info{};
      info.struct_size = sizeof info;
      REQUIRE(nook_model_match_vertices(host.model, &match, part.data(), &info) == NOOK_OK);
      CHECK(info.unmatched == 0);
      ambiguous += info.ambiguous;
      found.insert(found.end(), part.begin(), part.end());
      expected.insert(expected.end(), order.begin(), order.end());
    }
    nook_model remapped = nullptr;
    REQUIRE(nook_model_remap(host.model, found.data(), static_cast<std::uint32_t>(found.size()), &remapped) ==
            NOOK_OK);
    nook_instance_id id = 0;
    REQUIRE(nook_scene_remove_instance(host.scene, host.instance) == NOOK_OK);
    REQUIRE(nook_scene_add_instance(host.scene, remapped, &id) == NOOK_OK);
    nook_model_destroy(&remapped);
    host.instance = id;
    host.vertices = static_cast<std::uint32_t>(found.size());
    set_engine_pose(host, host.engine.globals(clip, 0.3f), nullptr);
    const std::vector<float> ao = host.ao();
    std::size_t other_vertex = 0, other_ao = 0;
    for (std::size_t i = 0; i < ao.size(); ++i) {
      other_vertex += mesh.file_to_welded[found[i]] != mesh.file_to_welded[expected[i]];
      other_ao += ao[i] != own[expected[i]];
    }
    INFO(other_vertex << " of " << ao.size() << ", ambiguous " << ambiguous);
    // Positions of 16 bits do not tell layers apart that lie closer. Every vertex that is not sure is
    // counted.
    CHECK(other_vertex <= ambiguous);
    CHECK(other_ao <= other_vertex);
  }
}
