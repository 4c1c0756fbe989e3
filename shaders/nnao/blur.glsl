// Half of a separable bilateral blur: along one axis.
uniform sampler2D nook_ao;
uniform ivec2 nook_blur_axis;
uniform int nook_blur_reach;  // texels; 0: none

// A box of 4 between the pixels, then (1, 2, 1) / 4: any noise with a period of 4 pixels averages out exactly.
const float nook_blur_weights[4] = float[4](1.0, 0.875, 0.5, 0.125);

// How much one texel has to do with a surface at `position`: 0 off its plane, or round a corner.
float nook_same_surface(ivec2 at, vec3 position, vec3 normal, float tolerance) {
  float depth = nook_surface_depth(at);
  if (depth == nook_no_surface) return 0.0;
  float off_plane = abs(dot(nook_position(nook_surface_rays, at, depth) - position, normal));
  float turn = max(dot(nook_surface_normal(at), normal), 0.0);
  turn *= turn;
  turn *= turn;
  return max(1.0 - off_plane / tolerance, 0.0) * turn * turn;
}

float nook_blurred(ivec2 texel) {
  float centre = texelFetch(nook_ao, texel, 0).r;
  float depth = nook_surface_depth(texel);
  if (depth == nook_no_surface || nook_blur_reach == 0) return centre;
  vec3 position = nook_position(nook_surface_rays, texel, depth);
  vec3 normal = nook_surface_normal(texel);
  float tolerance = nook_pixel_radius(nook_pixel_scale(depth)).x / nook_blur_sharpness;
  float sum = centre, weights = 1.0;
  for (int i = 1; i <= nook_blur_reach; ++i)
    for (int side = -1; side <= 1; side += 2) {
      ivec2 at = texel + side * i * nook_blur_axis;
      float weight = nook_blur_weights[i] * nook_same_surface(at, position, normal, tolerance);
      if (weight == 0.0) continue;
      sum += weight * texelFetch(nook_ao, at, 0).r;
      weights += weight;
    }
  return sum / weights;
}
