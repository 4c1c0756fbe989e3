// A light of the crowd: the lobes of a probe, and the environment that the lobes stand for.
#pragma once

#include <nook/experimental/nook_trace.h>
#include <nook/nook_probe.h>

#include <filesystem>
#include <nook/nook.hpp>
#include <string>
#include <vector>

namespace crowd {

// A light in two parts: soft light, and a cone that stands for the lobe of a sun.
struct SplitLight {
  std::vector<nook_lobe> soft;
  float to_sun[3] = {0, 1, 0};
  float sun_degrees = 0;                  // full angle; 0: there is no such lobe
  float soft_up[3] = {}, sun_up[3] = {};  // the irradiance of open ground
};

class Light {
 public:
  // Reads a probe's file, whose lobes are then the environment too, or a latitude-longitude map, to which
  // this fits 12 lobes. Throws std::runtime_error and nook::Error.
  Light(const nook::Context& context, const std::filesystem::path& path);

  // A clear sky over warm ground, to which 12 lobes are fitted, and a low, hazy sun, which is a lobe itself.
  static Light built_in_sky(const nook::Context& context);

  const std::string& name() const { return name_; }
  const std::vector<nook_lobe>& lobes() const { return lobes_; }
  nook_bake_environment environment() const { return {rgb_.data(), width_, height_}; }
  // The mean over the sphere and the channels, which a constant light of the same power has.
  float mean_radiance() const { return mean_radiance_; }

  // The irradiance of surfaces with these unit normals from the lobes: RGB for each, not below 0.
  std::vector<float> irradiance(const std::vector<float>& normals) const;
  // The world pass takes the soft part by its bands, which hold no sharp shadow, and the sun as a cone.
  // Fitted lobes of a map overlap with both signs, so that none of them is a sun.
  SplitLight split() const;
  // The radiance of the lobes in a unit direction: RGB, not below 0.
  std::vector<float> radiance(const float direction[3]) const;

 private:
  explicit Light(std::string name) : name_(std::move(name)) {}
  void read_probe(const nook::Context& context, const std::filesystem::path& path);
  void read_map(const std::filesystem::path& path);
  void fit_lobes(const nook::Context& context);
  void measure_mean();

  std::string name_;
  std::vector<nook_lobe> lobes_;
  std::vector<float> rgb_;  // the environment
  std::uint32_t width_ = 0, height_ = 0;
  float mean_radiance_ = 0;
  bool has_sun_ = false;  // the last lobe is a sun
};

}  // namespace crowd
