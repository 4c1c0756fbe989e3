#include "sdk/src/character/face_normals.h"

namespace nook {

Vector<Vec3> face_normals_of(const HostVertices& host, std::span<const std::uint32_t> indices,
                             Memory* memory) {
  Vector<Vec3> sum(host.count, Vec3{}, memory);
  // `along` is twice the area of the triangles that face the same way as the normals, and `away` is twice the
  // area of the other triangles. Both are equal for flat cards whose two faces have the same normals.
  double along = 0, away = 0;
  for (std::size_t t = 0; t + 2 < indices.size(); t += 3) {
    const std::uint32_t a = indices[t], b = indices[t + 1], c = indices[t + 2];
    const Vec3 face = cross(host.position[b] - host.position[a], host.position[c] - host.position[a]);
    for (const std::uint32_t corner : {a, b, c}) sum[corner] += face;
    if (!host.normal.first) continue;
    const float side = dot(face, host.normal[a] + host.normal[b] + host.normal[c]);
    (side < 0 ? away : along) += double(length(face));
  }
  const float sign = away > 2 * along ? -1.0f : 1.0f;
  for (Vec3& normal : sum) normal = sign * normalised(normal);
  return sum;
}

}  // namespace nook
