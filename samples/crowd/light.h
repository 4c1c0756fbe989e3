// The light of a comparison: lobes of a probe, and the environment that they stand for.
#pragma once

#include <nook/nook_bake.h>
#include <nook/nook_probe.h>

#include <filesystem>
#include <memory>
#include <nook/nook.hpp>
#include <string>
#include <vector>

namespace crowd {

class Light {
 public:
  // A probe's file, whose lobes are then the environment too, or a latitude-longitude map, to which 12 lobes
  // are fitted. Throws std::runtime_error and nook::Error.
  Light(const nook::Context& context, const std::filesystem::path& path);

  // A clear sky with a low, hazy sun over warm ground, to which 12 lobes are fitted.
  static Light built_in_sky(const nook::Context& context);

  const std::string& name() const { return name_; }
  const std::vector<nook_probe_lobe>& lobes() const { return lobes_; }
  nook_bake_environment environment() const { return {rgb_.data(), width_, height_}; }
  // Mean over the sphere and the channels: what a constant light of the same power has.
  float mean_radiance() const { return mean_radiance_; }

  // What the lobes send to surfaces with these unit normals, three floats each.
  std::vector<float> irradiance(const std::vector<float>& normals) const;
  // What they send from a unit direction: RGB, not below 0.
  std::vector<float> radiance(const float direction[3]) const;

 private:
  explicit Light(std::string name) : name_(std::move(name)) {}
  void read_probe(const nook::Context& context, const std::filesystem::path& path);
  void read_map(const std::filesystem::path& path);
  // 12 lobes to the map.
  void fit_lobes(const nook::Context& context);
  void measure_mean();

  std::string name_;
  std::vector<nook_probe_lobe> lobes_;
  std::vector<float> rgb_;
  std::uint32_t width_ = 0, height_ = 0;
  float mean_radiance_ = 0;
};

}  // namespace crowd
