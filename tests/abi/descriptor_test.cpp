// Structs of older and newer headers, and the version handshake.
#include <nook/experimental/nook_debug.h>
#include <nook/nook_nnao.h>
#include <nook/nook_world.h>

#include <string>

#include "tests/abi/growing_struct.h"
#include "tests/abi/host.h"

using namespace nook::test;

namespace {

bool last_mentions(const char* part) {
  return std::string(nook_last_message()).find(part) != std::string::npos;
}

constexpr std::uint32_t version_of(std::uint32_t major, std::uint32_t minor) {
  return major << 22 | minor << 12;
}

}  // namespace

TEST_CASE("init functions fill what fits into the caller's struct, of every release") {
  check_init<nook_context_desc>(nook_desc_init, NOOK_DESC_CONTEXT);
  check_init<nook_scene_desc>(nook_desc_init, NOOK_DESC_SCENE);
  check_init<nook_gl_desc>(nook_desc_init, NOOK_DESC_GL);
  check_init<nook_gl_frame_desc>(nook_desc_init, NOOK_DESC_GL_FRAME);
  check_init<nook_nnao_desc>(nook_desc_init, NOOK_DESC_NNAO);
  check_init<nook_nnao_debug_desc>(nook_desc_init, NOOK_DESC_NNAO_DEBUG);
  check_init<nook_nnao_frame_desc>(nook_desc_init, NOOK_DESC_NNAO_FRAME);
  check_init<nook_nnao_frame_debug_desc>(nook_desc_init, NOOK_DESC_NNAO_FRAME_DEBUG);
  check_init<nook_world_desc>(nook_desc_init, NOOK_DESC_WORLD);
  check_init<nook_world_frame_desc>(nook_desc_init, NOOK_DESC_WORLD_FRAME);
  check_init<nook_world_frame_debug_desc>(nook_desc_init, NOOK_DESC_WORLD_FRAME_DEBUG);

  nook_context_desc desc;
  CHECK(nook_desc_init(NOOK_DESC_CONTEXT, &desc, sizeof desc - 1, NOOK_VERSION) ==
        NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(last_mentions("nook_context_desc_init: size is out of range (got 79, need at least 80)"));
}

TEST_CASE("descriptors of every release are read, and what a newer one adds is refused unless 0") {
  Stage stage;
  check_use(stage.host.context_desc(), [](const nook_context_desc* desc) {
    nook_context context = nullptr;
    const nook_result result = nook_context_create(desc, &context);
    nook_context_destroy(&context);
    return result;
  });
  check_use(Host::scene_desc(), [&](const nook_scene_desc* desc) {
    nook_scene scene = nullptr;
    const nook_result result = nook_scene_create(stage.context, desc, &scene);
    nook_scene_destroy(&scene);
    return result;
  });
  // A loader that finds nothing: a descriptor that is understood ends at UNSUPPORTED, without OpenGL.
  nook_gl_desc gl_desc;
  REQUIRE(nook_gl_desc_init(&gl_desc) == NOOK_OK);
  gl_desc.get_proc = [](void*, const char*) -> void* { return nullptr; };
  check_use(gl_desc, [&](const nook_gl_desc* desc) {
    nook_gl gl = nullptr;
    return nook_gl_create(stage.context, desc, &gl);
  });
}

TEST_CASE("answers are cut to the caller's struct") {
  Stage stage;
  check_info<nook_model_info>([&](nook_model_info* info) { return nook_model_describe(stage.model, info); });
  check_info<nook_scene_info>(
      [&](nook_scene_info* stats) { return nook_scene_describe(stage.scene, stats); });
}

TEST_CASE("headers of another major or a newer minor version are refused with both numbers") {
  nook_context_desc desc;
  CHECK(nook_desc_init(NOOK_DESC_CONTEXT, &desc, sizeof desc, version_of(NOOK_VERSION_MAJOR + 1, 0)) ==
        NOOK_ERROR_VERSION);
  const auto text_of = [](int major, int minor) {
    return std::to_string(major) + "." + std::to_string(minor);
  };
  const std::string message = "got version " + text_of(NOOK_VERSION_MAJOR + 1, 0) + ", need " +
                              text_of(NOOK_VERSION_MAJOR, NOOK_VERSION_MINOR);
  CHECK(last_mentions(message.c_str()));
  CHECK(nook_desc_init(NOOK_DESC_CONTEXT, &desc, sizeof desc,
                       version_of(NOOK_VERSION_MAJOR, NOOK_VERSION_MINOR + 1)) == NOOK_ERROR_VERSION);
  CHECK(nook_desc_init(NOOK_DESC_CONTEXT, &desc, sizeof desc, version_of(NOOK_VERSION_MAJOR, 0)) == NOOK_OK);
  CHECK(nook_desc_init(NOOK_DESC_CONTEXT, &desc, sizeof desc, NOOK_VERSION + 1) == NOOK_OK);  // another patch
}

TEST_CASE("a descriptor of another type, and an unknown type, are refused by name") {
  nook_scene_desc scene;
  REQUIRE(nook_scene_desc_init(&scene) == NOOK_OK);
  nook_context_desc desc;
  REQUIRE(nook_context_desc_init(&desc) == NOOK_OK);
  desc.type = scene.type;
  nook_context context = nullptr;
  CHECK(nook_context_create(&desc, &context) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(last_mentions("desc.type belongs to another descriptor"));
  CHECK(last_mentions("call nook_context_desc_init"));
  CHECK(context == nullptr);
  CHECK(nook_desc_init(0, &desc, sizeof desc, NOOK_VERSION) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(last_mentions("nook_desc_init: type is unknown (got 0"));
}

TEST_CASE("if a descriptor is refused, the message names the field that is not understood") {
  Stage stage;
  nook_scene scene = nullptr;
  nook_scene_desc desc{};
  CHECK(nook_scene_create(stage.context, &desc, &scene) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(last_mentions("call nook_scene_desc_init"));
  desc = Host::scene_desc();
  desc.next = &desc;
  CHECK(nook_scene_create(stage.context, &desc, &scene) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(last_mentions("desc.next is not NULL"));

  Roomy<nook_scene_desc> newer;
  nook_desc_init(NOOK_DESC_SCENE, newer.get(), newer.newer_size, NOOK_VERSION);
  newer.bytes[sizeof desc + 3] = 1;
  CHECK(nook_scene_create(stage.context, newer.get(), &scene) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(last_mentions("does not know"));
  CHECK(scene == nullptr);
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
  desc.strict_poses = 2;
  CHECK(nook_scene_create(context, &desc, &scene) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(last_mentions("desc.strict_poses"));
  desc.strict_poses = 1;
  REQUIRE(nook_scene_create(context, &desc, &scene) == NOOK_OK);
  nook_instance_id id = 0;
  nook_scene_add_instance(scene, stage.model, &id);
  nook_scene_add_instance(scene, stage.model, &id);
  REQUIRE(nook_scene_update(scene) == NOOK_OK);
  CHECK(calls > 0);
  nook_scene_info stats{};
  stats.struct_size = sizeof stats;
  REQUIRE(nook_scene_describe(scene, &stats) == NOOK_OK);
  CHECK(stats.evaluations > 0);
  nook_model_info info{};
  info.struct_size = sizeof info;
  REQUIRE(nook_model_describe(stage.model, &info) == NOOK_OK);
  CHECK(info.gamma == 1);
  nook_scene_destroy(&scene);
  nook_context_destroy(&context);
}
