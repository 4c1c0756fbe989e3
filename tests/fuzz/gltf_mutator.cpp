// Mutates glTF by what it says: a value of the JSON document becomes another number, is removed, or takes the
// place of another value; or the binary chunk changes. The headers of a .glb follow. One mutation in eight is
// blind.
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

using Json = nlohmann::ordered_json;
using Random = std::minstd_rand;

struct Document {
  bool is_binary = false;
  std::string json;
  std::vector<std::uint8_t> buffer;  // the binary chunk
};

std::uint32_t word_at(const std::uint8_t* data) {
  std::uint32_t value;
  std::memcpy(&value, data, sizeof value);
  return value;
}

Document read_document(const std::uint8_t* data, std::size_t size) {
  Document document;
  document.is_binary = size >= 20 && std::memcmp(data, "glTF", 4) == 0;
  if (!document.is_binary) {
    document.json.assign(data, data + size);
    return document;
  }
  const std::size_t json = std::min<std::size_t>(word_at(data + 12), size - 20);
  document.json.assign(data + 20, data + 20 + json);
  if (size >= 28 + json) document.buffer.assign(data + 28 + json, data + size);
  return document;
}

std::vector<std::uint8_t> write_document(Document document) {
  if (!document.is_binary) return {document.json.begin(), document.json.end()};
  document.json.resize((document.json.size() + 3) / 4 * 4, ' ');
  document.buffer.resize((document.buffer.size() + 3) / 4 * 4);
  std::vector<std::uint8_t> out{'g', 'l', 'T', 'F'};
  const auto word = [&](std::size_t value) {
    for (int shift = 0; shift < 32; shift += 8) out.push_back(std::uint8_t(value >> shift));
  };
  word(2);
  word(28 + document.json.size() + document.buffer.size());
  word(document.json.size());
  word(0x4e4f534a);
  out.insert(out.end(), document.json.begin(), document.json.end());
  word(document.buffer.size());
  word(0x004e4942);
  out.insert(out.end(), document.buffer.begin(), document.buffer.end());
  return out;
}

void collect(Json& value, std::vector<Json*>& all) {
  all.push_back(&value);
  if (value.is_structured())
    for (Json& child : value) collect(child, all);
}

Json any_number(Random& random) {
  constexpr double numbers[] = {0,    1,     2,     3,     4,     5,          7,           16,   -1,
                                0.5,  1e-30, 1e18,  3e38,  1e300, 5120,       5121,        5122, 5123,
                                5125, 5126,  33071, 65535, 65536, 16777217.0, 2147483647.0};
  const double number = random() % 4 ? numbers[random() % std::size(numbers)] : double(random() % 64);
  return std::abs(number) < 1e15 && number == std::trunc(number) ? Json(std::int64_t(number)) : Json(number);
}

void erase_one(Json& value, Random& random) {
  if (!value.is_structured() || value.empty()) return;
  value.erase(std::next(value.begin(), std::ptrdiff_t(random() % value.size())));
}

void mutate_json(std::string& text, Random& random) {
  Json document = Json::parse(text, nullptr, false);
  if (document.is_discarded()) return;
  for (std::uint32_t change = 1 + random() % 3; change > 0; --change) {
    std::vector<Json*> all, numbers;
    collect(document, all);
    for (Json* value : all)
      if (value->is_number()) numbers.push_back(value);
    Json& target = *all[random() % all.size()];
    const Json other = *all[random() % all.size()];
    switch (random() % 6) {
      case 0:
        erase_one(target, random);
        break;
      case 1:
        if (other.dump().size() < 400) target = other;
        break;
      case 2:
        if (target.is_array() && other.dump().size() < 400) target.push_back(other);
        break;
      default:
        if (!numbers.empty()) *numbers[random() % numbers.size()] = any_number(random);
    }
  }
  text = document.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  Random random(seed);
  random.discard(2);
  const std::uint32_t choice = std::uint32_t(random() % 8);
  if (choice == 0 || size < 2) return LLVMFuzzerMutate(data, size, max_size);
  Document document = read_document(data, size);
  if (choice <= 5) {
    mutate_json(document.json, random);
  } else if (!document.buffer.empty()) {
    document.buffer.resize(
        LLVMFuzzerMutate(document.buffer.data(), document.buffer.size(), document.buffer.size()));
  }
  const std::vector<std::uint8_t> whole = write_document(std::move(document));
  if (whole.empty() || whole.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::memcpy(data, whole.data(), whole.size());
  return whole.size();
}
