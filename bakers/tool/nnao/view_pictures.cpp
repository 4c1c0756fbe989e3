#include "bakers/tool/nnao/view_pictures.h"

#include <vector>

#include "bakers/measure/nnao/network_picture.h"
#include "bakers/measure/nnao/sheet.h"

namespace nook::tool {

using namespace measure;

namespace {

// The columns of a picture after the scene and the truth.
struct Shown {
  const char* suffix;
  std::vector<std::pair<std::string, int>> methods;
};
const Shown sheets[] = {
    {"", {{"nnao", 9}, {"xegtao", 18}, {"gtao_bitmask", 16}, {"hbao", 64}}},
    {"_presets", {{half_name, 9}, {"nnao", 9}, {"nnao", 32}, {"gtao", 16}}},
    {"_shipped", {{"n8ao_shipped", 16}, {"s4ao_shipped", 12}, {"vtk_shipped", 32}, {"filament_shipped", 7}}}};

// The names of the views' pictures: SCENE_CAMERA, or SCENE_NUMBER without the camera's name.
std::vector<std::string> picture_names(std::span<const MeasuredView> views) {
  std::vector<std::string> names;
  std::size_t number = 0;
  for (std::size_t v = 0; v < views.size(); ++v) {
    number = v > 0 && views[v].scene == views[v - 1].scene ? number + 1 : 0;
    std::string name = views[v].scene;
    name += '_';
    name += views[v].camera.empty() ? std::to_string(number) : views[v].camera;
    names.push_back(name);
  }
  return names;
}

void write_pictures_of(const std::filesystem::path& folder, const std::string& prefix,
                       const nook::nnao::Network& network, std::span<const MeasuredView> views,
                       std::span<const std::string> names) {
  platform::write_image(folder / (prefix + "_filters.png"), filter_picture(network));
  for (std::size_t v = 0; v < views.size(); ++v)
    platform::write_image(folder / (names[v] + "_" + prefix + "_units.png"), unit_picture(network, views[v]));
}

}  // namespace

bool is_shown(const std::string& method, int taps) {
  for (const Shown& sheet : sheets)
    for (const auto& [shown_method, shown_taps] : sheet.methods)
      if (method == shown_method && taps == shown_taps) return true;
  return false;
}

void write_sheets(const std::filesystem::path& folder, std::span<const MeasuredView> views,
                  std::span<const KeptImage> images) {
  const std::vector<std::string> names = picture_names(views);
  for (const Shown& sheet : sheets)
    for (std::size_t v = 0; v < views.size(); ++v) {
      std::vector<std::vector<float>> row;
      for (const auto& [method, taps] : sheet.methods)
        for (const KeptImage& image : images)
          if (image.view == v && image.method == method && image.taps == taps) row.push_back(image.ao);
      platform::write_image(folder / (names[v] + sheet.suffix + ".png"), make_sheet(views[v], row));
    }
}

void write_network_pictures(const std::filesystem::path& folder, const Networks& networks,
                            std::span<const MeasuredView> views) {
  const std::vector<std::string> names = picture_names(views);
  write_pictures_of(folder, "nnao", networks.embedded, views, names);
  if (!networks.file.empty()) write_pictures_of(folder, "other", networks.other, views, names);
}

}  // namespace nook::tool
