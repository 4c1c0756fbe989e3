// windows_gl CHARACTER.nook: AO by the OpenGL half in a context of Windows, in both desktop tiers, against
// the CPU half. Status 77 means that Windows gives no context of OpenGL 3.3.
#include <nook/nook_gl.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <windows.h>

namespace {

void check(nook_result result) {
  if (result == NOOK_OK) return;
  std::printf("windows_gl: %s\n", nook_last_message());
  std::exit(1);
}

// wglGetProcAddress has the functions since OpenGL 1.2, the DLL those before.
void* function(void* user, const char* name) {
  if (const PROC found = wglGetProcAddress(name)) return reinterpret_cast<void*>(found);
  return reinterpret_cast<void*>(GetProcAddress(static_cast<HMODULE>(user), name));
}

// Makes the context of a hidden window current.
bool make_context() {
  const HWND window = CreateWindowA("STATIC", "", WS_POPUP, 0, 0, 16, 16, nullptr, nullptr, nullptr, nullptr);
  if (!window) return false;
  const HDC device = GetDC(window);
  PIXELFORMATDESCRIPTOR format = {};
  format.nSize = sizeof format;
  format.nVersion = 1;
  format.dwFlags = PFD_DRAW_TO_WINDOW | PFD_SUPPORT_OPENGL;
  format.iPixelType = PFD_TYPE_RGBA;
  format.cColorBits = 24;
  const int number = ChoosePixelFormat(device, &format);
  if (number == 0 || !SetPixelFormat(device, number, &format)) return false;
  const HGLRC context = wglCreateContext(device);
  return context && wglMakeCurrent(device, context);
}

std::vector<unsigned char> read_file(const char* path) {
  std::vector<unsigned char> bytes;
  std::FILE* const file = std::fopen(path, "rb");
  if (!file) return bytes;
  unsigned char block[65536];
  for (std::size_t n; (n = std::fread(block, 1, sizeof block, file)) > 0;)
    bytes.insert(bytes.end(), block, block + n);
  std::fclose(file);
  return bytes;
}

// rows_3x4 has a rest-to-world matrix for each bone, three rows of four.
nook_result set_pose(nook_scene scene, nook_instance_id instance, const float* rows_3x4,
                     std::uint32_t bone_count) {
  nook_pose_desc desc;
  check(nook_pose_desc_init(&desc));
  desc.kind = NOOK_POSE_REST_TO_WORLD;
  desc.layout = NOOK_TRANSFORM_ROWS_3X4;
  desc.transforms = rows_3x4;
  desc.transform_count = bone_count;
  return nook_scene_set_pose(scene, instance, &desc);
}

// The largest difference between the AO of both halves, over two linked instances on the ground.
float difference(nook_context context, nook_gl gl, nook_model model) {
  nook_model_info info = {};
  info.struct_size = sizeof info;
  check(nook_model_describe(model, &info));
  nook_scene_desc desc;
  check(nook_scene_desc_init(&desc));
  nook_scene scene;
  check(nook_scene_create(context, &desc, &scene));
  nook_instance_id instances[2];
  const float ground[4] = {0, 1, 0, -0.8f * info.bounding_radius};
  for (int i = 0; i < 2; ++i) {
    check(nook_scene_add_instance(scene, model, &instances[i]));
    check(nook_scene_set_ground(scene, instances[i], ground));
    std::vector<float> pose;
    const float x = 0.7f * info.bounding_radius * float(i);
    for (std::uint32_t bone = 0; bone < info.bone_count; ++bone)
      pose.insert(pose.end(), {1, 0, 0, x, 0, 1, 0, 0, 0, 0, 1, 0});
    check(set_pose(scene, instances[i], pose.data(), info.bone_count));
  }
  check(nook_scene_link(scene, instances[0], instances[1]));
  check(nook_scene_update(scene));
  check(nook_gl_scene_update(gl, scene));
  float largest = 0;
  std::vector<float> cpu(info.file_vertex_count), gpu(info.file_vertex_count);
  for (const nook_instance_id instance : instances) {
    check(nook_scene_read(scene, instance, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, cpu.data(),
                          info.file_vertex_count, 0));
    check(nook_gl_scene_read(gl, scene, instance, NOOK_CHANNEL_AO, gpu.data(), info.file_vertex_count));
    for (std::size_t v = 0; v < cpu.size(); ++v) largest = std::max(largest, std::abs(cpu[v] - gpu[v]));
  }
  check(nook_gl_scene_release(gl, scene));
  nook_scene_destroy(&scene);
  return largest;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<unsigned char> file = argc == 2 ? read_file(argv[1]) : std::vector<unsigned char>();
  if (file.empty()) {
    std::printf("usage: windows_gl CHARACTER.nook, a file that can be read\n");
    return 2;
  }
  if (!make_context()) {
    std::printf("windows_gl: Windows gives no OpenGL context\n");
    return 77;
  }
  nook_context_desc desc;
  check(nook_context_desc_init(&desc));
  nook_context context;
  check(nook_context_create(&desc, &context));
  nook_model model;
  check(nook_model_load(context, file.data(), file.size(), &model));
  bool above = false;
  for (const int tier : {33, 43}) {
    nook_gl_desc gl_desc;
    check(nook_gl_desc_init(&gl_desc));
    gl_desc.get_proc = function;
    gl_desc.get_proc_user = LoadLibraryA("opengl32.dll");
    gl_desc.max_tier = tier;
    nook_gl gl;
    const nook_result created = nook_gl_create(context, &gl_desc, &gl);
    if (created == NOOK_ERROR_UNSUPPORTED) {
      std::printf("windows_gl: %s\n", nook_last_message());
      return 77;
    }
    check(created);
    nook_gl_info info = {};
    info.struct_size = sizeof info;
    check(nook_gl_describe(gl, &info));
    const float largest = difference(context, gl, model);
    std::printf("tier %d of OpenGL %s, %s: AO within %.1e of the CPU half\n", int(info.tier), info.version,
                info.renderer, double(largest));
    // The bound of nook_gl_scene_update.
    above = above || !(largest <= 2e-3f);
    nook_gl_destroy(&gl);
  }
  nook_model_destroy(&model);
  nook_context_destroy(&context);
  return above ? 1 : 0;
}
