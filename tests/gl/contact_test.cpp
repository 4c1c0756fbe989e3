// Where characters touch the world: the recipe of nook_world.h for a renderer with a mask of its characters
// gives floors and tables the AO of the casters, up to the last pixel beside them.
#include <nook/nook_world.h>

#include <cmath>
#include <string>

#include "tests/gl/world_scene.h"

using namespace nook;
using namespace nook::test;
using namespace nook::test::world;

namespace {

constexpr int columns = 192, rows = 128;

// Capsules, which are the characters and cast as they are drawn, over boxes, which are the world.
struct Box {
  Vec3 low, high;
};
struct Contact {
  std::string name;
  std::vector<nook_capsule> characters;
  std::vector<Box> boxes;
  Vec3 eye, target;
};

Vec3 vec(const float (&v)[3]) {
  return {v[0], v[1], v[2]};
}

float distance_to(const nook_capsule& capsule, Vec3 p) {
  const Vec3 a = vec(capsule.a), axis = vec(capsule.b) - a;
  const float along = dot(axis, axis) > 0 ? std::clamp(dot(p - a, axis) / dot(axis, axis), 0.0f, 1.0f) : 0.0f;
  return length(p - a - axis * along) - capsule.radius_a;
}

float distance_to(const Box& box, Vec3 p) {
  const Vec3 q{std::max(box.low.x - p.x, p.x - box.high.x), std::max(box.low.y - p.y, p.y - box.high.y),
               std::max(box.low.z - p.z, p.z - box.high.z)};
  const Vec3 out{std::max(q.x, 0.0f), std::max(q.y, 0.0f), std::max(q.z, 0.0f)};
  return length(out) + std::min(std::max({q.x, q.y, q.z}), 0.0f);
}

template <class Shapes>
float nearest(const Shapes& shapes, Vec3 p) {
  float least = 1e9f;
  for (const auto& shape : shapes) least = std::min(least, distance_to(shape, p));
  return least;
}

View look_at(Vec3 eye, Vec3 target) {
  const Vec3 z = normalised(eye - target), x = normalised(cross({0, 1, 0}, z)), y = cross(z, x);
  View view;
  const float m[16] = {x.x, y.x, z.x, 0, x.y,          y.y,          z.y,          0,
                       x.z, y.z, z.z, 0, -dot(x, eye), -dot(y, eye), -dot(z, eye), 1};
  std::memcpy(view.matrix, m, sizeof m);
  return view;
}

struct Seen {
  Picture picture;
  std::vector<std::uint8_t> is_character;
};

// Marches along the ray of each pixel.
Seen seen_by(const Camera& camera, const View& view, const Contact& contact) {
  Seen seen{look(camera, {}, columns, rows), {}};
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const std::size_t i = std::size_t(y) * columns + x;
      const Vec3 at_1 = nnao::view_position(seen.picture.rays, float(x) + 0.5f, float(y) + 0.5f, 1);
      const Vec3 origin = view.to_world({}), step = view.turn_back(at_1);
      const float size = length(step);
      float depth = 0;
      bool character = false;
      for (int march = 0; march < 400 && depth < 20; ++march) {
        const Vec3 p = origin + step * depth;
        const float body = nearest(contact.characters, p), box = nearest(contact.boxes, p);
        character = body < box;
        const float d = std::min(body, box);
        if (d < 2e-6f * (1 + depth)) break;
        depth += d / size;
      }
      if (depth >= 20) {
        seen.picture.depth[i] = INFINITY;
        seen.is_character.push_back(0);
        continue;
      }
      seen.picture.depth[i] = depth;
      const Vec3 p = origin + step * depth;
      const auto field = [&](Vec3 q) {
        return character ? nearest(contact.characters, q) : nearest(contact.boxes, q);
      };
      constexpr float h = 1e-3f;
      const Vec3 n = normalised(Vec3{field(p + Vec3{h, 0, 0}) - field(p - Vec3{h, 0, 0}),
                                     field(p + Vec3{0, h, 0}) - field(p - Vec3{0, h, 0}),
                                     field(p + Vec3{0, 0, h}) - field(p - Vec3{0, 0, h})});
      const float* m = view.matrix;
      seen.picture.normal[i] = {m[0] * n.x + m[4] * n.y + m[8] * n.z, m[1] * n.x + m[5] * n.y + m[9] * n.z,
                                m[2] * n.x + m[6] * n.y + m[10] * n.z};
      seen.is_character.push_back(character);
    }
  return seen;
}

nook_capsule capsule(Vec3 a, Vec3 b, float r) {
  return {{a.x, a.y, a.z}, r, {b.x, b.y, b.z}, r};
}

std::vector<Contact> contacts() {
  const Box floor{{-9, -1, -9}, {9, 0, 9}}, table{{-0.5f, 0.7f, -0.4f}, {0.5f, 0.75f, 0.4f}};
  std::vector<nook_capsule> feet, hand;
  for (const float side : {-0.09f, 0.11f}) {
    feet.push_back(capsule({side, 0.045f, -0.02f}, {side * 1.4f, 0.035f, 0.2f}, 0.035f));
    feet.push_back(capsule({side, 0.09f, -0.02f}, {side, 0.5f, 0}, 0.05f));
    feet.push_back(capsule({side, 0.5f, 0}, {side * 0.9f, 0.95f, 0}, 0.08f));
  }
  for (int finger = 0; finger < 4; ++finger)
    hand.push_back(
        capsule({0.025f * float(finger), 0.760f, 0.05f}, {0.03f * float(finger), 0.760f, 0.14f}, 0.009f));
  hand.push_back(capsule({0.01f, 0.768f, 0}, {0.07f, 0.768f, 0}, 0.018f));
  hand.push_back(capsule({0.04f, 0.775f, -0.03f}, {0.06f, 0.95f, -0.25f}, 0.03f));
  const std::vector<nook_capsule> sphere{capsule({0, 0.3f, 0}, {0, 0.3f, 0}, 0.3f)};
  return {{"feet", feet, {floor}, {0.7f, 1.5f, 2.0f}, {0, 0.2f, 0}},
          {"feet, low camera", feet, {floor}, {0.3f, 0.5f, 2.0f}, {0, 0.2f, 0}},
          {"feet, from far", feet, {floor}, {1, 2, 5}, {0, 0.2f, 0}},
          {"hand", hand, {floor, table}, {0.3f, 1.3f, 0.8f}, {0, 0.75f, 0}},
          {"sphere", sphere, {floor}, {0.5f, 1.2f, 2.2f}, {0, 0.2f, 0}}};
}

}  // namespace

namespace {

// The AO of a view that the passes give by the recipe of nook_world.h.
struct Composed {
  std::vector<float> room, alone, both;  // the screen pass, the world pass without it and with it
};

struct ContactFixture : WorldFixture {
  using WorldFixture::WorldFixture;

  Composed composed(const Seen& seen, const View& view, const Contact& contact, int half, bool normals) {
    nook_world_desc settings = world_desc(columns, rows);
    settings.half_resolution = half;
    nook_world_destroy(&pass);
    made(settings);
    nook_nnao screen = pass_of(9, half, 1, nullptr);
    std::vector<float> mask;
    for (const std::uint8_t character : seen.is_character) mask.insert(mask.end(), {1.0f, float(character)});
    ScreenFrame frame = frame_desc(plain_camera(float(columns) / rows), columns, rows,
                                   depth_of(plain_camera(float(columns) / rows), seen.picture),
                                   normals ? normals_of(seen.picture) : 0, 0.5f);
    std::memcpy(frame.view, view.matrix, sizeof frame.view);
    frame.gbuffer_ao = NOOK_GBUFFER_AO_EXCLUDE;
    frame.gbuffer_ao_texture = textures.floats(GL_RG32F, 2, columns, rows, mask);
    NOOK_OK_OR_FAIL(nook_nnao_render(screen, &frame, &frame));
    Composed found{own_ao(context.gl(), screen, columns, rows), {}, {}};
    DarkenedFrame darkened = world_frame(frame, view);
    darkened.capsules = contact.characters.data();
    darkened.capsule_count = std::uint32_t(contact.characters.size());
    NOOK_OK_OR_FAIL(nook_world_render(pass, &darkened, &darkened));
    found.alone = own(columns, rows);
    darkened.ao_texture = info_of(screen).texture;
    NOOK_OK_OR_FAIL(nook_world_render(pass, &darkened, &darkened));
    found.both = own(columns, rows);
    return found;
  }
};

struct Rim {
  int pixels = 0;       // of the world, beside a character
  int bright = 0;       // brighter by 60/255 than two pixels below, and by 8/255 than the closed form
  float brightest = 0;  // the most by which one is brighter than the closed form
  double squares = 0;   // of the error of all pixels of the world
};

Rim rim_of(const Seen& seen, const Composed& found, const std::vector<float>& wanted) {
  Rim rim;
  for (int y = 2; y + 1 < rows; ++y)
    for (int x = 1; x + 1 < columns; ++x) {
      const std::size_t i = std::size_t(y) * columns + x;
      if (seen.is_character[i] || !std::isfinite(seen.picture.depth[i])) continue;
      const float excess = found.alone[i] - wanted[i];
      rim.squares += double(excess) * double(excess);
      const auto is_character = [&](std::size_t at) { return seen.is_character[at] != 0; };
      if (!is_character(i - 1) && !is_character(i + 1) && !is_character(i - columns) &&
          !is_character(i + columns))
        continue;
      ++rim.pixels;
      rim.brightest = std::max(rim.brightest, excess);
      const std::size_t below = i - 2 * columns;
      rim.bright +=
          !is_character(below) && found.both[i] > found.both[below] + 60 / 255.0f && excess > 8.0f / 255;
    }
  return rim;
}

}  // namespace

TEST_CASE(
    "contact: floors and tables beside characters have the AO of the closed form, with normals from depth "
    "too",
    "[one-driver]") {
  NOOK_NEED_CONTEXT(context);
  ContactFixture fixture(context);
  for (const Contact& contact : contacts()) {
    const View view = look_at(contact.eye, contact.target);
    const Seen seen = seen_by(plain_camera(float(columns) / rows), view, contact);
    const std::vector<float> wanted = sampled(seen.picture, view, nullptr, contact.characters);
    for (const bool normals : {true, false}) {
      const Rim rim = rim_of(seen, fixture.composed(seen, view, contact, 0, normals), wanted);
      INFO(contact.name << ", normals " << normals << ": " << rim.bright << " of " << rim.pixels
                        << " bright, most " << rim.brightest);
      CHECK(rim.pixels > 50);
      CHECK(rim.bright == 0);
      // The host's normals are exact. From depth, a pixel between two fingers takes its plane across a
      // finger.
      CHECK(rim.brightest <= (normals ? bound : 8.0f / 255));
    }
    const Rim given = rim_of(seen, fixture.composed(seen, view, contact, 1, true), wanted),
              rebuilt = rim_of(seen, fixture.composed(seen, view, contact, 1, false), wanted);
    INFO(contact.name << " at half resolution: " << given.squares << " and " << rebuilt.squares);
    CHECK(given.bright + rebuilt.bright == 0);
    // Texels between two fingers have no neighbour on the table, and the view's own direction for a normal.
    CHECK(rebuilt.squares <= given.squares * (contact.name == "hand" ? 2.25 : 1.02));
  }
}

TEST_CASE("contact: at half resolution a gap of one pixel takes what its nearest surface has") {
  NOOK_NEED_CONTEXT(context);
  ContactFixture fixture(context);
  const Contact contact = contacts().back();
  const View view = look_at(contact.eye, contact.target);
  Seen seen = seen_by(plain_camera(float(columns) / rows), view, contact);
  const std::vector<float> wanted = sampled(seen.picture, view, nullptr, contact.characters);
  // Two posts of one pixel, in even columns, with an odd one between them; they hide nothing.
  constexpr int gap = columns / 2 + 5;
  static_assert(gap % 2 == 1);
  for (int y = 0; y < rows; ++y)
    for (const int side : {-1, 1}) seen.is_character[std::size_t(y) * columns + gap + side] = 1;
  const Composed found = fixture.composed(seen, view, contact, 1, true);
  float darkest_wanted = 1;
  for (int y = 0; y < rows / 2; ++y) {
    const std::size_t i = std::size_t(y) * columns + gap;
    if (seen.is_character[i]) break;
    // The nearest texel is at most 3 pixels away.
    float low = 1, high = 0;
    for (int k = 0; k < 49; ++k) {
      const int row = std::max(y + k / 7 - 3, 0);
      const std::size_t at = std::size_t(row) * columns + std::size_t(gap + k % 7 - 3);
      if (seen.is_character[at]) continue;
      low = std::min(low, wanted[at]);
      high = std::max(high, wanted[at]);
    }
    INFO("row " << y << ": " << found.alone[i] << ", closed form " << low << " to " << high);
    CHECK(found.alone[i] >= low - bound);
    CHECK(found.alone[i] <= high + bound);
    darkest_wanted = std::min(darkest_wanted, wanted[i]);
  }
  CHECK(darkest_wanted < 0.9f);
}
