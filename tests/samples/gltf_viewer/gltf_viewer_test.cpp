// The sample as a user runs it: its pictures and exit codes; and its loader against Nook's own check of
// poses.
#include <OpenImageIO/imageio.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nook/nook.hpp>

#include "samples/gltf_viewer/character_file.h"
#include "tests/catch.h"

namespace {

constexpr int kWidth = 320, kHeight = 240;

int run(const std::string& arguments) {
  const int status = std::system((std::string(VIEWER) + " " + arguments + " 2> /dev/null").c_str());
  return WEXITSTATUS(status);
}

std::vector<float> read(const std::filesystem::path& path) {
  const auto input = OIIO::ImageInput::open(path.string());
  REQUIRE(input);
  REQUIRE(input->spec().width == kWidth);
  REQUIRE(input->spec().height == kHeight);
  std::vector<float> rgb(3 * kWidth * kHeight);
  REQUIRE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, rgb.data()));
  return rgb;
}

struct Folder {
  std::filesystem::path path;
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "nook_viewer_XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary directory");
    path = name;
  }
  ~Folder() { std::filesystem::remove_all(path); }
};

}  // namespace

TEST_CASE("sample gltf_viewer: its pictures move, and have neither holes nor black dots") {
  const Folder folder;
  REQUIRE(run(VIEWER_CHARACTER " " VIEWER_MODEL " --frames 2 --size 320x240 --out " + folder.path.string()) ==
          0);
  const std::vector<float> first = read(folder.path / "frame_0000.png"),
                           second = read(folder.path / "frame_0001.png");
  CHECK(first != second);
  for (const auto& picture : {first, second}) CHECK(*std::ranges::min_element(picture) > 0.05f);
}

TEST_CASE("sample gltf_viewer: faults have exit codes") {
  const Folder folder;
  const std::string out = " --out " + folder.path.string();
  CHECK(run("") == 2);
  CHECK(run(VIEWER_CHARACTER " " VIEWER_MODEL " --size 0x0" + out) == 2);
  CHECK(run(VIEWER_CHARACTER " " VIEWER_MODEL " --clip no_such_clip" + out) == 3);
  CHECK(run(VIEWER_CHARACTER " " VIEWER_CHARACTER + out) == 3);
  CHECK(run(VIEWER_MODEL " " VIEWER_MODEL + out) == 3);
}

TEST_CASE("sample gltf_viewer: its skinning is what Nook expects of the same matrices") {
  const viewer::CharacterFile file(VIEWER_CHARACTER);
  std::ifstream stream(VIEWER_MODEL, std::ios::binary);
  const std::vector<char> bytes((std::istreambuf_iterator<char>(stream)), {});
  const nook::Context context;
  const nook::CharacterModel model(context, bytes.data(), bytes.size());
  REQUIRE(model.info().file_vertex_count == file.vertices.size());
  for (const viewer::Clip& clip : file.clips) {
    INFO(clip.name);
    const viewer::Pose pose = file.pose(&clip, 0.4f * clip.duration_s);
    const std::vector<glm::vec3> skinned = file.skinned(pose);
    std::vector<glm::vec3> rest_vertices;
    nook_rest_vertex rest{};
    rest.struct_size = sizeof rest;
    for (std::uint32_t v = 0; nook_character_model_rest_vertex(model.get(), v, &rest) == NOOK_OK; ++v)
      rest_vertices.push_back(skinned[rest.vertex]);
    nook_pose_desc desc = nook::pose_desc();
    desc.kind = NOOK_POSE_SKINNING;
    desc.layout = NOOK_TRANSFORM_COLUMNS_4X4;
    desc.transforms = &pose.matrices[0][0][0];
    desc.transform_count = std::uint32_t(file.skins[0].joints.size());
    nook_pose_check check{};
    check.vertex_count = std::uint32_t(rest_vertices.size());
    check.positions = &rest_vertices[0].x;
    model.check_pose(desc, check);
    INFO(check.text);
    CHECK(check.fault == NOOK_POSE_RIGHT);
  }
}
