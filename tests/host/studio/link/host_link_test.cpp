// The studio's link to hosts that it starts itself.
#include "host/studio/link/host_link.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "host/child/descriptor.h"
#include "host/child/process.h"
#include "host/content/film/compile.h"
#include "host/studio/link/host_job.h"
#include "tests/host/render/serve/scenes.h"
#include "tests/render/film_run.h"

namespace {

using namespace mars;
using studio::RendererLink;
using studio::SurfacePicture;

constexpr std::chrono::seconds kPatience{200};

// What /proc says of a process behind its name: state, parent, ...
std::vector<std::string> stat_of(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string line;
  std::getline(file, line);
  std::istringstream rest(line.substr(std::min(line.size(), line.rfind(')') + 1)));
  std::vector<std::string> words;
  for (std::string word; rest >> word;) words.push_back(word);
  return words;
}

std::string name_of(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/comm");
  std::string name;
  std::getline(file, name);
  return name;
}

// Processes that this one started, or these did.
std::set<pid_t> descendants(pid_t of) {
  std::map<pid_t, pid_t> parents;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const pid_t process = atoi(entry.path().filename().c_str());
    const auto words = process > 0 ? stat_of(process) : std::vector<std::string>();
    if (words.size() > 1 && words[0] != "Z") parents[process] = std::stoi(words[1]);
  }
  std::set<pid_t> found{of};
  for (std::size_t before = 0; before != found.size();) {
    before = found.size();
    for (const auto& [process, parent] : parents)
      if (found.contains(parent)) found.insert(process);
  }
  found.erase(of);
  return found;
}

pid_t find_host(pid_t of = getpid()) {
  for (const pid_t process : descendants(of))
    if (const std::string name = name_of(process); name == "mars-threads" || name == "mars-host") return process;
  return 0;
}

struct Example {
  film::CompiledFilm film = film::load_film(MARS_EXAMPLES "/caterpillar.json", {.size = {{160, 100}}});
  wire::PackedFilm view = film.view();
  std::uint32_t first = std::ranges::max_element(view.intervals(), {}, &wire::Interval::frame_count)->first_frame;
  test::Moves movers = test::movers_at(view, first);
  test::FilmRun rendered = render();

  test::FilmRun render() const {
    test::RunOptions options;
    options.work.frames = {first, first + 1, first + 2};
    return test::run_film(film.block(), options);
  }
  std::shared_ptr<const std::vector<std::byte>> block() const {
    return std::make_shared<std::vector<std::byte>>(film.block().begin(), film.block().end());
  }
};

const Example& example() {
  static const Example example;
  return example;
}

// A studio with one link.
class Studio {
 public:
  explicit Studio(options::Backend backend = options::Backend::threads) {
    options::RenderOptions options;
    options.backend = backend;
    options.nodes = 2;
    link_ = studio::make_host_link(context_, options, MARS_BIN "/mars",
                                   {[this](SurfacePicture picture) { take(std::move(picture)); },
                                    [this](auto, auto picture) { dropped_.push_back(picture); },
                                    [this](auto nodes, auto) { nodes_ = nodes; },
                                    [this](const std::string& trouble) { troubles_.push_back(trouble); }});
  }

  RendererLink& link() { return *link_; }
  void end() { link_.reset(); }
  // Works until it holds; false: it does not come true.
  bool run_until(const std::function<bool()>& holds) {
    const auto last = std::chrono::steady_clock::now() + kPatience;
    while (!holds() && std::chrono::steady_clock::now() < last) context_.run_one_for(std::chrono::milliseconds(50));
    return holds();
  }
  bool shows(std::uint32_t view, std::uint32_t step) {
    return canvases_[view] == example().rendered.frames.at(example().first + step);
  }

  void begin(std::uint32_t view, std::uint32_t picture, std::uint32_t step = 0) {
    link_->begin(view, picture, test::scene_of(example().view, example().first + step, example().movers));
  }
  void draw(std::uint32_t view, std::uint32_t picture, std::uint32_t step) {
    link_->draw(view, picture, test::moved_to(example().view, example().first + step, example().movers), {});
  }

  std::uint32_t nodes() const { return nodes_; }
  const std::vector<std::uint32_t>& dropped() const { return dropped_; }
  const std::vector<std::string>& troubles() const { return troubles_; }
  std::size_t pictures() const { return pictures_; }

 private:
  void take(SurfacePicture picture) {
    ++pictures_;
    std::vector<std::uint32_t>& canvas = canvases_[picture.view];
    canvas.resize(std::size_t{picture.head.width} * picture.head.height);
    auto from = picture.pixels.begin();
    for (const pictures::Rect& rect : picture.rects)
      for (std::uint32_t y = rect.y; y < std::uint32_t{rect.y} + rect.height; ++y, from += rect.width)
        std::transform(from, from + rect.width, canvas.begin() + y * picture.head.width + rect.x,
                       [](std::uint32_t pixel) { return pixel & 0xffffff; });
  }

  boost::asio::io_context context_;
  // Without it, a context that waits for another thread's work alone would stop for good.
  const boost::asio::executor_work_guard<boost::asio::io_context::executor_type> kept_{context_.get_executor()};
  std::uint32_t nodes_ = 0;
  std::size_t pictures_ = 0;
  std::vector<std::uint32_t> dropped_;
  std::vector<std::string> troubles_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> canvases_;
  std::unique_ptr<RendererLink> link_;
};

// Nothing that this process started is left.
void expect_nothing_left() {
  for (int waited = 0; waited < 100 && !descendants(getpid()).empty(); ++waited) poll(nullptr, 0, 20);
  for (const pid_t process : descendants(getpid())) ADD_FAILURE() << name_of(process) << " is left";
}

void expect_pictures(options::Backend backend) {
  Studio studio(backend);
  studio.link().set_film(example().block());
  studio.begin(5, 1);
  ASSERT_TRUE(studio.run_until([&] { return studio.shows(5, 0); }));
  EXPECT_EQ(studio.nodes(), 2u);
  EXPECT_EQ(studio.troubles().back(), "");
  studio.draw(5, 2, 2);
  ASSERT_TRUE(studio.run_until([&] { return studio.shows(5, 2); }));
  EXPECT_TRUE(studio.dropped().empty());
  studio.end();
  expect_nothing_left();
}

TEST(HostLink, BringsPicturesOfAHostThatItStarts) { expect_pictures(options::Backend::threads); }

TEST(HostLink, BringsPicturesOverMpi) {
  if (!MARS_HAVE_MPI) GTEST_SKIP() << "built without MPI";
  expect_pictures(options::Backend::mpi);
}

TEST(HostLink, AnswersAllThatIsAskedForBeforeTheHostIsThere) {
  Studio studio;
  studio.begin(1, 1);  // of no film
  studio.link().set_film(example().block());
  studio.begin(1, 2);
  studio.draw(1, 3, 1);
  studio.begin(1, 4);
  studio.draw(1, 5, 1);
  studio.draw(1, 6, 2);
  studio.draw(2, 7, 2);  // of no scene
  ASSERT_TRUE(studio.run_until([&] { return studio.shows(1, 2); }));
  EXPECT_EQ(studio.dropped(), (std::vector<std::uint32_t>{1, 2, 3, 5, 7}));
  EXPECT_EQ(studio.pictures(), 2u);
}

TEST(HostLink, StartsAKilledHostAgainWithAllViews) {
  Studio studio;
  studio.link().set_film(example().block());
  studio.begin(1, 1);
  studio.draw(1, 2, 1);
  studio.begin(2, 3, 2);
  const auto both = [&] { return studio.shows(1, 1) && studio.shows(2, 2); };
  ASSERT_TRUE(studio.run_until(both));
  const std::size_t before = studio.pictures();
  ASSERT_NE(find_host(), 0);
  kill(find_host(), SIGKILL);
  ASSERT_TRUE(studio.run_until([&] { return !studio.troubles().back().empty(); }));
  EXPECT_NE(studio.troubles().back().find("again in 1 s: mars-threads was killed by signal 9"), std::string::npos)
      << studio.troubles().back();
  ASSERT_TRUE(studio.run_until([&] { return studio.pictures() >= before + 3; }));
  EXPECT_TRUE(both());
  EXPECT_EQ(studio.troubles().back(), "");
  studio.draw(2, 4, 0);
  ASSERT_TRUE(studio.run_until([&] { return studio.shows(2, 0); }));
  studio.end();
  expect_nothing_left();
}

TEST(HostLink, AnotherFilmEndsAllViews) {
  Studio studio;
  studio.link().set_film(example().block());
  studio.begin(1, 1);
  studio.link().set_film(example().block());
  studio.begin(2, 2, 1);
  ASSERT_TRUE(studio.run_until([&] { return studio.shows(2, 1); }));
  EXPECT_EQ(studio.dropped(), std::vector<std::uint32_t>{1});
  EXPECT_EQ(studio.pictures(), 1u);
}

// A studio that is killed leaves no host behind.
TEST(HostLink, EndsWithTheStudio) {
  child::Pipe pipe = child::make_pipe();
  child::Process other(
      [&] {
        Studio studio;
        studio.link().set_film(example().block());
        studio.begin(1, 1);
        studio.run_until([&] { return studio.pictures() > 0; });
        const pid_t host = find_host();
        return write(pipe.writing.number(), &host, sizeof host) > 0 && pause() < 0;
      },
      {});
  pid_t host = 0;
  ASSERT_EQ(read(pipe.reading.number(), &host, sizeof host), static_cast<ssize_t>(sizeof host));
  ASSERT_GT(host, 0);
  other.send(SIGKILL);
  other.wait();
  for (int waited = 0; waited < 500 && kill(host, 0) == 0; ++waited) poll(nullptr, 0, 10);
  EXPECT_NE(kill(host, 0), 0);
}

TEST(HostLink, HostIsHereWhateverMachinesThereAre) {
  const std::vector<launch::Slots> others{{"n1", 4}, {"n2.cluster", 2}};
  EXPECT_EQ(studio::machines_from_here(others, "desk"),
            (std::vector<launch::Slots>{{"desk", 1}, {"n1", 4}, {"n2.cluster", 2}}));
  EXPECT_EQ(studio::machines_from_here(others, "n2"), (std::vector<launch::Slots>{{"n2.cluster", 2}, {"n1", 4}}));
}

}  // namespace
