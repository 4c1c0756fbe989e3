#include <nook/experimental/nook_sg.h>
#include "bakers/lab/gpu_cost/shader_cases.h"
#include "bakers/lab/gpu_cost/trip_counts.h"

namespace nook::lab {
namespace {

constexpr int lobe_counts[] = {6, 12, 24};

struct Function {
  const char* name;
  const char* call;
};
constexpr Function of_a_grid[] = {
    {"radiance", "nook_probe_radiance(place, view)"},
    {"irradiance", "nook_probe_irradiance(place, normal)"},
    {"irradiance, fitted", "nook_probe_irradiance_fitted(place, normal)"},
    {"irradiance, inner product", "nook_probe_irradiance_inner_product(place, normal)"},
    {"specular, isotropic", "nook_probe_specular_isotropic(place, surface)"},
    {"specular, anisotropic", "nook_probe_specular_anisotropic(place, surface)"}};

std::string grid_shader(const Function& function) {
  return R"(#include "shaders/probe/host.glsl"
in vec3 position;
in vec3 normal;
in vec3 view;
in vec3 tangent;
in vec3 alpha_and_reflectance;
out vec4 colour;
void main() {
  NookProbePlace place = nook_probe_place(position);
  NookProbeSurface surface =
      NookProbeSurface(normal, view, tangent, alpha_and_reflectance.xy, alpha_and_reflectance.z);
  colour = vec4()" +
         std::string(function.call) + R"(, 1.0);
}
)";
}

struct Volume {
  const char* name;
  const char* defines;
};
constexpr Volume volumes[] = {
    {"harmonics", "#define NOOK_GRID_TEXELS NOOK_GRID_HARMONICS_TEXELS\n"},
    {"zonal harmonics", "#define NOOK_GRID_TEXELS NOOK_GRID_ZONAL_TEXELS\n"},
    {"zonal harmonics, walls",
     "#define NOOK_GRID_TEXELS NOOK_GRID_ZONAL_TEXELS\n#define NOOK_GRID_WALLS 1\n"}};

std::string volume_shader(const Volume& volume) {
  return std::string(volume.defines) + R"(#include "shaders/probe/volume/host.glsl"
in vec3 position;
in vec3 normal;
out vec4 colour;
void main() { colour = vec4(nook_grid_irradiance(position, normal), 1.0); }
)";
}

constexpr char harmonics[] = R"(#include "shaders/probe/host.glsl"
uniform vec3 coefficients[9];
in vec3 normal;
out vec4 colour;
void main() {
  NookHarmonics light;
  for (int i = 0; i < 9; ++i) light.coefficient[i] = coefficients[i];
  colour = vec4(nook_sh_irradiance(light, normal), 1.0);
}
)";
constexpr char zonal_harmonics[] = R"(#include "shaders/probe/host.glsl"
uniform vec3 coefficients[5];
in vec3 normal;
out vec4 colour;
void main() {
  NookZonalHarmonics light;
  for (int i = 0; i < 4; ++i) light.coefficient[i] = coefficients[i];
  light.zonal = coefficients[4];
  colour = vec4(nook_zh3_irradiance(light, normal), 1.0);
}
)";
constexpr char ambient[] = R"(#include "shaders/probe/host.glsl"
in vec3 albedo;
in vec3 irradiance;
in vec3 ao_facing_roughness;
out vec4 colour;
void main() {
  colour = vec4(nook_probe_ambient(albedo, irradiance, vec3(ao_facing_roughness.x)),
                nook_probe_specular_occlusion(ao_facing_roughness.x, ao_facing_roughness.y, ao_facing_roughness.z));
}
)";

std::string capture_define(const char* name, const char* value) {
  return std::string("#define NOOK_CAPTURE_").append(name) + " NOOK_CAPTURE_" + value + "\n";
}

// Adds the shaders of a capture: one sums over the texels of a row, one averages over the rows, and one
// writes the probe.
void add_captures(std::vector<ShaderCase>& shaders) {
  const auto add = [&](const char* file, const std::string& variant, const std::string& defines,
                       const std::vector<Loop>& loops) {
    shaders.push_back(tree_shader(Stage::vertex, std::string("shaders/probe/capture/") + file,
                                  "probe capture, " + variant, defines, loops));
  };
  const std::vector<Loop> columns = {{"texels of a row", trips::capture_face_size, {}}};
  add("rows.vert", "a row's sums of 12 lobes", capture_define("KIND", "LOBES"), columns);
  add("rows.vert", "a row's sums of harmonics", capture_define("KIND", "BANDS"), columns);
  add("rows.vert", "a row's luminance", capture_define("KIND", "LUMINANCE"), columns);
  add("mean.vert", "mean over the rows", "", {{"rows", trips::capture_rows, {}}});
  add("solve.vert", "amplitudes of 12 lobes", capture_define("FORM", "AMPLITUDES"),
      {{"four factors of the map", trips::capture_factors, {}}});
  add("solve.vert", "harmonics", capture_define("FORM", "HARMONICS"), {});
  add("solve.vert", "zonal harmonics", capture_define("FORM", "ZONAL"), {});
}

}  // namespace

std::vector<ShaderCase> probe_shaders() {
  std::vector<ShaderCase> shaders;
  for (const Function& function : of_a_grid)
    for (const int lobes : lobe_counts)
      shaders.push_back(
          host_shader(grid_shader(function),
                      "probe grid, " + std::string(function.name) + ", " + std::to_string(lobes) + " lobes",
                      {{"lobes", double(lobes), {}}}));
  for (const Volume& volume : volumes)
    shaders.push_back(
        host_shader(volume_shader(volume), std::string("probe volume, irradiance, ").append(volume.name)));
  shaders.push_back(host_shader(harmonics, "probe, irradiance of harmonics"));
  shaders.push_back(host_shader(zonal_harmonics, "probe, irradiance of zonal harmonics"));
  shaders.push_back(host_shader(ambient, "probe, ambient and specular occlusion"));
  add_captures(shaders);
  return shaders;
}

}  // namespace nook::lab
