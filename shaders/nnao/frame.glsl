// The values that are equal for all pixels of a frame; frame_constants.h fills them. Pixels are those of the
// viewport, with (0, 0) at its lower left corner. The surface is the viewport at the resolution at which AO
// is computed: itself, or every second pixel of every second row.
uniform vec4 nook_frame[11];

#define nook_screen_rays nook_frame[0]   // x_scale, x_offset, y_scale, y_offset, for pixels of the screen
#define nook_surface_rays nook_frame[1]  // for texels of the surface
#define nook_depth_decode nook_frame[2]  // depth = (x + y stored) / (z + w stored)
#define nook_far_stored nook_frame[3].x  // the stored value of the far plane
#define nook_far_sign nook_frame[3].y    // 1: stored values grow with the distance; -1: they fall
#define nook_min_depth nook_frame[3].z
#define nook_orthographic (nook_frame[3].w != 0.0)
#define nook_radius nook_frame[4].x         // metres
#define nook_max_radius_px nook_frame[4].y  // texels of the surface
#define nook_intensity nook_frame[4].z
#define nook_power nook_frame[4].w
#define nook_blur_sharpness nook_frame[5].x
#define nook_normal_scale nook_frame[5].y
#define nook_normal_bias nook_frame[5].z
#define nook_has_normals (nook_frame[5].w != 0.0)
#define nook_origin ivec2(nook_frame[6].xy)  // of the viewport in the host's textures
#define nook_screen_size ivec2(nook_frame[6].zw)
#define nook_surface_size ivec2(nook_frame[7].xy)
#define nook_layer_mode int(nook_frame[7].z)
#define nook_view_mode int(nook_frame[7].w)
#define nook_normal_matrix mat3(nook_frame[8].xyz, nook_frame[9].xyz, nook_frame[10].xyz)

// The depth where there is no surface: sky, far plane, off the screen.
const float nook_no_surface = 1.0e30;

bool nook_inside(ivec2 texel, ivec2 size) {
  return all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, size));
}

// Returns the view-space position of a pixel's centre at a depth.
vec3 nook_position(vec4 rays, ivec2 pixel, float depth) {
  vec2 ray = rays.xz * (vec2(pixel) + 0.5) + rays.yw;
  return vec3(ray * (nook_orthographic ? 1.0 : depth), -depth);
}

vec3 nook_to_viewer(vec3 position) {
  return nook_orthographic ? vec3(0.0, 0.0, 1.0) : normalize(-position);
}

// Returns the texels of the surface per metre at a depth.
vec2 nook_pixel_scale(float depth) {
  return 1.0 / (nook_surface_rays.xz * (nook_orthographic ? 1.0 : depth));
}

// Returns the radius of a pixel in metres and in texels. It shrinks where it would cover too many texels.
vec2 nook_pixel_radius(vec2 scale) {
  float per_metre = abs(scale.y);
  float texels = min(nook_radius * per_metre, nook_max_radius_px);
  return vec2(texels / per_metre, texels);
}
