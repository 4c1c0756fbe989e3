// Jobs of synthesis, and their files in the runtime.
#include <nook/experimental/nook_bake_materials.h>
#include <nook/experimental/nook_synthesis.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/bakers/api/handles.h"
#include "tests/catch.h"

namespace {

std::string bytes_of(nook_bake_job job) {
  REQUIRE(nook_bake_job_wait(job) == NOOK_OK);
  const void* bytes = nullptr;
  std::size_t size = 0;
  REQUIRE(nook_bake_job_file(job, &bytes, &size) == NOOK_OK);
  return {static_cast<const char*>(bytes), size};
}

// A small fibre of 32 x 32 texels, baked once.
const std::string& fiber() {
  static const std::string bytes = [] {
    nook_bake_material_desc desc;
    REQUIRE(nook_bake_material_desc_init(&desc) == NOOK_OK);
    desc.meso = "fiber";
    desc.light_count = desc.view_count = 9;
    desc.width = desc.height = 32;
    desc.samples = 1;
    desc.bounces = 0;
    desc.view_map_side = 0;
    nook_bake_job job = nullptr;
    REQUIRE(nook_bake_start_material(&desc, &job) == NOOK_OK);
    std::string out = bytes_of(job);
    nook_bake_job_destroy(&job);
    return out;
  }();
  return bytes;
}

nook_bake_synthesis_desc desc_of(const std::string& material) {
  nook_bake_synthesis_desc desc;
  REQUIRE(nook_bake_synthesis_desc_init(&desc) == NOOK_OK);
  CHECK(desc.side == 512);
  CHECK(desc.is_tiling == 1);
  desc.material = material.data();
  desc.material_size = material.size();
  desc.side = 64;
  return desc;
}

}  // namespace

TEST_CASE("a synthesis job gives a file for its material, the same on any number of threads") {
  nook_bake_synthesis_desc desc = desc_of(fiber());
  std::string first;
  for (const std::uint32_t threads : {1u, 3u}) {
    desc.threads = threads;
    nook_bake_job job = nullptr;
    REQUIRE(nook_bake_start_synthesis(&desc, &job) == NOOK_OK);
    const std::string bytes = bytes_of(job);
    const char* report = nullptr;
    REQUIRE(nook_bake_job_report(job, &report) == NOOK_OK);
    CHECK(nlohmann::json::parse(report)["side"] == 64);
    nook_bake_job_destroy(&job);
    if (first.empty()) first = bytes;
    CHECK(bytes == first);
  }
  nook_context_desc context_desc;
  nook_context context = nullptr;
  nook_material material = nullptr;
  nook_synthesis synthesis = nullptr;
  REQUIRE(nook_context_desc_init(&context_desc) == NOOK_OK);
  REQUIRE(nook_context_create(&context_desc, &context) == NOOK_OK);
  REQUIRE(nook_material_load(context, fiber().data(), fiber().size(), nullptr, &material) == NOOK_OK);
  REQUIRE(nook_synthesis_load(context, first.data(), first.size(), &synthesis) == NOOK_OK);
  nook_synthesis_info info{};
  info.struct_size = sizeof info;
  REQUIRE(nook_synthesis_describe(synthesis, &info) == NOOK_OK);
  nook_material_info worn{};
  worn.struct_size = sizeof worn;
  REQUIRE(nook_material_describe(material, &worn) == NOOK_OK);
  CHECK((info.material_width == worn.width && info.material_height == worn.height));
  nook_synthesis_destroy(&synthesis);
  nook_material_destroy(&material);
  nook_context_destroy(&context);
}

TEST_CASE("bad descriptors of a synthesis are refused") {
  nook_bake_job job = nullptr;
  const auto refused = [&](const nook_bake_synthesis_desc& desc, nook_result result, const char* part) {
    CHECK(nook_bake_start_synthesis(&desc, &job) == result);
    CHECK(std::string(nook_bake_last_message()).find(part) != std::string::npos);
    CHECK(job == nullptr);
  };
  nook_bake_synthesis_desc desc = desc_of(fiber());
  desc.side = 65;
  refused(desc, NOOK_ERROR_INVALID_ARGUMENT, "multiple of 64");
  desc = desc_of(fiber());
  desc.crop[0] = 20;
  desc.crop[2] = desc.crop[3] = 16;
  refused(desc, NOOK_ERROR_INVALID_ARGUMENT, "crop");
  desc = desc_of(fiber());
  desc.material = nullptr;
  refused(desc, NOOK_ERROR_INVALID_ARGUMENT, "desc.material");
  desc = desc_of(fiber());
  desc.material_size -= 7;
  refused(desc, NOOK_ERROR_BAD_FILE, "");
  desc = desc_of(fiber());
  desc.is_tiling = 2;
  refused(desc, NOOK_ERROR_INVALID_ARGUMENT, "is_tiling");
  desc = desc_of(fiber());
  desc.reserved = 1;
  refused(desc, NOOK_ERROR_INVALID_ARGUMENT, "reserved");
}

TEST_CASE("a synthesis job can be cancelled") {
  nook_bake_synthesis_desc desc = desc_of(fiber());
  desc.progress = [](void*, const nook_bake_progress*) -> std::int32_t { return 0; };
  nook_bake_job job = nullptr;
  REQUIRE(nook_bake_start_synthesis(&desc, &job) == NOOK_OK);
  CHECK(nook_bake_job_wait(job) == NOOK_ERROR_CANCELLED);
  nook_bake_job_destroy(&job);
}
