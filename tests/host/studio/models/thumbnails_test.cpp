// Thumbnails as pages see them, with a program in place of mars: which models are listed, and what is drawn when.
#include "host/studio/models/thumbnails.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <boost/asio/io_context.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "hal/failure/failure.h"
#include "tests/sanitizers/sanitized.h"
#include "tests/temporary_folder.h"

namespace mars::studio {
namespace {

namespace fs = std::filesystem;

// preview FILE --as surface --frames 0 --size WxH -o TO: "draws" the length of the file.
constexpr const char* kMars = R"sh(#!/bin/sh
echo "${2##*/} $(nice)" >> "${0%/*}/drawn"
read -r text < "$2"
case $text in *broken*) echo "mars: $2:1: is no joint (correct it)" >&2; exit 1;; esac
shift 8; printf 'picture' > "$2"
)sh";
constexpr const char* kPicture = "cGljdHVyZQ==";

class ThumbnailsTest : public testing::Test {
 protected:
  ThumbnailsTest() {
    fs::create_directories(folder_ / "films");
    fs::create_directories(folder_ / "temporary");
    std::ofstream(folder_ / "mars") << kMars;
    fs::permissions(folder_ / "mars", fs::perms::owner_all);
    write("film.json", R"({"frames": 1, "actors": [{"joints": 1}]})");
    write("rock.json", R"({"materials": {"actors": 1}, "joints": [{"name": "rock"}]})");
    thumbnails_ = make_thumbnails(context_, {folder_ / "films/film.json", folder_ / "mars", folder_ / "temporary"},
                                  {[this](PageNumber page, const Json& message) {
                                    pages_.push_back(page);
                                    messages_.push_back(message);
                                  }});
  }

  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / "films" / name) << text; }
  void ask(PageNumber page, const std::string& model) {
    thumbnails_->take(page, {{"do", "thumbnail"}, {"model", model}});
  }

  std::vector<std::string> listed() {
    thumbnails_->take(1, {{"do", "models"}});
    return names_of(messages_.back());
  }
  static std::vector<std::string> names_of(const Json& message) {
    std::vector<std::string> names;
    for (const Json& model : message["models"])
      if (model["kind"] == "file") names.push_back(model["name"]);
    return names;
  }

  bool runs_until(std::size_t messages) {
    const auto last = std::chrono::steady_clock::now() + std::chrono::seconds(60) * sanitizers::kSlowness;
    while (messages_.size() < messages && std::chrono::steady_clock::now() < last) {
      thumbnails_->look(true);
      context_.restart();
      context_.run_one_for(std::chrono::milliseconds(10));
    }
    return messages_.size() >= messages;
  }

  std::string drawn() const {
    std::ifstream stream(folder_ / "drawn");
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  using Names = std::vector<std::string>;

  const test::TemporaryFolder folder_;
  boost::asio::io_context context_;
  std::vector<PageNumber> pages_;
  std::vector<Json> messages_;
  std::unique_ptr<Thumbnails> thumbnails_;
};

TEST_F(ThumbnailsTest, ModelsAreTheLibrarysAndThoseBesideTheFilm) {
  write("derived.json", R"({"from": "rock.json"})");
  write("cut.json", R"({"joints": [{"name": "ro)");
  write("list.json", R"(["joints", {"joints": 1}])");
  write("words.json", R"({"scripts": {"joints": 1}})");
  write(".hidden.json", R"({"joints": []})");
  write("empty.json", "");
  EXPECT_EQ(listed(), (Names{"cut.json", "derived.json", "rock.json"}));
  EXPECT_EQ(messages_[0]["models"][0].dump(),
            R"({"name":"man","what":"5.1 units tall, 2.9 to a metre","kind":"figure","version":""})");
}

TEST_F(ThumbnailsTest, APictureIsDrawnOnceAndBehindAllElse) {
  ask(1, "rock.json");
  ask(2, "rock.json");
  ask(1, "ball");
  ASSERT_TRUE(runs_until(3));
  EXPECT_EQ(pages_, (std::vector<PageNumber>{1, 2, 1}));
  EXPECT_EQ(messages_[0]["png"], kPicture);
  EXPECT_EQ(messages_[2]["model"], "ball");
  ask(3, "rock.json");
  ASSERT_EQ(messages_.size(), 4u);  // at once
  EXPECT_EQ(messages_[3]["png"], kPicture);
  EXPECT_EQ(drawn(), "rock.json 10\nball.json 10\n");
  EXPECT_TRUE(fs::is_empty(folder_ / "temporary"));
}

TEST_F(ThumbnailsTest, FilesComeBeforeTheLibrary) {
  ask(1, "ball");
  ask(1, "box");
  ask(1, "rock.json");
  ASSERT_TRUE(runs_until(3));
  EXPECT_EQ(drawn(), "rock.json 10\nball.json 10\nbox.json 10\n");
}

TEST_F(ThumbnailsTest, NothingIsBegunWhileAHandMoves) {
  ask(1, "rock.json");
  for (int look = 0; look < 30; ++look) {
    thumbnails_->look(false);
    context_.restart();
    context_.run_one_for(std::chrono::milliseconds(2));
  }
  EXPECT_EQ(drawn(), "");
  EXPECT_TRUE(runs_until(1));
}

TEST_F(ThumbnailsTest, AChangedFileIsListedAndDrawnAgain) {
  listed();
  ask(1, "rock.json");
  ASSERT_TRUE(runs_until(2));
  write("rock.json", R"({"joints": [{"name": "broken rock"}]})");
  write("new.json", R"({"joints": []})");
  ASSERT_TRUE(runs_until(3));  // it looks at the folder
  EXPECT_EQ(names_of(messages_[2]), (Names{"new.json", "rock.json"}));
  EXPECT_NE(messages_[2]["models"], messages_[0]["models"]);
  ask(1, "rock.json");
  ASSERT_TRUE(runs_until(4));
  EXPECT_EQ(messages_[3]["problem"], (folder_ / "films/rock.json").string() + ":1: is no joint (correct it)");
  EXPECT_FALSE(messages_[3].contains("png"));
}

TEST_F(ThumbnailsTest, OnlyModelsOfTheListAreDrawn) {
  EXPECT_THROW(ask(1, "../rock.json"), Failure);
  EXPECT_THROW(ask(1, "film.json"), Failure);
  ask(1, "rock.json");
  thumbnails_->page_closed(1);
  ask(2, "ball");
  ASSERT_TRUE(runs_until(1));
  EXPECT_EQ(drawn(), "ball.json 10\n");
}

}  // namespace
}  // namespace mars::studio
