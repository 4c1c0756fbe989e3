// Code that the host programs share: arguments, the character in one pose with a camera, an OpenGL error
// counter, and the picture.
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
  std::string path = "gpu";        // gpu, cpu: where Nook evaluates the vertices; none: without Nook; vtk:
                                   // vtkSSAOPass; traced: ray tracing
  std::string show = "lit";        // lit, plain (no shader reads Nook's AO) or ao
  std::string state = "preserve";  // preserve, defaults or host
  bool orthographic = false;       // VTK only
  int width_px = 640, height_px = 480;

  nook_gl_state_mode state_mode() const;
};

// Returns false if the program must end with exit_code. In this case it has printed the usage.
bool parse_options(const char* name, int argc, char** argv, Options& options, int& exit_code);

// The character in one pose of its clip, and a camera in which the whole character is visible.
struct Scene {
  viewer::CharacterFile file;
  viewer::Pose pose;
  glm::vec3 eye_ws, target_ws;
  float vertical_fov_rad = 0.5f, near_m = 0, far_m = 0;
  float size_m = 0;  // the diagonal of the character's bounding box

  explicit Scene(const Options& options);
  // The global matrix of a node.
  const glm::mat4& global(int node) const {
    return pose.matrices[file.first_node_matrix + std::uint32_t(node)];
  }
};

// Finds functions of the current GLX context. Ignores the user pointer.
void* gl_proc(void* user, const char* name);

// Starts to count OpenGL errors, synchronously through KHR_debug.
void start_counting_gl_errors();

// Writes the picture, rows from top to bottom, three bytes each, and prints a report in JSON.
void finish(const char* name, const Options& options, const unsigned char* rgb);

// The GLSL for the colours of all hosts, without #version. Its inputs are the AO of a vertex and of a pixel.
extern const char* const light_glsl;

// Runs `body`, and prints the text of an exception. Returns the exit code.
int run(const char* name, int argc, char** argv, void (*body)(const Options&));

}  // namespace hosts
