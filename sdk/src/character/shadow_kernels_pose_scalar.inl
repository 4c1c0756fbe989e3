// Transforms from rest space to world space, one element at a time. The file is included inside an
// instruction set's namespace.

namespace {

struct BoneBlend {
  float m[12];
};

BoneBlend blend_bones(const Mat3x4* bones, const std::uint16_t* bone, const float* weight) {
  BoneBlend blend;
  for (int j = 0; j < 12; ++j) {
    float sum = 0;
    for (int b = 0; b < 4; ++b) sum += weight[b] * bones[bone[b]].m[j];
    blend.m[j] = sum;
  }
  return blend;
}

void pose_points(const KeyPointSoa& rest, const float* m, Vec3 offset_ws, std::uint32_t k,
                 const KeyPointTarget& out) {
  const float x = rest.x[k], y = rest.y[k], z = rest.z[k];
  out.x[k] = m[0] * x + m[1] * y + m[2] * z + (m[3] - offset_ws.x);
  out.y[k] = m[4] * x + m[5] * y + m[6] * z + (m[7] - offset_ws.y);
  out.z[k] = m[8] * x + m[9] * y + m[10] * z + (m[11] - offset_ws.z);
  const float nx = rest.nx[k], ny = rest.ny[k], nz = rest.nz[k];
  const float wx = m[0] * nx + m[1] * ny + m[2] * nz;
  const float wy = m[4] * nx + m[5] * ny + m[6] * nz;
  const float wz = m[8] * nx + m[9] * ny + m[10] * nz;
  // If bones with opposite rotations are blended, a normal can become zero. It then stays zero, and shadows
  // treat it as having no direction.
  const float scale = rsqrt(max(wx * wx + wy * wy + wz * wz, 1e-30f));
  out.nx[k] = wx * scale;
  out.ny[k] = wy * scale;
  out.nz[k] = wz * scale;
}

void pose_key_points(const RestKeyPointView& rest, const Mat3x4* bones, Vec3 offset_ws,
                     const KeyPointTarget& out, const KeyPointTarget* surface) {
  for (std::uint32_t k = 0; k < rest.padded_count; ++k) {
    const BoneBlend blend = blend_bones(bones, rest.bone + 4 * k, rest.weight + 4 * k);
    pose_points(rest.fitted, blend.m, offset_ws, k, out);
    if (surface) pose_points(rest.surface, blend.m, offset_ws, k, *surface);
  }
}

void pose_spheres(const RestSphereView& rest, const Mat3x4* bones, Vec3 offset_ws, const SphereTarget& out) {
  for (std::uint32_t i = 0; i < rest.count; ++i) {
    const float* m = bones[rest.bone[i]].m;
    const float x = rest.x[i], y = rest.y[i], z = rest.z[i];
    out.x[i] = m[0] * x + m[1] * y + m[2] * z + (m[3] - offset_ws.x);
    out.y[i] = m[4] * x + m[5] * y + m[6] * z + (m[7] - offset_ws.y);
    out.z[i] = m[8] * x + m[9] * y + m[10] * z + (m[11] - offset_ws.z);
    // The matrices are rigid or have a uniform scale, so the length of each row of the linear part is the
    // scale.
    const float scale = sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
    out.inverse_radius[i] = 1 / max(rest.radius[i] * scale, min_sphere_radius);
  }
}

}  // namespace
