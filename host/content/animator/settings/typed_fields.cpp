#include "host/content/animator/settings/typed_fields.h"

#include <algorithm>
#include <set>
#include <vector>

#include "hal/failure/failure.h"
#include "host/content/animator/keys/written.h"
#include "host/content/document/fields.h"

namespace mars::animator {
namespace {

document::Json value_of(const std::string& text) {
  document::Json list = document::Json::array();
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const auto number = document::number_in<double>(std::string_view(text).substr(at, comma - at));
    if (!number) return text;
    list.push_back(written(*number));
    at = comma + 1;
  }
  return list.size() == 1 ? list[0] : list;
}

}  // namespace

void set_fields(document::Json& object, std::span<const std::string> words, std::span<const std::string_view> keys,
                const std::string& what) {
  std::set<std::string> given;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == word.size())
      throw Failure("is not KEY=VALUE", "'" + word + "'", "write it like color=1,0.8,0.6");
    const std::string key = word.substr(0, equals);
    if (std::ranges::find(keys, std::string_view(key)) == keys.end())
      throw Failure("is no key of " + what, document::in_quotes(key),
                    document::did_you_mean(key, keys, "choose " + document::joined(keys)));
    if (!given.insert(key).second) throw Failure("is given twice", document::in_quotes(key), "give each key once");
    object[key] = value_of(word.substr(equals + 1));
  }
}

void put_before(document::Json& object, const std::string& key, document::Json value,
                std::span<const std::string_view> others) {
  if (object.contains(key)) return void(object[key] = std::move(value));
  document::Json ordered = document::Json::object();
  for (const auto& [name, item] : object.items()) {
    if (!ordered.contains(key) && std::ranges::find(others, std::string_view(name)) != others.end())
      ordered[key] = value;
    ordered[name] = item;
  }
  ordered[key] = std::move(value);
  object = std::move(ordered);
}

}  // namespace mars::animator
