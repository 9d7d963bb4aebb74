#include "host/render/sinks/claim.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "host/content/document/file.h"
#include "host/content/document/whole_file.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::sinks {
namespace {

Manifest film(const char* name, char checksum, std::vector<std::uint32_t> frames) {
  return {name, std::string(32, checksum), 6, 4, images::PictureFormat::png, 24, 400, std::move(frames), {}, {}, {}};
}

// A run that claims `manifest`, by its files.
class ClaimOf {
 public:
  explicit ClaimOf(const Manifest& manifest, std::int64_t since = time(nullptr)) {
    ProcessName process = this_process();
    process.host = "n1";
    process.number = 4711;
    document::write_whole_file(folder_ / "n1.claim", text_of(Claim{process, since, manifest}));
  }
  RunFiles run() const { return {"n1", {folder_ / "n1.claim", folder_ / "n1.hashes"}}; }
  std::filesystem::path hashes() const { return folder_ / "n1.hashes"; }
  std::string refuses(const Manifest& wanted) const {
    return document::failure_of([&] {
      if (const auto conflict = conflict_with(run(), wanted, "out")) throw *conflict;
    });
  }

 private:
  const test::TemporaryFolder folder_;
};

TEST(Claim, ReadsAgain) {
  const Manifest manifest = film("a.json", 'a', {0, 1, 2, 9});
  const ClaimOf claim(manifest, 12345);
  const std::optional<Claim> read = claim_of(claim.run());
  ASSERT_TRUE(read);
  EXPECT_EQ(read->manifest, manifest);
  EXPECT_EQ(read->process.number, 4711);
  EXPECT_EQ(read->since, 12345);
  EXPECT_FALSE(claim_of({"x", {}}));
}

TEST(Claim, OnlyOtherFramesOfTheSameFilmAreLetIn) {
  const ClaimOf claim(film("a.json", 'a', {0, 1, 2, 9}));
  EXPECT_EQ(claim.refuses(film("a.json", 'a', {3, 4, 8})), "");
  const std::string overlap = claim.refuses(film("copy.json", 'a', {4, 9}));
  EXPECT_TRUE(
      overlap.starts_with("out: another run, process 4711 on host n1, renders frames 0-2,9 of a.json into this "
                          "folder since "))
      << overlap;
  EXPECT_TRUE(overlap.ends_with("(give other frames with --frames, another folder with -o, or wait)")) << overlap;
  const std::string other = claim.refuses(film("b.json", 'b', {3}));
  EXPECT_TRUE(document::holds(other, "renders frames 0-2,9 of a.json into this folder")) << other;
  EXPECT_TRUE(document::holds(other, "(give another folder with -o, or wait)")) << other;
  EXPECT_TRUE(
      document::holds(claim.refuses(film("a.json", 'b', {3})), "of another version, size or format of a.json into"));
}

TEST(Claim, LongListsAndOtherDaysAreToldShortAndWhole) {
  std::vector<std::uint32_t> many;
  for (std::uint32_t frame = 1; frame < 400; ++frame)
    if (frame % 3 != 0) many.push_back(frame);
  const ClaimOf claim(film("a.json", 'a', many), 12345);
  const std::string refusal = claim.refuses(film("a.json", 'a', {1}));
  EXPECT_TRUE(document::holds(refusal, "renders 266 frames from 1 to 398 of a.json into this folder since 19"))
      << refusal;
  EXPECT_TRUE(document::holds(ClaimOf(film("a.json", 'a', {3})).refuses(film("a.json", 'a', {3})),
                              "renders frame 3 of a.json"));
}

TEST(Claim, OneThatCannotBeReadIsRefusedToo) {
  const ClaimOf claim(film("a.json", 'a', {1}));
  document::write_whole_file(claim.run().files.front(), "nonsense");
  EXPECT_TRUE(
      document::holds(claim.refuses(film("a.json", 'a', {3})), "n1.claim: another run renders into this folder"));
}

TEST(Claim, OneThatNoRunWritesCannotBeRead) {
  const ClaimOf claim(film("a.json", 'a', {1}));
  const std::filesystem::path file = claim.run().files.front();
  const nlohmann::json sound = nlohmann::json::parse(document::read_file(file));
  const auto with = [&](const char* key, const nlohmann::json& value) {
    nlohmann::json changed = sound;
    changed[key] = value;
    document::write_whole_file(file, changed.dump());
    return claim_of(claim.run()).has_value();
  };
  EXPECT_TRUE(with("process", 4712));
  EXPECT_FALSE(with("process", (std::int64_t{1} << 40) + 1));
  EXPECT_FALSE(with("process", 0));
  EXPECT_FALSE(with("since", std::int64_t{1} << 62));
  EXPECT_FALSE(with("since", -1));
  EXPECT_FALSE(with("host", "n1\nmars: all is well"));
  EXPECT_FALSE(with("host", "\033[2J"));
  EXPECT_FALSE(with("host", std::string(100000, 'n')));
  EXPECT_FALSE(with("manifest", nullptr));
}

TEST(Claim, FilmsNamesAreToldOnOneLineAndShort) {
  const std::string odd = ClaimOf(film("a\n\033[2J.json", 'a', {1})).refuses(film("x", 'a', {1}));
  EXPECT_TRUE(document::holds(odd, R"(renders frame 1 of a\u000a\u001b[2J.json into)")) << odd;
  const std::string path = std::string(4000, '/') + "film.json";
  const std::string refusal = ClaimOf(film(path.c_str(), 'a', {1})).refuses(film("x", 'a', {1}));
  EXPECT_TRUE(document::holds(refusal, "frame 1 of ...//")) << refusal;
  EXPECT_TRUE(document::holds(refusal, "/film.json into")) << refusal;
  EXPECT_LT(refusal.size(), 500u);
}

TEST(Claim, WhatWasRenderedIsKnownUpToWhereTheRunWasKilled) {
  const ClaimOf claim(film("a.json", 'a', {0, 1, 2, 9}));
  EXPECT_EQ(rendered_by(claim.run())->pixel_hashes, std::vector<std::string>(4)) << "no frame yet";
  const std::string hash(32, '7');
  {
    HashLog log(claim.hashes());
    log.add(9, hash);
    log.add(1, hash);
    log.add(5, hash);  // not claimed
  }
  EXPECT_NE(document::failure_of([&] { HashLog(claim.hashes()); }), "") << "it is one run's own";
  document::write_whole_file(claim.hashes(), document::read_file(claim.hashes()) + "2 777");
  EXPECT_EQ(rendered_by(claim.run())->pixel_hashes, (std::vector<std::string>{"", hash, "", hash}));
}

// A process of its own, whose files may not grow beyond some bytes for a while.
TEST(Claim, ALineThatDidNotFitIsEndedBeforeAnotherBegins) {
  const ClaimOf claim(film("a.json", 'a', {0, 1, 2, 9}));
  const std::string hash(32, '7');
  const auto add_within_limits = [&] {
    std::signal(SIGXFSZ, SIG_IGN);
    HashLog log(claim.hashes());
    const auto limit_to = [](rlim_t bytes) {
      const rlimit limit{bytes, RLIM_INFINITY};
      setrlimit(RLIMIT_FSIZE, &limit);
    };
    log.add(9, hash);
    bool failed = true;
    for (const rlim_t bytes : {40, 60, 69}) {  // within the second line, which begins at 35
      limit_to(bytes);
      failed = failed && document::holds(document::failure_of([&] { log.add(1, hash); }), "File too large");
    }
    limit_to(RLIM_INFINITY);
    log.add(0, hash);
    log.add(1, hash);
    return failed;
  };
  const pid_t child = fork();
  if (child == 0) _exit(add_within_limits() ? 0 : 1);
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  const std::string one = "1 " + hash + "\n";
  EXPECT_EQ(document::read_file(claim.hashes()), "9 " + hash + "\n" + one + "0 " + hash + "\n" + one);
}

}  // namespace
}  // namespace mars::sinks
