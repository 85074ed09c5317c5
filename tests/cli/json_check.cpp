// SPDX-FileCopyrightText: 2026 the vsprite authors
// SPDX-License-Identifier: MIT
//
// json_check POINTER... < document - one JSON document, and something stands at every pointer.
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

int main(int argc, char** argv) {
  const std::string text{std::istreambuf_iterator<char>(std::cin), {}};
  const auto document = nlohmann::json::parse(text, nullptr, false);
  if (document.is_discarded()) return std::cerr << "not one JSON document\n", 1;
  int missing = 0;
  for (int i = 1; i < argc; ++i) {
    if (document.contains(nlohmann::json::json_pointer(argv[i]))) continue;
    std::cerr << "nothing stands at " << argv[i] << "\n";
    ++missing;
  }
  return missing == 0 ? 0 : 1;
}
