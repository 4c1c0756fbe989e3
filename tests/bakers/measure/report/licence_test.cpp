#include <filesystem>
#include <fstream>

#include "bakers/measure/report/page.h"
#include "tests/catch.h"

using namespace nook;

namespace {

bake::AssetNotes notes_of(const std::string& asset) {
  const auto path = std::filesystem::temp_directory_path() / "nook_licence_test.gltf";
  std::ofstream(path) << "{\"asset\": {\"version\": \"2.0\"" << asset << "}}";
  const bake::AssetNotes notes = bake::read_asset_notes(path);
  std::filesystem::remove(path);
  return notes;
}

}  // namespace

TEST_CASE("licences are those that a file states, and none is made up") {
  const bake::AssetNotes full = notes_of(
      R"(, "copyright": "2020 A", "generator": "G", "extras": {"license": "CC-BY-4.0", "author": "<B>", "source": 7})");
  CHECK(full.copyright == "2020 A");
  CHECK(full.licence == "CC-BY-4.0");
  CHECK(full.author == "<B>");
  CHECK(full.source.empty());  // no text
  const bake::AssetNotes empty = notes_of(R"(, "extras": [1, 2])");
  CHECK(empty.copyright.empty());
  CHECK(empty.licence.empty());

  report::PageSource source{
      "hero.nook", {{"kind", "character model"}}, {{"a.glb", full}, {"b.glb", empty}}, ""};
  const std::string page = report::page_of(source, {});
  CHECK(page.find("2020 A; licence: CC-BY-4.0; author: &lt;B&gt;") != std::string::npos);
  CHECK(page.find("copyright: not stated; licence: not stated") != std::string::npos);
  CHECK(page.find("Licence note for all of them") == std::string::npos);
  source.licence = "CC0";
  CHECK(report::page_of(source, {}).find("Licence note for all of them, given with --licence: CC0") !=
        std::string::npos);
}
