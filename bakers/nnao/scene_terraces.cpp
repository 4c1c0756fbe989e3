#include "bakers/nnao/level_set.h"
#include "bakers/nnao/scene_families.h"

namespace nook::bake::nnao {
namespace {

// A landscape. Its height is a function of x and z in [-1, 1].
struct Land {
  std::uint64_t seed;
  float scale, tall, terrace;  // `terrace` is the height of a step; 0: no steps
  float sharpness;             // sharpness of the steps' edges
  bool ridged;

  float height(float x, float z) const {
    float h = 0, weight = 1, s = scale;
    for (int octave = 0; octave < 6; ++octave) {
      const float n = value_noise(seed + std::uint64_t(octave), {s * x, 0, s * z});
      h += weight * (ridged ? 1 - 2 * std::abs(n) : n);
      weight *= 0.5f;
      s *= 2.03f;
    }
    h *= tall;
    if (terrace <= 0) return h;
    const float level = std::floor(h / terrace), t = h / terrace - level;
    return terrace * (level + std::pow(t, sharpness));
  }
};

// Adds cubes of equal size that follow the land, as in voxel games.
void add_voxels(TriangleSoup& soup, const Land& land, float reach, int cells) {
  const float cube = 2 * reach / float(cells);
  const auto level = [&](int i, int j) {
    return std::floor(land.height(2 * (float(i) + 0.5f) / float(cells) - 1,
                                  2 * (float(j) + 0.5f) / float(cells) - 1) *
                      reach / cube) *
           cube;
  };
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const float x = -reach + cube * float(i), z = -reach + cube * float(j), y = level(i, j);
      add_quad(soup, {x, y, z}, {x + cube, y, z}, {x + cube, y, z + cube}, {x, y, z + cube});
      if (i + 1 < cells)
        if (const float next = level(i + 1, j); next != y)
          add_quad(soup, {x + cube, y, z}, {x + cube, y, z + cube}, {x + cube, next, z + cube},
                   {x + cube, next, z});
      if (j + 1 < cells)
        if (const float next = level(i, j + 1); next != y)
          add_quad(soup, {x, y, z + cube}, {x + cube, y, z + cube}, {x + cube, next, z + cube},
                   {x, next, z + cube});
    }
}

// Adds a town of towers with set-backs. The cameras see it from above.
void add_town(TriangleSoup& soup, float reach, Random& random) {
  const float block = random.between(1.2f, 3), street = block * random.between(0.15f, 0.5f),
              tall = random.between(1, 5);
  for (float x = -reach; x + block < reach; x += block + street)
    for (float z = -reach; z + block < reach; z += block + street) {
      float y = 0.06f, inset = 0;
      add_block(soup, {x - 0.1f * street, 0, z - 0.1f * street},
                {x + block + 0.1f * street, y, z + block + 0.1f * street});
      for (int part = random.whole(1, 4); part > 0; --part) {
        const float rise = tall * random.log_between(0.15f, 1);
        add_block(soup, {x + inset, y, z + inset}, {x + block - inset, y + rise, z + block - inset});
        if (random.chance(0.4f))  // storeys as ribs
          for (float h = y; h < y + rise; h += 0.25f)
            add_block(soup, {x + inset - 0.03f, h, z + inset - 0.03f},
                      {x + block - inset + 0.03f, h + 0.08f, z + block - inset + 0.03f});
        y += rise;
        inset += block * random.between(0.04f, 0.16f);
        if (inset > 0.4f * block) break;
      }
      for (int i = random.whole(0, 5); i > 0; --i)  // machines on the roof
        add_block(soup, {x + block * random.between(0.3f, 0.5f), y, z + block * random.between(0.3f, 0.5f)},
                  {x + block * random.between(0.5f, 0.65f), y + random.between(0.05f, 0.3f),
                   z + block * random.between(0.5f, 0.65f)});
    }
}

}  // namespace

TrainingScene make_terraces(Random& random) {
  TrainingScene scene;
  TriangleSoup& soup = scene.soup;
  const float reach = 12;
  const int kind = random.whole(0, 3);
  const float tall = random.between(0.06f, 0.2f);
  const Land land{random.bits(),
                  random.between(1, 4),
                  tall,
                  kind == 1 || random.chance(0.3f) ? tall * random.between(0.1f, 0.5f) : 0,
                  random.log_between(2, 12),
                  random.chance(0.5f)};
  float top = 0;
  if (kind == 3) {
    add_floor(soup, 4 * reach);
    add_town(soup, reach, random);
    top = 4;
  } else if (kind == 2) {
    add_voxels(soup, land, reach, random.whole(40, 120));
    top = 1.5f * tall * reach;
  } else {
    const int cells = random.whole(150, 320);
    add_sheet(soup, cells, cells, [&](float u, float v) {
      const float x = 2 * u - 1, z = 2 * v - 1;
      return Vec3{reach * x, reach * land.height(x, z), reach * z};
    });
    for (int i = random.whole(0, 60); i > 0; --i) {
      const float x = random.between(-0.8f, 0.8f), z = random.between(-0.8f, 0.8f);
      add_crate_or_ball(soup, {reach * x, reach * land.height(x, z) - 0.05f, reach * z},
                        random.log_between(0.1f, 0.8f), random);
    }
    top = 1.2f * tall * reach;
  }
  scene.size = 3;
  scene.cameras = {{-0.7f * reach, top + 0.3f, -0.7f * reach}, {0.7f * reach, top + 5, 0.9f * reach}};
  scene.subject = {{-0.5f * reach, -0.3f * top, -0.5f * reach}, {0.5f * reach, 0.7f * top, 0.5f * reach}};
  return scene;
}

}  // namespace nook::bake::nnao
