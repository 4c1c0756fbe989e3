#include "bakers/measure/report/page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bakers/measure/report/html.h"
#include "sdk/src/core/version.h"

namespace nook::report {
namespace {

using Json = nlohmann::ordered_json;

Html value_of(const Json& value) {
  if (value.is_string()) return text(value.get<std::string>());
  if (value.is_number_float()) return number(value.get<double>());
  return text(value.dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::string words(std::string key) {
  std::ranges::replace(key, '_', ' ');
  return key;
}

bool counts_bytes(const std::string& key) {
  return key.starts_with("bytes") || key.ends_with("_bytes");
}

// Shows the first entries. The reader must click to unfold the sizes of sections and the settings of the
// bake.
Html facts_table(const Json& facts) {
  constexpr std::size_t open_rows = 12;
  const std::vector<Html> head{Html("what"), Html("value")};
  std::vector<std::vector<Html>> first{head}, others{head};
  for (const auto& item : facts.items()) {
    if (item.value().is_null()) continue;
    const bool is_size = counts_bytes(item.key()) && item.value().is_number();
    (first.size() <= open_rows ? first : others)
        .push_back({text(words(item.key())),
                    is_size ? byte_count(item.value().get<double>()) : value_of(item.value())});
  }
  if (others.size() == 1) return table(first);
  return table(first) + Html("<details><summary>All sizes and settings</summary>\n") + table(others) +
         Html("</details>\n");
}

Html or_not_stated(const std::string& said) {
  return said.empty() ? Html("not stated") : text(said);
}

Html licence_list(const PageSource& source) {
  Html items;
  for (const ShownFile& file : source.shown) {
    const bake::AssetNotes& notes = file.notes;
    Html item = Html("<strong>") + text(file.name) + Html("</strong>: copyright: ") +
                or_not_stated(notes.copyright) + Html("; licence: ") + or_not_stated(notes.licence);
    if (!notes.title.empty()) item += Html("; title: ") + text(notes.title);
    if (!notes.author.empty()) item += Html("; author: ") + text(notes.author);
    if (!notes.source.empty()) item += Html("; source: ") + text(notes.source);
    if (!notes.generator.empty()) item += Html("; written by ") + text(notes.generator);
    items += element("li", item);
  }
  Html list = items.empty() ? Html("<p>No model is shown.</p>\n") : element("ul", items);
  if (!source.licence.empty())
    list += element("p", Html("Licence note for all of them, given with --licence: ") + text(source.licence));
  return list;
}

}  // namespace

std::string page_of(const PageSource& source, const PageParts& parts) {
  const std::string version = version_text;
  return fill("page.html",
              {{"title", text(source.title)},
               {"kind", Html("Nook report: ") + value_of(source.facts.value("kind", Json("file")))},
               {"style", fill("style.css", {})},
               {"lead", parts.lead},
               {"advice", parts.advice},
               {"sections", parts.sections},
               {"facts", facts_table(source.facts)},
               {"licences", licence_list(source)},
               {"version", text(version)},
               {"scripts", parts.scripts}})
      .code();
}

Html error_scale(double end, Markup unit) {
  constexpr int stops = 16, ticks = 5;
  Html ramp;
  for (int i = 0; i <= stops; ++i) {
    const bake::Colour c = bake::viridis(float(i) / stops);
    char shown[40];
    std::snprintf(shown, sizeof shown, "%srgb(%ld,%ld,%ld)", i > 0 ? "," : "",
                  std::lround(255 * std::clamp(c[0], 0.0f, 1.0f)),
                  std::lround(255 * std::clamp(c[1], 0.0f, 1.0f)),
                  std::lround(255 * std::clamp(c[2], 0.0f, 1.0f)));
    ramp += text(shown);
  }
  Html labels;
  for (int i = 0; i <= ticks; ++i) {
    labels += Html("<span>") + number(end * i / ticks) + (i == ticks ? Html(" and more") : Html()) +
              Html("</span>");
  }
  return Html(
             "<div class=\"scale\" role=\"img\" aria-label=\"Colours of the error: dark violet is 0, green "
             "is half of ") +
         number(end) + Html(", yellow is ") + number(end) +
         Html(" and more\"><span class=\"ramp\" style=\"background:linear-gradient(90deg,") + ramp +
         Html(")\"></span><span class=\"ticks\">") + labels + Html("</span><small>") + Html(unit) +
         Html(
             "; the colours are the viridis map, which grows evenly lighter, so that colour-blind readers "
             "can tell the values apart</small></div>\n");
}

Html share_bar(double share) {
  char width[40];
  std::snprintf(width, sizeof width, "%.1f", 100 * std::clamp(share, 0.0, 1.0));
  return Html("<span class=\"bar\" aria-hidden=\"true\"><span style=\"width:") + text(width) +
         Html("%\"></span></span>") + percent(share);
}

}  // namespace nook::report
