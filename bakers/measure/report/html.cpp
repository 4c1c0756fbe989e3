#include "bakers/measure/report/html.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "platform/printable.h"
#include "sdk/src/core/failure.h"

namespace nook::report {
namespace {

std::string_view template_text(std::string_view name) {
  const auto* const found =
      std::find_if(templates_begin(), templates_end(), [&](const Template& t) { return t.name == name; });
  if (found == templates_end())
    throw Failure(NOOK_ERROR_INTERNAL, "the page does not contain the template %.*s", int(name.size()),
                  name.data());
  return found->text;
}

}  // namespace

Html Html::escaped(std::string_view plain) {
  Html html;
  for (const char c : platform::printable(plain)) switch (c) {
      case '&':
        html.code_ += "&amp;";
        break;
      case '<':
        html.code_ += "&lt;";
        break;
      case '>':
        html.code_ += "&gt;";
        break;
      case '"':
        html.code_ += "&quot;";
        break;
      case '\'':
        html.code_ += "&#39;";
        break;
      default:
        html.code_ += c;
    }
  return html;
}

Html text(std::string_view plain) {
  return Html::escaped(plain);
}

Html number(double value) {
  if (!std::isfinite(value)) return Html("–");
  char shown[40];
  const double size = std::fabs(value);
  if (size >= 1000)
    std::snprintf(shown, sizeof shown, "%.0f", value);
  else
    std::snprintf(shown, sizeof shown, size > 0 && size < 1e-3 ? "%.2e" : "%.3g", value);
  return text(shown);
}

Html percent(double share) {
  if (!std::isfinite(share)) return Html("–");
  char shown[40];
  std::snprintf(shown, sizeof shown, "%.*f", share < 0.095 ? 1 : 0, 100 * share);
  return text(shown) + Html("&nbsp;%");
}

Html byte_count(double bytes) {
  if (bytes < 1e3) return number(bytes) + Html("&nbsp;bytes");
  if (bytes < 1e6) return number(bytes / 1e3) + Html("&nbsp;kB");
  return number(bytes / 1e6) + Html("&nbsp;MB");
}

std::string base64(const void* bytes, std::size_t size) {
  static constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto* in = static_cast<const unsigned char*>(bytes);
  std::string out;
  out.reserve((size + 2) / 3 * 4);
  for (std::size_t i = 0; i < size; i += 3) {
    std::uint32_t word = std::uint32_t(in[i]) << 16;
    if (i + 1 < size) word |= std::uint32_t(in[i + 1]) << 8;
    if (i + 2 < size) word |= in[i + 2];
    out += letters[word >> 18];
    out += letters[word >> 12 & 63];
    out += i + 1 < size ? letters[word >> 6 & 63] : '=';
    out += i + 2 < size ? letters[word & 63] : '=';
  }
  return out;
}

Html element(Markup tag, const Html& inside) {
  return Html("<") + Html(tag) + Html(">") + inside + Html("</") + Html(tag) + Html(">\n");
}

Html script_data(const nlohmann::ordered_json& data) {
  Html html;
  for (const char c : data.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace)) switch (c) {
      case '<':
        html.code_ += "\\u003c";
        break;
      case '>':
        html.code_ += "\\u003e";
        break;
      case '&':
        html.code_ += "\\u0026";
        break;
      default:
        html.code_ += c;
    }
  return html;
}

Html table(const std::vector<std::vector<Html>>& rows) {
  Html inside;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    Html row;
    for (const Html& cell : rows[r]) row += r == 0 ? element("th", cell) : element("td", cell);
    inside += element("tr", row);
  }
  return Html("<div class=\"wide\"><table>") + inside + Html("</table></div>\n");
}

Html figure(const bake::Picture& picture, const std::string& alternative, const Html& caption) {
  const std::vector<std::byte> png = bake::png_bytes(picture);
  return Html("<figure><img alt=\"") + text(alternative) + Html("\" width=\"") +
         text(std::to_string(picture.width)) + Html("\" height=\"") + text(std::to_string(picture.height)) +
         Html("\" src=\"data:image/png;base64,") + text(base64(png.data(), png.size())) +
         Html("\"><figcaption>") + caption + Html("</figcaption></figure>\n");
}

// Inserts values between the pieces of a template. The template itself is trusted markup that belongs to this
// program.
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
      throw Failure(NOOK_ERROR_INTERNAL, "the template %.*s uses %.*s, which has no value",
                    int(template_name.size()), template_name.data(), int(name.size()), name.data());
    page.append(rest.substr(0, open));
    page.append(value->second);
    rest.remove_prefix(close + 2);
  }
  page.append(rest);
  return page.take();
}

}  // namespace nook::report
