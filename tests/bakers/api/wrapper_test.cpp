// The C++ wrapper of the bakers' library.
#include <nook/nook_bake.hpp>

#include <string>

#include "tests/bakers/api/baked_tube.h"

TEST_CASE("the C++ wrapper imports a character and bakes its model") {
  const std::string glb = glb_tube({"bend"});
  nook_bake_source_desc source = nook::bake::source_desc();
  source.bytes = glb.data();
  source.byte_count = glb.size();
  const nook::bake::Character character(source);
  const nook_bake_character_info info = character.info();
  CHECK(std::string(character.name(NOOK_BAKE_NAME_CLIP, 0)) == "bend");
  CHECK(character.clip_duration(0) > 0);
  CHECK(character.sample_clip(0, 0).size() == 12 * info.bone_count);
  std::vector<float> positions(3 * info.file_vertex_count, -1e9f);
  character.read(NOOK_BAKE_ARRAY_POSITIONS, positions.data(), info.file_vertex_count);
  for (const float p : positions) CHECK(p > -1e6f);

  nook_bake_character_desc desc;
  REQUIRE(nook_bake_character_desc_init(&desc) == NOOK_OK);
  desc.character = character.get();
  desc.preset = NOOK_BAKE_PRESET_DRAFT;
  desc.pose_mode = NOOK_BAKE_POSES_AUTO;
  desc.auto_pose_count = 8;
  desc.spheres = 8;
  desc.key_points = 24;
  desc.rays = 4;
  desc.steps = 40;
  const nook::bake::Job job(desc);
  CHECK(job.file().size() > 100);
  CHECK(std::string(job.report()).find("\"spheres\"") != std::string::npos);
  CHECK(job.progress().state == NOOK_BAKE_DONE);
}

TEST_CASE("the C++ wrapper throws the message of the bakers' library") {
  try {
    const nook::bake::Character character(std::string("no such file.glb"));
    FAIL("there is no such file");
  } catch (const nook::Error& error) {
    CHECK(error.result() == NOOK_ERROR_BAD_FILE);
    CHECK(std::string(error.what()).find("no such file.glb") != std::string::npos);
  }
}
