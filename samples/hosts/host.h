// The host programs share this: arguments, the character in one pose with a camera, the count of OpenGL's
// errors, and the picture.
#pragma once

#include <nook/nook_gl.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "samples/gltf_viewer/viewed_character.h"

namespace hosts {

struct Options {
  std::filesystem::path character, model, out;
  std::string clip;
  std::string path = "gpu";  // where Nook evaluates the vertices: gpu, cpu, or none, which leaves Nook out;
                             // vtk, traced: vtkSSAOPass, rays
  std::string show = "lit";  // lit, plain (no shader reads what Nook made) or ao
  std::string state = "preserve";  // preserve, defaults or host
  bool orthographic = false;       // VTK only
  int width_px = 640, height_px = 480;

  nook_gl_state_mode state_mode() const;
};

// Prints usage and returns false when the program must end with exit_code.
bool parse_options(const char* name, int argc, char** argv, Options& options, int& exit_code);

// The character in a pose of its clip, and a camera that sees all of it.
struct Scene {
  viewer::CharacterFile file;
  viewer::Pose pose;
  glm::vec3 eye_ws, target_ws;
  float vertical_fov_rad = 0.5f, near_m = 0, far_m = 0;
  float size_m = 0;  // the diagonal of its box

  explicit Scene(const Options& options);
  // The global matrix of a node.
  const glm::mat4& global(int node) const {
    return pose.matrices[file.first_node_matrix + std::uint32_t(node)];
  }
};

// Finds functions of the current GLX context. Ignores the user pointer.
void* gl_proc(void* user, const char* name);

// From start_counting on, OpenGL's errors are counted through KHR_debug, synchronously.
void start_counting_gl_errors();

// Writes the picture, rows from top to bottom, three bytes each, and prints a report in JSON.
void finish(const char* name, const Options& options, const unsigned char* rgb);

// The colours that all hosts use. They take the AO of a vertex and of a pixel: GLSL without #version.
extern const char* const light_glsl;

// Runs the body and prints what it throws. Returns the exit code.
int run(const char* name, int argc, char** argv, void (*body)(const Options&));

}  // namespace hosts
