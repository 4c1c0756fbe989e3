// Panels that show one group of the crowd with several kinds of ambient occlusion, through the same camera.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "samples/crowd/frames.h"
#include "samples/crowd/truth.h"

namespace crowd {

// The group that the sheets look at, with its poses of the first frame.
struct Group {
  std::vector<std::uint32_t> members;  // indices of the crowd
  Camera camera;
};

// The members nearest to the busiest place, seen from where the fewest others stand in the way.
Group choose_group(const std::vector<Placement>& places, std::size_t count);

// A square that holds all floor within margin_m of the members' bodies, a point every side-th part.
FloorPatch floor_under(const Group& group, const std::vector<Placement>& places, float margin_m,
                       std::uint32_t side);

// A floor whose irradiance is known, three floats a point, and how bright the picture is.
struct LitFloor {
  FloorPatch patch;
  std::vector<float> irradiance;
  float exposure = 1;
};

class SheetPainter {
 public:
  SheetPainter(const Stage& stage, const std::vector<Bones>& poses, Group group)
      : stage_(stage), poses_(poses), group_(std::move(group)) {}

  const Group& group() const { return group_; }
  // One value a vertex and member; empty: fully open.
  void add(const std::string& label, const std::vector<std::vector<float>>& ao);
  // From Nook's own buffers, as a host draws it.
  void add(const std::string& label, const CrowdScene& scene);
  // The same with the stage's screen-space AO where no character is.
  void add_with_screen_space(const std::string& label, const CrowdScene& scene);
  // The stage's screen-space AO alone, on characters as well.
  void add_screen_space_alone(const std::string& label);
  // One value a vertex and member, one a point of the floor.
  void add(const std::string& label, const std::vector<std::vector<float>>& ao, const FloorPatch& patch,
           const std::vector<float>& floor_ao);
  // Irradiance alone: three floats a vertex and member, and the floor's.
  void add_lit(const std::string& label, const std::vector<std::vector<float>>& irradiance,
               const LitFloor& floor);
  void write(const std::filesystem::path& path, int columns) const;

 private:
  enum class ScreenSpace { kOff, kBesideCharacters, kAlone };
  std::vector<AoSource> sources_of(const CrowdScene& scene) const;
  // Values of all members in one buffer, which the caller deletes.
  GLuint upload(const std::vector<std::vector<float>>& values, std::uint32_t channels,
                std::vector<AoSource>& sources) const;
  FloorAo upload(const FloorPatch& patch, const std::vector<float>& values, std::uint32_t channels) const;
  void add_panel(const std::string& label, std::span<const AoSource> sources, ScreenSpace screen_space);

  FloorAo floor_;

  const Stage& stage_;
  const std::vector<Bones>& poses_;
  Group group_;
  std::vector<platform::Image> panels_;
};

}  // namespace crowd
