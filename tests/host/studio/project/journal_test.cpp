// The journal: whatever is in the file, the history that comes out of it fits the file.
#include "host/studio/project/journal.h"

#include <gtest/gtest.h>

#include <fstream>

#include "host/content/document/file.h"
#include "tests/temporary_folder.h"

namespace mars::studio {
namespace {

class Journals : public testing::Test {
 protected:
  // As a project makes a step.
  void step(Journal& journal, History& history, const std::string& name, const std::string& after) {
    const HistoryEntry entry{time_now(), name, change_between(text_, after)};
    journal.write_step(entry, text_, after);
    history.add(entry);
    text_ = after;
  }

  std::string lines() const { return document::read_file(Journal(file_).path()); }
  void set_lines(const std::string& lines) const { std::ofstream(Journal(file_).path()) << lines; }

  test::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_ / "a.json";
  std::string text_ = "one";
};

std::vector<std::string> names(const History& history) {
  std::vector<std::string> names;
  for (const HistoryEntry& entry : history.entries()) names.push_back(entry.name);
  return names;
}

using Names = std::vector<std::string>;

TEST(TextChange, TakesOneTextToTheOtherAndBack) {
  for (const auto& [before, after] : {std::pair<std::string, std::string>{"", ""},
                                      {"aaa", "aaaa"},
                                      {"abc", "axc"},
                                      {"k\xc3\xa4se", "k\xc3\xa5se"},
                                      {"x\xc3\xa4", "x\xe2\x82\xa4"},
                                      {"", "new"},
                                      {"gone", ""}}) {
    const TextChange change = change_between(before, after);
    EXPECT_EQ(change.done(before), after);
    EXPECT_EQ(change.undone(after), before);
  }
  EXPECT_EQ(change_between("k\xc3\xa4se", "k\xc3\xa5se").before, "\xc3\xa4");
  EXPECT_FALSE(change_between("abc", "axc").done("a"));
}

TEST_F(Journals, HistoryIsReadAgain) {
  Journal journal(file_);
  History history;
  step(journal, history, "first", "one two");
  step(journal, history, "second", "three");
  journal.write_undo("three", "one two");
  const auto read = Journal(file_).read("one two");
  ASSERT_TRUE(read);
  EXPECT_EQ(names(*read), (Names{"first", "second"}));
  EXPECT_EQ(read->done(), 1u);
  EXPECT_EQ(read->to_redo()->change.done("one two"), "three");
  EXPECT_EQ(read->to_undo()->change.undone("one two"), "one");
}

TEST_F(Journals, TheFirstJournalIsNone) { EXPECT_FALSE(Journal(file_).read("one")); }

TEST_F(Journals, ALineWhoseEffectNeverCameIsLeftOut) {
  Journal journal(file_);
  History history;
  step(journal, history, "first", "one two");
  step(journal, history, "never", "three");
  auto read = Journal(file_).read("one two");
  ASSERT_TRUE(read);
  EXPECT_EQ(names(*read), Names{"first"});
  text_ = "one two";
  step(journal, *read, "then", "four");
  read = Journal(file_).read("four");
  ASSERT_TRUE(read);
  EXPECT_EQ(names(*read), (Names{"first", "then"}));
}

TEST_F(Journals, AnUndoThatNeverCameIsLeftOut) {
  Journal journal(file_);
  History history;
  step(journal, history, "first", "one two");
  journal.write_undo("one two", "one");
  const auto read = Journal(file_).read("one two");
  ASSERT_TRUE(read);
  EXPECT_EQ(read->done(), 1u);
}

TEST_F(Journals, TornLastLine) {
  Journal journal(file_);
  History history;
  step(journal, history, "first", "one two");
  const std::string whole = lines();
  step(journal, history, "torn", "three");
  const std::string both = lines();
  for (std::size_t size = whole.size(); size < both.size() - 1; ++size) {
    set_lines(both.substr(0, size));
    Journal again(file_);
    auto read = again.read("one two");
    ASSERT_TRUE(read);
    EXPECT_EQ(names(*read), Names{"first"}) << size;
    again.write_step({time_now(), "next", change_between("one two", "five")}, "one two", "five");
    read = Journal(file_).read("five");
    ASSERT_TRUE(read);
    EXPECT_EQ(names(*read), (Names{"first", "next"})) << size;
  }
}

TEST_F(Journals, WhatOthersDidMeanwhileIsAnEntry) {
  Journal journal(file_);
  History history;
  step(journal, history, "first", "one two");
  auto read = Journal(file_).read("one two and more");
  ASSERT_TRUE(read);
  EXPECT_EQ(names(*read), (Names{"first", kChangedOutside}));
  EXPECT_EQ(read->to_undo()->change.undone("one two and more"), "one two");
  EXPECT_EQ(names(*Journal(file_).read("one two and more")), (Names{"first", kChangedOutside}));
}

TEST_F(Journals, ForeignAndDamagedOnesBeginAnew) {
  for (const char* foreign :
       {"", "\n\n", "no json\n", "[]\n", "{\"mars-journal\": 1}\n", "{\"from\": 1, \"to\": []}\n",
        "{\"from\": \"a\", \"to\": \"b\", \"step\": \"x\", \"at\": 99999, \"before\": \"y\"}\n"}) {
    set_lines(foreign);
    Journal journal(file_);
    EXPECT_FALSE(journal.read("one")) << foreign;
    text_ = "one";
    History history;
    step(journal, history, "first", "one two");
    const auto read = Journal(file_).read("one two");
    ASSERT_TRUE(read) << foreign;
    EXPECT_EQ(names(*read), Names{"first"}) << foreign;
  }
}

TEST_F(Journals, AFolderInItsPlaceIsTroubleNotTheEnd) {
  std::filesystem::create_directory(Journal(file_).path());
  Journal journal(file_);
  EXPECT_FALSE(journal.read("one"));
  History history;
  step(journal, history, "first", "one two");
  EXPECT_NE(journal.trouble(), "");
}

TEST_F(Journals, OldEntriesAreForgottenAndTheFileStaysShort) {
  Journal journal(file_);
  History history;
  std::uintmax_t longest = 0;
  for (int i = 0; i < 2 * int(History::kMostEntries); ++i) {
    step(journal, history, "step " + std::to_string(i), std::to_string(i) + std::string(2000, 'x'));
    if (i % 3 == 0) step(journal, history, "big", std::string(2000, char('a' + i % 20)));
    journal.shorten(history, text_);
    longest = std::max(longest, std::filesystem::file_size(journal.path()));
  }
  EXPECT_EQ(history.entries().size(), History::kMostEntries);
  EXPECT_LT(longest, 20u << 20);
  const auto read = Journal(file_).read(text_);
  ASSERT_TRUE(read);
  EXPECT_EQ(names(*read), names(history));
  EXPECT_EQ(read->done(), history.done());
}

TEST_F(Journals, AShortenedOneKeepsWhatCanBeRedone) {
  Journal journal(file_);
  History history;
  text_ = std::string(1'500'000, 'x');
  for (int i = 0; i < 10; ++i) step(journal, history, std::to_string(i), std::string(1000, char('a' + i)) + text_);
  for (int i = 9; i > 5; --i) {
    const std::string before = *history.to_undo()->change.undone(text_);
    journal.write_undo(text_, before);
    history.undo();
    text_ = before;
  }
  const auto size = std::filesystem::file_size(journal.path());
  for (int i = 0; i < 30000 && std::filesystem::file_size(journal.path()) >= size; ++i) {
    const std::string before = *history.to_undo()->change.undone(text_);
    journal.write_undo(text_, before);
    journal.write_redo(before, text_);
    journal.shorten(history, text_);
    if (i > 40) break;
  }
  const auto read = Journal(file_).read(text_);
  ASSERT_TRUE(read);
  EXPECT_EQ(names(*read), names(history));
  EXPECT_EQ(read->done(), history.done());
}

}  // namespace
}  // namespace mars::studio
