#include "samples/crowd/debug_overlay.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <thread>

namespace crowd {

DebugOverlay::DebugOverlay(const GladGLContext& gl, const Hero& hero) : gl_(gl), hero_(hero), shapes_(gl) {
  gl.GenBuffers(1, &error_buffer_);
}

DebugOverlay::~DebugOverlay() {
  gl_.DeleteBuffers(1, &error_buffer_);
}

void DebugOverlay::trace_missing(const PictureOfCrowd& picture, const std::vector<std::uint32_t>& characters,
                                 bool wait) {
  if (picture.poses != traced_poses_) {
    tracing_.reset();
    truth_.clear();
    traced_poses_ = picture.poses;
  }
  if (!tracing_) {
    std::vector<std::uint32_t> missing;
    for (const std::uint32_t character : characters)
      if (!truth_.contains(character)) missing.push_back(character);
    if (missing.empty()) return;
    tracing_ = std::make_unique<TracedAo>(hero_, traced_poses_, std::move(missing));
  }
  while (wait && !tracing_->is_done()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  const bool is_done = tracing_->is_done();
  if (const std::string failure = tracing_->failure(); !failure.empty()) throw std::runtime_error(failure);
  truth_.merge(tracing_->done());
  if (is_done) tracing_.reset();
}

void DebugOverlay::draw_errors(Renderer& renderer, const PictureOfCrowd& picture, const DebugView& view,
                               bool wait) {
  const std::vector<std::uint32_t> characters =
      nearest_characters(picture.scene, picture.camera.eye_ws, view.bodies);
  trace_missing(picture, characters, wait);
  std::vector<DrawnInstance> bodies;
  std::vector<float> errors;
  double squares = 0;
  for (const std::uint32_t character : characters) {
    const auto truth = truth_.find(character);
    if (truth == truth_.end()) continue;
    bodies.push_back(picture.drawn[character]);
    bodies.back().ao = {error_buffer_, errors.size() * sizeof(float), sizeof(float)};
    const std::vector<float> ao = picture.scene.read_ao(character);
    for (std::size_t i = 0; i < ao.size(); ++i) {
      errors.push_back(ao[i] - truth->second[i]);
      squares += double(errors.back()) * double(errors.back());
    }
  }
  is_complete_ = bodies.size() == characters.size();
  char text[96] = "ray tracing";
  if (!bodies.empty())
    std::snprintf(text, sizeof text, "%zu of %zu bodies traced, rms %.3f over their vertices", bodies.size(),
                  characters.size(), std::sqrt(squares / double(errors.size())));
  error_text_ = text;
  gl_.BindBuffer(GL_ARRAY_BUFFER, error_buffer_);
  gl_.BufferData(GL_ARRAY_BUFFER, GLsizeiptr(errors.size() * sizeof(float)), errors.data(), GL_STREAM_DRAW);
  shapes_.draw_errors(renderer, bodies, picture.camera);
}

void DebugOverlay::draw(Renderer& renderer, const PictureOfCrowd& picture, const DebugView& view,
                        bool wait_for_rays) {
  is_complete_ = true;
  error_text_.clear();
  if (view.error) draw_errors(renderer, picture, view, wait_for_rays);
  if (!view.spheres && !view.key_points && !view.links) return;
  // The GPU keeps the shadows of key points to itself.
  if (view.key_points) picture.scene.update_on_cpu();
  shapes_.draw(debug_shapes(picture.scene, view, picture.camera.eye_ws), picture.camera);
}

void colour_by_level(const CrowdScene& scene, std::span<DrawnInstance> drawn) {
  for (std::uint32_t i = 0; i < drawn.size(); ++i) drawn[i].albedo = level_colour(scene.info(i).level);
}

}  // namespace crowd
