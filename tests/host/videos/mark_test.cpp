#include "host/videos/mark.h"

#include <gtest/gtest.h>

namespace mars::videos {
namespace {

TEST(Mark, GoesRoundThroughAText) {
  const Mark mark{"a film.json", "0123", {0, 1, 2, 7}, 9, 29.97, 64, 36};
  EXPECT_EQ(mark_of(text_of(mark)), mark);
}

TEST(Mark, FilesOfAnyVersionAreOurs) {
  EXPECT_TRUE(is_mark(text_of({"", "", {0}, 1, 24, 64, 36}))) << "of a preview";
  EXPECT_TRUE(is_mark(R"({"mars": 2})"));
  for (const char* text : {"", "mars", "[\"mars\"]", R"({"film": "mars"})"}) EXPECT_FALSE(is_mark(text)) << text;
}

TEST(Mark, TextsOfOthersAreNone) {
  for (const char* text :
       {"", "a comment", "{}", "[1]", R"({"mars": 2})", R"({"mars": 1, "film": 3})",
        R"({"mars":1,"film":"a","recipe":"","frames":"0-99","film_frames":3,"rate":1,"size":[1,1]})",
        R"({"mars":1,"film":"a","recipe":"","frames":"0","film_frames":4000000000,"rate":1,"size":[1,1]})",
        R"({"mars":1,"film":"a","recipe":"","frames":"0","film_frames":1e300,"rate":1,"size":[1,1]})",
        R"({"mars":1,"film":"a","recipe":"","frames":"0","film_frames":1,"rate":-24,"size":[1,1]})",
        R"({"mars":1,"film":"a","recipe":"","frames":"0","film_frames":1,"rate":1,"size":[-32,1]})",
        R"({"mars":1,"film":"a","recipe":"","frames":"0","film_frames":1,"rate":1,"size":[1,0]})",
        R"({"mars":1,"film":"a","recipe":"","frames":"0","film_frames":1,"rate":1,"size":[1]})"})
    EXPECT_FALSE(mark_of(text)) << text;
}

}  // namespace
}  // namespace mars::videos
