// The page about all baked files of a folder: what failed, what looks worst, and what changed since the last
// page. The page stores its rows as JSON. Its script shows the rows in pieces. When the next page is made, it
// is compared with the stored rows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nook::report {

// The states are in the order in which the page lists them. An asset is `bad` if its error is above twice the
// limit of `poor`.
enum class AssetState : std::uint8_t { failed, broken, bad, poor, good, unmeasured, gone };
enum class AssetChange : std::uint8_t { none, fresh, worse, better, other_key, gone };
inline constexpr std::size_t asset_state_count = 7, asset_change_count = 6;

// Returns the state's name as the page shows it.
const char* state_name(AssetState state);
const char* change_name(AssetChange change);

inline constexpr double bad_over_limit = 2;

// A baked file, or a bake that left no file. Texts may come from files. The page escapes them.
struct Asset {
  std::string name;  // its path in the folder, without the extension
  std::string kind;  // empty: unknown
  AssetState state = AssetState::unmeasured;
  std::optional<double> over_limit;  // the visible error divided by the limit for its kind
  std::string figure;                // the visible error in words
  std::string notes;                 // the reason why the bake failed, and other remarks
  std::uint64_t bytes = 0;
  std::optional<double> seconds;  // duration of the bake
  std::string key;                // key of the bake; empty: none
  bool has_page = false;          // NAME.html exists
  std::string log;                // its path in the folder; empty: none
  bool is_linkable = true;        // the name is the exact path
  bool can_have_page = false;     // `nook report` has pictures for it
  std::string source;             // the source file that `nook report` needs; empty: none, "?": unknown
  AssetChange change = AssetChange::none;
  std::string before;  // what the last page said about the asset; empty if this is not shown
};

// A row of the table that tells the reader how files of one kind are judged.
struct LimitRow {
  std::string kind, figure, limit;
};

struct Overview {
  std::string folder;  // the title of the page
  std::string links;   // the URL-encoded path from the page to the folder, with a slash at the end; empty: no
                       // links
  std::string made;    // the time at which the page was made
  std::string before;  // the time of the earlier page that this one is compared with; empty: none
  std::vector<LimitRow> limits;
  std::vector<Asset> assets;  // in the order of the page
};

std::string overview_page(const Overview& overview);

// The data that a page stores, so that the next page can be compared with it.
struct LastPage {
  std::string made;
  std::vector<Asset> assets;
};

// Returns nothing if `page` is not an overview page.
std::optional<LastPage> read_overview_page(std::string_view page);

// Sets the changes of `assets` since the last page, and appends the assets that are gone.
void mark_changes(std::vector<Asset>& assets, const LastPage& last);

// Sorts the assets by state, then by visible error, then by name.
void sort_worst_first(std::vector<Asset>& assets);

}  // namespace nook::report
