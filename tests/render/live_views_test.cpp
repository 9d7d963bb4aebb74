// Live views: every picture is, bit for bit, the frame of a film that shows the same moment, whatever was asked for
// before and besides.
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "node/firmware.h"
#include "node/wire/scene.h"
#include "tests/hal/machines_backend.h"
#include "tests/render/films.h"
#include "tests/render/live_host.h"
#include "tests/render/looks.h"

namespace mars::test {
namespace {

constexpr std::uint32_t kTeapot = 1, kSphere = 2, kLastBall = 11;  // segments of the crowd

// A moment of the crowd, which can be edited, as a film of one frame or as a scene of the film that it was made from.
class Moment {
 public:
  // With `shadows`, its lights cast.
  Moment(std::uint32_t width, std::uint32_t height, std::uint32_t samples, bool shadows = false)
      : film_(richly_lit(with_samples(crowd(width, height, 1, 1), samples))),
        base_shapes_(film_.shapes.size()),
        base_patches_(static_cast<std::uint32_t>(film_.patches.size())) {
    if (shadows) film_ = casting(film_, {0.0f, 0.0f, 0.0f});
  }

  const wire::FilmData& film() const { return film_; }
  // By rounding, pixels of several samples depend on what moves.
  Moment& moving(const std::vector<std::uint32_t>& segments) {
    film_.moving = segments;
    film_.intervals = {{0, 1, 0, static_cast<std::uint32_t>(segments.size())}};
    return *this;
  }
  wire::Matrix& matrix(std::uint32_t segment) { return film_.matrices[value(film_.segments[segment].motion)]; }
  std::uint32_t& material(std::uint32_t segment) { return value(film_.segments[segment].material); }
  wire::Camera& camera() { return film_.cameras.front(); }
  // Gives the segment a shape of its own, whose patches can be pulled.
  void give_shape(std::uint32_t segment) {
    const wire::Shape old = film_.shapes[film_.segments[segment].shape];
    film_.segments[segment].shape = static_cast<std::uint32_t>(film_.shapes.size());
    film_.shapes.push_back({static_cast<std::uint32_t>(film_.patches.size()), old.patch_count});
    for (std::uint32_t i = 0; i < old.patch_count; ++i) {
      const wire::Patch copy = film_.patches[old.first_patch + i];
      film_.patches.push_back(copy);
    }
  }
  // Of the scene block.
  std::uint32_t patches() const { return static_cast<std::uint32_t>(film_.patches.size()) - base_patches_; }
  wire::Patch& patch(std::uint32_t number) { return film_.patches[base_patches_ + number]; }

  wire::FilmData scene() const {
    wire::FilmData scene = film_;
    scene.patches.erase(scene.patches.begin(), scene.patches.begin() + base_patches_);
    scene.shapes.erase(scene.shapes.begin(), scene.shapes.begin() + static_cast<std::ptrdiff_t>(base_shapes_));
    for (wire::Shape& shape : scene.shapes) shape.first_patch -= base_patches_;
    scene.mesh_places.clear(), scene.mesh_normals.clear(), scene.mesh_triangles.clear(), scene.meshlets.clear();
    return scene;
  }
  std::vector<std::uint32_t> all() const {
    std::vector<std::uint32_t> segments;
    for (std::uint32_t s = 0; s < film_.segments.size(); ++s) segments.push_back(s);
    return segments;
  }

 private:
  std::uint32_t& value(const wire::Track& track) { return film_.changes[track.first].value; }

  wire::FilmData film_;
  std::size_t base_shapes_;
  std::uint32_t base_patches_;
};

struct Size {
  std::uint32_t width, height, samples;
  bool shadows = false;
};

// An edit of a moment that is also said as a Draw's change.
class SceneEdit {
 public:
  explicit SceneEdit(const Moment& keyframe) : moment_(keyframe) {}
  SceneEdit& move(std::uint32_t segment, double by) {
    wire::Matrix& matrix = moment_.matrix(segment);
    matrix.m[0][3] += by;
    matrix.m[2][3] += by / 3;
    change_.segments.push_back({segment, moment_.material(segment), matrix});
    return *this;
  }
  SceneEdit& paint(std::uint32_t segment, std::uint32_t material) {
    moment_.material(segment) = material;
    change_.segments.push_back({segment, material, moment_.matrix(segment)});
    return *this;
  }
  SceneEdit& pull(std::uint32_t patch, float by) {
    for (std::size_t k = 5; k < 11; ++k) moment_.patch(patch).points[k][2] += by;
    change_.patches.push_back({patch, 0, moment_.patch(patch)});
    return *this;
  }
  const Moment& moment() const { return moment_; }
  const Change& change() const { return change_; }

 private:
  Moment moment_;
  Change change_;
};

void expect_shows(const LivePicture& picture, const Moment& moment, const std::string& name) {
  const FilmRun expected = run_film(FilmBlock(moment.film()).bytes());
  FilmRun live;
  live.frames[0] = picture.pixels;
  expect_same(live, expected, moment.film().settings, name);
}

// Answers are put together on a thread of their own, for comparing takes a job of its own.
class LiveViews : public testing::TestWithParam<int> {
 protected:
  struct Expected {
    LivePicture picture;
    Moment moment;
    std::string name;
  };

  void run(const std::function<void(LiveHost& host)>& body, const threads::WrapBackend& wrap = {}) {
    threads::run_threads(
        GetParam(),
        [&] {
          LiveHost host;
          body(host);
        },
        [] {
          node::run_node({"test", "", {}, 64 << 20, ""});
        },
        wrap);
    for (const auto& [picture, moment, name] : expected_)
      expect_shows(picture, moment, "live-" + std::to_string(GetParam()) + "-" + name);
  }
  // Once all has ended.
  void expect(LivePicture picture, const Moment& moment, const std::string& name) {
    EXPECT_FALSE(picture.cut()) << name;
    expected_.push_back({std::move(picture), moment, name});
  }
  int some_node(LiveHost& host) { return static_cast<int>(turn_++ % static_cast<std::uint32_t>(host.nodes())); }

  // An interval of a view: its keyframe and inbetweens of all kinds.
  void show(LiveHost& host, std::uint32_t view, const Size& size, const std::string& name,
            std::uint64_t still_memory = 64 << 20) {
    Moment moment(size.width, size.height, size.samples, size.shadows);
    moment.give_shape(kSphere);
    moment.moving({kTeapot, kSphere, kLastBall});
    expect(host.finish(host.begin(view, moment.scene(), still_memory)), moment, name + "-keyframe");
    const std::vector<std::pair<const char*, SceneEdit>> edits = {
        {"moved", SceneEdit(moment).move(kTeapot, 0.7)},
        {"painted", SceneEdit(moment).paint(kLastBall, 0).move(kTeapot, -0.4)},
        {"pulled", SceneEdit(moment).pull(1, 0.4f).pull(3, -0.2f)},
        {"pulled-more", SceneEdit(moment).pull(3, 0.3f).move(kSphere, 0.3)},
        {"back", SceneEdit(moment)}};
    for (const auto& [what, edit] : edits) {
      const int node = some_node(host);
      const LivePicture picture = host.finish(host.draw(view, edit.change(), node));
      ASSERT_EQ(picture.lasts.size(), 1u);
      EXPECT_EQ(picture.lasts.front().node, node);
      expect(picture, edit.moment(), name + "-" + what);
    }
  }

 private:
  std::vector<Expected> expected_;
  std::uint32_t turn_ = 0;
};

wire::FilmData small_crowd() { return crowd(16, 16, 1, 1); }

TEST_P(LiveViews, ShowTheirMoments) {
  run([&](LiveHost& host) {
    host.load(small_crowd());
    show(host, 0, {96, 64, 1}, "one-sample");
    show(host, 1, {64, 48, 4}, "samples");
    show(host, 0, {80, 50, 4}, "resized");
    show(host, 0, {80, 50, 4}, "again");
    show(host, 2, {60, 40, 4}, "not-kept", 0);
    host.close(0);
    show(host, 0, {70, 45, 2}, "reopened");
  });
}

TEST_P(LiveViews, WithShadowsShowTheirMoments) {
  run([&](LiveHost& host) {
    host.load(small_crowd());
    show(host, 0, {48, 32, 1, true}, "shadows-one-sample");
    show(host, 1, {40, 27, 4, true}, "shadows-samples");
    show(host, 2, {32, 20, 4, true}, "shadows-not-kept", 0);
  });
}

TEST_P(LiveViews, OnSeveralMachines) {
  messages::Machines machines(2);
  messages::Counts counts;
  run(
      [&](LiveHost& host) {
        host.load(small_crowd());
        show(host, 0, {64, 48, 1}, "machines-one-sample");
        show(host, 1, {64, 48, 4}, "machines-samples");
        show(host, 2, {32, 20, 4, true}, "machines-shadows");
      },
      [&](messages::Backend& inner) { return std::make_unique<messages::MachinesBackend>(inner, counts, machines); });
}

TEST_P(LiveViews, OfSeveralSizesTakeTurns) {
  run([&](LiveHost& host) {
    host.load(small_crowd());
    const std::vector<Size> sizes = {{96, 64, 1}, {33, 70, 4}, {120, 20, 2}};
    std::vector<Moment> moments;
    for (std::uint32_t v = 0; v < sizes.size(); ++v) {
      moments.push_back(Moment(sizes[v].width, sizes[v].height, sizes[v].samples).moving({kTeapot, kLastBall}));
      expect(host.finish(host.begin(v, moments[v].scene())), moments[v], "turns-keyframe");
    }
    for (int turn = 0; turn < 3; ++turn) {
      std::vector<std::pair<std::uint32_t, SceneEdit>> asked;
      for (std::uint32_t v = 0; v < sizes.size(); ++v) {
        const SceneEdit edit = SceneEdit(moments[v]).move(kTeapot, 0.2 * turn).move(kLastBall, -0.1 * turn);
        asked.emplace_back(host.draw(v, edit.change(), some_node(host)), edit);
      }
      for (const auto& [picture, edit] : asked) expect(host.finish(picture), edit.moment(), "turns");
    }
  });
}

// As where the camera moves.
TEST_P(LiveViews, InWhichAllMoves) {
  run([&](LiveHost& host) {
    host.load(small_crowd());
    Moment moment(90, 60, 4);
    moment.moving(moment.all());
    for (int k = 0; k < 3; ++k) {
      moment.camera().world_to_eye.m[0][3] += 0.3;
      expect(host.finish(host.begin(3, moment.scene())), moment, "orbit");
    }
    const SceneEdit edit = SceneEdit(moment).move(0, 0.5).move(kTeapot, 1);
    expect(host.finish(host.draw(3, edit.change(), some_node(host))), edit.moment(), "all-moved");
    moment.moving({});
    expect(host.finish(host.begin(3, moment.scene())), moment, "rest");
  });
}

TEST_P(LiveViews, InbetweensDrawWhatMovesAlone) {
  run([&](LiveHost& host) {
    host.load(small_crowd());
    const Moment moment = Moment(96, 64, 4).moving({kTeapot});
    const LivePicture keyframe = host.finish(host.begin(0, moment.scene()));
    const SceneEdit edit = SceneEdit(moment).move(kTeapot, 0.5);
    const LivePicture inbetween = host.finish(host.draw(0, edit.change(), some_node(host)));
    std::uint64_t all = 0;
    for (const wire::Strip& strip : keyframe.lasts) all += strip.work.triangles;
    const wire::Strip& last = inbetween.lasts.at(0);
    EXPECT_GT(last.work.triangles, 0u);
    EXPECT_LT(last.work.triangles, all / 2);
    EXPECT_EQ(last.work.lines_drawn_again, 0u);
    EXPECT_EQ(last.work.bytes_to_nodes, 0u);
  });
}

TEST_P(LiveViews, EndWhereNewOnesBegin) {
  run([&](LiveHost& host) {
    host.load(small_crowd());
    const Moment old_one = Moment(400, 300, 4).moving({kTeapot}), other = Moment(64, 48, 1).moving({kTeapot});
    const Moment latest_one = Moment(400, 300, 4).moving({kTeapot, kLastBall});
    bool any_cut = false;
    for (int k = 0; k < 6; ++k) {
      const std::uint32_t old = host.begin(0, old_one.scene());
      const std::uint32_t between = host.begin(1, other.scene());
      const std::uint32_t drawn = host.draw(0, SceneEdit(old_one).move(kTeapot, 0.1 * k).change(), some_node(host));
      const std::uint32_t latest = host.begin(0, latest_one.scene());
      any_cut |= host.finish(old).cut();
      expect(host.finish(between), other, "beside-cut");
      host.finish(drawn);
      expect(host.finish(latest), latest_one, "after-cut");
      const SceneEdit edit = SceneEdit(latest_one).move(kTeapot, 0.3).paint(kLastBall, 1);
      expect(host.finish(host.draw(0, edit.change(), some_node(host))), edit.moment(), "drawn-after-cut");
    }
    EXPECT_TRUE(any_cut);
    const std::uint32_t closed = host.begin(0, old_one.scene());
    host.close(0);
    host.finish(closed);
    expect(host.finish(host.begin(0, other.scene())), other, "after-close");
  });
}

TEST_P(LiveViews, EndWithTheirFilm) {
  run([&](LiveHost& host) {
    const Moment moment = Moment(200, 150, 4).moving({kTeapot});
    host.load(small_crowd());
    show(host, 5, {64, 48, 2}, "first-film");
    host.begin(0, moment.scene());
    host.draw(0, SceneEdit(moment).move(kTeapot, 1).change(), some_node(host));
    host.begin(1, moment.scene());
    wire::FilmData other = small_crowd();
    std::swap(other.shapes[0], other.shapes[1]);
    host.load(other);
    host.load(small_crowd());
    show(host, 0, {64, 48, 4}, "next-film");
    host.begin(0, moment.scene());
  });
}

INSTANTIATE_TEST_SUITE_P(Nodes, LiveViews, testing::Values(1, 2, 3, 5));

}  // namespace
}  // namespace mars::test
