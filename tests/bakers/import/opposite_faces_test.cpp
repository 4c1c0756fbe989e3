// Vertices at one place: which become one, and which stay apart because their faces look opposite ways.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <set>

#include "bakers/import/skinned_mesh.h"
#include "bakers/import/weld.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;

namespace {

// Triangles given by their corners' places, each with three vertices of its own, as an unindexed file has
// them.
class Triangles {
 public:
  void add(Vec3 a, Vec3 b, Vec3 c) {
    const auto first = std::uint32_t(file_.position.size());
    for (const Vec3 p : {a, b, c}) file_.position.push_back(p);
    file_.triangle.push_back({first, first + 1, first + 2});
  }
  void add_both_sides(Vec3 a, Vec3 b, Vec3 c) {
    add(a, b, c);
    add(a, c, b);
  }
  SkinnedMesh welded() const { return weld_file(file_); }
  const FileMesh& file() const { return file_; }

  static SkinnedMesh weld_file(FileMesh file) {
    file.bones.resize(1);
    const std::pair<std::uint16_t, float> rigid{std::uint16_t{0}, 1.0f};
    file.weights.assign(file.position.size(), make_weights({&rigid, 1}));
    std::vector<std::string> warnings;
    return weld(std::move(file), warnings, NOOK_ERROR_INVALID_ARGUMENT);
  }

 private:
  FileMesh file_;
};

// A strip bent round by so many degrees, seen from outside and from inside.
Triangles bent_card(float degrees, int segments) {
  Triangles card;
  const auto at = [&](int i, float y) {
    const float angle = degrees / 180 * std::numbers::pi_v<float> * float(i) / float(segments);
    return Vec3{std::cos(angle), y, std::sin(angle)};
  };
  for (int i = 0; i < segments; ++i) {
    card.add_both_sides(at(i, 0), at(i, 1), at(i + 1, 0));
    card.add_both_sides(at(i, 1), at(i + 1, 1), at(i + 1, 0));
  }
  return card;
}

std::vector<Vec3> normals_of(const SkinnedMesh& mesh) {
  std::vector<Vec3> normals;
  vertex_normals(mesh.triangle, mesh.position, normals);
  return normals;
}

// The same file with its vertices and triangles in another order, and each triangle begun at another corner.
FileMesh shuffled(const FileMesh& file, unsigned seed, std::vector<std::uint32_t>& new_place) {
  std::mt19937 random(seed);
  new_place.resize(file.position.size());
  std::iota(new_place.begin(), new_place.end(), 0u);
  std::shuffle(new_place.begin(), new_place.end(), random);
  FileMesh out = file;
  for (std::size_t v = 0; v < new_place.size(); ++v) out.position[new_place[v]] = file.position[v];
  for (auto& t : out.triangle) {
    for (std::uint32_t& v : t) v = new_place[v];
    std::rotate(t.begin(), t.begin() + random() % 3, t.end());
  }
  std::shuffle(out.triangle.begin(), out.triangle.end(), random);
  return out;
}

}  // namespace

TEST_CASE("the two sides of a flat card are vertices of their own") {
  Triangles card;
  card.add_both_sides({0, 0, 0}, {1, 0, 0}, {1, 1, 0});
  card.add_both_sides({0, 0, 0}, {1, 1, 0}, {0, 1, 0});
  const SkinnedMesh mesh = card.welded();
  CHECK(mesh.vertex_count() == 8);
  const std::vector<Vec3> normal = normals_of(mesh);
  CHECK(std::count(normal.begin(), normal.end(), Vec3{0, 0, 1}) == 4);
  CHECK(std::count(normal.begin(), normal.end(), Vec3{0, 0, -1}) == 4);
  for (const auto& t : mesh.triangle) {
    CHECK(normal[t[0]] == normal[t[1]]);
    CHECK(normal[t[0]] == normal[t[2]]);
  }
}

TEST_CASE("a back that is divided into other triangles than the front is a side as well") {
  Triangles card;
  card.add({0, 0, 0}, {1, 0, 0}, {1, 1, 0.1f});
  card.add({0, 0, 0}, {1, 1, 0.1f}, {0, 1, 0});
  card.add({1, 0, 0}, {0, 0, 0}, {0, 1, 0});
  card.add({1, 0, 0}, {0, 1, 0}, {1, 1, 0.1f});
  CHECK(card.welded().vertex_count() == 8);
}

TEST_CASE("a card that bends round keeps two sides everywhere") {
  // At 300 degrees faces of one side look opposite ways too, but not at one place.
  for (const float degrees : {0.1f, 90.0f, 300.0f}) {
    const SkinnedMesh mesh = bent_card(degrees, 12).welded();
    CHECK(mesh.vertex_count() == 2 * 2 * 13);
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      const Vec3 outwards{mesh.position[v].x, 0, mesh.position[v].z};
      // Half a segment of 25 degrees, at the ends.
      CHECK(std::abs(dot(normals_of(mesh)[v], outwards)) > 0.97f);
    }
  }
}

TEST_CASE("the sides of a card do not depend on the order of its vertices and triangles") {
  const FileMesh file = bent_card(200, 9).file();
  const SkinnedMesh mesh = Triangles::weld_file(file);
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::vector<std::uint32_t> new_place;
    const SkinnedMesh other = Triangles::weld_file(shuffled(file, seed, new_place));
    REQUIRE(other.vertex_count() == mesh.vertex_count());
    std::map<std::uint32_t, std::uint32_t> same;
    for (std::size_t v = 0; v < new_place.size(); ++v) {
      const auto [found, is_new] = same.emplace(mesh.file_to_welded[v], other.file_to_welded[new_place[v]]);
      CHECK(found->second == other.file_to_welded[new_place[v]]);
    }
  }
}

TEST_CASE("no side of two cards that cross is lost where they meet") {
  Triangles cards;
  for (const float end : {-1.0f, 1.0f}) {
    cards.add_both_sides({0, 0, 0}, {0, 1, 0}, {0, 0, end});
    cards.add_both_sides({0, 0, 0}, {0, 1, 0}, {end, 0, 0});
  }
  const SkinnedMesh mesh = cards.welded();
  CHECK(std::count(mesh.position.begin(), mesh.position.end(), Vec3{}) >= 3);
  // At the crossing there are four directions; two that are not opposite may share a vertex.
  const std::vector<Vec3> normal = normals_of(mesh);
  for (const auto& t : mesh.triangle) {
    const Vec3 face = normalised(
        cross(mesh.position[t[1]] - mesh.position[t[0]], mesh.position[t[2]] - mesh.position[t[0]]));
    for (const std::uint32_t v : t) CHECK(dot(normal[v], face) > 0.7f);
  }
}

TEST_CASE("corners, creases and tips of closed surfaces stay one vertex") {
  SECTION("a cube with sides of their own") {
    Triangles cube;
    const auto corner = [](int i) { return Vec3{float(i & 1), float(i >> 1 & 1), float(i >> 2)}; };
    for (const auto& [a, b, c, d] :
         {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4}, std::array{2, 6, 7, 3},
          std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}}) {
      cube.add(corner(a), corner(b), corner(c));
      cube.add(corner(a), corner(c), corner(d));
    }
    CHECK(cube.welded().vertex_count() == 8);
  }
  SECTION("a needle, whose faces look opposite ways at its tips") {
    Triangles needle;
    constexpr int sides = 12;
    const auto ring = [](int i) {
      const float angle = 2 * std::numbers::pi_v<float> * float(i % sides) / sides;
      return Vec3{0.01f * std::cos(angle), 0, 0.01f * std::sin(angle)};
    };
    for (int i = 0; i < sides; ++i) {
      needle.add(ring(i), {0, 1, 0}, ring(i + 1));
      needle.add(ring(i), ring(i + 1), {0, -1, 0});
    }
    CHECK(needle.welded().vertex_count() == sides + 2);
  }
}

TEST_CASE("a vertex that both faces share in the file stays one and takes a face's normal") {
  FileMesh file;
  file.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  file.triangle = {{0, 1, 2}, {0, 2, 1}};
  const SkinnedMesh mesh = Triangles::weld_file(file);
  CHECK(mesh.vertex_count() == 3);
  for (const Vec3 n : normals_of(mesh)) CHECK(std::abs(n.z) == 1);
}

TEST_CASE("very many faces at one place are welded as one in a moment") {
  Triangles fan;
  constexpr int count = 20000;
  for (int i = 0; i < count; ++i) {
    const float a = float(i) * 1e-3f;
    fan.add_both_sides({0, 0, 0}, {std::cos(a), std::sin(a), 0},
                       {std::cos(a + 1e-3f), std::sin(a + 1e-3f), 0});
  }
  const SkinnedMesh mesh = fan.welded();
  CHECK(std::count(mesh.position.begin(), mesh.position.end(), Vec3{}) == 1);
}
