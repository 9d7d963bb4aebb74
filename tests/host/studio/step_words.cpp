#include "tests/host/studio/step_words.h"

#include <algorithm>
#include <sstream>

#include "host/content/document/text.h"

namespace mars::studio {
namespace {

std::vector<std::string> words_of(const std::string& text, char between) {
  std::vector<std::string> words;
  std::istringstream in(text);
  for (std::string word; std::getline(in, word, between);)
    if (!word.empty()) words.push_back(word);
  return words;
}

Json value_of(const std::vector<std::string>& words) {
  Json values = Json::array();
  for (const std::string& word : words) {
    const auto number = document::number_in<double>(word);
    values.push_back(number ? Json(*number) : Json(word));
  }
  return values.size() == 1 ? values[0] : values;
}

}  // namespace

Json step(const std::string& words) { return {{"commands", {words_of(words, ' ')}}}; }

Json pose(const std::string& thing, const std::string& settings, std::uint32_t frame) {
  return step("animate pose " + thing + " " + settings + " --frame " + std::to_string(frame) + " --clamp");
}

Json effect_of(const Json& step) {
  Json effect = Json::object();
  if (step.contains("pose")) {
    effect = step["pose"];
    effect["does"] = "turn";
    return effect;
  }
  const auto words = step.at("commands").at(0).get<std::vector<std::string>>();
  effect["does"] = words.at(1);
  for (std::size_t i = 2; i < words.size(); ++i) {
    const std::size_t equals = words[i].find('=');
    if (words[i].starts_with("--")) {
      std::vector<std::string> values;
      const std::string name = words[i].substr(2);
      while (i + 1 < words.size() && !words[i + 1].starts_with("--") && words[i + 1].find('=') == std::string::npos)
        values.push_back(words[++i]);
      effect[name] = values.empty() ? Json(true) : value_of(values);
    } else if (equals != std::string::npos) {
      effect[words[i].substr(0, equals)] = value_of(words_of(words[i].substr(equals + 1), ','));
    } else {
      effect["of"] = words[i];
    }
  }
  return effect;
}

}  // namespace mars::studio
