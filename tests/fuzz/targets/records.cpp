// What runs leave in a folder of frames: frames.json, and claims and hashes in .runs; and what a frame's file says of
// itself. Four texts, between lines of `----`. A manifest's sum is made right. What is read is written back as the next
// run writes it, and must be read again.
#include <array>
#include <nlohmann/json.hpp>

#include "hal/failure/failure.h"
#include "host/render/sinks/claim.h"
#include "host/render/sinks/frame_folder.h"
#include "host/render/sinks/frame_mark.h"
#include "host/render/sinks/record.h"
#include "tests/fuzz/scratch.h"
#include "tests/fuzz/target.h"

namespace mars::fuzz::records {
namespace {

constexpr std::string_view kBetween = "\n----\n";

std::array<std::string_view, 4> parts_of(std::string_view input) {
  std::array<std::string_view, 4> parts;
  for (std::string_view& part : parts) {
    const std::size_t end = std::min(input.find(kBetween), input.size());
    part = input.substr(0, end);
    input.remove_prefix(std::min(end + kBetween.size(), input.size()));
  }
  return parts;
}

std::string with_sum(std::string_view manifest) {
  nlohmann::json text = nlohmann::json::parse(manifest, nullptr, false);
  if (!text.is_object() || !text.contains("sum")) return std::string(manifest);
  text["sum"] = sinks::sum_of(text);
  return text.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void expect_written_again(const sinks::Manifest& manifest) {
  const std::string text = sinks::to_json(manifest).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  const sinks::Manifest again = sinks::manifest_of(sinks::parse_record(text));
  check(again.frames == manifest.frames && again.more == manifest.more, "a manifest is read as it was written");
}

}  // namespace

void take(std::string_view input) {
  static const std::filesystem::path runs = scratch().path(".runs");
  std::filesystem::create_directory(runs);
  const auto [manifest, claim, hashes, mark] = parts_of(input);
  if (const auto read = sinks::mark_of(std::string(mark)))
    check(sinks::mark_of(sinks::text_of(*read)) == read, "a mark is read as it was written");
  const sinks::RunFiles run{"run",
                            {scratch().file(".runs/run.claim", claim), scratch().file(".runs/run.hashes", hashes)}};
  scratch().file("frames.json", with_sum(manifest));
  if (const auto of_run = sinks::claim_of(run)) sinks::text_of(*of_run);
  if (const auto rendered = sinks::rendered_by(run)) {
    expect_written_again(*rendered);
    sinks::conflict_with(run, *rendered, "folder");
  }
  expect_written_again(sinks::read_manifest(scratch().path("")));
}

const Target target("records", Form::text, take);

}  // namespace mars::fuzz::records
