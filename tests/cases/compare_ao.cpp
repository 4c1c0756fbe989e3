// compare_ao GIVEN PLAIN: prints the mean difference of the AO of two files of one body, and the mean AO of
// the plain one. Both are ray traced in the pose that the file shows.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <vector>

#include "bakers/import/clip.h"
#include "bakers/import/gltf.h"
#include "bakers/import/posed_normals.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "sdk/src/core/geometry.h"

namespace {

using namespace nook;
using namespace nook::bake;

struct Shown {
  TriangleSoup soup;
  std::vector<Vec3> normal;
};

Shown shown(const char* path) {
  const ImportedCharacter character = import_gltf(std::filesystem::path(path));
  const Pose pose = bone_matrices(character, default_locals(character.nodes), nullptr);
  Shown out;
  skin_positions(character.mesh, pose, out.soup.position);
  posed_normals(character.mesh, pose, out.soup.position, out.normal);
  out.soup.triangle = character.mesh.triangle;
  return out;
}

// The vertices in the order of another file: rays depend on the number of a vertex. Of those at one place the
// one that faces the same way is taken.
Receivers in_order_of(const Shown& from, const Shown& order, std::vector<Vec3>& position,
                      std::vector<Vec3>& normal) {
  for (std::size_t v = 0; v < order.normal.size(); ++v) {
    std::size_t best = 0;
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < from.normal.size(); ++i) {
      const float apart = length(from.soup.position[i] - order.soup.position[v]) +
                          1e-4f * length(from.normal[i] - order.normal[v]);
      if (apart < least) {
        least = apart;
        best = i;
      }
    }
    position.push_back(from.soup.position[best]);
    normal.push_back(from.normal[best]);
  }
  return {position, normal};
}

int compare(const char* given_path, const char* plain_path) {
  const Shown given = shown(given_path), plain = shown(plain_path);
  AoSettings settings{256, 1};
  settings.origin_offset = ray_origin_offset(plain.soup.position);
  std::vector<Vec3> position, normal;
  const std::vector<float> of_given =
      trace_ao(given.soup, in_order_of(given, plain, position, normal), settings);
  const std::vector<float> of_plain = trace_ao(plain.soup, {plain.soup.position, plain.normal}, settings);
  double difference = 0, mean = 0;
  for (std::size_t v = 0; v < of_plain.size(); ++v) {
    difference += std::abs(double(of_given[v]) - double(of_plain[v]));
    mean += double(of_plain[v]);
  }
  const double count = double(of_plain.size());
  std::printf("%.6f %.6f\n", difference / count, mean / count);
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    if (count == 3) return compare(arguments[1], arguments[2]);
    std::fprintf(stderr, "usage: compare_ao GIVEN PLAIN\n");
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
  }
  return 1;
}
