#include "bakers/measure/report/template.h"

#include <algorithm>

#include "sdk/src/core/failure.h"

namespace nook::report {
namespace {

std::string_view template_text(std::string_view name) {
  const auto* const found =
      std::find_if(templates_begin(), templates_end(), [&](const Template& t) { return t.name == name; });
  if (found == templates_end())
    throw Failure(NOOK_ERROR_INTERNAL, "the page has no template %.*s", int(name.size()), name.data());
  return found->text;
}

}  // namespace

// Puts values between pieces of a template, which is markup of this program.
class HtmlFill {
 public:
  void append(std::string_view markup) { html_.code_ += markup; }
  void append(const Html& value) { html_ += value; }
  Html take() { return std::move(html_); }

 private:
  Html html_;
};

Html fill(std::string_view template_name, const std::vector<std::pair<std::string_view, Html>>& values) {
  std::string_view rest = template_text(template_name);
  HtmlFill page;
  for (std::size_t open; (open = rest.find("{{")) != std::string_view::npos;) {
    const std::size_t close = rest.find("}}", open);
    const std::string_view name =
        rest.substr(open + 2, close == std::string_view::npos ? close : close - open - 2);
    const auto value = std::ranges::find(values, name, &std::pair<std::string_view, Html>::first);
    if (close == std::string_view::npos || value == values.end())
      throw Failure(NOOK_ERROR_INTERNAL, "the template %.*s names %.*s, which has no value",
                    int(template_name.size()), template_name.data(), int(name.size()), name.data());
    page.append(rest.substr(0, open));
    page.append(value->second);
    rest.remove_prefix(close + 2);
  }
  page.append(rest);
  return page.take();
}

}  // namespace nook::report
