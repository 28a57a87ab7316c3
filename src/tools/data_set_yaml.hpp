// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <sks_detector/detection.hpp>

#include "io/dataset.hpp"

namespace sks::tools {

/// Quoted text and lists of numbers for a YAML file. @throws Error(bad_data) for text that is not UTF-8
std::string yamlText(const std::string& text);
std::string yamlList(const std::vector<double>& values);

/// A scene as an entry of a data set file in metres; its cloud and references as they are to stand there.
std::string sceneYaml(const Scene& scene);

/// A scene of which the truth is known as detections: a score is the fraction of the object that is seen, 0 where that
/// is unknown. Objects of which less than 5 % is seen are ignored.
/// @param points how many were measured on each of them; empty: unknown @param least_points fewer: ignored as well
Scene groundTruthScene(const std::string& name, const std::vector<Detection>& truth,
                       const std::vector<std::size_t>& points = {}, std::size_t least_points = 0);

}  // namespace sks::tools
