// docs/ says of keys what their table says.
#include <gtest/gtest.h>

#include "host/content/document/file.h"
#include "tests/host/content/keys/docs.h"

namespace mars::keys {
namespace {

TEST(Docs, SayOfKeysWhatTheTableSays) {
  for (const auto& [file, text] : docs_of_keys())
    EXPECT_TRUE(document::read_file(file) == text)
        << file << ": write it again with build/release/bin/write-docs-of-keys";
}

}  // namespace
}  // namespace mars::keys
