// The ten lines of the project's README, with what stands round them: a file that is read, a pose and a mean
// that is printed.
//
//   ten_lines MODEL.nook
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <nook/nook.hpp>
#include <numeric>

namespace {

std::vector<char> read_file(const char* path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// An engine passes the matrices of its own skinning. Here they are the rest pose, moved sideways: three rows
// of four for each bone.
class Standing {
 public:
  Standing(const nook::CharacterModel& model, float x_m) : desc_(nook::pose_desc()) {
    for (std::uint32_t bone = 0; bone < model.info().bone_count; ++bone)
      rows_.insert(rows_.end(), {1, 0, 0, x_m, 0, 1, 0, 0, 0, 0, 1, 0});
    desc_.kind = NOOK_POSE_REST_TO_WORLD;
    desc_.layout = NOOK_TRANSFORM_ROWS_3X4;
    desc_.transforms = rows_.data();
    desc_.transform_count = model.info().bone_count;
  }
  operator const nook_pose_desc&() const { return desc_; }

 private:
  std::vector<float> rows_;
  nook_pose_desc desc_;
};

std::vector<float> ao_beside_another(const std::vector<char>& file) {
  // clang-format off
  // ---- the ten lines ----
  nook::Context context;
  nook::CharacterModel hero(context, file.data(), file.size());      // what `nook bake character` wrote
  nook::Scene scene(context);
  const nook_instance_id left = scene.add_instance(hero), right = scene.add_instance(hero);
  scene.link(left, right);                                           // the right body darkens the left one
  scene.set_pose(left, Standing(hero, 0.0f));                        // in each frame: your skinning's matrices
  scene.set_pose(right, Standing(hero, 0.6f));                       // the same body, 0.6 m to the side
  scene.update();
  std::vector<float> ao(hero.info().file_vertex_count);              // 1 is open, 0 is fully occluded
  scene.read_ao(left, ao.data(), hero.info().file_vertex_count);     // one value for each vertex of the file
  // ---- end ----
  // clang-format on
  return ao;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fputs("usage: ten_lines MODEL.nook\n", stderr);
    return 2;
  }
  const std::vector<float> ao = ao_beside_another(read_file(argv[1]));
  const auto [darkest, lightest] = std::minmax_element(ao.begin(), ao.end());
  std::printf("%zu vertices: mean AO %.3f, darkest %.3f, lightest %.3f\n", ao.size(),
              double(std::reduce(ao.begin(), ao.end()) / float(ao.size())), double(*darkest),
              double(*lightest));
} catch (const std::exception& error) {
  std::fprintf(stderr, "ten_lines: %s\n", error.what());
  return 3;
}
