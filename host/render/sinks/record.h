// The values of a JSON object that MARS keeps in a folder of frames. A file there may be damaged, or anybody's: each
// value is checked, and what does not fit is a Failure, without a place, that names the key, says what belongs there,
// and shows the value, shortened.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

namespace mars::sinks {

// Bytes of any one file there: enough for the longest film's 1,000,000 frames, with a hash each.
inline constexpr std::uintmax_t kLargestRecord = std::uintmax_t{64} << 20;

inline constexpr std::uint64_t kLastSecond = 253402300799;  // of the year 9999

inline constexpr std::uint32_t kMostVersion = 1'000'000;  // of anything that has a version

// Throws Failure where `text` is no JSON.
nlohmann::json parse_record(const std::string& text);

class Record {
 public:
  // `object` must outlive it. Throws Failure where it is none.
  explicit Record(const nlohmann::json& object);
  explicit Record(const nlohmann::json&&) = delete;

  void refuse_keys_but(std::span<const std::string_view> known) const;

  bool has(std::string_view key) const;
  const nlohmann::json& value(std::string_view key) const;
  const nlohmann::json& list(std::string_view key) const;
  std::uint64_t whole_number(std::string_view key, std::uint64_t lowest, std::uint64_t highest) const;
  double positive_number(std::string_view key) const;
  double number(std::string_view key) const;  // from 0
  // Of at most `longest` bytes.
  std::string text(std::string_view key, std::size_t longest) const;
  std::string checksum(std::string_view key) const;

 private:
  const nlohmann::json& object_;
};

// 32 hexadecimal digits (checksum.h).
bool is_checksum(const nlohmann::json& value);

// "pixel_hashes: 3 is not a text".
[[noreturn]] void refuse_value(std::string_view key, const nlohmann::json& value, const std::string& expected);

}  // namespace mars::sinks
