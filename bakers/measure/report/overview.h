// The page about all baked files of a folder: what failed, what looks worst, and what changed since the last
// page. The page holds its rows as JSON, which its script shows in pieces and which the next page compares.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nook::report {

// In the order of the page. Bad begins at twice the limit of poor.
enum class AssetState : std::uint8_t { failed, broken, bad, poor, good, unmeasured, gone };
enum class AssetChange : std::uint8_t { none, fresh, worse, better, other_key, gone };
inline constexpr std::size_t asset_state_count = 7, asset_change_count = 6;

// Names for people.
const char* state_name(AssetState state);
const char* change_name(AssetChange change);

inline constexpr double bad_over_limit = 2;

// A baked file, or a bake that left none. Texts may come from files: the page escapes them.
struct Asset {
  std::string name;  // its path in the folder, without the extension
  std::string kind;  // empty: unknown
  AssetState state = AssetState::unmeasured;
  std::optional<double> over_limit;  // the visible error over the limit of its kind
  std::string figure;                // the visible error in words
  std::string notes;                 // why it failed, and what else to know
  std::uint64_t bytes = 0;
  std::optional<double> seconds;  // of the bake
  std::string key;                // of the bake; empty: none
  bool has_page = false;          // NAME.html exists
  std::string log;                // its path in the folder; empty: none
  bool is_linkable = true;        // the name is the exact path
  bool can_have_page = false;     // `nook report` has pictures for it
  std::string source;             // what that command needs; empty: nothing, "?": unknown
  AssetChange change = AssetChange::none;
  std::string before;  // what the last page said, if that is of interest
};

// How a kind is judged, for the reader.
struct LimitRow {
  std::string kind, figure, limit;
};

struct Overview {
  std::string folder;  // the title of the page
  std::string links;   // the encoded way from the page to the folder, with a slash; empty: without links
  std::string made;    // the time
  std::string before;  // the time of the page that it is compared with; empty: none
  std::vector<LimitRow> limits;
  std::vector<Asset> assets;  // in the order of the page
};

std::string overview_page(const Overview& overview);

// What a page holds for the next one.
struct LastPage {
  std::string made;
  std::vector<Asset> assets;
};

// Returns nothing for text that is not such a page.
std::optional<LastPage> read_overview_page(std::string_view page);

// Sets the changes of `assets` since the last page, and appends the assets that are gone.
void mark_changes(std::vector<Asset>& assets, const LastPage& last);

// By state, then by the visible error, then by name.
void sort_worst_first(std::vector<Asset>& assets);

}  // namespace nook::report
