#include "host/render/sinks/status.h"

#include <gtest/gtest.h>

#include "host/content/document/whole_file.h"
#include "tests/temporary_folder.h"

namespace mars::sinks {
namespace {

Status some_status() {
  Status status;
  status.process = this_process();
  status.since = 1000;
  status.written = 1010;
  status.film = "a film.json";
  status.doing = "rendering";
  status.done = 3;
  status.of = 9;
  status.seconds = 1.5;
  status.left = 3;
  status.machines = {{"n1", {{.node = 0, .frames = 2, .doing = ""}}},
                     {"n2", {{.node = 1, .frames = 1, .silent = 7.5, .frame = 4, .doing = "scanline", .slow = 2}}}};
  status.warnings = {"node 1 is slow"};
  status.used = {12.5, 1'000'000, 0};
  return status;
}

std::optional<Status> read_again(const std::string& text) {
  const test::TemporaryFolder folder;
  document::create_file(folder / "run.status", text);
  return status_of(RunFiles{"run", {folder / "run.status"}});
}

TEST(Status, IsReadAsItWasWritten) {
  EXPECT_EQ(read_again(text_of(some_status())), some_status());
  Status begun;
  begun.process = this_process();
  EXPECT_EQ(read_again(text_of(begun)), begun);
}

TEST(Status, IsNoneWhereItsFileIsDamagedOrMissing) {
  const std::string whole = text_of(some_status());
  EXPECT_EQ(read_again(whole.substr(0, whole.size() / 2)), std::nullopt);
  EXPECT_EQ(read_again("{}"), std::nullopt);
  EXPECT_EQ(status_of(RunFiles{"run", {}}), std::nullopt);
  EXPECT_EQ(status_of(RunFiles{"run", {"nowhere/run.status"}}), std::nullopt);
}

TEST(Status, HidesWhatATerminalWouldObey) {
  Status status = some_status();
  status.warnings = {"\x1b[2J"};
  EXPECT_EQ(read_again(text_of(status))->warnings.front(), R"(\u001b[2J)");
}

TEST(Status, OfManyNodesIsSmall) {
  Status status = some_status();
  for (std::int32_t node = 0; node < 1000; ++node)
    status.machines.front().nodes.push_back({.node = node, .frames = 1000, .doing = ""});
  EXPECT_LT(text_of(status).size(), 40'000u);
}

}  // namespace
}  // namespace mars::sinks
