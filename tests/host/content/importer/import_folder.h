// A folder of files to import, and where their models go.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "host/content/importer/import_file.h"
#include "tests/temporary_folder.h"

namespace mars::importer {

class ImportFolder : public testing::Test {
 protected:
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

  const test::TemporaryFolder folder_;
};

}  // namespace mars::importer
