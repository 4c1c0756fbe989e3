#include "bakers/measure/report/html.h"

#include "sdk/src/core/failure.h"
#include "tests/catch.h"

using namespace nook::report;

TEST_CASE("text is escaped for elements and attributes") {
  CHECK(text("a <b> & \"c\" 'd'").code() == "a &lt;b&gt; &amp; &quot;c&quot; &#39;d&#39;");
  // A line feed and U+202E, which turns the direction of writing, become visible.
  CHECK(text("a\nb").code().find('\n') == std::string::npos);
  CHECK(text("a\xe2\x80\xae"
             "b")
            .code()
            .find("\xe2\x80\xae") == std::string::npos);
  CHECK(text("\xff").code().find('\xff') == std::string::npos);
}

TEST_CASE("data of scripts cannot end their element, and stays JSON") {
  const nlohmann::ordered_json data{{"name", "</script><!--&"}};
  const std::string code = script_data(data).code();
  CHECK(code.find('<') == std::string::npos);
  CHECK(nlohmann::ordered_json::parse(code) == data);
}

TEST_CASE("numbers, shares and sizes") {
  CHECK(number(0.12345).code() == "0.123");
  CHECK(number(0).code() == "0");
  CHECK(number(12345.6).code() == "12346");
  CHECK(number(2.5e-5).code() == "2.50e-05");
  CHECK(number(0.0 / 0.0).code() == "–");
  CHECK(percent(0.4).code() == "40&nbsp;%");
  CHECK(percent(0.034).code() == "3.4&nbsp;%");
  CHECK(byte_count(131'000).code() == "131&nbsp;kB");
}

TEST_CASE("base64 of RFC 4648, section 10") {
  for (const auto& [plain, coded] : {std::pair<std::string, std::string>{"", ""},
                                     {"f", "Zg=="},
                                     {"fo", "Zm8="},
                                     {"foo", "Zm9v"},
                                     {"foob", "Zm9vYg=="},
                                     {"fooba", "Zm9vYmE="},
                                     {"foobar", "Zm9vYmFy"}})
    CHECK(base64(plain.data(), plain.size()) == coded);
}

TEST_CASE("a template without a value fails, and a value with braces stays what it is") {
  CHECK_THROWS_AS(fill("none.html", {}), nook::Failure);
  CHECK_THROWS_AS(fill("page.html", {}), nook::Failure);
  const Html page = fill("page.html", {{"title", text("{{lead}}")},
                                       {"kind", {}},
                                       {"style", {}},
                                       {"lead", Html("words")},
                                       {"advice", {}},
                                       {"sections", {}},
                                       {"facts", {}},
                                       {"licences", {}},
                                       {"version", {}},
                                       {"scripts", {}}});
  CHECK(page.code().find("<h1>{{lead}}</h1>") != std::string::npos);
}
