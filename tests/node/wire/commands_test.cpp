// Commands as a host should not send them: each is refused before anything of it is used.
#include "node/wire/greeting.h"
#include "node/wire/commands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hal/failure/failure.h"
#include "tests/node/wire/small_film.h"

namespace mars::wire {
namespace {

using Bytes = std::vector<std::byte>;

template <typename Head, typename Item>
Bytes message(const Head& head, const std::vector<Item>& items) {
  Bytes bytes(sizeof head + items.size() * sizeof(Item));
  std::memcpy(bytes.data(), &head, sizeof head);
  if (!items.empty()) std::memcpy(bytes.data() + sizeof head, items.data(), items.size() * sizeof(Item));
  return bytes;
}

// What `read` says against it; "" if nothing.
std::string refusal(const std::function<void()>& read) {
  try {
    read();
  } catch (const Failure& failure) {
    return failure.what();
  }
  return "";
}

class LoadCommands : public testing::Test {
 protected:
  LoadCommands() {
    load_.stamp = own_stamp();
    load_.film_bytes = 1000;
    load_.credits = 2;
    load_.groups = 2;
  }
  std::string said() const {
    return refusal([this] { read_load(message(load_, machines_), 3, "n1 (node 1)"); });
  }

  Load load_{};
  std::vector<std::int32_t> machines_{0, 0, 2};
};

TEST_F(LoadCommands, SoundOnesAreTaken) {
  EXPECT_EQ(said(), "");
  const Bytes bytes = message(load_, machines_);
  const LoadCommand command = read_load(bytes, 3, "n1 (node 1)");
  EXPECT_EQ(command.load.credits, 2);
  EXPECT_EQ(command.machines[2], 2);
}

TEST_F(LoadCommands, AnotherVersionIsSeenFirst) {
  load_.stamp.wire = 200;
  machines_.clear();
  EXPECT_NE(said().find("the host runs MARS"), std::string::npos);
  EXPECT_NE(said().find("(wire 200), n1 (node 1) runs MARS"), std::string::npos);
  EXPECT_NE(refusal([] { read_load({}, 3, "n1 (node 1)"); }).find("the host is not MARS"), std::string::npos);
}

TEST_F(LoadCommands, OfAnotherSize) {
  machines_.pop_back();
  EXPECT_NE(said().find("its size"), std::string::npos);
  machines_ = {0, 0, 0, 0};
  EXPECT_NE(said().find("its size"), std::string::npos);
  Bytes bytes = message(load_, std::vector<std::int32_t>{0, 0, 0});
  bytes.pop_back();
  EXPECT_NE(refusal([&] { read_load(bytes, 3, ""); }).find("its size"), std::string::npos);
}

TEST_F(LoadCommands, WithValuesThatMakeNoSense) {
  const auto refused = [this](const auto& spoil) {
    const Load sound = load_;
    const auto machines = machines_;
    spoil();
    const bool is = !said().empty();
    load_ = sound;
    machines_ = machines;
    return is;
  };
  EXPECT_TRUE(refused([&] { load_.film_bytes = 0; }));
  EXPECT_TRUE(refused([&] { load_.credits = 0; }));
  EXPECT_TRUE(refused([&] { load_.credits = kMaxCredits + 1; }));
  EXPECT_TRUE(refused([&] { load_.groups = 0; }));
  EXPECT_TRUE(refused([&] { load_.groups = 4; }));
  EXPECT_TRUE(refused([&] { load_.traced = 2; }));
  EXPECT_TRUE(refused([&] { load_.live = 2; }));
  EXPECT_TRUE(refused([&] { load_.live = 1; })) << "of two groups";
  EXPECT_TRUE(refused([&] { load_.mapping = static_cast<Mapping>(3); }));
  EXPECT_TRUE(refused([&] { load_.exchange = static_cast<Exchange>(3); }));
  EXPECT_TRUE(refused([&] { load_.pixel_format = with_layers(PixelFormat::rgb8, kAllLayers, 4); }));
  EXPECT_TRUE(refused([&] { load_.pixel_format = static_cast<PixelFormat>(4u << 16); })) << "samples of no layers";
  EXPECT_TRUE(refused([&] {
    load_.groups = load_.live = 1;
    load_.pixel_format = with_layers(PixelFormat::half, kAllLayers, 4);
  })) << "live views have no layers";
  EXPECT_TRUE(refused([&] { machines_[0] = 1; }));
  EXPECT_TRUE(refused([&] { machines_[2] = -1; }));
  EXPECT_TRUE(refused([&] { machines_[2] = 1; })) << "node 1 is on machine 0";
  EXPECT_FALSE(refused([] {}));
}

// The lists of a pixel's surfaces are as long as the film's pixels have samples.
TEST(LoadedFilms, HaveAsManySamplesAsTheFormatOfLayersSays) {
  const auto refused = [](PixelFormat format, std::uint32_t samples) {
    return !refusal([&] { check_pixels(format, samples); }).empty();
  };
  EXPECT_FALSE(refused(PixelFormat::rgb8, 4));
  EXPECT_FALSE(refused(with_layers(PixelFormat::half_alpha, kAllLayers, 4), 4));
  EXPECT_TRUE(refused(with_layers(PixelFormat::half, kAllLayers, 1), 4));
  EXPECT_TRUE(refused(with_layers(PixelFormat::half, kAllLayers, 1000), 4));
}

// Of a film of intervals 0-1 and 2; node 1 of five, which form two groups: 0-1 and 2-4.
class RenderCommands : public testing::Test {
 protected:
  RenderCommands() : block_(pack(small_film())) {
    words_.resize((block_.size() + 7) / 8);
    std::memcpy(words_.data(), block_.data(), block_.size());
  }
  PackedFilm film() const { return {std::as_bytes(std::span(words_)).first(block_.size()), "film"}; }
  RenderCommand read(const Bytes& bytes) const { return read_render(bytes, film(), {1, 5, 2, left_}, frames_); }
  bool refused(const Render& render, const std::vector<std::uint32_t>& list) const {
    return !refusal([&] { read(message(render, list)); }).empty();
  }

  std::vector<std::byte> block_;
  std::vector<std::uint64_t> words_;
  const Render sound_{0, 0, 2, 2, 2, 0, 7, 2, 0, 1, 0};
  std::vector<std::uint32_t> left_;  // for Renders that go on
  mutable std::vector<std::uint32_t> frames_;
};

TEST_F(RenderCommands, SoundOnesAreTaken) {
  const Bytes bytes = message(sound_, std::vector<std::uint32_t>{0, 1});
  const RenderCommand command = read(bytes);
  EXPECT_EQ(command.render.first_inbetween, 7u);
  EXPECT_EQ(command.frames[1], 1u);
  EXPECT_FALSE(refused({1, 0, 2, 1, 1, 0, 0, 1, 0, 1, 0}, {2}));
}

TEST_F(RenderCommands, FramesThatFollowEachOtherNeedNoList) {
  const Bytes bytes = message(Render{0, 0, 2, 2, 2, 0, 7, 2, 0, 0, 0}, std::vector<std::uint32_t>{});
  EXPECT_TRUE(std::ranges::equal(read(bytes).frames, std::vector{0u, 1u}));
  EXPECT_TRUE(refused({0, 0, 2, 2, 3, 0, 7, 3, 0, 0, 0}, {})) << "beyond the interval";
  EXPECT_TRUE(refused({0, 0, 2, 2, 0xffffffff, 0, 7, 0xffffffff, 0, 0, 0}, {}));
  EXPECT_TRUE(refused({0, 0, 2, 2, 2, 0xffffffff, 7, 2, 0, 0, 0}, {}));
  EXPECT_TRUE(refused({0, 0, 2, 2, 2, 0, 7, 2, 0, 0, 0}, {0, 1})) << "a list, too";
  EXPECT_TRUE(refused({0, 0, 2, 2, 2, 0, 7, 2, 0, 2, 0}, {0, 1}));
}

TEST_F(RenderCommands, ACycleFollowsTheFrames) {
  Render render = sound_;
  render.cycle = 3;
  const Bytes bytes = message(render, std::vector<std::uint32_t>{0, 1, 1, 1, 0});
  const RenderCommand command = read(bytes);
  EXPECT_TRUE(std::ranges::equal(command.frames, std::vector{0u, 1u}));
  EXPECT_TRUE(std::ranges::equal(command.cycle, std::vector{1, 1, 0}));
  EXPECT_EQ(command.team(0), (collectives::Group{1, 1})) << "inbetween 7 of the film";
  EXPECT_EQ(command.team(1), (collectives::Group{0, 1}));
  EXPECT_TRUE(refused(render, {0, 1, 1, 1, 2})) << "of two nodes";
  EXPECT_TRUE(refused(render, {0, 1, 1, 1, 0xffffffff}));
  EXPECT_TRUE(refused(render, {0, 1, 1, 1}));
  EXPECT_TRUE(refused(render, {0, 1, 1, 1, 0, 0}));
}

TEST_F(RenderCommands, SomeFramesMayBeLeftForLater) {
  Render render = sound_;
  render.drawn = 1;
  const Bytes bytes = message(render, std::vector<std::uint32_t>{0, 1});
  EXPECT_TRUE(read(bytes).inbetweens().empty());
  EXPECT_TRUE(std::ranges::equal(read(bytes).left(), std::vector{1u}));
  for (const std::uint32_t drawn : {0u, 3u, 0xffffffffu}) {
    render.drawn = drawn;
    EXPECT_TRUE(refused(render, {0, 1})) << drawn;
  }
}

TEST_F(RenderCommands, ThatGoOnHaveTheNextOfThoseLeft) {
  Render render{0, 0, 2, 2, 1, 1, 7, 1, 0, 0, 1};
  EXPECT_TRUE(refused(render, {})) << "nothing is left";
  left_ = {1};
  const Bytes bytes = message(render, std::vector<std::uint32_t>{});
  EXPECT_TRUE(std::ranges::equal(read(bytes).inbetweens(), std::vector{1u}));
  EXPECT_TRUE(read(bytes).left().empty());
  left_ = {0, 1};
  EXPECT_TRUE(refused(render, {})) << "not the next";
  left_ = {1};
  EXPECT_TRUE(refused({0, 0, 2, 2, 2, 0, 7, 2, 0, 0, 1}, {})) << "more than are left";
  EXPECT_TRUE(refused({0, 0, 2, 2, 1, 1, 7, 1, 0, 0, 2}, {}));
  left_ = {0, 1};
  EXPECT_TRUE(refused({0, 0, 2, 2, 2, 0, 7, 1, 0, 0, 1}, {})) << "it draws them all";
}

TEST_F(RenderCommands, OfNoSuchContributors) {
  EXPECT_TRUE(refused({0, 0, 2, 0, 2, 0, 7, 2, 0, 1, 0}, {0, 1}));
  EXPECT_TRUE(refused({0, 0, 2, 3, 2, 0, 7, 2, 0, 1, 0}, {0, 1}));
  EXPECT_FALSE(refused({0, 0, 2, 1, 2, 0, 7, 2, 0, 1, 0}, {0, 1}));
}

TEST_F(RenderCommands, OfNoSuchTeams) {
  Render render = sound_;
  for (const std::int32_t teams : {-1, 3}) {
    render.teams = teams;
    EXPECT_TRUE(refused(render, {0, 1})) << teams;
  }
  for (const std::int32_t teams : {0, 1, 2}) {
    render.teams = teams;
    EXPECT_FALSE(refused(render, {0, 1})) << teams;
  }
  render.teams = 1;
  render.cycle = 1;
  EXPECT_FALSE(refused(render, {0, 1, 0}));
  EXPECT_TRUE(refused(render, {0, 1, 1})) << "there is one team";
}

TEST_F(RenderCommands, OfAnotherSize) {
  EXPECT_TRUE(refused(sound_, {0}));
  EXPECT_TRUE(refused(sound_, {0, 1, 1}));
  EXPECT_TRUE(refused({0, 0, 2, 1, 0, 0, 0, 0, 0, 1, 0}, {}));
  EXPECT_TRUE(refused({0, 0, 2, 1, 0xffffffff, 0, 0, 0xffffffff, 0, 1, 0}, {0, 1}));
  EXPECT_FALSE(refusal([this] { read({}); }).empty());
  Bytes bytes = message(sound_, std::vector<std::uint32_t>{0, 1});
  bytes.push_back({});
  EXPECT_FALSE(refusal([&] { read(bytes); }).empty());
}

TEST_F(RenderCommands, ForOthersOrOfNoSuchFrames) {
  EXPECT_TRUE(refused({2, 0, 2, 1, 1, 0, 0, 1, 0, 1, 0}, {2})) << "no such interval";
  EXPECT_TRUE(refused({0, 2, 3, 1, 2, 0, 0, 2, 0, 1, 0}, {0, 1})) << "another group's";
  EXPECT_TRUE(refused({0, 0, 3, 1, 2, 0, 0, 2, 0, 1, 0}, {0, 1})) << "no group";
  EXPECT_TRUE(refused({0, -1, 3, 1, 2, 0, 0, 2, 0, 1, 0}, {0, 1}));
  EXPECT_TRUE(refused(sound_, {1, 0}));
  EXPECT_TRUE(refused(sound_, {1, 1}));
  EXPECT_TRUE(refused(sound_, {1, 2})) << "beyond the interval";
  EXPECT_TRUE(refused({1, 0, 2, 1, 1, 0, 0, 1, 0, 1, 0}, {1})) << "before the interval";
}

TEST(BeginViewCommands, HaveTheirScene) {
  const auto block = pack_scene(small_scene());
  const auto refused = [&](const BeginView& view, std::size_t bytes) {
    return !refusal([&] {
              read_begin_view(message(view, Bytes(block.begin(), block.begin() + static_cast<long>(bytes))));
            }).empty();
  };
  EXPECT_FALSE(refused({63, 1, block.size(), 0, 0}, block.size()));
  EXPECT_TRUE(refused({64, 1, block.size(), 0, 0}, block.size()));
  EXPECT_TRUE(refused({0, 1, block.size() + 1, 0, 0}, block.size()));
  EXPECT_TRUE(refused({0, 1, ~std::uint64_t{0}, 0, 0}, block.size()));
  EXPECT_TRUE(refused({0, 1, block.size(), 0, 0}, block.size() - 1));
  EXPECT_FALSE(refusal([] { read_begin_view({}); }).empty());
}

TEST(CloseViewCommands, NameAView) {
  const auto refused = [](std::uint32_t view) {
    return !refusal([&] { read_close_view(message(CloseView{view}, Bytes())); }).empty();
  };
  EXPECT_FALSE(refused(63));
  EXPECT_TRUE(refused(64));
  EXPECT_FALSE(refusal([] { read_close_view({}); }).empty());
}

// Of view 5, in which segment 1 of three moves, with the block's first two patches.
class DrawCommands : public testing::Test {
 protected:
  bool refused(const Draw& draw, const std::vector<MovedSegment>& segments,
               const std::vector<MovedPatch>& patches = {}) {
    Bytes bytes = message(draw, segments);
    const Bytes more = message(draw, patches);
    bytes.insert(bytes.end(), more.begin() + sizeof draw, more.end());
    return !refusal([&] {
              read_draw(bytes, [this](std::uint32_t view) { return view == 5 ? &moving_ : nullptr; });
            }).empty();
  }
  bool refused(const MovedSegment& segment) { return refused({5, 1, 1, 0}, {segment}); }
  bool refused(const MovedPatch& patch) { return refused({5, 1, 0, 1}, {}, {patch}); }

  const Bytes film_block_ = pack(small_film()), scene_block_ = pack_scene(small_scene());
  const PackedFilm film_{film_block_, "film"};
  const PackedFilm scene_{scene_block_, film_, "scene"};
  const MovingParts moving_{scene_};
};

TEST_F(DrawCommands, SoundOnesAreTaken) {
  EXPECT_FALSE(refused({5, 1, 0, 0}, {}));
  EXPECT_FALSE(refused({5, 1, 2, 1}, {{1, 0, moved(2)}, {1, 1, moved(1)}}, {{1, 0, flat_patch()}}));
}

TEST_F(DrawCommands, OfAnotherSizeOrView) {
  EXPECT_TRUE(refused({5, 1, 1, 0}, {}));
  EXPECT_TRUE(refused({5, 1, 0, 0}, {{1, 0, moved(2)}}));
  EXPECT_TRUE(refused({5, 1, ~0u, ~0u}, {{1, 0, moved(2)}}));
  EXPECT_TRUE(refused({4, 1, 0, 0}, {}));
  EXPECT_TRUE(refused({64, 1, 0, 0}, {}));
  EXPECT_FALSE(refusal([] { read_draw({}, [](std::uint32_t) { return nullptr; }); }).empty());
}

TEST_F(DrawCommands, OfWhatDoesNotMove) {
  for (const std::uint32_t segment : {0u, 2u, 3u, ~0u}) EXPECT_TRUE(refused(MovedSegment{segment, 0, moved(1)}));
  for (const std::uint32_t patch : {2u, 3u, 4u, ~0u}) EXPECT_TRUE(refused(MovedPatch{patch, 0, flat_patch()}));
}

TEST_F(DrawCommands, WithValuesThatMakeNoSense) {
  EXPECT_TRUE(refused(MovedSegment{1, 2, moved(1)}));
  EXPECT_TRUE(refused(MovedSegment{1, 0, moved(1e13)}));
  EXPECT_TRUE(refused(MovedSegment{1, 0, moved(std::nan(""))}));
  Patch patch = flat_patch();
  patch.points[7][1] = INFINITY;
  EXPECT_TRUE(refused(MovedPatch{1, 0, patch}));
}

TEST(Scenes, AreRefusedWhereTheyAreNone) {
  const Bytes film_block = pack(small_film());
  const PackedFilm film(film_block, "film");
  const auto refused = [&](const auto& spoil) {
    FilmData scene = small_scene();
    spoil(scene);
    const Bytes block = pack(scene);
    return !refusal([&] { PackedFilm(block, film, "scene"); }).empty();
  };
  EXPECT_FALSE(refused([](FilmData&) {}));
  EXPECT_TRUE(refused([](FilmData& scene) { scene.settings.frames = 2, scene.intervals[0].frame_count = 2; }));
  EXPECT_TRUE(refused([](FilmData& scene) { scene.segments[0].shape = 5; })) << "three of the film, two of its own";
  EXPECT_TRUE(refused([](FilmData& scene) { scene.shapes[1].patch_count = 3; }));
  EXPECT_TRUE(refused([](FilmData& scene) { scene.shapes[1].meshlet_count = 1; })) << "the film's";
  EXPECT_TRUE(
      refused([](FilmData& scene) { scene.moving = {std::uint32_t(scene.segments.size() + scene.bones.size())}; }));
  EXPECT_TRUE(refused([](FilmData& scene) { scene.intervals.clear(); }));
  EXPECT_TRUE(refused([](FilmData& scene) { scene.settings.width = kMaxSide + 1; }));
  EXPECT_TRUE(refused([](FilmData& scene) {
    scene.mesh_places = {{0, 0, 0}};
    scene.mesh_normals = {{0, 0, 1}};
  }));
}

// Patches that a stationary segment shows too stand still.
TEST(Scenes, KnowWhatMoves) {
  const Bytes film_block = pack(small_film());
  const PackedFilm film(film_block, "film");
  FilmData data = small_scene();
  data.shapes = {{0, 3}, {2, 2}};
  const Bytes block = pack_scene(data);
  const PackedFilm scene(block, film, "scene");
  const MovingParts moving(scene);
  EXPECT_TRUE(moving.has_patch(0) && moving.has_patch(1));
  EXPECT_FALSE(moving.has_patch(2) || moving.has_patch(3) || moving.has_patch(4));
  EXPECT_EQ(scene.patches_of(1).data(), film.patches().data() + 2);
  EXPECT_EQ(scene.patches_of(4).data(), scene.patches().data() + 2);
  EXPECT_EQ(scene.meshlets_of(1).data(), film.meshlets().data());
}

// A segment's material is that of all of it.
TEST(Scenes, ChangeSkinsWhollyWhereAllTheirBonesMove) {
  const Bytes film_block = pack(small_film());
  const PackedFilm film(film_block, "film");
  FilmData data = small_scene();
  data.segments[2] = {2, 0, {0, 1}, {0, 1}, 0, 0, 2};
  data.bones = {{0, 1}, {0, 1}};
  for (const auto& [moving, whole] : {std::pair{std::vector<std::uint32_t>{2, 4}, false}, {{2, 3, 4}, true}}) {
    data.moving = moving;
    data.intervals = {{0, 1, 0, std::uint32_t(moving.size())}};
    const Bytes block = pack_scene(data);
    const PackedFilm scene(block, film, "scene");
    const MovingParts parts(scene);
    EXPECT_EQ(parts.has_segment(2), whole);
    EXPECT_EQ(parts.has_segment(3), whole);
    EXPECT_TRUE(parts.has_segment(4));
    EXPECT_FALSE(parts.has_segment(5) || parts.are_all());
  }
}

// Slot 1 of three is the node's.
TEST(CreditCommands, GiveASlotThatIsTheHosts) {
  const auto refused = [](std::uint32_t slot, std::uint32_t by_message) {
    const Credit credit{slot, by_message};
    return !refusal([&] { read_credit(std::as_bytes(std::span(&credit, 1)), 0b010, 3); }).empty();
  };
  EXPECT_FALSE(refused(0, 0));
  EXPECT_FALSE(refused(2, 1));
  EXPECT_TRUE(refused(1, 0));
  EXPECT_TRUE(refused(3, 0));
  EXPECT_TRUE(refused(32, 0));
  EXPECT_TRUE(refused(~0u, 0));
  EXPECT_TRUE(refused(0, 2));
  EXPECT_FALSE(refusal([] { read_credit({}, 0, 3); }).empty());
}

}  // namespace
}  // namespace mars::wire
