// Jobs of radiance transfer, and their files in the runtime.
#include <nook/experimental/nook_bake_materials.h>
#include <nook/experimental/nook_transfer.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/bakers/api/handles.h"
#include "tests/catch.h"
#include "tests/transfer/shapes.h"

namespace {

using nook::transfer::test::Shape;

nook_bake_transfer_desc desc_of(const Shape& shape) {
  nook_bake_transfer_desc desc;
  REQUIRE(nook_bake_transfer_desc_init(&desc) == NOOK_OK);
  CHECK(desc.lobes == 642);
  CHECK(desc.ray_side == 32);
  desc.positions = &shape.position[0].x;
  desc.normals = &shape.normal[0].x;
  desc.uvs = shape.uv[0].data();
  desc.indices = shape.triangle[0].data();
  desc.vertex_count = std::uint32_t(shape.position.size());
  desc.index_count = std::uint32_t(3 * shape.triangle.size());
  desc.lobes = 42;
  desc.ray_side = 16;
  return desc;
}

std::string bytes_of(nook_bake_job job) {
  REQUIRE(nook_bake_job_wait(job) == NOOK_OK);
  const void* bytes = nullptr;
  std::size_t size = 0;
  REQUIRE(nook_bake_job_file(job, &bytes, &size) == NOOK_OK);
  std::string out(static_cast<const char*>(bytes), size);
  nook_bake_job_destroy(&job);
  return out;
}

std::string bytes_of(const nook_bake_transfer_desc& desc) {
  nook_bake_job job = nullptr;
  REQUIRE(nook_bake_start_transfer(&desc, &job) == NOOK_OK);
  return bytes_of(job);
}

// The file of a job, loaded by the runtime.
struct Loaded {
  nook_context context = nullptr;
  nook_transfer transfer = nullptr;
  nook_transfer_info info{};

  explicit Loaded(const std::string& bytes) {
    nook_context_desc context_desc;
    REQUIRE(nook_context_desc_init(&context_desc) == NOOK_OK);
    REQUIRE(nook_context_create(&context_desc, &context) == NOOK_OK);
    REQUIRE(nook_transfer_load(context, bytes.data(), bytes.size(), &transfer) == NOOK_OK);
    info.struct_size = sizeof info;
    REQUIRE(nook_transfer_describe(transfer, &info) == NOOK_OK);
  }
  ~Loaded() {
    nook_transfer_destroy(&transfer);
    nook_context_destroy(&context);
  }
  Loaded(const Loaded&) = delete;
  Loaded& operator=(const Loaded&) = delete;
};

// A grey material of 6 x 4 texels, where every third column is a hole.
std::string material_with_holes(std::uint32_t column) {
  constexpr std::uint32_t directions = 5, width = 6, height = 4;
  std::vector<float> set{0, 0, 1}, btf, coverage;
  for (std::uint32_t i = 1; i < directions; ++i)
    set.insert(set.end(), {0.6f * float(int(i % 2) * 2 - 1) * float(i < 3),
                           0.6f * float(int(i % 2) * 2 - 1) * float(i >= 3), 0.8f});
  for (std::uint32_t i = 0; i < directions * directions * height * width; ++i)
    btf.insert(btf.end(), 3, 0.2f + 0.01f * float(i % 7));
  for (std::uint32_t i = 0; i < directions * height * width; ++i)
    coverage.push_back(i % width % 3 == column ? 0.0f : 1.0f);
  nook_bake_material_desc desc;
  REQUIRE(nook_bake_material_desc_init(&desc) == NOOK_OK);
  desc.light_count = desc.view_count = directions;
  desc.width = desc.rank_x = desc.votf_rank_x = width;
  desc.height = desc.rank_y = desc.votf_rank_y = height;
  desc.rank_light = 3 * directions;
  desc.rank_view = directions;
  desc.method = NOOK_BAKE_METHOD_N_SVD;
  desc.btf = btf.data();
  desc.coverage = coverage.data();
  desc.lights = desc.views = set.data();
  nook_bake_job job = nullptr;
  const nook_result started = nook_bake_start_material(&desc, &job);
  INFO(nook_bake_last_message());
  REQUIRE(started == NOOK_OK);
  return bytes_of(job);
}

bool refused(const nook_bake_transfer_desc& desc, const char* text) {
  nook_bake_job job = nullptr;
  const nook_result result = nook_bake_start_transfer(&desc, &job);
  INFO(nook_bake_last_message());
  CHECK(job == nullptr);
  nook_bake_job_destroy(&job);
  return result == NOOK_ERROR_INVALID_ARGUMENT &&
         std::string(nook_bake_last_message()).find(text) != std::string::npos;
}

}  // namespace

TEST_CASE("a job bakes a file that the runtime loads and knows by its mesh") {
  const Shape shape = nook::transfer::test::plane(1, 4, 2);
  nook_bake_transfer_desc desc = desc_of(shape);
  const std::string bytes = bytes_of(desc);
  nook_context_desc context_desc;
  REQUIRE(nook_context_desc_init(&context_desc) == NOOK_OK);
  nook_context context = nullptr;
  REQUIRE(nook_context_create(&context_desc, &context) == NOOK_OK);
  nook_transfer transfer = nullptr;
  REQUIRE(nook_transfer_load(context, bytes.data(), bytes.size(), &transfer) == NOOK_OK);
  nook_transfer_mesh_desc mesh;
  REQUIRE(nook_transfer_mesh_desc_init(&mesh) == NOOK_OK);
  mesh.vertex_count = desc.vertex_count;
  mesh.positions = desc.positions;
  mesh.normals = desc.normals;
  mesh.uvs = desc.uvs;
  CHECK(nook_transfer_check(transfer, &mesh, nullptr) == NOOK_OK);
  Shape moved = shape;
  moved.uv[3][1] += 0.25f;
  mesh.uvs = moved.uv[0].data();
  CHECK(nook_transfer_check(transfer, &mesh, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(std::string(nook_last_message()).find("texture coordinates") != std::string::npos);
  std::vector<float> tangents(4 * desc.vertex_count);
  REQUIRE(nook_transfer_read_frames(transfer, nullptr, tangents.data(), desc.vertex_count) == NOOK_OK);
  // u grows along +x, v along -z, and cross(+y, +x) is -z.
  for (std::size_t v = 0; v < desc.vertex_count; ++v) {
    CHECK(tangents[4 * v] > 0.9999f);
    CHECK(tangents[4 * v + 3] == 1);
  }
  nook_transfer_destroy(&transfer);
  nook_context_destroy(&context);

  desc.threads = 1;
  CHECK(bytes_of(desc) == bytes);
}

TEST_CASE("jobs of radiance transfer refuse what cannot be baked") {
  const Shape shape = nook::transfer::test::plane(1, 4, 2);
  const nook_bake_transfer_desc good = desc_of(shape);
  nook_bake_transfer_desc desc = good;
  desc.uvs = nullptr;
  CHECK(refused(desc, "desc.uvs is NULL"));
  desc = good;
  desc.index_count -= 1;
  CHECK(refused(desc, "multiple of 3"));
  desc = good;
  desc.lobes = 5000;
  CHECK(refused(desc, "lobes"));
  desc = good;
  desc.vertex_count = 0;
  CHECK(refused(desc, "vertices"));
  desc = good;
  desc.bounces = 3;
  CHECK(refused(desc, "bounces"));
  desc = good;
  desc.tiles = NAN;
  CHECK(refused(desc, "tiles"));
  desc = good;
  desc.reserved = 1;
  CHECK(refused(desc, "desc.reserved"));
  Shape bad = shape;
  bad.position[2].y = NAN;
  CHECK(refused(desc_of(bad), "vertex 2"));
  std::vector<float> tangents(4 * good.vertex_count, 0.0f);
  desc = good;
  desc.tangents = tangents.data();
  CHECK(refused(desc, "handedness"));
}

TEST_CASE("a job bakes reflections and the holes of a material, which the runtime describes") {
  Shape shape = nook::transfer::test::plane(1, 4, 2);
  append(shape, nook::transfer::test::plane(1, 4, 2, 0.3f));
  nook_bake_transfer_desc desc = desc_of(shape);
  CHECK(desc.bounces == 0);
  CHECK(desc.tiles == 1);
  const std::string material = material_with_holes(0);
  desc.votf = material.data();
  desc.votf_size = material.size();
  desc.bounces = 1;
  const std::string bytes = bytes_of(desc);
  const Loaded loaded(bytes);
  const nook_transfer_info& info = loaded.info;
  CHECK(info.bounces == 1);
  CHECK(info.has_holes == 1);
  CHECK(info.indirect_bytes == 18 * desc.vertex_count);
  for (const std::uint32_t column : {0u, 1u}) {
    const std::string worn = material_with_holes(column);
    nook_material handle = nullptr;
    REQUIRE(nook_material_load(loaded.context, worn.data(), worn.size(), nullptr, &handle) == NOOK_OK);
    CHECK(nook_transfer_check(loaded.transfer, nullptr, handle) ==
          (column == 0 ? NOOK_OK : NOOK_ERROR_INVALID_ARGUMENT));
    nook_material_destroy(&handle);
  }
  desc.votf_size -= 1;
  nook_bake_job job = nullptr;
  CHECK(nook_bake_start_transfer(&desc, &job) == NOOK_ERROR_BAD_FILE);
}

TEST_CASE("a job bakes the paper's form for the light modes of one material") {
  const Shape shape = nook::transfer::test::plane(1, 9, 2);
  nook_bake_transfer_desc desc = desc_of(shape);
  const std::string material = material_with_holes(0);
  desc.material = material.data();
  desc.material_size = material.size();
  desc.lobes = 162;
  desc.clusters = 2;
  CHECK(refused(desc, "desc.form is NOOK_FORM_DEFAULT"));
  desc.form = NOOK_FORM_PAPER;
  const std::string bytes = bytes_of(desc);
  const Loaded loaded(bytes);
  const nook_transfer_info& info = loaded.info;
  CHECK(info.form == NOOK_FORM_PAPER);
  CHECK(info.vertex_count == desc.vertex_count);
  CHECK(info.share_bytes == 0);
  CHECK(info.light_modes == 16);  // 15 of the material, rounded up
  CHECK(double(bytes.size()) < 1.01 * double(info.paper_bytes) + 400);
  float normal[3];
  CHECK(nook_transfer_read_frames(loaded.transfer, normal, nullptr, desc.vertex_count) ==
        NOOK_ERROR_UNSUPPORTED);
  desc.clusters = 300;
  CHECK(refused(desc, "clusters"));
  desc.clusters = 0;
  desc.material = nullptr;
  CHECK(refused(desc, "NOOK_FORM_PAPER needs the file of a material"));
  desc.form = 2;
  CHECK(refused(desc, "desc.form is unknown (got 2)"));
}

TEST_CASE("a job of radiance transfer can be cancelled by its progress") {
  const Shape shape = nook::transfer::test::knot_over_plane();
  nook_bake_transfer_desc desc = desc_of(shape);
  desc.progress = [](void*, const nook_bake_progress*) { return std::int32_t(0); };
  nook_bake_job job = nullptr;
  REQUIRE(nook_bake_start_transfer(&desc, &job) == NOOK_OK);
  CHECK(nook_bake_job_wait(job) == NOOK_ERROR_CANCELLED);
  nook_bake_job_destroy(&job);
}
