// A folder of files to import, and where their models go.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "host/content/importer/import_file.h"

namespace mars::importer {

class ImportFolder : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return folder_ / name;
  }

  // Into model.json, whether it is there or not.
  ImportOptions options_for(const std::filesystem::path& from) const {
    ImportOptions options;
    options.from = from;
    options.to = folder_ / "model.json";
    options.force = true;
    return options;
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() /
      (std::string("mars_") + testing::UnitTest::GetInstance()->current_test_info()->test_suite_name());
};

}  // namespace mars::importer
