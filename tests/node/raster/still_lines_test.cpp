// Which lines are kept for inbetweens, and that those which are come back as they were written, on their machine and
// on others.
#include "node/raster/still_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <span>
#include <vector>

#include "hal/threads/run_threads.h"

namespace mars::raster {
namespace {

constexpr std::uint32_t kStillWidth = 10, kStillHeight = 12, kSamples = 4, kInterval = 7;
constexpr geometry::LineRange kAll{0, kStillHeight};

// Bytes for `lines` lines with `groups` groups a column.
std::uint64_t bytes_for(std::uint32_t lines, std::uint32_t groups) {
  const std::uint64_t line =
      wire::still_head_bytes(kStillWidth) +
      kStillWidth * (kSamples * sizeof(float) + sizeof(std::uint32_t) + groups * sizeof(StillGroup));
  return lines * ((line + 63) / 64 * 64);
}
const std::uint64_t kAmple = bytes_for(kStillHeight, kSamples);

// On a node that is alone.
void as_node(const std::function<void(const Neighbours&)>& node) {
  threads::run_threads(
      1, [] {},
      [&] {
        const std::int32_t machine = 0;
        node(Neighbours({&machine, 1}, 1));
      });
}

StillLines lines_of(const Neighbours& neighbours, std::uint64_t bytes, std::uint32_t samples = kSamples) {
  return {neighbours, kStillWidth, kStillHeight, shape::sample_pattern(samples), bytes};
}

// As it travels.
std::vector<std::byte> packed(const StillLines& still, std::uint32_t line) {
  std::vector<std::byte> bytes(still.packed_bytes(line));
  if (!bytes.empty()) still.pack(line, bytes.data());
  return bytes;
}

// Of `groups` groups evenly over the columns: where column `x` ends, and whether it has any.
std::uint32_t end_of(std::uint32_t x, std::uint32_t groups) { return groups * (x + 1) / kStillWidth; }
bool shows(std::uint32_t x, std::uint32_t groups) { return end_of(x, groups) > (x == 0 ? 0 : end_of(x - 1, groups)); }

// Where nothing is seen, there is no depth.
float depth_of(std::uint32_t line, std::uint32_t sample, std::uint32_t x, std::uint32_t groups) {
  return shows(x, groups) ? static_cast<float>(1000 * line + 100 * sample + x) : 0;
}

// Depths and groups that tell their line and place; `groups` of them, evenly over the columns.
bool write(StillLines& still, std::uint32_t line, std::uint32_t groups) {
  if (!still.begin_line(line, groups)) return false;
  for (std::uint32_t s = 0; s < kSamples; ++s)
    for (std::uint32_t x = 0; x < kStillWidth; ++x) still.depth(line, s)[x] = depth_of(line, s, x, groups);
  const StillGroups out = still.groups(line);
  for (std::uint32_t x = 0; x < kStillWidth; ++x) out.end[x] = end_of(x, groups);
  for (std::uint32_t k = 0; k < groups; ++k)
    out.groups[k] = {{static_cast<float>(line), 0.5f, static_cast<float>(k)}, k};
  return true;
}

void expect_kept(StillLines& still, std::uint32_t line, std::uint32_t groups) {
  ASSERT_TRUE(still.keeps(line)) << line;
  for (std::uint32_t s = 0; s < kSamples; ++s)
    for (std::uint32_t x = 0; x < kStillWidth; ++x) ASSERT_EQ(still.depth(line, s)[x], depth_of(line, s, x, groups));
  std::uint32_t k = 0;
  for (std::uint32_t x = 0; x < kStillWidth; ++x)
    for (const StillGroup& group : still.groups(line).of(x)) {
      ASSERT_EQ(group.light[0], static_cast<float>(line));
      ASSERT_EQ(group.light[2], static_cast<float>(k));
      ASSERT_EQ(group.samples, k++);
    }
  ASSERT_EQ(k, groups);
}

TEST(StillLines, LinesComeBackAsTheyWereWritten) {
  as_node([](const Neighbours& alone) {
    StillLines still = lines_of(alone, kAmple);
    still.begin_interval(kInterval, {2, 9});
    for (std::uint32_t line = 2; line < 9; ++line) ASSERT_TRUE(write(still, line, 6 * line % 41));
    for (std::uint32_t line = 2; line < 9; ++line) expect_kept(still, line, 6 * line % 41);
    for (const std::uint32_t line : {0u, 1u, 9u, 11u}) EXPECT_FALSE(still.keeps(line)) << line;
  });
}

TEST(StillLines, ALineWithMoreGroupsThanFitIsNotKept) {
  as_node([](const Neighbours& alone) {
    StillLines still = lines_of(alone, bytes_for(kStillHeight, 2));
    still.begin_interval(kInterval, kAll);
    EXPECT_TRUE(write(still, 0, 2 * kStillWidth));
    EXPECT_FALSE(write(still, 1, 2 * kStillWidth + 1));
    EXPECT_TRUE(write(still, 2, 0));
    expect_kept(still, 0, 2 * kStillWidth);
    EXPECT_FALSE(still.keeps(1));
    expect_kept(still, 2, 0);
    EXPECT_FALSE(still.keeps(3)) << "not written";
  });
}

// The first lines of those that inbetweens may touch, wherever these are.
TEST(StillLines, WhereFewLinesFitTheOthersAreNotKept) {
  as_node([](const Neighbours& alone) {
    StillLines still = lines_of(alone, bytes_for(3, 1));
    for (const std::uint32_t first : {0u, 5u}) {
      still.begin_interval(kInterval + first, {first, first + 6});
      for (std::uint32_t k = 0; k < 6; ++k) EXPECT_EQ(write(still, first + k, kStillWidth), k < 3);
      for (std::uint32_t k = 0; k < 6; ++k) EXPECT_EQ(still.keeps(first + k), k < 3);
      for (std::uint32_t k = 0; k < 3; ++k) expect_kept(still, first + k, kStillWidth);
    }
    StillLines none = lines_of(alone, 0);
    none.begin_interval(kInterval, kAll);
    EXPECT_FALSE(write(none, 0, 0));
    EXPECT_FALSE(none.keeps(0));
    EXPECT_TRUE(packed(none, 0).empty());
  });
}

TEST(StillLines, LinesOfAnEarlierIntervalAreNotKept) {
  as_node([](const Neighbours& alone) {
    StillLines still = lines_of(alone, kAmple);
    still.begin_interval(kInterval, kAll);
    for (std::uint32_t line = 0; line < kStillHeight; ++line) write(still, line, 5);
    still.begin_interval(kInterval + 1, kAll);
    write(still, 4, 5);
    for (std::uint32_t line = 0; line < kStillHeight; ++line) EXPECT_EQ(still.keeps(line), line == 4) << line;
  });
}

// Of one interval, whose frames came in two tasks: lines then lie elsewhere.
TEST(StillLines, LinesOfAnotherFirstLineAreNotKept) {
  as_node([](const Neighbours& alone) {
    StillLines still = lines_of(alone, kAmple);
    still.begin_interval(kInterval, kAll);
    for (std::uint32_t line = 0; line < kStillHeight; ++line) write(still, line, 5);
    still.begin_interval(kInterval, {3, kStillHeight});
    for (std::uint32_t line = 0; line < kStillHeight; ++line) EXPECT_FALSE(still.keeps(line)) << line;
    write(still, 3, 5);
    expect_kept(still, 3, 5);
  });
}

// From a machine with ample memory to one with little, and back.
TEST(StillLines, TravelBetweenMachinesWithMoreAndLessMemory) {
  as_node([](const Neighbours& alone) {
    StillLines ample = lines_of(alone, kAmple), small = lines_of(alone, bytes_for(4, 1));
    ample.begin_interval(kInterval, {1, 8});
    small.begin_interval(kInterval, {1, 8});
    for (std::uint32_t line = 1; line < 8; ++line) write(ample, line, line == 2 ? 3 * kStillWidth : kStillWidth);
    for (std::uint32_t line = 7; line >= 1; --line) small.unpack(packed(ample, line));
    for (std::uint32_t line = 1; line < 8; ++line) {
      if (line == 2 || line > 4)
        EXPECT_FALSE(small.keeps(line)) << line;
      else
        expect_kept(small, line, kStillWidth);
    }
    ample.begin_interval(kInterval + 1, {1, 8});
    small.begin_interval(kInterval + 1, {1, 8});
    write(small, 3, 4);
    EXPECT_TRUE(packed(small, 4).empty()) << "of the interval before";
    ample.unpack(packed(small, 3));
    expect_kept(ample, 3, 4);
    EXPECT_FALSE(ample.keeps(2));
  });
}

// Whether a line in which a byte is another is still one.
bool takes(StillLines& still, std::vector<std::byte> line, std::size_t at, std::uint32_t byte) {
  line[at] = static_cast<std::byte>(byte);
  return still.is_packed(line);
}

TEST(StillLines, OfOtherMachinesAreSound) {
  as_node([](const Neighbours& alone) {
    StillLines still = lines_of(alone, kAmple);
    still.begin_interval(kInterval, {1, 8});
    write(still, 3, 5);
    const auto sound = packed(still, 3);
    ASSERT_TRUE(still.is_packed(sound));
    for (const std::size_t size : {std::size_t{0}, std::size_t{3}, std::size_t{64}, sound.size() - 1})
      EXPECT_FALSE(still.is_packed(std::span(sound).first(size))) << size;
    for (std::size_t at = 0; at < 16; at += 4)
      EXPECT_FALSE(takes(still, sound, at, 99)) << "byte " << at << " of its head";
    const std::size_t counts = wire::still_head_bytes(kStillWidth),
                      groups = sound.size() - 5 * wire::still_packed_group_bytes(0);
    EXPECT_EQ(groups, counts + kStillWidth + 5 * wire::still_packed_bytes(kSamples, 0)) << "five columns have a group";
    EXPECT_FALSE(takes(still, sound, counts, 1)) << "more groups than the line has";
    EXPECT_FALSE(takes(still, sound, counts + 1, 0)) << "fewer";
    EXPECT_FALSE(takes(still, sound, counts + 1, kSamples + 1)) << "more than a pixel has samples";
    EXPECT_FALSE(takes(still, sound, sound.size() - 1, 0xff)) << "more samples than a pixel has";
    EXPECT_TRUE(takes(still, sound, groups, 0xff)) << "light of any amount";
    EXPECT_TRUE(takes(still, sound, groups - 1, 0xff)) << "any depth";
  });
}

// CZB alone, line after line, and all of it whatever the memory.
TEST(StillLines, WithOneSampleAllLinesAreKept) {
  as_node([](const Neighbours& alone) {
    StillLines still = lines_of(alone, 0, 1);
    still.begin_interval(kInterval, {2, kStillHeight});
    for (std::uint32_t line = 2; line < kStillHeight; ++line) {
      ASSERT_TRUE(still.begin_line(line, 0));
      std::ranges::fill(still.depth(line, 0), static_cast<float>(line));
    }
    EXPECT_FALSE(still.keeps(1));
    std::vector<float> depths(3 * kStillWidth);
    ASSERT_EQ(still.depth_bytes({3, 6}), std::span(depths).size_bytes());
    still.pack_depths({3, 6}, std::as_writable_bytes(std::span(depths)).data());
    for (std::uint32_t k = 0; k < depths.size(); ++k) EXPECT_EQ(depths[k], static_cast<float>(3 + k / kStillWidth));
    still.begin_interval(kInterval + 1, kAll);
    EXPECT_TRUE(still.keeps(11)) << "whoever reads lines waits until they are written";
  });
}

constexpr std::uint32_t kCasting = 2;

StillLines casting_lines_of(const Neighbours& neighbours, std::uint64_t bytes, std::uint32_t samples) {
  return {neighbours, kStillWidth, kStillHeight, shape::sample_pattern(samples), bytes, kCasting};
}

wire::StillPairs pairs_of(std::uint32_t line, std::uint32_t p, std::uint32_t groups) {
  if (!shows(p % kStillWidth, groups)) return {0, 0};
  return {static_cast<std::uint16_t>(100 * line + p), static_cast<std::uint16_t>(~p)};
}

// As write() above, with light that is not summed up and pairs.
bool write_unsummed(StillLines& still, std::uint32_t line, std::uint32_t groups, std::uint32_t samples) {
  if (!still.begin_line(line, groups)) return false;
  for (std::uint32_t s = 0; s < samples; ++s)
    for (std::uint32_t x = 0; x < kStillWidth; ++x) still.depth(line, s)[x] = depth_of(line, s, x, groups);
  const UnsummedStill out = still.unsummed(line);
  for (std::uint32_t x = 0; x < kStillWidth; ++x) out.end[x] = end_of(x, groups);
  for (std::uint32_t p = 0; p < kCasting * kStillWidth; ++p) out.pairs[p] = pairs_of(line, p, groups);
  for (std::uint32_t k = 0; k < groups; ++k) {
    wire::UnsummedGroup& group = out.group(k);
    group = {k % (1u << samples), 0.25f, {static_cast<float>(line), 0.5f, static_cast<float>(k)}};
    for (std::uint32_t t = 0; t < 3 * kCasting; ++t) group.terms()[t] = static_cast<float>(10 * k + t);
  }
  return true;
}

void expect_unsummed(StillLines& still, std::uint32_t line, std::uint32_t groups, std::uint32_t samples) {
  ASSERT_TRUE(still.keeps(line)) << line;
  for (std::uint32_t s = 0; s < samples; ++s)
    for (std::uint32_t x = 0; x < kStillWidth; ++x) ASSERT_EQ(still.depth(line, s)[x], depth_of(line, s, x, groups));
  const UnsummedStill kept = still.unsummed(line);
  for (std::uint32_t x = 0; x < kStillWidth; ++x) ASSERT_EQ(kept.end[x], end_of(x, groups));
  for (std::uint32_t p = 0; p < kCasting * kStillWidth; ++p) {
    ASSERT_EQ(kept.pairs[p].lit, pairs_of(line, p, groups).lit);
    ASSERT_EQ(kept.pairs[p].blocked, pairs_of(line, p, groups).blocked);
  }
  for (std::uint32_t k = 0; k < groups; ++k) {
    const wire::UnsummedGroup& group = kept.group(k);
    ASSERT_EQ(group.samples, k % (1u << samples));
    ASSERT_EQ(group.fog, 0.25f);
    ASSERT_EQ(group.base[0], static_cast<float>(line));
    ASSERT_EQ(group.base[2], static_cast<float>(k));
    for (std::uint32_t t = 0; t < 3 * kCasting; ++t) ASSERT_EQ(group.terms()[t], static_cast<float>(10 * k + t));
  }
}

// With one sample, too, for pairs and groups are needed then.
TEST(StillLines, WhereLightsCastComeBackAndTravel) {
  as_node([](const Neighbours& alone) {
    for (const std::uint32_t samples : {1u, 4u}) {
      StillLines still = casting_lines_of(alone, 1 << 20, samples), other = casting_lines_of(alone, 1 << 20, samples);
      EXPECT_TRUE(still.has_groups());
      const std::uint32_t most = samples * kStillWidth;
      for (StillLines* lines : {&still, &other}) lines->begin_interval(kInterval, {1, 8});
      for (std::uint32_t line = 1; line < 7; ++line) ASSERT_TRUE(write_unsummed(still, line, most - line, samples));
      for (std::uint32_t line = 1; line < 7; ++line) expect_unsummed(still, line, most - line, samples);
      EXPECT_FALSE(still.keeps(7)) << "not written";
      for (std::uint32_t line = 1; line < 7; ++line) {
        const auto bytes = packed(still, line);
        EXPECT_LE(bytes.size(), still.most_packed());
        ASSERT_TRUE(other.is_packed(bytes));
        other.unpack(bytes);
      }
      for (std::uint32_t line = 1; line < 7; ++line) expect_unsummed(other, line, most - line, samples);
    }
  });
}

TEST(StillLines, WhereLightsCastThatDoNotFitAreNotKept) {
  as_node([](const Neighbours& alone) {
    const wire::StillPlan ample = wire::plan_still_lines(kStillWidth, kStillHeight, kSamples, 1 << 20, kCasting);
    EXPECT_EQ(ample.groups_per_column, kSamples);
    EXPECT_EQ(ample.lines, kStillHeight);
    for (const std::uint64_t lines : {0u, 1u, 3u}) {
      StillLines still = casting_lines_of(alone, lines * ample.line_bytes, kSamples);
      still.begin_interval(kInterval, kAll);
      std::uint32_t kept = 0;
      for (std::uint32_t line = 0; line < kStillHeight; ++line) {
        const bool written = write_unsummed(still, line, kStillWidth, kSamples);
        EXPECT_EQ(still.keeps(line), written);
        kept += written ? 1 : 0;
      }
      EXPECT_GE(kept, lines);
      for (std::uint32_t line = 0; line < kept; ++line) expect_unsummed(still, line, kStillWidth, kSamples);
    }
  });
}

TEST(StillLines, WhereLightsCastOfOtherMachinesAreSound) {
  as_node([](const Neighbours& alone) {
    StillLines still = casting_lines_of(alone, 1 << 20, kSamples);
    still.begin_interval(kInterval, {1, 8});
    write_unsummed(still, 3, 5, kSamples);
    const auto sound = packed(still, 3);
    ASSERT_TRUE(still.is_packed(sound));
    const std::size_t group = wire::still_packed_group_bytes(kCasting);
    for (const std::size_t less : {std::size_t{1}, std::size_t{4}, group, 5 * group, sound.size()})
      EXPECT_FALSE(still.is_packed(std::span(sound).first(sound.size() - less))) << less;
    const std::size_t counts = wire::still_head_bytes(kStillWidth), groups = sound.size() - 5 * group;
    EXPECT_FALSE(takes(still, sound, counts + kStillWidth - 1, 2)) << "more groups than the line has";
    EXPECT_FALSE(takes(still, sound, groups + group, 0xff)) << "more samples than a pixel has";
    EXPECT_TRUE(takes(still, sound, groups - 1, 0xff)) << "any pairs";
    EXPECT_TRUE(takes(still, sound, groups + 4, 0xff)) << "light of any amount";
  });
}

constexpr std::uint32_t kWide = 40, kOfTile = 3;  // columns of a line; groups of a marked tile
constexpr std::uint32_t kMarked[] = {1, 3};       // tiles

bool has_some(std::uint32_t column) { return column == 8 || column == 24; }
bool is_marked(std::uint32_t column) { return column / wire::kStillTile == 1 || column / wire::kStillTile == 3; }

void mark(StillLines& still) {
  still.marks().clear();
  for (const std::uint32_t tile : kMarked) still.marks().mark({0, kStillHeight}, {8 * tile, 8 * tile + 1});
}

// Three groups on the first column of each marked tile; depths and pairs there, and on columns that are not kept.
void write_marked(StillLines& still, std::uint32_t line, std::uint32_t casting) {
  ASSERT_TRUE(still.begin_line(line, 2 * kOfTile));
  std::vector<float> depths(kWide);
  for (std::uint32_t s = 0; s < kSamples; ++s) {
    for (std::uint32_t x = 0; x < kWide; ++x)
      depths[x] = is_marked(x) && !has_some(x) ? 0 : static_cast<float>(100 * s + x + 1);
    EXPECT_EQ(still.keep_depths(line, s, depths.data()), 16u);
  }
  std::uint32_t* const end = casting > 0 ? still.unsummed(line).end : still.groups(line).end;
  for (std::uint32_t x = 0; x < kWide; ++x) end[x] = x < 8 ? 0 : x < 24 ? kOfTile : 2 * kOfTile;
  for (std::uint32_t k = 0; k < 2 * kOfTile; ++k)
    if (casting > 0)
      still.unsummed(line).group(k) = {k, 0.5f, {1, 2, 3}};
    else
      still.groups(line).groups[k] = {{1, 2, 3}, k};
  std::vector<wire::StillPairs> pairs(std::size_t{casting} * kWide);
  for (std::uint32_t p = 0; p < pairs.size(); ++p)
    if (has_some(p % kWide) || !is_marked(p % kWide)) pairs[p] = {static_cast<std::uint16_t>(p + 1), 7};
  if (casting > 0) still.keep_pairs(line, pairs.data());
}

// All of them, as an interval before did.
void write_all(StillLines& still, std::uint32_t line, std::uint32_t casting) {
  still.marks().mark_all();
  ASSERT_TRUE(still.begin_line(line, kWide));
  const std::vector<float> depths(kWide, 99.0f);
  for (std::uint32_t s = 0; s < kSamples; ++s) still.keep_depths(line, s, depths.data());
  std::fill_n(casting > 0 ? still.unsummed(line).end : still.groups(line).end, kWide, kWide);
  const std::vector<wire::StillPairs> pairs(std::size_t{casting} * kWide, wire::StillPairs{5, 5});
  if (casting > 0) still.keep_pairs(line, pairs.data());
}

void expect_marked(StillLines& still, std::uint32_t line, std::uint32_t casting) {
  ASSERT_TRUE(still.keeps(line));
  for (std::uint32_t s = 0; s < kSamples; ++s) {
    std::vector<float> depths(kWide);
    still.take_depths(line, s, {3, kWide - 12}, depths.data());
    for (std::uint32_t x = 0; x < kWide; ++x)
      EXPECT_EQ(depths[x], has_some(x) && x < kWide - 12 ? static_cast<float>(100 * s + x + 1) : 0.0f) << x;
  }
  const std::uint32_t* const end = casting > 0 ? still.unsummed(line).end : still.groups(line).end;
  for (std::uint32_t x = 0; x < kWide; ++x) {
    EXPECT_EQ(has_column(still.columns(line), x), is_marked(x));
    EXPECT_EQ(end[x] - (x == 0 ? 0 : end[x - 1]), has_some(x) ? kOfTile : 0) << x;
    for (std::uint32_t l = 0; l < casting; ++l) {
      const wire::StillPairs pairs = still.unsummed(line).pairs[l * kWide + x];
      EXPECT_EQ(pairs.lit, has_some(x) ? l * kWide + x + 1 : 0u);
      EXPECT_EQ(pairs.blocked, has_some(x) ? 7u : 0u);
    }
  }
}

// On other columns there is nothing, whatever was there before; they do not travel.
TEST(StillLines, AreKeptOnMarkedColumnsAlone) {
  as_node([](const Neighbours& alone) {
    for (const std::uint32_t casting : {0u, kCasting}) {
      const auto lines = [&] {
        return StillLines(alone, kWide, kStillHeight, shape::sample_pattern(kSamples), 1 << 20, casting);
      };
      StillLines home = lines(), other = lines();
      for (StillLines* still : {&home, &other}) {
        still->begin_interval(kInterval, {1, 8});
        for (std::uint32_t line = 1; line < 8; ++line) write_all(*still, line, casting);
        still->begin_interval(kInterval + 1, {1, 8});
      }
      mark(home);
      for (std::uint32_t line = 1; line < 8; ++line) {
        write_marked(home, line, casting);
        expect_marked(home, line, casting);
        const auto bytes = packed(home, line);
        EXPECT_EQ(bytes.size(), wire::still_head_bytes(kWide) + 16 + 2 * wire::still_packed_bytes(kSamples, casting) +
                                    2 * kOfTile * wire::still_packed_group_bytes(casting));
        ASSERT_TRUE(other.is_packed(bytes));
        other.unpack(bytes);
        expect_marked(other, line, casting);
      }
    }
  });
}

TEST(StillLines, ALineWithoutColumnsIsKept) {
  as_node([](const Neighbours& alone) {
    StillLines home = lines_of(alone, kAmple), other = lines_of(alone, kAmple);
    for (StillLines* still : {&home, &other}) still->begin_interval(kInterval, kAll);
    home.marks().clear();
    ASSERT_TRUE(home.begin_line(5, 0));
    const auto bytes = packed(home, 5);
    EXPECT_EQ(bytes.size(), wire::still_head_bytes(kStillWidth));
    ASSERT_TRUE(other.is_packed(bytes));
    other.unpack(bytes);
    EXPECT_TRUE(other.keeps(5));
    EXPECT_FALSE(any(other.columns(5)));
  });
}

TEST(StillLines, MarkedColumnsOfOtherMachinesAreSound) {
  as_node([](const Neighbours& alone) {
    StillLines still(alone, kWide, kStillHeight, shape::sample_pattern(kSamples), 1 << 20, kCasting);
    still.begin_interval(kInterval, {1, 8});
    mark(still);
    write_marked(still, 3, kCasting);
    const auto sound = packed(still, 3);
    const auto takes = [&](std::uint64_t tiles) {
      auto damaged = sound;
      std::memcpy(damaged.data() + wire::kStillHeadBytes, &tiles, sizeof tiles);
      return still.is_packed(damaged);
    };
    EXPECT_TRUE(takes(0b01010));
    EXPECT_FALSE(takes(0b01011)) << "more columns than come";
    EXPECT_FALSE(takes(0b00010)) << "fewer";
    EXPECT_FALSE(takes(0b1000010)) << "beyond the line";
  });
}

// CZB alone: all nodes know the columns.
TEST(StillLines, WithOneSampleMarkedColumnsTravel) {
  as_node([](const Neighbours& alone) {
    StillLines home(alone, kWide, kStillHeight, shape::sample_pattern(1), 0),
        other(alone, kWide, kStillHeight, shape::sample_pattern(1), 0);
    std::vector<float> depths(kWide);
    for (std::uint32_t x = 0; x < kWide; ++x) depths[x] = static_cast<float>(x + 1);
    for (StillLines* still : {&home, &other}) {
      still->begin_interval(kInterval, {2, kStillHeight});
      mark(*still);
    }
    for (std::uint32_t line = 3; line < 6; ++line) {
      ASSERT_TRUE(home.begin_line(line, 0));
      EXPECT_EQ(home.keep_depths(line, 0, depths.data()), 16u);
    }
    std::vector<std::byte> bytes(home.depth_bytes({3, 6}));
    EXPECT_EQ(bytes.size(), 3 * 16 * sizeof(float));
    home.pack_depths({3, 6}, bytes.data());
    other.unpack_depths({3, 6}, bytes.data());
    for (std::uint32_t line = 3; line < 6; ++line) {
      std::vector<float> taken(kWide);
      other.take_depths(line, 0, {0, kWide}, taken.data());
      for (std::uint32_t x = 0; x < kWide; ++x) EXPECT_EQ(taken[x], is_marked(x) ? depths[x] : 0.0f);
    }
  });
}

}  // namespace
}  // namespace mars::raster
