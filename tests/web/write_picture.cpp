// Draws the two linked instances of samples/web/write_data.cpp on a floor, with the AO of their vertices and
// of the screen, by the native library in an OpenGL ES context, for the page to draw again:
//
//   web_picture FOLDER
//
// FOLDER holds character.json, character.bin, showcase.bin and character.nook. FOLDER/picture.json gets
// sizes, matrices, shaders, and places in FOLDER/picture.bin: positions and normals in world space,
// triangles, and the picture as RGBA bytes whose rows begin at the bottom.
#include <glad/gl.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <nlohmann/json.hpp>
#include <nook/nook_gl.hpp>
#include <nook/nook_nnao.hpp>
#include <string>
#include <vector>

#include "platform/file_bytes.h"
#include "platform/platform.h"
#include "platform/program.h"
#include "sdk/src/core/vec.h"
#include "tests/web/picture_shaders.h"

namespace {

using nook::Vec3;
using Matrix = std::array<float, 16>;  // columns

constexpr int width_px = 480, height_px = 270;
constexpr float near_m = 0.2f, far_m = 30, fov_y_radians = 0.62f;
constexpr float radius_m = 0.4f, floor_half_size_m = 6;
constexpr Vec3 eye_ws = {1.9f, 1.7f, 3.3f}, target_ws = {0.2f, 0.85f, 0.15f};

// Positions and normals of all vertices in world space; the floor's four are the last.
struct Geometry {
  std::vector<float> positions_ws, normals_ws;
  std::vector<std::uint32_t> triangles;  // of one body; the floor's six are the last
  std::uint32_t body_vertices = 0;
};

// An array of character.bin or showcase.bin.
template <class T>
std::vector<T> array_of(const nlohmann::json& places, const std::vector<unsigned char>& bytes,
                        const char* name) {
  const nlohmann::json& place = places[name];
  std::vector<T> values(place["length"].get<std::size_t>());
  std::memcpy(values.data(), bytes.data() + place["offset"].get<std::size_t>(), values.size() * sizeof(T));
  return values;
}

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix m{};
  for (std::size_t c = 0; c < 4; ++c)
    for (std::size_t r = 0; r < 4; ++r)
      for (std::size_t k = 0; k < 4; ++k) m[4 * c + r] += a[4 * k + r] * b[4 * c + k];
  return m;
}

Matrix perspective() {
  const float f = 1 / std::tan(fov_y_radians / 2), depth = near_m - far_m;
  return {f * height_px / width_px,   0, 0, 0, 0, f, 0, 0, 0, 0, (far_m + near_m) / depth, -1, 0, 0,
          2 * far_m * near_m / depth, 0};
}

Matrix view_from_world() {
  const Vec3 z = normalised(eye_ws - target_ws), x = normalised(cross({0, 1, 0}, z)), y = cross(z, x);
  return {
      x.x, y.x, z.x, 0, x.y, y.y, z.y, 0, x.z, y.z, z.z, 0, -dot(x, eye_ws), -dot(y, eye_ws), -dot(z, eye_ws),
      1};
}

// Appends one vertex of the body, skinned by matrices of three rows.
void skin_vertex(const std::vector<float>& positions, const std::vector<float>& normals,
                 const std::vector<std::uint16_t>& joints, const std::vector<float>& weights,
                 const float* pose_3x4, std::size_t v, Geometry& geometry) {
  float rows[12] = {};
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < 12; ++i)
      rows[i] += weights[4 * v + k] * pose_3x4[12 * std::size_t(joints[4 * v + k]) + i];
  for (std::size_t r = 0; r < 3; ++r) {
    float position = rows[4 * r + 3], normal = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      position += rows[4 * r + c] * positions[3 * v + c];
      normal += rows[4 * r + c] * normals[3 * v + c];
    }
    geometry.positions_ws.push_back(position);
    geometry.normals_ws.push_back(normal);
  }
}

Geometry build_geometry(const nlohmann::json& places, const std::vector<unsigned char>& bytes,
                        const std::vector<float>& poses) {
  const auto positions = array_of<float>(places, bytes, "positions");
  const auto normals = array_of<float>(places, bytes, "normals");
  const auto joints = array_of<std::uint16_t>(places, bytes, "joints");
  const auto weights = array_of<float>(places, bytes, "weights");
  Geometry geometry;
  geometry.body_vertices = static_cast<std::uint32_t>(positions.size() / 3);
  geometry.triangles = array_of<std::uint32_t>(places, bytes, "indices");
  for (std::size_t body = 0; body < 2; ++body)
    for (std::size_t v = 0; v < geometry.body_vertices; ++v)
      skin_vertex(positions, normals, joints, weights, &poses[body * poses.size() / 2], v, geometry);
  for (const std::uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u})
    geometry.triangles.push_back(2 * geometry.body_vertices + corner);
  for (const float x : {-floor_half_size_m, floor_half_size_m})
    for (const float z : {-floor_half_size_m, floor_half_size_m}) {
      geometry.positions_ws.insert(geometry.positions_ws.end(), {x, 0, z});
      geometry.normals_ws.insert(geometry.normals_ws.end(), {0, 1, 0});
    }
  return geometry;
}

// The vertex array of the picture, and how each body and the floor are drawn from it.
class Bodies {
 public:
  Bodies(const GladGLContext& gl, const Geometry& geometry) : gl_(gl), geometry_(geometry) {
    gl.GenVertexArrays(1, &array_);
    gl.GenBuffers(3, buffers_);
    gl.BindVertexArray(array_);
    upload(GL_ARRAY_BUFFER, buffers_[0], geometry.positions_ws);
    upload(GL_ARRAY_BUFFER, buffers_[1], geometry.normals_ws);
    upload(GL_ELEMENT_ARRAY_BUFFER, buffers_[2], geometry.triangles);
  }
  ~Bodies() {
    gl_.DeleteVertexArrays(1, &array_);
    gl_.DeleteBuffers(3, buffers_);
  }
  Bodies(const Bodies&) = delete;
  Bodies& operator=(const Bodies&) = delete;

  // ao: the views of both instances, or null for depth alone.
  void draw(const nook_gl_view* ao) const {
    gl_.BindVertexArray(array_);
    const auto body_indices = static_cast<GLsizei>(geometry_.triangles.size() - 6);
    for (std::uint32_t body = 0; body < 2; ++body) {
      point_at(body * geometry_.body_vertices);
      if (ao) {
        gl_.BindBuffer(GL_ARRAY_BUFFER, ao[body].buffer);
        gl_.EnableVertexAttribArray(2);
        gl_.VertexAttribPointer(2, 1, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(ao[body].stride),
                                reinterpret_cast<const void*>(static_cast<std::uintptr_t>(ao[body].offset)));
      }
      gl_.DrawElements(GL_TRIANGLES, body_indices, GL_UNSIGNED_INT, nullptr);
    }
    point_at(0);
    gl_.DisableVertexAttribArray(2);
    gl_.VertexAttrib1f(2, 1);
    gl_.DrawElements(GL_TRIANGLES, 6, GL_UNSIGNED_INT,
                     reinterpret_cast<const void*>(static_cast<std::uintptr_t>(4 * body_indices)));
  }

 private:
  template <class T>
  void upload(GLenum target, GLuint buffer, const std::vector<T>& values) const {
    gl_.BindBuffer(target, buffer);
    gl_.BufferData(target, static_cast<GLsizeiptr>(values.size() * sizeof(T)), values.data(), GL_STATIC_DRAW);
  }
  void point_at(std::uint32_t first_vertex) const {
    for (GLuint slot = 0; slot < 2; ++slot) {
      gl_.BindBuffer(GL_ARRAY_BUFFER, buffers_[slot]);
      gl_.EnableVertexAttribArray(slot);
      gl_.VertexAttribPointer(slot, 3, GL_FLOAT, GL_FALSE, 12,
                              reinterpret_cast<const void*>(std::uintptr_t{12} * first_vertex));
    }
  }

  const GladGLContext& gl_;
  const Geometry& geometry_;
  GLuint array_ = 0, buffers_[3] = {};
};

// A framebuffer with a depth texture of 24 bits, and a colour texture of 8 bits a channel.
struct Target {
  explicit Target(const GladGLContext& gl) {
    gl.GenTextures(2, textures);
    gl.GenFramebuffers(1, &framebuffer);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    const GLenum formats[] = {GL_DEPTH_COMPONENT24, GL_RGBA8};
    const GLenum attachments[] = {GL_DEPTH_ATTACHMENT, GL_COLOR_ATTACHMENT0};
    for (int i = 0; i < 2; ++i) {
      gl.BindTexture(GL_TEXTURE_2D, textures[i]);
      gl.TexStorage2D(GL_TEXTURE_2D, 1, formats[i], width_px, height_px);
      gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
      gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
      gl.FramebufferTexture2D(GL_FRAMEBUFFER, attachments[i], GL_TEXTURE_2D, textures[i], 0);
    }
  }
  GLuint framebuffer = 0, textures[2] = {};  // depth, colour
};

// Clears the target and draws the bodies into it. With AO of vertices and of the screen it is the picture,
// without them depth alone.
void draw_target(const GladGLContext& gl, const Target& target, const Bodies& bodies, const Matrix& clip,
                 const platform::Program& program, const nook_gl_view* ao, GLuint screen_ao) {
  gl.BindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
  gl.Viewport(0, 0, width_px, height_px);
  gl.Enable(GL_DEPTH_TEST);
  gl.ClearColor(1, 1, 1, 1);
  gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  program.use();
  gl.UniformMatrix4fv(program.uniform("clip_from_world"), 1, GL_FALSE, clip.data());
  if (ao) {
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_2D, screen_ao);
    gl.Uniform1i(program.uniform("screen_ao"), 0);
  }
  bodies.draw(ao);
}

// The AO of two linked instances on the ground, as samples/web/write_data.cpp has them.
struct Occlusion {
  Occlusion(const std::vector<unsigned char>& file, const std::vector<float>& poses,
            const platform::Context& window)
      : model(context, file.data(), file.size()) {
    const float ground[4] = {0, 1, 0, 0};
    const std::uint32_t bones = model.info().bone_count;
    for (std::uint32_t i = 0; i < 2; ++i) {
      ids[i] = scene.add_instance(model);
      scene.set_ground(ids[i], ground);
      nook_pose_desc pose = nook::pose_desc();
      pose.kind = NOOK_POSE_REST_TO_WORLD;
      pose.layout = NOOK_TRANSFORM_ROWS_3X4;
      pose.transforms = &poses[std::size_t{12} * bones * i];
      pose.transform_count = bones;
      scene.set_pose(ids[i], pose);
    }
    scene.link(ids[0], ids[1]);
    scene.link(ids[1], ids[0]);
    nook_gl_desc desc = nook::gl_desc();
    desc.get_proc = &platform::Context::loader;
    desc.get_proc_user = const_cast<platform::Context*>(&window);
    gl = nook::Gl(context, desc);
    nook_nnao_desc pass_desc = nook::nnao_desc();
    pass_desc.max_width = width_px;
    pass_desc.max_height = height_px;
    pass = nook::Nnao(gl, pass_desc);
  }
  nook::Context context;
  nook::CharacterModel model;
  nook::Scene scene{context};
  nook_instance_id ids[2] = {};
  nook::Gl gl;
  nook::Nnao pass;
};

std::vector<unsigned char> draw(const Geometry& geometry, Occlusion& occlusion, const GladGLContext& gl,
                                const Matrix& projection, const Matrix& clip) {
  using namespace nook::test;
  const platform::Program depth(gl, {picture_head, picture_vertex}, {picture_head, picture_depth_fragment});
  const platform::Program lit(gl, {picture_head, picture_vertex}, {picture_head, picture_fragment});
  const Bodies bodies(gl, geometry);
  const Target target(gl), picture(gl);
  draw_target(gl, target, bodies, clip, depth, nullptr, 0);
  nook_gl_frame_desc frame = nook::gl_frame_desc();
  nook_nnao_frame_desc desc = nook::nnao_frame_desc();
  frame.depth_texture = target.textures[0];
  frame.width = width_px;
  frame.height = height_px;
  desc.radius = radius_m;
  std::copy(projection.begin(), projection.end(), frame.projection);
  occlusion.pass.render(frame, desc);
  occlusion.gl.update(occlusion.scene);
  const nook_gl_view ao[] = {occlusion.gl.view(occlusion.scene, occlusion.ids[0]),
                             occlusion.gl.view(occlusion.scene, occlusion.ids[1])};
  draw_target(gl, picture, bodies, clip, lit, ao, occlusion.pass.info().texture);
  std::vector<unsigned char> pixels(std::size_t{4} * width_px * height_px);
  gl.ReadPixels(0, 0, width_px, height_px, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
  if (const GLenum error = gl.GetError())
    throw std::runtime_error("OpenGL error " + std::to_string(error) + " after the picture");
  return pixels;
}

void run(const std::string& folder) {
  const std::vector<unsigned char> text = platform::read_file(folder + "/character.json");
  const nlohmann::json description = nlohmann::json::parse(text.begin(), text.end());
  const std::vector<unsigned char> arrays = platform::read_file(folder + "/character.bin");
  const auto poses = array_of<float>(description["showcase"], platform::read_file(folder + "/showcase.bin"),
                                     "expected_poses");
  const Geometry geometry = build_geometry(description["arrays"], arrays, poses);
  platform::ContextRequest request;
  request.es = true;
  request.major = 3;
  request.minor = 0;
  const std::unique_ptr<platform::Context> window = platform::create_context(request);
  Occlusion occlusion(platform::read_file(folder + "/character.nook"), poses, *window);
  const Matrix projection = perspective(), clip = product(projection, view_from_world());
  const std::vector<unsigned char> pixels = draw(geometry, occlusion, window->gl(), projection, clip);

  std::vector<unsigned char> bytes;
  nlohmann::json places;
  const auto add = [&](const char* name, const auto& values) {
    const auto* const first = reinterpret_cast<const unsigned char*>(values.data());
    places[name] = {{"offset", bytes.size()}, {"length", values.size()}};
    bytes.insert(bytes.end(), first, first + values.size() * sizeof values[0]);
  };
  add("positions", geometry.positions_ws);
  add("normals", geometry.normals_ws);
  add("triangles", geometry.triangles);
  add("pixels", pixels);
  const std::string json = nlohmann::json{
      {"width", width_px},
      {"height", height_px},
      {"radius", radius_m},
      {"projection", projection},
      {"clip_from_world", clip},
      {"vertex", nook::test::picture_vertex},
      {"depth_fragment", nook::test::picture_depth_fragment},
      {"fragment", nook::test::picture_fragment},
      {"arrays", places}}.dump(1);
  platform::write_file(folder + "/picture.bin", bytes.data(), bytes.size());
  platform::write_file(folder + "/picture.json", json.data(), json.size());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: web_picture FOLDER\n", stderr);
    return 2;
  }
  try {
    run(argv[1]);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "web_picture: %s\n", e.what());
    return 3;
  }
  return 0;
}
