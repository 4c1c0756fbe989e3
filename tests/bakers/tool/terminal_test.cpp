// The output of the tool cannot steer a terminal, whatever names its files and arguments hold.
#include <nlohmann/json.hpp>

#include "tests/bakers/tool/glb_tube.h"
#include "tests/bakers/tool/rgbe_map.h"
#include "tests/bakers/tool/tool_run.h"
#include "tests/catch.h"

namespace {

using Names = std::vector<std::string>;

// Retitles a window, colours by a C1 byte and by a C1 character, moves the cursor, is not UTF-8, and reverses
// the direction of writing.
const std::string hostile =
    "a\x1b]0;title\x07 \x9b 31m \xc2\x9b"
    "31m \rb\bc\x7f \xff \xe2\x80\xae";

bool is_control(const std::string& text, std::size_t i) {
  const auto c = static_cast<unsigned char>(text[i]);
  if (c < 0x20 || c == 0x7f) return c != '\n';
  if (c == 0xc2) return i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xa0;
  return c == 0xff || c == 0x9b || text.compare(i, 3, "\xe2\x80\xae") == 0;
}

void check_clean(const ToolRun& run) {
  const std::string text = run.out + run.error;
  INFO(text);
  for (std::size_t i = 0; i < text.size(); ++i)
    if (is_control(text, i)) {
      // The byte of a valid character is none of these.
      const bool continues = i > 0 && static_cast<unsigned char>(text[i]) == 0x9b &&
                             static_cast<unsigned char>(text[i - 1]) >= 0x80;
      CHECK(continues);
    }
}

Names small_bake(const std::string& in, const std::string& out) {
  return {"bake", "character",          in,  "-o",     out, "--preset", "draft", "--auto-poses",
          "4",    "--samples-per-clip", "2", "--rays", "2", "--steps",  "2",     "--spheres",
          "2",    "--key-points",       "4"};
}

}  // namespace

TEST_CASE("names of files and arguments are cleaned before they are printed") {
  const TestFolder folder;
  const std::string missing = folder.path(hostile);
  check_clean(folder.run({"inspect", missing}));
  check_clean(folder.run({"bake", "character", missing, "-o", folder.path("m.nook")}));
  check_clean(folder.run({"bake", hostile}));
  check_clean(folder.run({"bake", "character", "x", "-o", "y", "--preset", hostile}));
  check_clean(
      folder.run({"bake", "material", "--meso", "weave", "-o", folder.path("w"), "--ranks", hostile}));
  check_clean(folder.run({"evaluate", "nnao", "--frame", missing}));
  write_text(folder.path(hostile + ".hdr"), rgbe_map(16, 8));
  const ToolRun probe =
      folder.run({"bake", "probe", folder.path(hostile + ".hdr"), "-o", folder.path("p.nook")});
  CHECK(probe.exit_code == 0);
  check_clean(probe);
  check_clean(folder.run({"inspect", folder.path("p.nook")}));  // its recipe names the map
  check_clean(folder.run({"evaluate", "probe", folder.path(hostile + ".hdr"), "--seeds", "1"}));
}

TEST_CASE("names inside of files are cleaned before they are printed") {
  const TestFolder folder;
  // JSON text is UTF-8, so a glTF file holds the hostile characters that are valid.
  const std::string clip =
      "a\x1b]0;title\x07 \xc2\x9b"
      "31m \rb\x7f \xe2\x80\xae";
  write_text(folder.path("hero.glb"), glb_tube({clip, "bend"}));
  const ToolRun bake = folder.run(small_bake(folder.path("hero.glb"), folder.path("hero.nook")));
  INFO(bake.error);
  CHECK(bake.exit_code == 0);
  check_clean(bake);
  check_clean(folder.run({"inspect", folder.path("hero.nook")}));
  Names unknown = small_bake(folder.path("hero.glb"), folder.path("other.nook"));
  unknown.insert(unknown.end(), {"--clips", "none"});
  const ToolRun listing = folder.run(unknown);
  CHECK(listing.exit_code == 2);
  CHECK(listing.error.find("\\x1b]0;title\\x07") != std::string::npos);  // visible, so that it can be found
  check_clean(listing);
  check_clean(folder.run({"evaluate", "character", folder.path("hero.glb"), folder.path("hero.nook"),
                          "--rays", "2", "--samples-per-clip", "2"}));
}

TEST_CASE("letters of all scripts are printed as they are") {
  const TestFolder folder;
  const ToolRun run = folder.run({"inspect", folder.path("größe 体 \xf0\x9f\x92\xa1.nook")});
  CHECK(run.exit_code == 3);
  CHECK(run.error.find("größe 体 \xf0\x9f\x92\xa1.nook") != std::string::npos);
}
