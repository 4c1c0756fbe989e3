// SHA-256 against the examples of FIPS 180-4 (csrc.nist.gov, "SHA256.pdf" and "SHA2_Additional.pdf").
#include "bakers/import/sha256.h"

#include <string>

#include "tests/catch.h"

using nook::bake::Sha256;
using nook::bake::sha256;

TEST_CASE("SHA-256 of the standard's examples") {
  CHECK(sha256(std::string_view()) == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(sha256(std::string_view("abc")) ==
        "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(sha256(std::string_view("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq")) ==
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  CHECK(sha256(std::string_view(std::string(1000000, 'a'))) ==
        "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_CASE("SHA-256 does not depend on how bytes are cut into pieces") {
  std::string text;
  for (int i = 0; i < 300; ++i) text += char('a' + i % 23);
  const std::string whole = sha256(std::string_view(text));
  for (const std::size_t piece :
       {std::size_t(1), std::size_t(55), std::size_t(63), std::size_t(64), std::size_t(65)}) {
    Sha256 hash;
    for (std::size_t at = 0; at < text.size(); at += piece) {
      const std::string part = text.substr(at, piece);
      hash.add(std::as_bytes(std::span(part)));
    }
    CHECK(hash.hex() == whole);
  }
}
