// Structs of older and newer headers, and the version handshake.
#include <cstring>
#include <string>

#include "catch.h"
#include "host.h"

using namespace nook::test;

namespace {

bool last_mentions(const char* part) {
  return std::string(nook_last_message()).find(part) != std::string::npos;
}

// The bytes of a struct with room behind it, all marked.
template <class Desc>
struct Roomy {
  alignas(Desc) unsigned char bytes[sizeof(Desc) + 32];
  Roomy() { std::memset(bytes, 0xa5, sizeof bytes); }
  Desc* desc() { return reinterpret_cast<Desc*>(bytes); }
};

constexpr std::uint32_t version_of(std::uint32_t major, std::uint32_t minor) {
  return major << 22 | minor << 12;
}

}  // namespace

TEST_CASE("an init function writes exactly the caller's size") {
  Roomy<nook_scene_desc> exact;
  REQUIRE(nook_scene_desc_init(exact.desc(), sizeof(nook_scene_desc), NOOK_VERSION) == NOOK_OK);
  CHECK(exact.bytes[sizeof(nook_scene_desc)] == 0xa5);
  CHECK(exact.desc()->struct_size == sizeof(nook_scene_desc));
  CHECK(exact.desc()->ground_radius == 10'000);

  // A newer header of the same version: what the library does not know is 0.
  Roomy<nook_scene_desc> larger;
  REQUIRE(nook_scene_desc_init(larger.desc(), sizeof(nook_scene_desc) + 16, NOOK_VERSION) == NOOK_OK);
  CHECK(larger.bytes[sizeof(nook_scene_desc) + 15] == 0);
  CHECK(larger.bytes[sizeof(nook_scene_desc) + 16] == 0xa5);

  Roomy<nook_context_desc> small;
  CHECK(nook_context_desc_init(small.desc(), sizeof(nook_context_desc) - 1, NOOK_VERSION) ==
        NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(last_mentions("nook_context_desc_init: size is out of range (got 71, need at least 72)"));
  CHECK(small.bytes[0] == 0xa5);
  CHECK(nook_scene_desc_init(nullptr, sizeof(nook_scene_desc), NOOK_VERSION) == NOOK_ERROR_INVALID_ARGUMENT);
}

TEST_CASE("headers of another major or a newer minor version are refused with both numbers") {
  nook_context_desc desc;
  CHECK(nook_context_desc_init(&desc, sizeof desc, version_of(NOOK_VERSION_MAJOR + 1, 0)) ==
        NOOK_ERROR_VERSION);
  CHECK(last_mentions("got version 1.0, need 0.1"));
  CHECK(nook_context_desc_init(&desc, sizeof desc, version_of(NOOK_VERSION_MAJOR, NOOK_VERSION_MINOR + 1)) ==
        NOOK_ERROR_VERSION);
  CHECK(nook_context_desc_init(&desc, sizeof desc, version_of(NOOK_VERSION_MAJOR, 0)) == NOOK_OK);
  CHECK(nook_context_desc_init(&desc, sizeof desc, NOOK_VERSION + 1) == NOOK_OK);  // another patch

  nook_context context = nullptr;
  desc.header_version = version_of(NOOK_VERSION_MAJOR + 1, 0);
  CHECK(nook_context_create(&desc, &context) == NOOK_ERROR_VERSION);
}

TEST_CASE("a descriptor that was not initialised, or is of the future, is refused") {
  Stage stage;
  Roomy<nook_scene_desc> roomy;
  nook_scene scene = nullptr;
  nook_scene_desc_init(roomy.desc(), sizeof(nook_scene_desc) + 16, NOOK_VERSION);
  CHECK(nook_scene_create(stage.context, roomy.desc(), &scene) == NOOK_OK);
  nook_scene_destroy(&scene);
  roomy.bytes[sizeof(nook_scene_desc) + 3] = 1;
  CHECK(nook_scene_create(stage.context, roomy.desc(), &scene) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(last_mentions("does not know"));
  CHECK(scene == nullptr);

  nook_scene_desc desc{};
  CHECK(nook_scene_create(stage.context, &desc, &scene) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(last_mentions("call nook_scene_desc_init"));
  desc = Host::scene_desc();
  desc.next = &desc;
  CHECK(nook_scene_create(stage.context, &desc, &scene) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(last_mentions("desc.next is not NULL"));
}

TEST_CASE("the last field of each struct counts") {
  // A parallel_for_user that arrives proves that the context's last field was read.
  Stage stage;
  nook_context_desc context_desc = stage.host.context_desc();
  int calls = 0;
  context_desc.parallel_for = [](void* user, std::uint32_t count, nook_job_fn body, void* body_user) {
    ++*static_cast<int*>(user);
    for (std::uint32_t i = 0; i < count; ++i) body(body_user, i);
  };
  context_desc.parallel_for_user = &calls;
  nook_context context = nullptr;
  nook_scene scene = nullptr;
  REQUIRE(nook_context_create(&context_desc, &context) == NOOK_OK);
  nook_scene_desc desc = Host::scene_desc();
  desc.reserved = 1;
  CHECK(nook_scene_create(context, &desc, &scene) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(last_mentions("desc.reserved"));
  desc.reserved = 0;
  REQUIRE(nook_scene_create(context, &desc, &scene) == NOOK_OK);
  nook_instance_id id = 0;
  nook_scene_add_instance(scene, stage.model, &id);
  nook_scene_add_instance(scene, stage.model, &id);
  REQUIRE(nook_scene_update(scene) == NOOK_OK);
  CHECK(calls > 0);
  nook_scene_stats stats{};
  stats.struct_size = sizeof stats;
  REQUIRE(nook_scene_get_stats(scene, &stats) == NOOK_OK);
  CHECK(stats.evaluations > 0);
  stats.struct_size = sizeof stats - 8;
  CHECK(nook_scene_get_stats(scene, &stats) == NOOK_ERROR_INVALID_ARGUMENT);
  nook_character_model_info info{};
  CHECK(nook_character_model_get_info(stage.model, &info) == NOOK_ERROR_INVALID_ARGUMENT);
  info.struct_size = sizeof info;
  REQUIRE(nook_character_model_get_info(stage.model, &info) == NOOK_OK);
  CHECK(info.gamma == 1.5f);
  nook_scene_destroy(&scene);
  nook_context_destroy(&context);
}
