// The time of the import grows with its input, and not with its square: each kind of file is imported at one
// size and at four times that size. Four times the work is 4 times as long for a linear stage, little more
// for n log n, and 16 times for a quadratic one. The bound of 9 lies between them, and processor time keeps
// other programs out.
#include <ctime>

#include "bakers/import/static_scene.h"
#include "sdk/src/core/failure.h"
#include "tests/bakers/import/tube_file.h"
#include "tests/catch.h"
#include "tests/sanitized.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::test;

namespace {

double processor_seconds() {
  return double(std::clock()) / CLOCKS_PER_SEC;
}

// The smallest of three runs; one run under the sanitizer, whose times are not compared. A refusal is a
// result as well: it must not take long either.
template <class Import>
double seconds_of(const Import& import) {
  double best = 1e9;
  for (int run = 0; run < (sanitized ? 1 : 3); ++run) {
    const double begin = processor_seconds();
    try {
      import();
    } catch (const Failure&) {
    }
    best = std::min(best, processor_seconds() - begin);
  }
  return best;
}

// make(n) gives the file of size n.
template <class Make>
void check_growth(const char* kind, std::size_t n, const Make& make, bool is_scene = false) {
  INFO(kind);
  const auto seconds = [&](std::size_t size) {
    const std::vector<std::byte> bytes = make(size);
    return seconds_of([&] {
      if (is_scene)
        import_static_scene(bytes, SceneTextures::read);
      else
        import_gltf(bytes);
    });
  };
  // Below this time, work that does not grow dominates.
  const double once = std::max(seconds(n), 0.01);
  if (sanitized) return;
  const double four_times = seconds(4 * n);
  CAPTURE(once, four_times);
  CHECK(four_times < 9 * once);
}

// A tube with `count` more vertices at one place, without triangles.
std::vector<std::byte> unused_vertices(std::size_t count) {
  Tube tube;
  for (std::size_t i = 0; i < count; ++i) {
    tube.position.insert(tube.position.end(), {0, 0, 0});
    tube.joint.insert(tube.joint.end(), {0, 0, 0, 0});
    tube.weight.insert(tube.weight.end(), {1, 0, 0, 0});
  }
  return tube_file(tube).glb();
}

// Triangles with three vertices each, where corner(t, c) is the place of corner c.
template <class Corner>
GltfBuilder triangles(std::size_t count, const Corner& corner) {
  GltfBuilder file;
  std::vector<float> position;
  for (std::size_t t = 0; t < count; ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 p = corner(t, c);
      position.insert(position.end(), {p.x, p.y, p.z});
    }
  const int accessor = file.add_floats(position, "VEC3");
  file.document["nodes"] = Json::array({{{"mesh", 0}}});
  file.document["meshes"] =
      Json::array({{{"primitives", Json::array({{{"attributes", {{"POSITION", accessor}}}}})}}});
  return file;
}

// `shared` triangles meet at each place, turned about a common edge.
std::vector<std::byte> fans(std::size_t count, std::size_t shared) {
  return triangles(count,
                   [&](std::size_t t, std::size_t c) {
                     const auto place = float(t / shared), angle = float(t % shared);
                     if (c == 0) return Vec3{place, 0, 0};
                     if (c == 1) return Vec3{place, 1, 0};
                     return Vec3{place + 0.3f * std::cos(angle), 0.5f, 0.3f * std::sin(angle)};
                   })
      .glb();
}

std::vector<std::byte> chain(std::size_t count) {
  GltfBuilder file = tube_file();
  Json& nodes = file.document["nodes"];
  for (std::size_t i = 0; i < count; ++i) {
    Json node = {{"mesh", 1}, {"translation", {1, 0, 0}}};
    if (i + 1 < count) node["children"] = Json::array({nodes.size() + 1});
    nodes.push_back(std::move(node));
  }
  nodes[2]["children"] = Json::array({4});
  Json mesh = file.document["meshes"][0];
  mesh["primitives"][0]["attributes"] = {{"POSITION", file.add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3")}};
  mesh["primitives"][0].erase("indices");
  file.document["meshes"].push_back(mesh);
  return file.glb();
}

}  // namespace

TEST_CASE("vertices at one place take linear time") {
  check_growth("unused vertices", 100000, unused_vertices);
  check_growth("all vertices at one place in triangles without area", 50000, [](std::size_t n) {
    return triangles(n, [](std::size_t t, std::size_t) { return t ? Vec3{} : Vec3{1, 0, 0}; }).glb();
  });
  check_growth("triangles round one edge", 20000, [](std::size_t n) { return fans(n, n); });
  check_growth("triangles round edges, 85 at each", 20000, [](std::size_t n) { return fans(n, 85); });
  check_growth("a triangle many times", 20000, [](std::size_t n) {
    return triangles(n,
                     [](std::size_t, std::size_t c) {
                       return Vec3{float(c == 1), float(c == 2), 0};
                     })
        .glb();
  });
}

// Code with the address sanitizer takes three to five times as long.
constexpr double million_vertices_s = sanitized ? 10 : 2;

TEST_CASE("a million vertices at one place import in less than 2 seconds") {
  const std::vector<std::byte> bytes = unused_vertices(1'000'000);
  CHECK(seconds_of([&] { import_gltf(bytes); }) < million_vertices_s);
}

TEST_CASE("many parts of a file take linear time") {
  check_growth("tiny primitives", 2000, [](std::size_t n) {
    GltfBuilder file = tube_file();
    Json& primitives = file.document["meshes"][0]["primitives"];
    for (std::size_t i = 0; i < n; ++i) primitives.push_back(Json(primitives[0]));
    return file.glb();
  });
  check_growth("a chain of mesh nodes", 1000, chain);
  check_growth("nodes that show a mesh of many primitives without vertices", 250, [](std::size_t n) {
    GltfBuilder file = tube_file();
    file.document["accessors"].push_back({{"componentType", 5126}, {"count", 0}, {"type", "VEC3"}});
    const int none = int(file.document["accessors"].size()) - 1;
    Json primitives = Json::array();
    for (std::size_t i = 0; i < n; ++i)
      primitives.push_back({{"attributes", {{"POSITION", none}}}, {"mode", 0}});
    file.document["meshes"].push_back({{"primitives", primitives}});
    for (int i = 0; i < 400; ++i) file.document["nodes"].push_back({{"mesh", 1}});
    file.document.erase("scenes");
    file.document.erase("scene");
    return file.glb();
  });
  check_growth("clips", 1000, [](std::size_t n) {
    GltfBuilder file = tube_file();
    const Json clip = file.document["animations"][0];
    for (std::size_t i = 0; i < n; ++i) file.document["animations"].push_back(clip);
    return file.glb();
  });
  check_growth("keys", 100000, [](std::size_t n) {
    GltfBuilder file = tube_file();
    std::vector<float> times, values;
    for (std::size_t i = 0; i < n; ++i) {
      times.push_back(float(i));
      values.insert(values.end(), {float(i % 3), 0, 0});
    }
    file.add_channel(1, "translation", times, values);
    return file.glb();
  });
}

TEST_CASE("many joints, skins and nodes take linear time") {
  check_growth("joints", 4000, [](std::size_t n) {
    GltfBuilder file = tube_file();
    for (std::size_t i = 0; i < n; ++i) {
      file.document["skins"][0]["joints"].push_back(file.document["nodes"].size());
      file.document["nodes"].push_back({{"name", "joint"}});
    }
    file.document["skins"][0].erase("inverseBindMatrices");
    return file.glb();
  });
  check_growth("skins with one joint each and one list of matrices", 500, [](std::size_t n) {
    GltfBuilder file = tube_file();
    file.document["accessors"].push_back({{"componentType", 5126}, {"count", 2 * n}, {"type", "MAT4"}});
    Json& nodes = file.document["nodes"];
    for (std::size_t i = 0; i < n; ++i) {
      file.document["skins"].push_back({{"joints", Json::array({1})}, {"inverseBindMatrices", 4}});
      nodes.push_back({{"mesh", 0}, {"skin", i + 1}});
      nodes[0]["children"].push_back(nodes.size() - 1);
    }
    return file.glb();
  });
}

TEST_CASE("many textures and values take linear time") {
  check_growth(
      "textures", 4000,
      [](std::size_t n) {
        GltfBuilder file = triangles(1, [](std::size_t, std::size_t c) {
          return Vec3{float(c == 1), float(c == 2), 0};
        });
        const int uv = file.add_floats({0, 0, 1, 0, 0, 1}, "VEC2");
        file.document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = uv;
        for (std::size_t i = 0; i < n; ++i) {
          file.document["images"].push_back({{"uri", "data:image/png;base64,CQgH"}});
          file.document["textures"].push_back({{"source", i}});
          file.document["materials"].push_back(
              {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", i}}}}}});
        }
        return file.glb();
      },
      true);
  check_growth("deep JSON", 1000, [](std::size_t n) {
    GltfBuilder file = tube_file();
    Json deep = 1;
    for (int level = 0; level < 100; ++level) deep = Json::array({deep});
    for (std::size_t i = 0; i < n; ++i) file.document["extras"].push_back(deep);
    return file.glb();
  });
}
