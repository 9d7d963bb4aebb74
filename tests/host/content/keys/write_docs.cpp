// Writes what docs/ says of keys again, after the table has changed: build/release/bin/write-docs-of-keys
#include <fstream>
#include <iostream>

#include "tests/host/content/keys/docs.h"

int main() {
  for (const auto& [file, text] : mars::keys::docs_of_keys()) {
    std::ofstream(file) << text;
    std::cout << file.string() << '\n';
  }
}
