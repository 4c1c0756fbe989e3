// Builds the page of a .nook file of any kind. The page has advice, the sections for the file's kind, sizes
// and settings, and licences.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bakers/import/asset_notes.h"
#include "bakers/measure/report/html.h"

namespace nook::report {

// A file that the page shows, and the licence text in the file.
struct ShownFile {
  std::string name;
  bake::AssetNotes notes;
};

struct PageSource {
  std::string title;             // the name of the .nook file
  nlohmann::ordered_json facts;  // one row of `nook inspect`
  std::vector<ShownFile> shown;
  std::string licence;  // the user's licence text for all files; may be empty
};

// The part of a page that depends on the kind of its file.
struct PageParts {
  Html lead;      // the result in one or two sentences
  Html advice;    // made by advice_list
  Html sections;  // a sequence of section elements
  Html scripts;   // may be empty
};

std::string page_of(const PageSource& source, const PageParts& parts);

// Returns the colour scale for errors from 0 to `end`. `unit` is the unit of the ticks.
Html error_scale(double end, Markup unit);
// Shows a share of a whole as a bar with its number.
Html share_bar(double share);

}  // namespace nook::report
