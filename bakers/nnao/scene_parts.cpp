#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {
namespace {

// All parts are about 0.1 m in size. In its frame, each part lies on y = 0.

void add_screw(TriangleSoup& soup, const Mat3x4& frame, float radius, Random& random) {
  const auto at = [&](float y) { return transform_point(frame, {0, y, 0}); };
  switch (random.below(4)) {
    case 0:  // a hexagon
      add_rod(soup, at(0), at(0.15f * radius), 1.25f * radius, 24);
      add_rod(soup, at(0.15f * radius), at(0.9f * radius), radius, 6);
      break;
    case 1:  // a socket head with its hole
      add_lathe(soup, frame,
                {{{radius, 0},
                  {radius, 1.1f * radius},
                  {0.95f * radius, 1.2f * radius},
                  {0.55f * radius, 1.2f * radius},
                  {0.55f * radius, 0.5f * radius},
                  {0, 0.5f * radius}}},
                24);
      break;
    case 2:  // a round head with a slot: two halves
      for (const float side : {-1.0f, 1.0f})
        add_sheet(soup, 12, 6, [&](float u, float v) {
          const float angle = side * (0.15f + 2.84f * u), out = radius * std::cos(1.5f * v),
                      y = 0.7f * radius * std::sin(1.5f * v);
          return transform_point(frame, {out * std::cos(angle), y, out * std::sin(angle)});
        });
      break;
    default:  // a bolt's end with thread and nut
      add_rod(soup, at(0), at(0.8f * radius), 1.7f * radius, 6);
      add_rod(soup, at(0), at(2.5f * radius), 0.85f * radius, 16);
      for (int i = 0; i < 9; ++i)
        add_torus(soup, moved(frame, {0, radius * (0.9f + 0.17f * float(i)), 0}), 0.85f * radius,
                  0.09f * radius, 16);
  }
}

// Adds a gear with teeth, a web with holes or spokes, and a hub with a bore.
void add_gear(TriangleSoup& soup, const Mat3x4& frame, float radius, float thick, Random& random) {
  const int teeth = random.whole(10, 36);
  const float tooth = 6.2831853f * radius / float(teeth) * 0.45f, bevel = 0.1f * tooth;
  const auto ring = [&](float r) {
    return std::vector<std::array<float, 2>>{
        {0.7f * r, 0}, {r, 0}, {r, thick}, {0.7f * r, thick}, {0.7f * r, 0}};
  };
  add_lathe(soup, frame, ring(radius), 3 * teeth);
  for (int i = 0; i < teeth; ++i) {
    const float angle = 6.2831853f * float(i) / float(teeth);
    add_bevelled_box(soup, moved(frame * standing_frame({}, angle), {radius, 0.5f * thick, 0}),
                     {tooth, 0.5f * thick, 0.5f * tooth}, bevel);
  }
  add_lathe(soup, frame,
            {{{0.15f * radius, -0.2f * thick},
              {0.3f * radius, -0.2f * thick},
              {0.3f * radius, 1.2f * thick},
              {0.15f * radius, 1.2f * thick},
              {0.15f * radius, -0.2f * thick}}},
            24);
  const int spokes = random.whole(3, 7);
  if (random.chance(0.5f))
    for (int i = 0; i < spokes; ++i)
      add_block(soup, frame * standing_frame({}, 6.2831853f * float(i) / float(spokes)),
                {0.25f * radius, 0.25f * thick, -0.09f * radius},
                {0.75f * radius, 0.75f * thick, 0.09f * radius});
  else
    add_lathe(soup, frame,
              {{{0.28f * radius, 0.3f * thick},
                {0.75f * radius, 0.3f * thick},
                {0.75f * radius, 0.7f * thick},
                {0.28f * radius, 0.7f * thick}}},
              32);
}

void add_bearing(TriangleSoup& soup, const Mat3x4& frame, float radius, Random& random) {
  const float w = 0.35f * radius;
  const auto ring = [&](float in, float out) {
    add_lathe(soup, frame, {{{in, 0}, {out, 0}, {out, w}, {in, w}, {in, 0}}}, 32);
  };
  ring(0.86f * radius, radius);
  ring(0.45f * radius, 0.6f * radius);
  const int balls = random.whole(7, 14);
  for (int i = 0; i < balls; ++i) {
    const float angle = 6.2831853f * float(i) / float(balls);
    const float r = 0.135f * radius;
    add_ellipsoid(
        soup, moved(frame, {0.73f * radius * std::cos(angle), 0.5f * w, 0.73f * radius * std::sin(angle)}),
        {r, r, r}, 14);
  }
}

void add_spring(TriangleSoup& soup, const Mat3x4& frame, float radius, float height, Random& random) {
  const int turns = random.whole(4, 12);
  std::vector<Vec3> path;
  for (int i = 0; i <= 14 * turns; ++i) {
    const float angle = 6.2831853f * float(i) / 14;
    path.push_back(transform_point(frame, {radius * std::cos(angle), height * float(i) / (14 * float(turns)),
                                           radius * std::sin(angle)}));
  }
  add_tube(soup, path, radius * random.between(0.1f, 0.22f), 8);
}

// Adds a housing with steps, pockets, fins, bosses and screws. It may be symmetric.
void add_casting(TriangleSoup& soup, const Mat3x4& frame, Vec3 half, Random& random) {
  const float bevel = half.y * random.log_between(0.02f, 0.3f);
  add_bevelled_box(soup, moved(frame, {0, half.y, 0}), half, bevel);
  const Mat3x4 top = moved(frame, {0, 2 * half.y, 0});
  const float x0 = -0.85f * half.x;
  switch (random.below(4)) {
    case 0:  // cooling fins
      for (float x = x0; x < 0.85f * half.x; x += 0.12f * half.x)
        add_block(soup, top, {x, 0, -0.8f * half.z}, {x + 0.05f * half.x, 0.6f * half.y, 0.8f * half.z});
      break;
    case 1:  // a lid with a gap and screws in its corners
      add_bevelled_box(soup, moved(top, {0, 0.08f * half.y, 0}),
                       {0.92f * half.x, 0.06f * half.y, 0.92f * half.z}, 0.03f * half.y);
      for (const float x : {-0.8f, 0.8f})
        for (const float z : {-0.8f, 0.8f})
          add_screw(soup, moved(top, {x * half.x, 0.14f * half.y, z * half.z}), 0.07f * half.x, random);
      break;
    case 2:  // a tray: walls round a pocket with chips in it
      for (const float s : {-1.0f, 1.0f}) {
        add_block(soup, moved(top, {s * 0.9f * half.x, 0, 0}), {-0.06f * half.x, 0, -0.95f * half.z},
                  {0.06f * half.x, 0.7f * half.y, 0.95f * half.z});
        add_block(soup, moved(top, {0, 0, s * 0.9f * half.z}), {-0.95f * half.x, 0, -0.06f * half.z},
                  {0.95f * half.x, 0.7f * half.y, 0.06f * half.z});
      }
      for (int i = random.whole(4, 20); i > 0; --i) {
        const Vec3 size{half.x * random.log_between(0.03f, 0.25f), half.y * random.between(0.05f, 0.4f),
                        half.z * random.log_between(0.03f, 0.25f)};
        const Mat3x4 chip =
            moved(top, {random.between(-0.7f, 0.7f) * half.x, 0, random.between(-0.7f, 0.7f) * half.z});
        add_block(soup, chip, {-size.x, 0, -size.z}, size);
        for (float x = -size.x; x < size.x; x += 0.3f * size.x + 0.003f)
          add_block(soup, chip, {x, 0, -1.2f * size.z}, {x + 0.002f, 0.3f * size.y, 1.2f * size.z});
      }
      break;
    default:  // bosses and holes
      for (int i = random.whole(2, 6); i > 0; --i) {
        const float r = half.x * random.between(0.08f, 0.25f);
        const Mat3x4 boss =
            moved(top, {random.between(-0.7f, 0.7f) * half.x, 0, random.between(-0.7f, 0.7f) * half.z});
        add_lathe(soup, boss,
                  {{{1.3f * r, 0},
                    {1.05f * r, 0.2f * r},
                    {r, 0.9f * r},
                    {0.6f * r, 0.9f * r},
                    {0.6f * r, 0.1f * r},
                    {0, 0.1f * r}}},
                  24);
      }
  }
  for (const float side : {-1.0f, 1.0f}) {  // grooves or ribs along the sides
    const int ribs = random.whole(0, 6);
    for (int i = 0; i < ribs; ++i)
      add_bevelled_box(
          soup, moved(frame, {half.x * (2 * (float(i) + 0.5f) / float(ribs) - 1), half.y, side * half.z}),
          {0.04f * half.x, 0.8f * half.y, 0.1f * half.z}, 0.01f * half.x);
    if (random.chance(0.5f))
      add_screw(soup, tilted(moved(frame, {0.6f * half.x, half.y, side * half.z}), side * 1.5707963f),
                0.1f * half.y, random);
  }
}

void add_connector(TriangleSoup& soup, const Mat3x4& frame, Random& random) {
  const int pins = random.whole(3, 12);
  const float pitch = 0.008f, half = 0.5f * pitch * float(pins);
  for (const float z : {-0.01f, 0.008f})
    add_block(soup, frame, {-half - 0.003f, 0, z}, {half + 0.003f, 0.02f, z + 0.002f});
  for (const float x : {-half - 0.003f, half + 0.001f})
    add_block(soup, frame, {x, 0, -0.01f}, {x + 0.002f, 0.02f, 0.01f});
  for (int i = 0; i < pins; ++i) {
    const float x = pitch * (float(i) + 0.5f) - half;
    add_block(soup, frame, {x - 0.001f, 0, -0.001f}, {x + 0.001f, 0.017f, 0.001f});
  }
}

}  // namespace

TrainingScene make_parts(Random& random) {
  TrainingScene scene;
  TriangleSoup& soup = scene.soup;
  add_floor(soup, 2);
  // Adds a base plate with rows of parts. The scene is as large as a workbench, and the parts are hand-sized.
  const float plate = random.between(0.012f, 0.03f);
  add_bevelled_box(soup, standing_frame({0, 0.5f * plate, 0}, 0), {0.4f, 0.5f * plate, 0.3f}, 0.3f * plate);
  for (const float x : {-0.36f, 0.36f})
    for (const float z : {-0.26f, 0.26f})
      add_screw(soup, standing_frame({x, plate, z}, random.between(0, 3)), random.between(0.008f, 0.02f),
                random);
  const auto spot = [&] {
    return standing_frame(
        {random.between(-0.3f, 0.3f), plate, random.between(-0.22f, 0.22f)},
        random.chance(0.6f) ? 1.5707963f * float(random.below(4)) : random.between(0, 6.28f));
  };
  for (int i = random.whole(3, 9); i > 0; --i)
    add_casting(soup, spot(),
                {random.log_between(0.03f, 0.14f), random.log_between(0.01f, 0.06f),
                 random.log_between(0.03f, 0.12f)},
                random);
  for (int i = random.whole(1, 6); i > 0; --i) {
    const Mat3x4 frame = random.chance(0.5f) ? spot() : tilted(moved(spot(), {0, 0.09f, 0}), 1.5707963f);
    add_gear(soup, frame, random.between(0.03f, 0.1f), random.between(0.008f, 0.03f), random);
    add_rod(soup, transform_point(frame, {0, -0.05f, 0}), transform_point(frame, {0, 0.09f, 0}), 0.009f, 16);
  }
  for (int i = random.whole(1, 4); i > 0; --i)
    add_bearing(soup, spot(), random.between(0.02f, 0.07f), random);
  for (int i = random.whole(0, 4); i > 0; --i)
    add_spring(soup, spot(), random.between(0.01f, 0.03f), random.between(0.04f, 0.12f), random);
  for (int i = random.whole(4, 25); i > 0; --i)
    add_screw(soup, spot(), random.log_between(0.004f, 0.02f), random);
  for (int i = random.whole(0, 5); i > 0; --i) add_connector(soup, spot(), random);
  for (int i = random.whole(0, 6); i > 0; --i) {  // cables
    const Mat3x4 a = spot(), b = spot();
    const Vec3 from = transform_point(a, {0, 0.01f, 0}), to = transform_point(b, {0, 0.01f, 0}),
               bow{random.between(-0.1f, 0.1f), random.between(0.02f, 0.15f), random.between(-0.1f, 0.1f)};
    std::vector<Vec3> path;
    for (int j = 0; j <= 14; ++j) {
      const float t = float(j) / 14;
      path.push_back(from + t * (to - from) + 4 * t * (1 - t) * bow);
    }
    add_tube(soup, path, random.log_between(0.002f, 0.01f), 8);
  }
  scene.size = 0.3f;
  scene.cameras = {{-0.7f, 0.12f, -0.3f}, {0.7f, 0.7f, 0.9f}};
  scene.subject = {{-0.28f, 0, -0.2f}, {0.28f, 0.1f, 0.2f}};
  return scene;
}

}  // namespace nook::bake::nnao
