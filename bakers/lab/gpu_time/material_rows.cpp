#include <nook/nook_gl.h>

#include "bakers/lab/gpu_time/timed_rows.h"
#include "bakers/lab/gpu_time/whole_image.h"
#include "platform/file_bytes.h"

namespace nook::lab {

using namespace measure;

namespace {

// Shows one tile over 256 x 256 pixels. The view and the light change over the image.
const char* const body =
    "  vec2 uv = gl_FragCoord.xy / 256.0;\n"
    "  vec3 view = normalize(vec3(at - 0.5, 0.7)), light = normalize(vec3(0.5 - at.yx, 0.5));\n"
    "  vec4 modes[NOOK_LIGHT_VEC4_COUNT];\n"
    "  nook_material_decode(uv, dFdx(uv), dFdy(uv), view, modes);\n"
    "  float occlusion = nook_material_occlusion(uv, dFdx(uv), dFdy(uv), view);\n"
    "  colour = nook_material_radiance(modes, light) * nook_material_visibility(occlusion);\n";

class Uploaded {
 public:
  Uploaded(const NookGl& gl, const std::filesystem::path& file) {
    const std::vector<unsigned char> bytes = platform::read_file(file);
    succeed(nook_material_load(gl.context(), bytes.data(), bytes.size(), nullptr, &material_));
    succeed(nook_gl_upload_material(gl.get(), material_, &uploaded_));
    info_.struct_size = sizeof info_;
    succeed(nook_gl_upload_describe(uploaded_, &info_));
  }
  ~Uploaded() {
    nook_gl_upload_destroy(&uploaded_);
    nook_material_destroy(&material_);
  }
  Uploaded(const Uploaded&) = delete;
  Uploaded& operator=(const Uploaded&) = delete;

  const char* glsl() const { return info_.glsl; }
  void bind(WholeImage& image) const {
    for (std::uint32_t i = 0; i < info_.texture_count; ++i) {
      const nook_gl_upload_texture& texture = info_.textures[i];
      image.bind(texture.target, texture.texture, texture.uniform);
    }
  }

 private:
  nook_material material_ = nullptr;
  nook_gl_upload uploaded_ = nullptr;
  nook_gl_upload_info info_{};
};

}  // namespace

std::vector<TimedRow> time_materials(const Timing& timing, const std::vector<std::filesystem::path>& files) {
  std::vector<TimedRow> rows;
  for (const std::filesystem::path& file : files) {
    const std::string name = "material " + file.stem().string();
    if (!timing.wanted(name)) continue;
    const Uploaded material(timing.nook, file);
    WholeImage image(timing.context.gl(), timing.width, timing.height, material.glsl(), body);
    material.bind(image);
    timing.add(rows, name, [&] { image.draw(); });
  }
  return rows;
}

}  // namespace nook::lab
