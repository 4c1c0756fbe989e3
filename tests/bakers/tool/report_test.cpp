#include <nlohmann/json.hpp>

#include "tests/bakers/tool/glb_tube.h"
#include "tests/bakers/tool/rgbe_map.h"
#include "tests/bakers/tool/tool_run.h"
#include "tests/catch.h"
#include "tests/transfer/shapes.h"

namespace {

const std::string hostile = "<script>alert(\"1\")</script>&'</title>";

void bake_tube(const TestFolder& folder, const std::vector<std::string>& clips) {
  write_text(folder.path("hero.glb"), glb_tube(clips));
  const ToolRun run = folder.run({"bake",
                                  "character",
                                  folder.path("hero.glb"),
                                  "-o",
                                  folder.path("hero.nook"),
                                  "--preset",
                                  "draft",
                                  "--auto-poses",
                                  "20",
                                  "--rays",
                                  "4",
                                  "--steps",
                                  "20",
                                  "--spheres",
                                  "6",
                                  "--key-points",
                                  "20",
                                  "--poses",
                                  "auto",
                                  "--quiet"});
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
}

std::size_t count_of(const std::string& text, const std::string& piece) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(piece, at)) != std::string::npos; at += piece.size()) ++count;
  return count;
}

// Loads nothing, and each element that is opened is closed.
void check_page(const std::string& page) {
  CHECK(page.rfind("<!doctype html>", 0) == 0);
  CHECK(page.size() < 10'000'000);
  for (const char* load : {"http://", "https://", "src=\"//", "url(", "@import", "{{"}) {
    INFO(load);
    CHECK(page.find(load) == std::string::npos);
  }
  for (const char* tag :
       {"html", "body", "main", "section", "table", "tr",     "td",    "th",  "figure", "figcaption",
        "ul",   "li",   "p",    "h2",      "h3",    "script", "style", "div", "span",   "details"}) {
    INFO(tag);
    const std::string name = tag;
    CHECK(count_of(page, "<" + name + ">") + count_of(page, "<" + name + " ") ==
          count_of(page, "</" + name + ">"));
  }
  CHECK(count_of(page, "<img ") == count_of(page, "alt=\""));
  CHECK(page.find("alt=\"\"") == std::string::npos);
}

}  // namespace

TEST_CASE("the page of a character holds its pictures, its view and its advice") {
  const TestFolder folder;
  bake_tube(folder, {"bend", "bow", "curl"});
  const ToolRun run =
      folder.run({"report", folder.path("hero.nook"), folder.path("hero.glb"), "-o", folder.path("page.html"),
                  "--rays", "8", "--licence", "CC0", "--report", folder.path("r.json"), "--quiet"});
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  const std::string page = read_text(folder.path("page.html"));
  check_page(page);
  // Eight sides, three clips, and up to four places.
  CHECK(count_of(page, "<img ") >= 12);
  for (const char* words :
       {"turn-data", "draft bake", "used none of the file", "not stated", "CC0", "viridis", "curl"}) {
    INFO(words);
    CHECK(page.find(words) != std::string::npos);
  }
  const auto row = nlohmann::json::parse(read_text(folder.path("r.json"))).at("rows").at(0);
  CHECK(row.at("page_bytes") == page.size());
}

TEST_CASE("names from files add no markup and no code to a page") {
  const TestFolder folder;
  bake_tube(folder, {hostile, "bow", "curl"});
  const ToolRun run = folder.run({"report", folder.path("hero.nook"), folder.path("hero.glb"), "-o",
                                  folder.path("page.html"), "--rays", "8", "--licence", hostile, "--quiet"});
  REQUIRE(run.exit_code == 0);
  const std::string page = read_text(folder.path("page.html"));
  check_page(page);
  CHECK(page.find("alert(\"1\")") == std::string::npos);
  CHECK(page.find("<script>alert") == std::string::npos);
  CHECK(page.find("&lt;script&gt;alert(&quot;1&quot;)&lt;/script&gt;&amp;&#39;") != std::string::npos);
  // In the view's data, where entities are not characters.
  CHECK(page.find("\\u003cscript\\u003ealert") != std::string::npos);
  CHECK(count_of(page, "</title>") == 1);
}

TEST_CASE("one seed gives the same page on any number of threads") {
  const TestFolder folder;
  bake_tube(folder, {"bend", "bow", "curl"});
  for (const char* threads : {"1", "3"})
    REQUIRE(folder
                .run({"report", folder.path("hero.nook"), folder.path("hero.glb"), "-o",
                      folder.path(std::string(threads) + ".html"), "--rays", "8", "--threads", threads,
                      "--quiet"})
                .exit_code == 0);
  CHECK(read_text(folder.path("1.html")) == read_text(folder.path("3.html")));
}

TEST_CASE("a page refuses sources that it cannot use") {
  const TestFolder folder;
  bake_tube(folder, {"bend"});
  const auto exit_code = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "report");
    return folder.run(arguments).exit_code;
  };
  const std::string model = folder.path("hero.nook"), shape = folder.path("hero.glb"),
                    page = folder.path("page.html");
  CHECK(exit_code({model, "-o", page}) == 2);
  CHECK(exit_code({model, shape, shape, "-o", page}) == 2);
  CHECK(exit_code({model, folder.path("sky.hdr"), "-o", page}) == 2);
  CHECK(exit_code({model, folder.path("notes.txt"), "-o", page}) == 2);
  CHECK(exit_code({model, shape, "-o", model}) == 2);
  CHECK(exit_code({folder.path("none.nook"), shape, "-o", page}) == 3);
  write_text(folder.path("cut.nook"), read_text(model).substr(0, 1000));
  CHECK(exit_code({folder.path("cut.nook"), shape, "-o", page}) == 3);
  write_text(folder.path("other.glb"), glb_tube({"bend"}, false));
  CHECK(exit_code({model, folder.path("other.glb"), "-o", page}) == 3);
  CHECK(folder.names() == std::vector<std::string>{"cut.nook", "hero.glb", "hero.nook", "other.glb"});
}

TEST_CASE("pages of probes, materials and transfer") {
  const TestFolder folder;
  write_text(folder.path("sky.hdr"), rgbe_map(64, 32));
  REQUIRE(folder.run({"bake", "probe", folder.path("sky.hdr"), "-o", folder.path("sky.nook"), "--quiet"})
              .exit_code == 0);
  const ToolRun probe = folder.run(
      {"report", folder.path("sky.nook"), folder.path("sky.hdr"), "-o", folder.path("sky.html"), "--quiet"});
  INFO(probe.error);
  REQUIRE(probe.exit_code == 0);
  check_page(read_text(folder.path("sky.html")));
  CHECK(read_text(folder.path("sky.html")).find("irradiance_relative") != std::string::npos);

  REQUIRE(folder
              .run({"bake",          "material", "--meso",       "fiber", "-o",         folder.path("m.nook"),
                    "--texels",      "12",       "--directions", "12",    "--detail",   "0.3",
                    "--bounce-rays", "8",        "--view-map",   "16",    "--ranks",    "8,8,8,8",
                    "--votf-ranks",  "8,8",      "--mixture",    "2",     "--keep-raw", folder.path("m.raw"),
                    "--quiet"})
              .exit_code == 0);
  for (const bool is_compared : {false, true}) {
    std::vector<std::string> arguments{"report", folder.path("m.nook"), "-o", folder.path("m.html"),
                                       "--quiet"};
    if (is_compared) arguments.push_back(folder.path("m.raw"));
    const ToolRun material = folder.run(arguments);
    INFO(material.error);
    REQUIRE(material.exit_code == 0);
    check_page(read_text(folder.path("m.html")));
    CHECK((read_text(folder.path("m.html")).find("Beside the raw material") != std::string::npos) ==
          is_compared);
  }

  namespace shapes = nook::transfer::test;
  shapes::Shape shape = shapes::plane(1, 8, 2);
  shapes::append(shape, shapes::ball({0, 0.25f, 0}, 0.2f, 24));
  const std::vector<std::byte> bytes = shapes::glb_of(shape);
  write_text(folder.path("ball.glb"), {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  REQUIRE(folder
              .run({"bake", "transfer", folder.path("ball.glb"), "-o", folder.path("ball.nook"), "--lobes",
                    "162", "--quiet"})
              .exit_code == 0);
  const ToolRun transfer = folder.run({"report", folder.path("ball.nook"), folder.path("ball.glb"), "-o",
                                       folder.path("ball.html"), "--quiet"});
  INFO(transfer.error);
  REQUIRE(transfer.exit_code == 0);
  check_page(read_text(folder.path("ball.html")));
  CHECK(read_text(folder.path("ball.html")).find("--bounces 2") != std::string::npos);
}
