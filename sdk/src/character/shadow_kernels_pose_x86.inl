// Transforms from rest space to world space with four floats at a time. The file is included inside an x86
// instruction set's namespace. The matrix of a bone takes three loads, one for each row; four blended key
// points are then transposed to arrays.

namespace {

__m128 multiply_add(__m128 a, __m128 b, __m128 c) {
#ifdef __FMA__
  return _mm_fmadd_ps(a, b, c);
#else
  return _mm_add_ps(_mm_mul_ps(a, b), c);
#endif
}

// Returns 1 / sqrt(a) to float precision, for a > 0.
__m128 inverse_root(__m128 a) {
  return _mm_div_ps(_mm_set1_ps(1.0f), _mm_sqrt_ps(a));
}

// Column c of row r of four matrices: m[4 * r + c] holds one number for each of them.
struct FourMatrices {
  __m128 m[12];
};

FourMatrices transposed(const __m128 (&rows)[4][3]) {
  FourMatrices out;
  for (int r = 0; r < 3; ++r) {
    __m128 a = rows[0][r], b = rows[1][r], c = rows[2][r], d = rows[3][r];
    _MM_TRANSPOSE4_PS(a, b, c, d);
    out.m[4 * r] = a;
    out.m[4 * r + 1] = b;
    out.m[4 * r + 2] = c;
    out.m[4 * r + 3] = d;
  }
  return out;
}

FourMatrices blend_four(const Mat3x4* bones, const std::uint16_t* bone, const float* weight) {
  __m128 rows[4][3];
  for (int k = 0; k < 4; ++k) {
    const __m128 first = _mm_set1_ps(weight[4 * k]);
    const float* m = bones[bone[4 * k]].m;
    for (int r = 0; r < 3; ++r) rows[k][r] = _mm_mul_ps(first, _mm_loadu_ps(m + 4 * r));
    for (int b = 1; b < 4; ++b) {
      const __m128 w = _mm_set1_ps(weight[4 * k + b]);
      const float* n = bones[bone[4 * k + b]].m;
      for (int r = 0; r < 3; ++r) rows[k][r] = multiply_add(w, _mm_loadu_ps(n + 4 * r), rows[k][r]);
    }
  }
  return transposed(rows);
}

struct Three {
  __m128 x, y, z;
};

Three linear_part(const FourMatrices& a, const Three& v) {
  const auto row = [&](int r) {
    return multiply_add(a.m[4 * r], v.x, multiply_add(a.m[4 * r + 1], v.y, _mm_mul_ps(a.m[4 * r + 2], v.z)));
  };
  return {row(0), row(1), row(2)};
}

Three moved_point(const FourMatrices& a, const Three& p, Vec3 offset_ws) {
  const Three turned = linear_part(a, p);
  return {_mm_add_ps(turned.x, _mm_sub_ps(a.m[3], _mm_set1_ps(offset_ws.x))),
          _mm_add_ps(turned.y, _mm_sub_ps(a.m[7], _mm_set1_ps(offset_ws.y))),
          _mm_add_ps(turned.z, _mm_sub_ps(a.m[11], _mm_set1_ps(offset_ws.z)))};
}

__m128 squared_length(const Three& v) {
  return multiply_add(v.x, v.x, multiply_add(v.y, v.y, _mm_mul_ps(v.z, v.z)));
}

void pose_four(const KeyPointSoa& rest, const FourMatrices& m, Vec3 offset_ws, std::uint32_t k,
               const KeyPointTarget& out) {
  const Three p = moved_point(
      m, {_mm_loadu_ps(rest.x + k), _mm_loadu_ps(rest.y + k), _mm_loadu_ps(rest.z + k)}, offset_ws);
  _mm_storeu_ps(out.x + k, p.x);
  _mm_storeu_ps(out.y + k, p.y);
  _mm_storeu_ps(out.z + k, p.z);
  const Three n =
      linear_part(m, {_mm_loadu_ps(rest.nx + k), _mm_loadu_ps(rest.ny + k), _mm_loadu_ps(rest.nz + k)});
  // The blend of opposite bones can cancel a normal. It then stays zero, and shadows treat it as no
  // direction.
  const __m128 scale = inverse_root(_mm_max_ps(squared_length(n), _mm_set1_ps(1e-30f)));
  _mm_storeu_ps(out.nx + k, _mm_mul_ps(n.x, scale));
  _mm_storeu_ps(out.ny + k, _mm_mul_ps(n.y, scale));
  _mm_storeu_ps(out.nz + k, _mm_mul_ps(n.z, scale));
}

void pose_key_points(const RestKeyPointView& rest, const Mat3x4* bones, Vec3 offset_ws,
                     const KeyPointTarget& out, const KeyPointTarget* surface) {
  for (std::uint32_t k = 0; k < rest.padded_count; k += 4) {
    const FourMatrices m = blend_four(bones, rest.bone + 4 * k, rest.weight + 4 * k);
    pose_four(rest.fitted, m, offset_ws, k, out);
    if (surface) pose_four(rest.surface, m, offset_ws, k, *surface);
  }
}

// The lanes after the last sphere repeat it.
void pose_spheres(const RestSphereView& rest, const Mat3x4* bones, Vec3 offset_ws, const SphereTarget& out) {
  for (std::uint32_t i = 0; i < rest.count; i += 4) {
    float x[4], y[4], z[4], radius[4];
    __m128 rows[4][3];
    const std::uint32_t lanes = rest.count - i < 4 ? rest.count - i : 4;
    for (std::uint32_t l = 0; l < 4; ++l) {
      const std::uint32_t s = i + (l < lanes ? l : lanes - 1);
      x[l] = rest.x[s];
      y[l] = rest.y[s];
      z[l] = rest.z[s];
      radius[l] = rest.radius[s];
      for (int r = 0; r < 3; ++r) rows[l][r] = _mm_loadu_ps(bones[rest.bone[s]].m + 4 * r);
    }
    const FourMatrices m = transposed(rows);
    const Three p = moved_point(m, {_mm_loadu_ps(x), _mm_loadu_ps(y), _mm_loadu_ps(z)}, offset_ws);
    // Under rigid or uniformly scaled matrices, the length of every row of the linear part is the scale.
    const __m128 scale = _mm_sqrt_ps(squared_length({m.m[0], m.m[1], m.m[2]}));
    const __m128 scaled = _mm_max_ps(_mm_mul_ps(_mm_loadu_ps(radius), scale), _mm_set1_ps(min_sphere_radius));
    float ox[4], oy[4], oz[4], inverse[4];
    _mm_storeu_ps(ox, p.x);
    _mm_storeu_ps(oy, p.y);
    _mm_storeu_ps(oz, p.z);
    _mm_storeu_ps(inverse, _mm_div_ps(_mm_set1_ps(1.0f), scaled));
    for (std::uint32_t l = 0; l < lanes; ++l) {
      out.x[i + l] = ox[l];
      out.y[i + l] = oy[l];
      out.z[i + l] = oz[l];
      out.inverse_radius[i + l] = inverse[l];
    }
  }
}

}  // namespace
