// Transforms from rest space to world space with four floats at a time. The file is included inside an
// instruction set's namespace, after it has defined
//   Four, a vector of four floats with Four(float), +, -, *, /, fma, max and sqrt,
//   load_four(p), store(p, a) and transpose(a, b, c, d), which swaps rows and columns of a 4 x 4 matrix.
// The matrix of a bone takes three loads, one for each row. Four blended key points are transposed, so that
// each coordinate can be stored in its own array.

namespace {

// Returns 1 / sqrt(a) to float precision, for a > 0.
Four inverse_root(Four a) {
  return Four(1.0f) / sqrt(a);
}

// Four matrices. m[4 * r + c] holds the element in row r and column c of all four matrices.
struct FourMatrices {
  Four m[12];
};

NOOK_INLINE FourMatrices transposed(const Four (&rows)[4][3]) {
  FourMatrices out;
  for (int r = 0; r < 3; ++r) {
    Four a = rows[0][r], b = rows[1][r], c = rows[2][r], d = rows[3][r];
    transpose(a, b, c, d);
    out.m[4 * r] = a;
    out.m[4 * r + 1] = b;
    out.m[4 * r + 2] = c;
    out.m[4 * r + 3] = d;
  }
  return out;
}

// Returns the largest number of bones that any of four key points uses. Weights of 0 must come last.
int used_bones(const float* weight) {
  float largest[4];
  store(largest, max(max(load_four(weight), load_four(weight + 4)),
                     max(load_four(weight + 8), load_four(weight + 12))));
  return largest[3] > 0 ? 4 : largest[2] > 0 ? 3 : largest[1] > 0 ? 2 : 1;
}

NOOK_INLINE FourMatrices blend_four(const Mat3x4* bones, const std::uint16_t* bone, const float* weight) {
  Four rows[4][3];
  const int used = used_bones(weight);
  for (int k = 0; k < 4; ++k) {
    const Four first = Four(weight[4 * k]);
    const float* m = bones[bone[4 * k]].m;
    for (int r = 0; r < 3; ++r) rows[k][r] = first * load_four(m + 4 * r);
    for (int b = 1; b < used; ++b) {
      const Four w = Four(weight[4 * k + b]);
      const float* n = bones[bone[4 * k + b]].m;
      for (int r = 0; r < 3; ++r) rows[k][r] = fma(w, load_four(n + 4 * r), rows[k][r]);
    }
  }
  return transposed(rows);
}

struct Three {
  Four x, y, z;
};

Three linear_part(const FourMatrices& a, const Three& v) {
  const auto row = [&](int r) {
    return fma(a.m[4 * r], v.x, fma(a.m[4 * r + 1], v.y, a.m[4 * r + 2] * v.z));
  };
  return {row(0), row(1), row(2)};
}

Three moved_point(const FourMatrices& a, const Three& p, Vec3 offset_ws) {
  const Three turned = linear_part(a, p);
  return {turned.x + (a.m[3] - Four(offset_ws.x)), turned.y + (a.m[7] - Four(offset_ws.y)),
          turned.z + (a.m[11] - Four(offset_ws.z))};
}

Four squared_length(const Three& v) {
  return fma(v.x, v.x, fma(v.y, v.y, v.z * v.z));
}

NOOK_INLINE void pose_four(const KeyPointSoa& rest, const FourMatrices& m, Vec3 offset_ws, std::uint32_t k,
                           const KeyPointTarget& out) {
  const Three p =
      moved_point(m, {load_four(rest.x + k), load_four(rest.y + k), load_four(rest.z + k)}, offset_ws);
  store(out.x + k, p.x);
  store(out.y + k, p.y);
  store(out.z + k, p.z);
  const Three n = linear_part(m, {load_four(rest.nx + k), load_four(rest.ny + k), load_four(rest.nz + k)});
  // If bones with opposite rotations are blended, a normal can become zero. It then stays zero, and shadows
  // treat it as having no direction.
  const Four scale = inverse_root(max(squared_length(n), Four(1e-30f)));
  store(out.nx + k, n.x * scale);
  store(out.ny + k, n.y * scale);
  store(out.nz + k, n.z * scale);
}

// Without the surface positions and normals, the compiler can keep the matrices in registers.
void pose_key_points(const RestKeyPointView& rest, const Mat3x4* bones, Vec3 offset_ws,
                     const KeyPointTarget& out, const KeyPointTarget* surface) {
  const auto blend = [&](std::uint32_t k) {
    return blend_four(bones, rest.bone + 4 * k, rest.weight + 4 * k);
  };
  if (!surface) {
    for (std::uint32_t k = 0; k < rest.padded_count; k += 4)
      pose_four(rest.fitted, blend(k), offset_ws, k, out);
    return;
  }
  for (std::uint32_t k = 0; k < rest.padded_count; k += 4) {
    const FourMatrices m = blend(k);
    pose_four(rest.fitted, m, offset_ws, k, out);
    pose_four(rest.surface, m, offset_ws, k, *surface);
  }
}

// Lanes after the last sphere repeat the last sphere.
void pose_spheres(const RestSphereView& rest, const Mat3x4* bones, Vec3 offset_ws, const SphereTarget& out) {
  for (std::uint32_t i = 0; i < rest.count; i += 4) {
    float x[4], y[4], z[4], radius[4];
    Four rows[4][3];
    const std::uint32_t lanes = rest.count - i < 4 ? rest.count - i : 4;
    for (std::uint32_t l = 0; l < 4; ++l) {
      const std::uint32_t s = i + (l < lanes ? l : lanes - 1);
      x[l] = rest.x[s];
      y[l] = rest.y[s];
      z[l] = rest.z[s];
      radius[l] = rest.radius[s];
      for (int r = 0; r < 3; ++r) rows[l][r] = load_four(bones[rest.bone[s]].m + 4 * r);
    }
    const FourMatrices m = transposed(rows);
    const Three p = moved_point(m, {load_four(x), load_four(y), load_four(z)}, offset_ws);
    // The matrices are rigid or have a uniform scale, so the length of each row of the linear part is the
    // scale.
    const Four scale = sqrt(squared_length({m.m[0], m.m[1], m.m[2]}));
    const Four scaled = max(load_four(radius) * scale, Four(min_sphere_radius));
    float ox[4], oy[4], oz[4], inverse[4];
    store(ox, p.x);
    store(oy, p.y);
    store(oz, p.z);
    store(inverse, Four(1.0f) / scaled);
    for (std::uint32_t l = 0; l < lanes; ++l) {
      out.x[i + l] = ox[l];
      out.y[i + l] = oy[l];
      out.z[i + l] = oz[l];
      out.inverse_radius[i + l] = inverse[l];
    }
  }
}

}  // namespace
