#include "bakers/import/asset_notes.h"

#include "bakers/import/file_reader.h"
#include "bakers/import/gltf_document.h"

namespace nook::bake {
namespace {

std::string entry(const tinygltf::Value& extras, const char* name) {
  if (!extras.IsObject() || !extras.Has(name) || !extras.Get(name).IsString()) return {};
  return extras.Get(name).Get<std::string>();
}

}  // namespace

AssetNotes read_asset_notes(const std::filesystem::path& path, LinkedFiles linked) {
  const tinygltf::Model model =
      parse_gltf(read_file_bytes(path), {std::filesystem::absolute(path).parent_path().string(), linked});
  const tinygltf::Value& extras = model.asset.extras;
  AssetNotes notes;
  notes.copyright = model.asset.copyright;
  notes.generator = model.asset.generator;
  notes.title = entry(extras, "title");
  notes.author = entry(extras, "author");
  notes.licence = entry(extras, "license");
  if (notes.licence.empty()) notes.licence = entry(extras, "licence");
  notes.source = entry(extras, "source");
  return notes;
}

}  // namespace nook::bake
