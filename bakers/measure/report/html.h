// The pieces of a page. Text from files and arguments can only become Html through text(), which escapes it.
// Names therefore cannot add markup or code to a page.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bakers/images/picture.h"

namespace nook::report {

// Markup that is written in this program's source. It must be a compile-time constant, so that text from
// elsewhere cannot become markup.
class Markup {
 public:
  consteval Markup(const char* literal) : text_(literal) {}
  const char* text() const { return text_; }

 private:
  const char* text_;
};

class Html {
 public:
  Html() = default;
  explicit Html(Markup markup) : code_(markup.text()) {}

  const std::string& code() const { return code_; }
  bool empty() const { return code_.empty(); }
  Html& operator+=(const Html& other) {
    code_ += other.code_;
    return *this;
  }
  friend Html operator+(Html a, const Html& b) { return a += b; }

  static Html escaped(std::string_view plain);

 private:
  std::string code_;
  friend class HtmlFill;
  friend Html script_data(const nlohmann::ordered_json& data);
};

// Escapes text for elements and for attributes in quotes. Control characters, characters that change the
// direction of writing, and bytes that are not UTF-8 become visible escapes.
Html text(std::string_view plain);

// Formats the value with three significant digits. Values of at least 0.001 are written without an exponent.
// If the value is not finite, returns a dash.
Html number(double value);
Html percent(double share);
Html byte_count(double bytes);

std::string base64(const void* bytes, std::size_t size);

// Returns <tag>inside</tag>.
Html element(Markup tag, const Html& inside);

// Returns JSON as the text of a script element, escaped so that it cannot end the element.
Html script_data(const nlohmann::ordered_json& data);

// The first row holds the names of the columns.
Html table(const std::vector<std::vector<Html>>& rows);

// Embeds a picture in the page. `alternative` is a text that describes what the picture shows.
Html figure(const bake::Picture& picture, const std::string& alternative, const Html& caption);

// The files of templates/, embedded at build time.
struct Template {
  const char* name;  // name of the file
  const char* text;
};
const Template* templates_begin();
const Template* templates_end();

// Replaces each {{name}} of a template by its value. Braces inside a value are not replaced. Throws
// Failure(INTERNAL) for an unknown template or name.
Html fill(std::string_view template_name, const std::vector<std::pair<std::string_view, Html>>& values);

}  // namespace nook::report
