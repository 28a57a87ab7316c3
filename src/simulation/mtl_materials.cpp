// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cctype>
#include <cmath>

#include "io/number_text.hpp"
#include "simulation/file_mesh.hpp"
#include "simulation/text_lines.hpp"

namespace sks {
namespace {

bool isNumber(std::string_view word, double& value) {
  return parseNumber(std::string(word), value) && std::isfinite(value);
}

std::string keywordOf(std::string_view word) {
  std::string keyword(word);
  std::transform(keyword.begin(), keyword.end(), keyword.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return keyword;
}

/// `Kd r g b`, or `Kd r` for a grey; spectra and CIE XYZ are no colours that could be used.
std::optional<Rgb> diffuseColor(const std::vector<std::string_view>& words) {
  double rgb[3] = {0, 0, 0};
  std::size_t count = 0;
  while (count < 3 && count + 1 < words.size() && isNumber(words[count + 1], rgb[count])) ++count;
  if (count != 1 && count != 3) return std::nullopt;
  if (count == 1) rgb[1] = rgb[2] = rgb[0];
  const auto byte = [](double value) { return std::uint8_t(std::lround(255 * std::clamp(value, 0.0, 1.0))); };
  return Rgb{byte(rgb[0]), byte(rgb[1]), byte(rgb[2])};
}

/// `map_Kd [-option value ...] name`.
void readTexture(const TextLines& line, FileMaterial& material) {
  const std::vector<std::string_view>& words = line.words();
  std::size_t at = 1;
  while (at + 1 < words.size() && words[at].size() > 1 && words[at][0] == '-') {
    const std::string option = keywordOf(words[at++]);
    const bool moves = option == "-o" || option == "-s" || option == "-t";
    const std::size_t most = moves ? 3 : option == "-mm" ? 2 : 1;
    const double neutral = option == "-s" ? 1 : 0;
    double value = 0;
    for (std::size_t k = 0; k < most && at + 1 < words.size(); ++k, ++at) {
      if (moves && !isNumber(words[at], value)) break;
      if (moves && value != neutral) material.problem = "its option " + option + " is not understood";
    }
    if (option == "-clamp" && words[at - 1] == "on") material.problem = "its option -clamp is not understood";
  }
  material.texture = line.after(at);
}

}  // namespace

void readMaterials(const std::string& path, std::map<std::string, FileMaterial>& materials) {
  const std::string content = MeshFiles::read(path);
  FileMaterial* material = nullptr;
  for (TextLines line(content); line.next();) {
    const std::string keyword = keywordOf(line.words()[0]);
    if (keyword == "newmtl") {
      const std::string name = line.after(1);
      material = &(materials[name] = FileMaterial());
      material->name = name;
      material->file = path;
    } else if (material != nullptr && keyword == "kd") {
      material->color = diffuseColor(line.words());
    } else if (material != nullptr && keyword == "map_kd") {
      readTexture(line, *material);
    }
  }
}

}  // namespace sks
