// SPDX-License-Identifier: BSD-3-Clause
#include <sks_detector/codebook.hpp>

#include <algorithm>

namespace sks {

std::string Codebook::descriptorName() const {
  return own_descriptor.empty() ? EnumNames<DescriptorType>::value[std::size_t(descriptor_type)] : own_descriptor;
}

std::size_t Codebook::descriptorSize() const {
  return own_descriptor.empty() ? sks::descriptorSize(descriptor_type) : descriptors.cols();
}

const RegisteredModel* Codebook::modelOf(const TrainingView& view) const {
  const auto found = std::find_if(models.begin(), models.end(), [&](const RegisteredModel& model) {
    return model.object == view.object && model.frame == view.frame;
  });
  return found == models.end() ? nullptr : &*found;
}

float Codebook::largestExtent() const {
  float largest = 0;
  for (const TrainingView& view : views) largest = std::max(largest, view.extent().maxCoeff());
  return largest;
}

}  // namespace sks
