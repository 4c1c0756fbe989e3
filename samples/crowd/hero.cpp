#include "samples/crowd/hero.h"

#include <nook/experimental/nook_bake_key.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

#include "bakers/mannequin/mannequin.h"
#include "platform/file_bytes.h"
#include "platform/progress_bar.h"

namespace crowd {
namespace {

constexpr std::uint32_t rest_pose = ~0u;

// T-poses and A-poses are not worth showing, and a sitting character needs a chair, which this sample does
// not have.
bool is_unfit(std::string name) {
  std::erase_if(name, [](unsigned char c) { return !std::isalnum(c); });
  for (char& c : name) c = char(std::tolower(static_cast<unsigned char>(c)));
  return name.find("tpose") != std::string::npos || name.find("apose") != std::string::npos ||
         name.starts_with("sit");
}

}  // namespace

Hero::Hero(const std::filesystem::path& glb) : character_(glb.string()), info_(character_.info()) {
  const std::uint32_t n = vertex_count();
  const auto read = [&](auto& out, nook_bake_array array, std::uint32_t count, std::size_t each) {
    out.resize(count * each);
    character_.read(array, out.data(), count);
  };
  read(positions_m, NOOK_BAKE_ARRAY_POSITIONS, n, 3);
  read(normals, NOOK_BAKE_ARRAY_NORMALS, n, 3);
  read(joints, NOOK_BAKE_ARRAY_JOINTS, n, 4);
  read(weights, NOOK_BAKE_ARRAY_WEIGHTS, n, 4);
  read(triangles, NOOK_BAKE_ARRAY_TRIANGLES, info_.triangle_count, 3);
  for (std::uint32_t i = 0; i < info_.clip_count; ++i)
    if (!is_unfit(character_.name(NOOK_BAKE_NAME_CLIP, i)))
      clips_.push_back({i, character_.clip_duration(i)});
  if (clips_.empty()) clips_.push_back({rest_pose, 1.0f});
}

Bones Hero::pose(std::size_t clip, float phase) const {
  const Clip& c = clips_.at(clip);
  if (c.index != rest_pose) return character_.sample_clip(c.index, phase * c.duration_s);
  Bones bones(12 * std::size_t(bone_count()), 0.0f);
  for (std::size_t b = 0; b < bones.size(); b += 12) bones[b] = bones[b + 5] = bones[b + 10] = 1.0f;
  return bones;
}

void Hero::skin(const Bones& bones, std::vector<float>& positions_ws, std::vector<float>& normals_ws) const {
  positions_ws.resize(3 * std::size_t(vertex_count()));
  normals_ws.resize(positions_ws.size());
  nook::bake::check(nook_bake_character_skin(character_.get(), bones.data(), bone_count(),
                                             positions_ws.data(), normals_ws.data(), vertex_count()));
}

std::filesystem::path built_in_glb(const std::filesystem::path& folder) {
  const std::vector<unsigned char> bytes = nook::mannequin::make_mannequin_glb();
  platform::write_file(folder / "mannequin.glb", bytes.data(), bytes.size());
  return folder / "mannequin.glb";
}

std::vector<unsigned char> cached_model(const Hero& hero, const std::filesystem::path& cache, bool quiet,
                                        float gamma) {
  nook_bake_character_desc desc;
  nook::bake::check(nook_bake_character_desc_init(&desc));
  desc.character = hero.character().get();
  desc.preset = NOOK_BAKE_PRESET_DRAFT;
  desc.gamma = gamma;
  // Equal keys mean equal files.
  char key[NOOK_BAKE_KEY_SIZE];
  nook::bake::check(nook_bake_key(&desc, key, sizeof key));
  const std::filesystem::path path = cache / (std::string(key) + ".nook");
  if (std::filesystem::exists(path)) return platform::read_file(path);
  if (!quiet) std::fprintf(stderr, "baking %s\n", path.string().c_str());
  const nook::bake::Job bake(desc);
  platform::ProgressBar bar(quiet);
  for (nook_bake_progress p = bake.progress(); p.state != NOOK_BAKE_DONE; p = bake.progress()) {
    bar.show(p.stage, std::string(p.stage) == "ray tracing" ? "poses" : "steps", p.done, p.total);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  const std::vector<unsigned char> model = bake.file();
  platform::write_file(path, model.data(), model.size());
  return model;
}

}  // namespace crowd
