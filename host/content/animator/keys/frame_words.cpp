#include "host/content/animator/keys/frame_words.h"

#include <algorithm>
#include <cctype>

#include "hal/failure/failure.h"
#include "host/content/animator/reading/read_keys.h"
#include "host/content/document/document.h"
#include "host/content/document/fields.h"
#include "host/content/document/json_file.h"
#include "node/wire/film.h"

namespace mars::animator {
namespace {

constexpr const char* kEaseRemedy = "write --ease 0.4,0,0.6,1";

std::uint32_t frame_of(const std::string& digits, const std::string& text) {
  const auto frame = document::number_in<std::uint32_t>(digits);
  if (!frame || *frame > wire::kMostFrames)
    throw Failure("is no frame", "'" + text + "'",
                  "write a frame from 0 to 1000000, or a range: 24-48, or 24- to the end");
  return *frame;
}

}  // namespace

FrameRange read_frame_range(const std::string& text) {
  const std::size_t dash = text.find('-');
  const std::uint32_t first = frame_of(text.substr(0, dash), text);
  if (dash == std::string::npos) return {first, first};
  if (dash + 1 == text.size()) return {first, wire::kMostFrames};
  const std::uint32_t last = frame_of(text.substr(dash + 1), text);
  if (last < first) throw Failure("ends before it begins", "'" + text + "'", "write the earlier frame first");
  return {first, last};
}

std::string shown_range(FrameRange range) {
  if (range.first == range.last) return "at frame " + std::to_string(range.first);
  if (range.last >= wire::kMostFrames) return "from frame " + std::to_string(range.first) + " on";
  return "in frames " + std::to_string(range.first) + " to " + std::to_string(range.last);
}

std::uint32_t read_frame(const std::string& text) {
  const FrameRange range = read_frame_range(text);
  if (range.first != range.last) throw Failure("is a range", "'" + text + "'", "name one frame here");
  return range.first;
}

Ease read_typed_ease(const std::string& text) {
  if (text.empty()) throw Failure("is empty", "", kEaseRemedy);
  const bool named = std::isalpha(static_cast<unsigned char>(text[0]));
  const auto numbers = std::count(text.begin(), text.end(), ',') + 1;
  if (!named && numbers != 4)
    throw Failure("has " + document::counted(static_cast<std::uint64_t>(numbers), "number"), "", kEaseRemedy);
  const std::string json =
      R"({"ease": )" +
      (named ? document::Json(text).dump(-1, ' ', false, document::Json::error_handler_t::replace) : "[" + text + "]") +
      "}";
  if ((!named && text.find_first_not_of("+-.0123456789eE, ") != text.npos) || !document::Json::accept(json))
    throw Failure("is '" + text + "'", "", kEaseRemedy);
  try {
    const document::Document document(json, "--ease");
    constexpr std::string_view names[] = {"ease"};
    return read_ease(document::Fields(document.root(), document::Keys{"option", names}));
  } catch (const Failure& failure) {
    throw Failure(failure.problem, "", failure.remedy);  // nobody has typed a line and a key
  }
}

}  // namespace mars::animator
