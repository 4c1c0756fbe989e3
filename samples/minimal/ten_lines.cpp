// The ten lines of the project's README in a complete program: it reads a file, animates, and prints the mean
// AO.
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

// Stands in for the engine's animation. Returns the matrices of its vertex shader, joint matrix * inverse
// bind matrix, in columns of four. The character stands still in its rest pose, x_m to the side, so all of
// its joints have the same matrix.
std::vector<float> animate(const nook::CharacterModel& model, float x_m) {
  nook_skin_info skin{};
  skin.struct_size = sizeof skin;
  nook::check(nook_model_describe_skin(model.get(), 0, &skin));
  const float* const s = skin.rest_from_mesh_3x4;
  std::vector<float> columns;
  for (std::uint32_t joint = 0; joint < skin.joint_count; ++joint)
    columns.insert(columns.end(), {s[0], s[4], s[8], 0, s[1], s[5], s[9], 0,  //
                                   s[2], s[6], s[10], 0, s[3] + x_m, s[7], s[11], 1});
  return columns;
}

// Describes matrices of the given kind.
nook_pose_desc pose(nook_pose_kind kind, const std::vector<float>& columns_4x4) {
  nook_pose_desc desc = nook::pose_desc();
  desc.kind = kind;
  desc.layout = NOOK_TRANSFORM_COLUMNS_4X4;
  desc.transforms = columns_4x4.data();
  desc.transform_count = static_cast<std::uint32_t>(columns_4x4.size() / 16);
  return desc;
}

std::vector<float> ao_beside_another(const std::vector<char>& file) {
  // clang-format off
  // ---- the ten lines ----
  nook::Context context;
  nook::CharacterModel hero(context, file.data(), file.size());      // what `nook bake character` wrote
  nook::Scene scene(context);
  const nook_instance_id left = scene.add_instance(hero), right = scene.add_instance(hero);
  scene.link(left, right);                                           // the right body darkens the left one
  scene.set_pose(left, pose(NOOK_POSE_SKINNING, animate(hero, 0)));  // in each frame: your vertex shader's matrices
  scene.set_pose(right, pose(NOOK_POSE_SKINNING, animate(hero, 0.6f)));  // the same body, 0.6 m to the side
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
