// References are kept under everything that they depend on, and a damaged one is traced anew.
#include "bakers/lab/nnao/truth_store.h"

#include <filesystem>
#include <fstream>

#include "tests/bakers/measure/nnao/small_scenes.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::lab;
using namespace nook::measure;
using namespace nook::test;

namespace {

struct Folder {
  std::filesystem::path path = std::filesystem::temp_directory_path() / "nook_truth_store_test";
  Folder() {
    std::filesystem::remove_all(path);
    std::filesystem::create_directories(path);
  }
  ~Folder() { std::filesystem::remove_all(path); }
};

TruthSettings settings_of(std::uint32_t rays, float radius) {
  TruthSettings settings;
  settings.width = width;
  settings.height = height;
  settings.rays = rays;
  settings.radius = radius;
  return settings;
}

// Counts how often it traces.
struct Tracer {
  int count = 0;
  Truth operator()() {
    ++count;
    return {std::vector<float>(std::size_t(width) * height, 0.25f + float(count)), 0.125};
  }
};

}  // namespace

TEST_CASE("a reference is traced once for a scene, a camera and its settings") {
  const Folder folder;
  Tracer trace;
  const auto ask = [&](const bake::TriangleSoup& scene, float distance, std::uint32_t rays, float radius) {
    return TruthStore(folder.path, scene).read_or_trace(camera(distance), settings_of(rays, radius), [&] {
      return trace();
    });
  };
  const Truth first = ask(corner(), 3, 64, 0.5f);
  CHECK(trace.count == 1);
  const Truth again = ask(corner(), 3, 64, 0.5f);
  CHECK(trace.count == 1);
  CHECK(again.ao == first.ao);
  CHECK(again.noise == first.noise);
  ask(plane(), 3, 64, 0.5f);
  ask(corner(), 4, 64, 0.5f);
  ask(corner(), 3, 65, 0.5f);
  ask(corner(), 3, 64, 0.25f);
  CHECK(trace.count == 5);
  for (const auto& file : std::filesystem::directory_iterator(folder.path))
    std::ofstream(file.path(), std::ios::in | std::ios::binary).seekp(100).put('x');
  ask(corner(), 3, 64, 0.5f);
  CHECK(trace.count == 6);
  ask(corner(), 3, 64, 0.5f);
  CHECK(trace.count == 6);
}

TEST_CASE("without a folder nothing is kept") {
  Tracer trace;
  for (int i = 0; i < 2; ++i)
    TruthStore().read_or_trace(camera(), settings_of(64, 0.5f), [&] { return trace(); });
  CHECK(trace.count == 2);
}
