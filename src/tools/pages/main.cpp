// SPDX-License-Identifier: BSD-3-Clause
// Writes the completion script and the manual page of `sks`, when it is built.
#include <exception>
#include <iostream>
#include <string>

#include "io/file.hpp"
#include "tools/application.hpp"
#include "tools/pages/pages.hpp"

int main(int argc, char** argv) try {
  if (argc != 5) {
    std::cerr << "usage: sks_pages COMPLETION MANUAL VERSION DATE\n";
    return 2;
  }
  const auto app = sks::tools::makeApplication();
  sks::writeFileAtomically(argv[1], sks::tools::completionScript(*app));
  sks::writeFileAtomically(argv[2], sks::tools::manualPage(*app, argv[3], argv[4]));
  return 0;
} catch (const std::exception& error) {
  std::cerr << "sks_pages: " << error.what() << "\n";
  return 1;
}
