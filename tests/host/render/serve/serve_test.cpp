// A serving host and its nodes against a studio that is this test.
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <vector>

#include "host/content/film/compile.h"
#include "tests/host/render/serve/scenes.h"
#include "tests/host/render/serve/studio_end.h"
#include "tests/render/film_run.h"

namespace {

using namespace mars;
using pictures::Kind;
using test::StudioEnd;

constexpr std::uint32_t kView = 3;

// A film, small, and its frames as they are rendered to files.
struct Example {
  explicit Example(std::uint32_t samples_a_pixel) : samples(samples_a_pixel) {}

  std::uint32_t samples;
  film::CompiledFilm film =
      film::load_film(MARS_EXAMPLES "/caterpillar.json", {.size = {{160, 100}}, .samples = samples});
  wire::PackedFilm view = film.view();
  const wire::Interval* interval = longest();
  std::uint32_t first = interval->first_frame;
  test::Moves movers = test::movers_at(view, first);
  test::FilmRun rendered = render();

  const wire::Interval* longest() const {
    return &*std::ranges::max_element(view.intervals(), {}, &wire::Interval::frame_count);
  }
  test::FilmRun render() const {
    test::RunOptions options;
    options.nodes = 2;
    options.work.frames = {first, first + 1, first + 2};
    return test::run_film(film.block(), options);
  }
  std::vector<std::byte> scene(std::uint32_t frame) const { return test::scene_of(view, frame, movers); }
  // Of which everything may move.
  std::vector<std::byte> moving_scene(std::uint32_t frame) const {
    return test::scene_of(view, frame, [](std::uint32_t) { return true; });
  }
  std::vector<wire::MovedSegment> moved(std::uint32_t frame) const { return test::moved_to(view, frame, movers); }
  const test::Pixels& frame(std::uint32_t number) const { return rendered.frames.at(number); }
};

const Example& example() {
  static const Example example(4);
  return example;
}

void start_with(const Example& film, StudioEnd& studio, int nodes, bool mpi = false) {
  ASSERT_GE(film.interval->frame_count, 3u);
  ASSERT_NO_FATAL_FAILURE(studio.start(nodes, mpi));
  studio.send(Kind::film, 0, 0, film.film.block());
  const auto answer = studio.receive();
  ASSERT_TRUE(answer) << studio.errors();
  const pictures::BeginMessage begin = pictures::read_begin(*answer);
  EXPECT_EQ(begin.nodes.size(), static_cast<std::size_t>(nodes));
  for (const pictures::Node& node : begin.nodes) EXPECT_EQ(node.machine, 0);
}

void start_with_film(StudioEnd& studio, int nodes, bool mpi = false) { start_with(example(), studio, nodes, mpi); }

// The next answer is this one.
void expect_answer(StudioEnd& studio, Kind kind, std::uint32_t view, std::uint32_t picture) {
  const auto answer = studio.receive();
  ASSERT_TRUE(answer) << studio.errors();
  EXPECT_EQ(answer->head.kind, kind);
  EXPECT_EQ(answer->head.view, view);
  EXPECT_EQ(answer->head.picture, picture);
}

// The host sees that the studio is gone, and nothing is left of it.
void expect_end(StudioEnd& studio) {
  studio.close();
  const auto ending = studio.ending();
  ASSERT_TRUE(ending);
  EXPECT_TRUE(ending->well()) << studio.errors();
  EXPECT_EQ(kill(-studio.host().id(), 0), -1);
}

void expect_frames_of_the_film(int nodes, bool mpi) {
  const Example& film = example();
  StudioEnd studio;
  ASSERT_NO_FATAL_FAILURE(start_with_film(studio, nodes, mpi));
  studio.send(Kind::scene, kView, 1, film.scene(film.first));
  ASSERT_NO_FATAL_FAILURE(expect_answer(studio, Kind::picture, kView, 1));
  EXPECT_EQ(studio.shown(kView), film.frame(film.first));
  EXPECT_EQ(studio.pixels_sent(kView), 160u * 100);
  for (std::uint32_t step : {1u, 2u, 0u, 1u}) {
    static std::uint32_t number = 1;
    studio.send_draw(kView, ++number, film.moved(film.first + step));
    ASSERT_NO_FATAL_FAILURE(expect_answer(studio, Kind::picture, kView, number));
    EXPECT_EQ(studio.shown(kView), film.frame(film.first + step)) << step;
    EXPECT_LT(studio.pixels_sent(kView), 160u * 100);
  }
  expect_end(studio);
}

TEST(Serve, PicturesAreTheFilmsFrames) { expect_frames_of_the_film(3, false); }

TEST(Serve, PicturesAreTheFilmsFramesOverMpi) {
  if (!MARS_HAVE_MPI) GTEST_SKIP() << "built without MPI";
  expect_frames_of_the_film(2, true);
}

// With one sample a pixel, for with several it counts where intervals are cut (docs/exactness.md).
TEST(Serve, WhereAllMovesPicturesAreTheSame) {
  const Example film(1);
  StudioEnd studio;
  ASSERT_NO_FATAL_FAILURE(start_with(film, studio, 2));
  for (std::uint32_t step = 0; step < 3; ++step) {
    studio.send(Kind::scene, kView, 1 + step, film.moving_scene(film.first + step));
    ASSERT_NO_FATAL_FAILURE(expect_answer(studio, Kind::picture, kView, 1 + step));
    EXPECT_EQ(studio.shown(kView), film.frame(film.first + step));
  }
  expect_end(studio);
}

// Of what is asked for at once, each is answered once; the last shows.
TEST(Serve, NewestWins) {
  const Example& film = example();
  StudioEnd studio;
  ASSERT_NO_FATAL_FAILURE(start_with_film(studio, 2));
  std::uint32_t picture = 0;
  for (int turn = 0; turn < 10; ++turn) {
    studio.send(Kind::scene, kView, ++picture, film.scene(film.first));
    for (std::uint32_t step : {1u, 2u, 0u, 2u, 1u}) studio.send_draw(kView, ++picture, film.moved(film.first + step));
  }
  std::vector<std::uint32_t> answered, pictures;
  while (answered.size() < picture) {
    const auto answer = studio.receive();
    ASSERT_TRUE(answer) << studio.errors();
    answered.push_back(answer->head.picture);
    if (answer->head.kind == Kind::picture) pictures.push_back(answer->head.picture);
  }
  EXPECT_FALSE(studio.has_answer(100));
  std::ranges::sort(answered);
  for (std::uint32_t i = 0; i < picture; ++i) EXPECT_EQ(answered[i], i + 1);
  EXPECT_TRUE(std::ranges::is_sorted(pictures));
  EXPECT_EQ(pictures.back(), picture);
  EXPECT_LT(pictures.size(), answered.size());
  EXPECT_EQ(studio.shown(kView), film.frame(film.first + 1));
  expect_end(studio);
}

TEST(Serve, ViewsAreIndependent) {
  const Example& film = example();
  StudioEnd studio;
  ASSERT_NO_FATAL_FAILURE(start_with_film(studio, 2));
  const film::CompiledFilm small = film::load_film(MARS_EXAMPLES "/caterpillar.json", {.size = {{90, 60}}});
  studio.send(Kind::scene, 0, 1, film.scene(film.first));
  studio.send(Kind::scene, 1, 2, test::scene_of(small.view(), film.first, film.movers));
  expect_answer(studio, Kind::picture, 0, 1);
  expect_answer(studio, Kind::picture, 1, 2);
  for (std::uint32_t round = 0; round < 5; ++round) {
    studio.send_draw(0, 3 + 2 * round, film.moved(film.first + 1 + round % 2));
    studio.send_draw(1, 4 + 2 * round, film.moved(film.first + 2));
    ASSERT_TRUE(studio.receive());
    ASSERT_TRUE(studio.receive());
  }
  EXPECT_EQ(studio.shown(0), film.frame(film.first + 1));
  EXPECT_EQ(studio.shown(1).size(), 90u * 60);
  studio.send(Kind::close, 0, 0);
  studio.send_draw(0, 20, film.moved(film.first));
  expect_answer(studio, Kind::dropped, 0, 20);
  studio.send_draw(1, 21, film.moved(film.first));
  expect_answer(studio, Kind::picture, 1, 21);
  expect_end(studio);
}

TEST(Serve, AnotherFilmEndsAllViews) {
  const Example& film = example();
  StudioEnd studio;
  ASSERT_NO_FATAL_FAILURE(start_with_film(studio, 2));
  studio.send(Kind::scene, kView, 1, film.scene(film.first));
  studio.send(Kind::film, 0, 0, film.film.block());
  studio.send_draw(kView, 2, film.moved(film.first));
  studio.send(Kind::scene, kView, 3, film.scene(film.first + 1));
  std::vector<Kind> kinds;
  do {
    const auto answer = studio.receive();
    ASSERT_TRUE(answer) << studio.errors();
    kinds.push_back(answer->head.kind);
  } while (kinds.back() != Kind::picture);
  EXPECT_EQ(std::ranges::count(kinds, Kind::dropped), 2);
  EXPECT_EQ(std::ranges::count(kinds, Kind::begin), 1);
  EXPECT_EQ(studio.shown(kView), film.frame(film.first + 1));
  expect_end(studio);
}

// Ends while nodes draw.
TEST(Serve, ClosedSocketEndsAllAtAnyTime) {
  const Example& film = example();
  for (const bool scene : {false, true}) {
    StudioEnd studio;
    ASSERT_NO_FATAL_FAILURE(start_with_film(studio, 2));
    if (scene) studio.send(Kind::scene, kView, 1, film.scene(film.first));
    expect_end(studio);
  }
}

// One message that makes no sense: the host says why, and ends.
void expect_refusal(const std::vector<std::byte>& message, const std::string& part) {
  StudioEnd studio;
  ASSERT_NO_FATAL_FAILURE(start_with_film(studio, 1));
  studio.send(Kind::scene, kView, 1, example().scene(example().first));
  expect_answer(studio, Kind::picture, kView, 1);
  studio.send_bytes(message);
  const auto answer = studio.receive();
  ASSERT_TRUE(answer) << studio.errors();
  EXPECT_EQ(answer->head.kind, Kind::refused);
  const std::string text(reinterpret_cast<const char*>(answer->body.data()), answer->body.size());
  EXPECT_NE(text.find(part), std::string::npos) << text;
  const auto ending = studio.ending();
  ASSERT_TRUE(ending);
  EXPECT_EQ(ending->code, 1) << studio.errors();
}

std::vector<std::byte> message_of(const pictures::Head& head, const std::vector<std::byte>& body = {}) {
  return pictures::joined(head, body);
}

TEST(Serve, MalformedMessagesAreRefused) {
  const auto kind = [](std::uint32_t number) { return static_cast<Kind>(number); };
  expect_refusal(message_of({kind(0), 0, 0, 0, 0}), "kind");
  expect_refusal(message_of({kind(77), 0, 0, 0, 0}), "kind");
  expect_refusal(message_of({Kind::scene, 1, 2, 0, (std::uint64_t{1} << 40) + 1}), "size");
  expect_refusal(message_of({Kind::draw, 1, 2, 0, 3}), "size");
  expect_refusal(message_of({Kind::close, 1, 0, 0, 8}, std::vector<std::byte>(8)), "size");
  expect_refusal(message_of({Kind::scene, wire::kMostViews, 2, 0, 8}), "view");
  expect_refusal(message_of({Kind::scene, 1, 1, 0, 8}, std::vector<std::byte>(8)), "ascend");
  expect_refusal(message_of({Kind::scene, 1, 2, 0, 64}, std::vector<std::byte>(64)), "scene");
  expect_refusal(message_of({Kind::film, 0, 0, 0, 64}, std::vector<std::byte>(64)), "film");
  const std::vector<std::byte> body = pictures::joined(pictures::DrawHead{1, 0});
  expect_refusal(message_of({Kind::draw, kView, 2, 0, body.size()}, body), "Draw");
}

}  // namespace
