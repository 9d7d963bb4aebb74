#include "host/experiments/platform.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "host/content/document/whole_file.h"
#include "host/experiments/calibrate.h"
#include "node/wire/work.h"
#include "tests/host/content/document/failure_of.h"
#include "tests/temporary_folder.h"

namespace mars::experiments {
namespace {

using document::failure_of;
using document::holds;

constexpr const char* kSmall = R"({
  "name": "small",
  "computers": {"nodes": 2, "processors": 4, "memory": 2097152},
  "host": {"apart": true, "processors": 3},
  "network": {"topology": "fat tree", "leaf": 8, "rate": 1e9, "send": [[0, 1e-6], [100, 2e-6]]},
  "work": WORK
})";

class Platforms : public testing::Test {
 protected:
  // `computers`: keys of these, too.
  void add(const std::string& name, const std::string& work, const std::string& computers = "") {
    std::string text = kSmall;
    text.insert(text.find("\"nodes\""), computers);
    text.replace(text.find("WORK"), 4, work);
    document::write_whole_file(folder_ / (name + ".json"), text);
  }
  Platform read(const std::string& name) const { return read_platform(name, folder_.path()); }
  static double cost(const Platform& platform, wire::Work kind) {
    return platform.machine.work.at(static_cast<std::size_t>(kind));
  }

  test::TemporaryFolder folder_;
};

TEST_F(Platforms, SayWhatMachinesAre) {
  add("small", R"({"pixel": 2e-9})");
  const Platform platform = read("small");
  EXPECT_EQ(platform.memory, 2097152u);
  EXPECT_EQ(platform.machine.nodes, 2);
  EXPECT_EQ(platform.machine.processors, 4);
  EXPECT_TRUE(platform.machine.host_apart);
  EXPECT_EQ(platform.host_memory, std::uint64_t{4} << 30) << "as much as a host takes";
  EXPECT_EQ(platform.machine.network.topology, simulated::Topology::fat_tree);
  EXPECT_DOUBLE_EQ(platform.machine.network.byte, 1e-9);
  ASSERT_EQ(platform.machine.network.send.size(), 2u);
  EXPECT_EQ(platform.machine.network.send[1].from, 100u);
  EXPECT_DOUBLE_EQ(cost(platform, wire::Work::pixel), 2e-9);
  EXPECT_EQ(cost(platform, wire::Work::patch), 0);
}

TEST_F(Platforms, SayWhatStorageTakes) {
  add("small", R"({}, "storage": {"rate": 2e9, "openings": 500, "file_part": 0.25})");
  const Platform platform = read("small");
  EXPECT_DOUBLE_EQ(platform.machine.storage.byte, 5e-10);
  EXPECT_DOUBLE_EQ(platform.machine.storage.opening, 2e-3);
  EXPECT_DOUBLE_EQ(platform.file_part, 0.25);
}

TEST_F(Platforms, SayHowComputersDiffer) {
  add("small", R"({}, "noise": {"seed": 7, "stragglers": 0.1, "slowdown": [1.5, 3], "detours": 100, "detour": 1e-4,
                                "lengths": "exponential"})",
      R"("speeds": [[3, 1], [1, 0.5]], )");
  const simulated::Machine machine = read("small").machine;
  ASSERT_EQ(machine.speeds.size(), 2u);
  EXPECT_EQ(machine.speeds[0].computers, 3);
  EXPECT_DOUBLE_EQ(machine.speeds[1].speed, 0.5);
  EXPECT_EQ(machine.noise.seed, 7u);
  EXPECT_DOUBLE_EQ(machine.noise.stragglers, 0.1);
  EXPECT_DOUBLE_EQ(machine.noise.least_slowdown, 1.5);
  EXPECT_DOUBLE_EQ(machine.noise.most_slowdown, 3);
  EXPECT_DOUBLE_EQ(machine.noise.detours, 100);
  EXPECT_DOUBLE_EQ(machine.noise.detour, 1e-4);
  EXPECT_EQ(machine.noise.lengths, simulated::Lengths::exponential);
  EXPECT_TRUE(machine.is_uneven());
}

TEST_F(Platforms, AreEvenWhereTheySayNothingElse) {
  add("small", "{}");
  const simulated::Machine machine = read("small").machine;
  EXPECT_FALSE(machine.is_uneven());
  EXPECT_EQ(machine.host_speed, 1);
  EXPECT_EQ(machine.network.eager, std::numeric_limits<std::size_t>::max());
  EXPECT_EQ(machine.storage.servers, 1);
}

TEST_F(Platforms, SayHowStorageIsDivided) {
  add("small", R"({}, "storage": {"rate": 1e9, "servers": 16, "stripe": 1048576, "writer_rate": 2e9})");
  const simulated::Storage storage = read("small").machine.storage;
  EXPECT_EQ(storage.servers, 16);
  EXPECT_EQ(storage.stripe, 1048576);
  EXPECT_DOUBLE_EQ(storage.writer_byte, 5e-10);
}

TEST_F(Platforms, RefuseNoiseThatCannotBe) {
  const auto refusal = [&](const std::string& noise) {
    add("small", R"({}, "noise": )" + noise);
    return failure_of([&] { read("small"); });
  };
  for (const auto& [noise, text] :
       {std::pair{R"({"detours": 1000, "detour": 1e-3})", "noise.detour: times detours is more than 90 %"},
        {R"({"detours": 1000})", "detour"},
        {R"({"stragglers": 0.5})", "slowdown"},
        {R"({"stragglers": 0.5, "slowdown": 0.5})", "noise.slowdown"},
        {R"({"stragglers": 0.5, "slowdown": [3, 2]})", "noise.slowdown: is not in order"},
        {R"({"lengths": "long"})", "noise.lengths"}})
    EXPECT_TRUE(holds(refusal(noise), text) && holds(refusal(noise), "small.json:6")) << noise << refusal(noise);
}

TEST_F(Platforms, RefuseSpeedsThatCannotBe) {
  for (const auto& [speeds, text] : {std::pair{"[]", "computers.speeds: is empty"},
                                     {"[[0, 1]]", "computers.speeds"},
                                     {"[[1, 0]]", "computers.speeds"},
                                     {"[1, 2]", "computers.speeds"}}) {
    add("small", "{}", std::string(R"("speeds": )") + speeds + ", ");
    const std::string failure = failure_of([&] { read("small"); });
    EXPECT_TRUE(holds(failure, text) && holds(failure, "small.json:3")) << failure;
  }
}

TEST_F(Platforms, SayWhichCostsAreNotIdentified) {
  using wire::Work;
  add("measured", R"({"pixel": 0, "light": 1e-9}, "not_identified": ["pixel", "line"])");
  add("small", R"("measured")");
  add("sure", R"({"pixel": 1e-9})");
  for (const char* name : {"measured", "small", "sure:small", "sure:measured"}) {
    EXPECT_EQ(read(name).unidentified, (std::vector{Work::pixel, Work::line})) << name;
    const std::string text = unidentified_text(read(name), std::array{Work::light, Work::pixel});
    EXPECT_TRUE(holds(text, "could not measure these kinds of work apart from others: pixel; the seconds are")) << text;
    EXPECT_EQ(unidentified_text(read(name), std::array{Work::light}), "");
  }
  EXPECT_TRUE(read("small:sure").unidentified.empty());
  add("wrong", R"({}, "not_identified": ["pixels"])");
  const std::string failure = failure_of([&] { read("wrong"); });
  EXPECT_TRUE(holds(failure, "wrong.json:6: not_identified[0]") && holds(failure, "pixel")) << failure;
}

TEST(ReferencePlatform, SaysWhichCostsAreNotIdentified) {
  using wire::Work;
  const std::string platforms = std::string(MARS_SOURCE_DIR) + "/cluster/platforms";
  for (const char* name : {"reference", "fat-tree"})
    for (const Work kind : {Work::pixel, Work::line, Work::triangle_tested})
      EXPECT_EQ(std::ranges::count(read_platform(name, platforms).unidentified, kind), 1) << name;
  EXPECT_TRUE(read_platform("ipsc2", platforms).unidentified.empty()) << "costs are counted operations there";
}

TEST_F(Platforms, OfACalibrationSayIt) {
  Calibration calibration;
  calibration.work.assign(wire::kWorkNames.size(), 1e-9);
  calibration.copy_rate = 1e10;
  EXPECT_FALSE(holds(table_text(calibration), "not identified"));
  calibration.unidentified = {wire::Work::line, wire::Work::pixel};
  EXPECT_TRUE(holds(table_text(calibration), "pixel                      1.000   not identified\n"));
  document::write_whole_file(folder_ / "sure.json",
                             platform_text(calibration, {1e-6, 2e9, 3e-7}, {"sure", "made up", 6, 1 << 30}));
  EXPECT_EQ(read("sure").unidentified, calibration.unidentified);
}

TEST_F(Platforms, TakeCostsOfWorkFromAnother) {
  add("measured", R"({"pixel": 5e-9})");
  add("small", R"("measured")");
  add("slow", R"({"pixel": 7e-9})");
  EXPECT_DOUBLE_EQ(cost(read("small"), wire::Work::pixel), 5e-9);
  EXPECT_DOUBLE_EQ(cost(read("small:slow"), wire::Work::pixel), 7e-9);
  EXPECT_EQ(read("small:slow").machine.network.leaf, 8);
}

TEST_F(Platforms, RefuseWhatTheyDoNotKnow) {
  add("small", R"({"pixels": 2e-9})");
  const std::string text = failure_of([&] { read("small"); });
  EXPECT_TRUE(holds(text, "pixels") && holds(text, "small.json:6") && holds(text, "did you mean 'pixel'?")) << text;
  const std::string unknown = failure_of([&] { read("smal"); });
  EXPECT_TRUE(holds(unknown, "no platform 'smal'") && holds(unknown, "small")) << unknown;
}

TEST_F(Platforms, RefuseWhatIsNeitherTrueNorFalse) {
  std::string text = kSmall;
  text.replace(text.find("WORK"), 4, "{}");
  text.replace(text.find("true"), 4, "1");
  document::write_whole_file(folder_ / "small.json", text);
  const std::string failure = failure_of([&] { read("small"); });
  EXPECT_TRUE(holds(failure, "small.json:4: host.apart: is a number")) << failure;
}

TEST_F(Platforms, TellWhereTheyNameOneThatIsNot) {
  add("small", R"("missing")");
  const std::string text = failure_of([&] { read("small"); });
  EXPECT_TRUE(holds(text, "small.json:6: work") && holds(text, "no platform 'missing'")) << text;
}

TEST_F(Platforms, ThatNameEachOtherAreRefused) {
  add("a", R"("b")");
  add("b", R"("a")");
  const std::string text = failure_of([&] { read("a"); });
  EXPECT_TRUE(holds(text, "work of work")) << text;
}

TEST_F(Platforms, AreWhatACalibrationWrites) {
  Calibration calibration;
  calibration.work.assign(wire::kWorkNames.size(), 1.23456e-9);
  calibration.copy_rate = 1e10;
  const MessageCosts messages{1e-6, 2e9, 3e-7};
  document::write_whole_file(folder_ / "here.json",
                             platform_text(calibration, messages, {"here", "made up", 6, 1 << 30}));
  const Platform named = read_platform((folder_ / "here.json").string(), folder_.path());
  EXPECT_EQ(named.machine.processors, 6);
  EXPECT_EQ(named.about, "made up");
  EXPECT_FALSE(named.machine.host_apart);
  EXPECT_DOUBLE_EQ(cost(named, wire::Work::facet_light), 1.23e-9);
  EXPECT_DOUBLE_EQ(named.machine.network.send.front().seconds, 3e-7);
  // Both ends copy; the rest of a byte's time is the network's.
  EXPECT_NEAR(named.machine.network.local_byte + 2 * named.machine.network.copy_byte, 1 / 2e9, 1e-12);
}

TEST_F(Platforms, OfABusyMachineAreDoubted) {
  EXPECT_EQ(doubt_of({1.9, 2, 0.2}), "");
  EXPECT_EQ(doubt_of({9, 2, 0}), "9.0 programs wanted to run at a time on 2 processors");
  EXPECT_EQ(doubt_of({0.5, 2, 0.34}), "repeats took 34 % longer than the shortest");
  EXPECT_GT(busyness().processors, 0);
  Calibration calibration;
  calibration.work.assign(wire::kWorkNames.size(), 1e-9);
  calibration.copy_rate = 1e10;
  calibration.doubt = "repeats took long";
  document::write_whole_file(folder_ / "busy.json",
                             platform_text(calibration, {1e-6, 2e9, 3e-7}, {"busy", "made up", 6, 1 << 30}));
  add("small", R"({"pixel": 2e-9})");
  EXPECT_EQ(doubt_text(read("small")), "");
  EXPECT_EQ(read("busy:small").doubt, "") << "doubtful are costs of work";
  EXPECT_TRUE(holds(doubt_text(read("small:busy")), "small:busy was measured on a machine that was too busy: repeats"));
}

TEST_F(Platforms, KeepTheSpreadOfForecasts) {
  Calibration calibration;
  calibration.work.assign(wire::kWorkNames.size(), 1e-9);
  calibration.copy_rate = 1e10;
  calibration.spread = {{1, false, 0.9, 1.05, 1.25}, {2, true, 0.8, 1, 1.5}};
  EXPECT_TRUE(holds(table_text(calibration), "80 %         100 %         150 %"));
  document::write_whole_file(folder_ / "tried.json",
                             platform_text(calibration, {1e-6, 2e9, 3e-7}, {"tried", "made up", 6, 1 << 30}));
  EXPECT_EQ(read("tried").spread, calibration.spread);
  add("small", R"({"pixel": 2e-9})");
  EXPECT_TRUE(read("small").spread.empty()) << "as files of before have none";
  EXPECT_TRUE(read("tried:small").spread.empty() && read("small:tried").spread.empty()) << "neither was tried";
}

TEST_F(Platforms, RefuseASpreadOutOfOrder) {
  const std::string spread = R"({}, "spread": [{"nodes": 1, "low": 1.2, "middle": 1.1, "high": 1.3}])";
  add("small", spread);
  EXPECT_TRUE(holds(failure_of([&] { read("small"); }), "spread[0]: is not in order"));
}

TEST_F(Platforms, LikeThisMachineHaveItsProcessors) {
  add("small", R"({"pixel": 2e-9})");
  const Platform platform = like_here("small", folder_.path(), 12);
  EXPECT_EQ(platform.machine.nodes, 12);
  EXPECT_EQ(platform.host_processors(), 12);
  EXPECT_DOUBLE_EQ(cost(platform, wire::Work::pixel), 2e-9);
}

}  // namespace
}  // namespace mars::experiments
